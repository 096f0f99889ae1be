// A short fingerprint of an input, to tell whether a result still belongs to it. Not a defence against forgery.
#pragma once

#include <string>
#include <string_view>

namespace voussoir {

// "fnv1a64:" and 16 hexadecimal digits: FNV-1a, 64 bits (Fowler, Noll & Vo)
std::string fingerprint(std::string_view text);

}  // namespace voussoir
