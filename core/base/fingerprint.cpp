#include "core/base/fingerprint.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace voussoir {

std::string fingerprint(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char character : text) {
    hash ^= static_cast<unsigned char>(character);
    hash *= 0x100000001b3u;
  }
  return fmt::format("fnv1a64:{:016x}", hash);
}

}  // namespace voussoir
