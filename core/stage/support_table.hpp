// Supports in the changes of a stage, a row for each kind.
#pragma once

#include <string>
#include <vector>

#include "core/model/supports_state.hpp"
#include "core/stage/excavation.hpp"
#include "core/stage/install_bolts.hpp"
#include "core/stage/install_linings.hpp"

namespace voussoir {

// A kind without entries is installed and removed with another kind.
template <int Dim>
struct StageSupport {
  SupportKind kind;
  // removes supports fixed in blocks that no longer exist
  void (*remove)(const Model<Dim>&, State<Dim>&) = nullptr;
  // keeps supports fixed in parts of blocks that remain after an excavation
  void (*carry)(const Model<Dim>& before, const Model<Dim>& model, const Excavated<Dim>&, State<Dim>&) = nullptr;
  // Installs those of these names; returns the names of those without effect. Throws std::invalid_argument if they are
  // too weak for their pretension.
  std::vector<std::string> (*install)(const Model<Dim>&, const std::vector<std::string>&, State<Dim>&) = nullptr;
  // a message about one without effect
  std::string (*describe_idle)(const std::string& name) = nullptr;
  // adds the bodies of these supports, if they have any, to the model of the stage
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
