// A load in the table of loads.cpp, or of a support in support_table.hpp.
#pragma once

#include <vector>

#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// the data that loads depend on, of one state
template <int Dim>
struct LoadInputs {
  const Schedule& schedule;
  const BodiesState<Dim>& bodies;
  const ContactsState<Dim>& contacts;
  const SupportsState<Dim>& supports;
  const std::vector<ReliefLoad<Dim>>& relief;
  const OpenSidesState<Dim>& open_sides;
};

template <int Dim>
LoadInputs<Dim> load_inputs(const State<Dim>& state) {
  return {state.schedule, state.bodies, state.contacts, state.supports, state.loads.relief, state.loads.open_sides};
}

// A load: whether there is any, its forces on the bodies, whose loads are zero before, and, if it changes with the
// body's pose, a bound of the change (for the time step) and the change itself (for Newton's method).
template <int Dim>
struct LoadRow {
  using Block = typename PairStiffness<Dim>::Block;
  Source source;
  bool (*acts)(const Model<Dim>&, const LoadInputs<Dim>&);
  void (*find)(const Model<Dim>&, int threads, const LoadInputs<Dim>&, std::vector<Load<Dim>>&);
  void (*stiffen)(const Model<Dim>&, const LoadInputs<Dim>&, std::vector<BodyStiffness>&) = nullptr;
  void (*add_tangent)(const Model<Dim>&, const LoadInputs<Dim>&, std::vector<Block>&) = nullptr;
};

}  // namespace voussoir
