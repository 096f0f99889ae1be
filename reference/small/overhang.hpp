#pragma once

#include <vector>

// A stack of equal blocks that leans out over an edge. SI units; weights and stiffness per metre of width.
namespace voussoir::reference {

struct OverhangStack {
  int blocks = 1;                  // n >= 1
  double length = 1;               // m, L
  double height = 0.25;            // m of a block, h
  double weight = 1;               // N/m of a block, W
  double normal_stiffness = 1e11;  // Pa/m of every joint, no tension, k
  double shear_stiffness = 1e11;   // Pa/m, no slip
};

// Overhang of block j = 1 .. n, counted from the top, over the one below (the lowest: over the edge) when every
// overhang is `fraction` of the harmonic one: fraction L/(2 j), m.
std::vector<double> harmonic_overhangs(const OverhangStack& stack, double fraction = 1);

// Their sum, at which rigid blocks are just stable: L/2 (1 + 1/2 + … + 1/n), m (Paterson & Zwick 2009, Amer. Math.
// Monthly 116, 19-44, for the history).
double harmonic_overhang(const OverhangStack& stack);

// A stack in equilibrium on elastic joints.
struct OverhangState {
  double fraction = 1;           // of the harmonic overhangs
  std::vector<double> distance;  // m, by joint from the top: from the edge below to the crossing of the weight above
  std::vector<double> tilt;      // rad, by joint
  double turn = 0;               // rad: of the top block, all tilts together
};

// At a fraction s the weight j W above joint j is (1 - s) L/2 inside the edge below it, for every j alike. Pressed in
// a triangle, the joint turns by t_j = 2 j W/(k (3 x_j)^2) when the force crosses it x_j inside; turning moves the
// blocks above outwards, in the first order of t
//   x_j = (1 - s) L/2 - h/(2 j) sum_i min(i, j)^2 t_i.
// Beyond the limit these have no solution. For one block 1 - s = (3/L) (2 W h/(9 k))^(1/3); for more the number before
// the root is another, the root is the same. The functions use the turned blocks' true places instead of the first
// order. They throw std::invalid_argument when a joint is pressed along its whole length.

// the largest stable fraction: 0.8 of the harmonic overhangs or more, or std::invalid_argument
OverhangState elastic_overhang_limit(const OverhangStack& stack);

// equilibrium at a smaller fraction; std::invalid_argument beyond the limit
OverhangState elastic_overhang(const OverhangStack& stack, double fraction);

}  // namespace voussoir::reference
