#include "core/scene/keys/supports.hpp"

namespace voussoir::keys {

// clang-format off
std::vector<KeyRow> support_rows() {
  return {
    {.key = "bolts", .type = tables, .holds = {"bolts"},
     .meaning = "rock bolts and cables, which a stage installs"},
    {.key = "linings", .type = tables, .holds = {"linings"},
     .meaning = "linings of openings, in the plane: beams between nodes on an excavation's outline, which a stage installs"},
  };
}
// clang-format on

std::vector<KeyTable> support_keys() {
  std::vector<KeyTable> all = bolt_keys();
  all.push_back(lining_keys());
  return all;
}

}  // namespace voussoir::keys
