#include "core/probability/latin_hypercube.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <utility>

#include "core/joint_sets/random_stream.hpp"
#include "core/probability/normal.hpp"

namespace voussoir {

std::vector<double> latin_column(int rows, std::uint64_t seed, const std::string& name) {
  RandomStream stream(seed, fmt::format("latin hypercube of {} rows of {}", rows, name));
  std::vector<double> column;
  for (int k = 0; k < rows; ++k) {
    // from the nearer tail: place is from the nearer end, in classes
    const double within = stream.uniform(), place = 2 * k < rows ? k + within : rows - k - within;
    const double z = normal_quantile(place / rows);
    column.push_back(2 * k < rows ? z : -z);
  }
  // Fisher & Yates
  for (std::size_t left = column.size(); left > 1; --left)
    std::swap(column[left - 1], column[static_cast<std::size_t>(stream.uniform() * static_cast<double>(left))]);
  return column;
}

}  // namespace voussoir
