// A bar grouted into rock along its axis: a row of elastic, perfectly plastic elements whose nodes are connected to the
// rock by a bond, elastic and perfectly plastic too (cases/support/README.md). The rock's displacements are given; the
// bar has no mass and is in equilibrium with them, so that it shortens no time step by itself.
//
// One coordinate s runs along the axis from the collar into the rock, m; displacements along it are positive, so are
// tension in the bar and forces that push the rock in this direction. With u of the bar, g of the rock, p the bond's
// slip,
//   N = EA du/ds, |N| <= yield force;   dN/ds = k (u - g - p), |k (u - g - p)| <= S.
// Closed forms, second-order accurate in the spacing of nodes: pulled out of rock √(EA k) tanh(l √(k/EA)) N/m; half of
// that, with l half its length, over one joint at its middle; √(EA S w) N if a joint opened by w and k is large.
#pragma once

#include <limits>
#include <span>
#include <vector>

namespace voussoir {

// the support of the first node, at the collar
enum class Plate {
  none,
  spring,  // pushes on the rock with plate_stiffness, never pulls
  tied     // moves with the rock
};

struct GroutedBar {
  double axial_stiffness = 0;                                      // N: EA
  double yield_force = std::numeric_limits<double>::infinity();    // N
  double bond_stiffness = 0;                                       // N/m²: k, force per length of bar and slip
  double bond_strength = std::numeric_limits<double>::infinity();  // N/m: S
  Plate plate = Plate::none;
  double plate_stiffness = 0;  // N/m

  // by node
  std::vector<double> position;     // m: s, ascending
  std::vector<double> bond_length;  // m, that the node represents; 0 where there is no grout
};

// Lays nodes along a bar: one at the collar, without bond, for the plate; then the middles of equal cells, no longer
// than `spacing`, of each segment between joints, which cross at `joints`, m, ascending, within the bar. A node's rock
// is the block at its position.
void lay_nodes(double length, std::span<const double> joints, double spacing, GroutedBar& bar);

// The history of a bar.
struct GroutedBarState {
  // by node
  std::vector<double> displacement;   // m, of the bar
  std::vector<double> rock;           // m, last given displacement; the collar's is that of the rock at the plate
  std::vector<double> bond_force;     // N, on the rock
  std::vector<double> bond_strength;  // N, now
  std::vector<double> slip;           // m: p
  // by element, from its node to the next
  std::vector<double> bar_force;        // N: tension
  std::vector<double> bar_strength;     // N, now
  std::vector<double> plastic_stretch;  // m

  double plate_force = 0;    // N, on the rock
  double plate_closure = 0;  // m, of the plate's spring; below 0 the plate has come off
};

// A bar without force in rock displaced so. Throws std::invalid_argument if neither bond nor plate holds it.
GroutedBarState installed(const GroutedBar& bar, std::span<const double> rock);

// The fraction of stiffness that slipping bonds and yielding elements keep: it determines the position of a bar all of
// whose bonds slip. A bond's strength grows by no more than 1e-12 of the elastic force of its slip.
inline constexpr double residual_stiffness = 1e-12;

// Iterations after which the equilibrium counts as not found. Newton's method with an exact line search on a strictly
// convex, piecewise quadratic function ends after finitely many (Sun 1997); random bars of up to 300 nodes, of any
// stiffness and strength, took up to 48, 4 on average.
inline constexpr int most_grout_iterations = 200;

struct GroutStep {
  bool converged = false;  // else the state is unchanged
  int iterations = 0;      // of Newton's method, one tridiagonal solution each
  // J; work = change of stored + dissipated up to rounding, except when a plate comes off or meets the rock
  double work = 0;        // of the rock, or the jack, in this step: mean of old and new forces times displacement
  double stored = 0;      // in bar, bond and plate at its end
  double dissipated = 0;  // by slip and yield in this step, the same mean times plastic slip: never negative
};

// Memory of a solution, allocated once.
struct GroutWorkspace {
  std::vector<double> move, step, trial, residual, held, rod, kinks, rock_move;
};

// whether bond or plate holds the bar along its axis
bool is_held(const GroutedBar& bar);

// Moves the rock to `rock`, m, by node, and the bar into equilibrium. Plasticity is integrated implicitly. If the rock
// has not moved, nothing changes, to the last bit.
GroutStep move_rock(const GroutedBar& bar, std::span<const double> rock, GroutedBarState& state,
                    GroutWorkspace& workspace);

// Tightens the nut at the plate until the plate presses with `force`, N; then it is locked. Needs a plate and
// a bond.
GroutStep tighten(const GroutedBar& bar, double force, GroutedBarState& state, GroutWorkspace& workspace);

// Stiffness, N/m, along the bar, against a displacement of the rock at the nodes first … last - 1 (one block's) while
// all other rock is held, without slip: the largest stiffness that the bar adds to that block, for its time step.
double elastic_stiffness(const GroutedBar& bar, int first, int last, GroutWorkspace& workspace);

// The derivatives of the forces on the rock by the rock's displacements, N/m, in the present state of bonds, elements
// and plate. The rock is rigid within each segment: node i lies in stretch[i], 0 … stretches - 1. `stiffness` becomes a
// symmetric matrix, row by row, minus the derivatives; rows sum to 0, since moving all rock equally causes no force,
// and off its diagonal no entry is above 0: segments act as if connected to each other by springs of -stiffness.
void condensed_stiffness(const GroutedBar& bar, const GroutedBarState& state, std::span<const int> stretch,
                         int stretches, GroutWorkspace& workspace, std::vector<double>& stiffness);

// Leaves nodes first … last - 1 with their connections to each other and to the rock, and the plate if it was theirs;
// displacements are then measured from the first one's rock. The ends are free: `settle` finds the equilibrium.
void keep_nodes(int first, int last, GroutedBar& bar, GroutedBarState& state);

// Equilibrium with the rock in its present position, after parts of the bar have been removed.
GroutStep settle(const GroutedBar& bar, GroutedBarState& state, GroutWorkspace& workspace);

}  // namespace voussoir
