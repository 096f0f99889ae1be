#include "app/base/digest.hpp"

#include <fmt/format.h>
#include <xxhash.h>

namespace voussoir {

std::string digest(std::string_view bytes) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits(bytes.data(), bytes.size()));
  std::string text;
  for (const unsigned char byte : canonical.digest)
    text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace voussoir
