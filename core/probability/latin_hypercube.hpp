// Latin hypercube (McKay, Beckman & Conover 1979): each key's values fall one into each of n classes of equal
// probability, in an order of the key's own. For means and deviations, hardly for probabilities.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace voussoir {

// The column of one key: `rows` standard normals; depends on seed, name and number of rows alone, and is not the
// beginning of a longer column.
std::vector<double> latin_column(int rows, std::uint64_t seed, const std::string& name);

}  // namespace voussoir
