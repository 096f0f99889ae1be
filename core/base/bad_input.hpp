// Input that is valid in itself but not supported here: one line for people; the program ends with exit code 2.
#pragma once

#include <stdexcept>

namespace voussoir {

class BadInput : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace voussoir
