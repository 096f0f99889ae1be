// Everything that a state or a progress holds, as bytes: two are the same to the bit when these are equal.
#pragma once

#include <cereal/archives/binary.hpp>
#include <sstream>
#include <string>

#include "core/checkpoint/fields.hpp"

namespace voussoir {

template <class T>
std::string bytes_of(const T& object) {
  std::ostringstream stream(std::ios::binary);
  cereal::BinaryOutputArchive archive(stream);
  archive(object);
  return std::move(stream).str();
}

}  // namespace voussoir
