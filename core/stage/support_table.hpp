// What a stage does with supports, a row for each kind.
#pragma once

#include <string>
#include <vector>

#include "core/model/supports_state.hpp"
#include "core/stage/excavation.hpp"
#include "core/stage/install_bolts.hpp"
#include "core/stage/install_linings.hpp"

namespace voussoir {

// A kind without entries is installed and removed with another.
template <int Dim>
struct StageSupport {
  SupportKind kind;
  // removes what was fixed in blocks that are no longer there
  void (*remove)(const Model<Dim>&, State<Dim>&) = nullptr;
  // leaves what is fixed in parts of blocks that an excavation has left
  void (*carry)(const Model<Dim>& before, const Model<Dim>& model, const Excavated<Dim>&, State<Dim>&) = nullptr;
  // Puts in those of these names; gives the names of those that hold nothing. Throws std::invalid_argument where they
  // cannot take what they are to carry.
  std::vector<std::string> (*install)(const Model<Dim>&, const std::vector<std::string>&, State<Dim>&) = nullptr;
  // a sentence about one that holds nothing
  std::string (*describe_idle)(const std::string& name) = nullptr;
  // gives the model of the stage the bodies of those of these names that have some
  void (*add_bodies)(Model<Dim>&, const std::vector<std::string>&) = nullptr;
};

// in the order in which they are installed
template <int Dim>
constexpr StageSupport<Dim> stage_supports[] = {
    {.kind = SupportKind::bolt,
     .remove = remove_springs<Dim>,
     .carry = carry_bolts<Dim>,
     .install = install_bolts<Dim>,
     .describe_idle = describe_idle_bolts},
    {.kind = SupportKind::grouted_bolt},  // with the bolts, among whose springs its joints are
    {.kind = SupportKind::lining,
     .remove = release_linings<Dim>,
     .carry = carry_linings<Dim>,
     .install = install_linings<Dim>,
     .describe_idle = describe_idle_lining,
     .add_bodies = add_lining_nodes<Dim>},
};
static_assert(has_each_kind(stage_supports<2>) && has_each_kind(stage_supports<3>), "a row for each kind of support");

}  // namespace voussoir
