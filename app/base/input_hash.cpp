#include "app/base/input_hash.hpp"

#include "core/base/fingerprint.hpp"

namespace voussoir {

std::string input_hash(const Scene& scene) {
  return fingerprint(canonical_text(scene));
}

}  // namespace voussoir
