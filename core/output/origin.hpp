// The origin of results: the program and the C library that computed them. The program does not determine the last bits
// alone, because the C library chooses its sine, exponential and power by processor.
#pragma once

#include <string>
#include <vector>

namespace voussoir {

struct Origin {
  std::string program;         // hash of the program's file
  std::string math_functions;  // math_functions_hash() of the process
  bool portable_math = false;  // set if it used the functions that every x86-64 processor has

  friend bool operator==(const Origin&, const Origin&) = default;
};

// Hash of 2,000 values of each function of the C library that the core calls and that may differ in the last bit
// by processor or version. Costs less than 1 ms, once.
const std::string& math_functions_hash();

// false: it was there already
bool add_origin(std::vector<Origin>& origins, const Origin& origin);

}  // namespace voussoir
