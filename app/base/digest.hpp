// A hash that distinguishes inputs, programs and results: 128 bits, so that a chance collision is practically
// impossible.
#pragma once

#include <string>
#include <string_view>

namespace voussoir {

// 32 hexadecimal digits: XXH3 with 128 bits (xxHash's canonical form). Not a defence against forgery.
std::string digest(std::string_view bytes);

}  // namespace voussoir
