// A grouted bar in its blocks (cases/support/README.md). The input of grout.hpp, the displacement of the rock along the
// bar, is the same at all nodes in a block, since a block is rigid; from one block to the next it increases by the
// opening of their joint along the bar:
//
//   w_j = s|d_j| - l_j, or a_j · d_j if l_j = 0;   g_i = sum of the w_j before node i,
//
// d_j, s, l_j and a_j those of a spring at joint j (bolt.hpp), its anchors fixed in the block before and the one behind
// at the bar's position at installation. That spring pulls on both blocks with the tension N_j of the element across
// the joint, along s d_j/|d_j| or a_j, both forces at its second anchor. These are the derivatives by the blocks'
// motion of
//
//   sum of f_i dg_i = sum over j of dw_j (sum of the forces f_i on the rock behind j) = - sum over j of N_j dw_j
//
// for equilibrium of the bar behind j. So forces and moments balance at every joint by themselves, moving all blocks as
// one causes no force, and without slip and yield the forces have the energy stored in the bar as potential. With
// anchors apart the bar is deflected over l_j when a joint slips, and resists it; with both at the joint only opening
// counts.
#pragma once

#include <vector>

#include "core/support/bolt.hpp"
#include "core/support/grout.hpp"

namespace voussoir {

template <int Dim>
struct GroutedBolt {
  int bolt = 0;          // Model::bolts
  int first_spring = 0;  // State::supports.bolt_springs: those of its joints are there one after the other
  GroutedBar bar;        // s from the point at which the bolt enters the rock
  GroutedBarState state;
  std::vector<int> body;           // by node
  std::vector<Vector<Dim>> place;  // by node: body frame, m
  std::vector<int> stretch;        // by node: the number of its joints before it
  std::vector<double> stiffness;   // by segment, N/m: against its block without slip, all others held

  int joints() const { return stretch.back(); }
};

// GroutedBolt::stiffness
template <int Dim>
void bound_stiffness(GroutedBolt<Dim>& grouted, GroutWorkspace& workspace);

// The rest of a bar as a bar of its own: nodes first … last - 1 and the joints between them. Its ends are free, and
// it is in equilibrium.
template <int Dim>
GroutedBolt<Dim> piece_of(const GroutedBolt<Dim>& grouted, int first, int last, GroutWorkspace& workspace);

}  // namespace voussoir
