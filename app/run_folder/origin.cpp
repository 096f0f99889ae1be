#include "app/run_folder/origin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "app/run_folder/child_process.hpp"
#include "core/base/bad_input.hpp"

namespace voussoir {
namespace {

constexpr const char *variable = "GLIBC_TUNABLES", *capabilities = "glibc.cpu.hwcaps=";

// the criterion by which glibc (2.33 and later) chooses its fused functions
constexpr const char* without_fused = "-FMA,-FMA4";

std::string tunables() {
  const char* const stated = std::getenv(variable);
  return stated ? stated : "";
}

bool is_portable() {
  return !tunables().empty() && with_portable_math(tunables()) == tunables();
}

}  // namespace

std::string with_portable_math(const std::string& stated) {
  // tunables are separated by colons; of a name that appears twice only the last counts
  const std::size_t found = fmt::format(":{}", stated).rfind(fmt::format(":{}", capabilities));
  if (found == std::string::npos)
    return fmt::format("{}{}{}{}", stated, stated.empty() ? "" : ":", capabilities, without_fused);
  const std::size_t end = std::min(stated.find(':', found), stated.size());
  const std::string_view list = std::string_view(stated).substr(found, end - found);
  if (list.ends_with(without_fused)) return stated;
  return stated.substr(0, end) + "," + without_fused + stated.substr(end);
}

Origin this_origin() {
  return {program_digest(), math_functions_hash(), is_portable()};
}

void ask_for_portable_math() {
#if defined(__GLIBC__) && defined(__x86_64__)
  ::setenv(variable, with_portable_math(tunables()).c_str(), 1);
#else
  throw BadInput("--portable-math: only glibc on x86-64 offers a choice of functions; leave it out");
#endif
}

}  // namespace voussoir
