// The supports that stages have installed.
#pragma once

#include <cstddef>
#include <vector>

#include "core/model/bodies_state.hpp"
#include "core/support/grouted_bolt.hpp"
#include "core/support/lining.hpp"

namespace voussoir {

// The kinds of supports. Each room that treats each of them differently has a table with a row for each:
// support_table.hpp in core/scene, core/stage, core/step and core/output.
enum class SupportKind { bolt, grouted_bolt, lining };
inline constexpr std::size_t support_kinds = 3;

// whether a table has a row for each kind, in their order
template <class Table>
constexpr bool has_each_kind(const Table& table) {
  std::size_t next = 0;
  for (const auto& row : table)
    if (static_cast<std::size_t>(row.kind) != next++) return false;
  return next == support_kinds;
}

template <int Dim>
struct SupportsState {
  std::vector<BoltSpring<Dim>> bolt_springs;  // of the bolts installed so far, in their order
  std::vector<GroutedBolt<Dim>> grouted;      // bars of those that are grouted, in the order of their springs
  std::vector<LiningState> linings;           // installed so far
};

// a body as a node of a lining
BeamNode moved_node(const BodiesState<2>& bodies, int body);

// the forces of an installed lining's beams, in their order
std::vector<BeamForces> forces_of_beams(const Lining& lining, const BodiesState<2>& bodies);

}  // namespace voussoir
