// [[monitors]]
#include "core/prepared.hpp"
#include "core/scene/keys/ranges.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir {

using enum KeyType;
using namespace key_ranges;

namespace {

std::vector<std::string_view> words() {
  std::vector<std::string_view> words;
  for (const Monitored& followed : monitored_quantities())
    words.push_back(followed.word);
  return words;
}

}  // namespace

// clang-format off
KeyTable monitor_keys() {
  return {"monitors", {
    {.key = "name", .type = name, .example = "\"wedge\"", .required = true,
     .meaning = "unique among the monitors; begins its columns in history.csv"},
    {.key = "quantities", .type = choices, .example = "[\"displacement\", \"rotation\"]",
     .required = true, .choices = words(),
     .meaning = "contact_force: resultant over the contacts of a joint, which `joint` names; the others: of one block that a "
         "selector chooses; …_load: what acts on it from one source, applied_load by stage.force; velocities are those of half a step before"},
    {.key = "joint", .type = name, .example = "\"A\"",
     .meaning = "joint of contact_force"},
  }};
}
// clang-format on

}  // namespace voussoir
