#include "core/base/version.hpp"

// written at build time by cmake/version.cmake; this is the only file that includes it, so a new commit rebuilds only
// this
#if __has_include("voussoir_version.h")
#include "voussoir_version.h"
#else
#define VOUSSOIR_VERSION "unknown"
#define VOUSSOIR_COMMIT "unknown"
#endif

namespace voussoir {

std::string version() {
  return VOUSSOIR_VERSION;
}

std::string commit() {
  return VOUSSOIR_COMMIT;
}

std::string compiler() {
#if defined(__clang__)
  return "Clang " + std::to_string(__clang_major__) + "." + std::to_string(__clang_minor__) + "." +
         std::to_string(__clang_patchlevel__);
#elif defined(__GNUC__)
  return "GNU " + std::to_string(__GNUC__) + "." + std::to_string(__GNUC_MINOR__) + "." +
         std::to_string(__GNUC_PATCHLEVEL__);
#else
  return "unknown";
#endif
}

bool fast_arithmetic() {
#ifdef VOUSSOIR_FAST_ARITHMETIC
  return true;
#else
  return false;
#endif
}

}  // namespace voussoir
