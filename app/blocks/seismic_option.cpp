#include "app/blocks/seismic_option.hpp"

#include <fmt/format.h>

#include "app/base/arguments.hpp"
#include "core/base/bad_input.hpp"
#include "text/angle.hpp"

namespace voussoir {

SeismicRequest seismic_request(const std::string& text) {
  constexpr const char* form = "a coefficient, or coefficient/trend in degrees, for example 0.12 or 0.12/180";
  const std::vector<double> numbers = slashed(text, "--seismic", form);
  if (numbers.size() > 2) throw BadInput(fmt::format("--seismic {}: write {}", text, form));
  SeismicRequest request;
  request.coefficient = numbers[0];
  if (numbers.size() == 2) request.trend = numbers[1] * degree;
  return request;
}

}  // namespace voussoir
