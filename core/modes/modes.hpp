// The lowest natural frequencies and mode shapes of a state at rest: K φ = ω² M φ, K the elastic tangent of Newton's
// method (core/run/twin.hpp) at rest, M the bodies' mass and inertia in space. Closed joints keep the stiffness that
// they have, joints that stick stick, open ones have none. Loads that follow the bodies are in K: gravity at a lever
// lowers the frequencies of rocking.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/modes/tangent_at_rest.hpp"
#include "core/run/progress.hpp"

namespace voussoir {

template <int Dim>
struct Mode {
  double omega_squared = 0;   // rad²/s²; negative: the state at rest is unstable, and this is how it leaves it
  bool no_stiffness = false;  // not told from 0
  std::vector<Vector<Dim>> displacement;  // by body, of its centroid; φᵀ M φ = 1
  std::vector<Spin<Dim>> rotation;        // by body, world axes
  // φᵀ M r for the shift r of all free bodies along each axis by 1: its square over φᵀ M φ = 1 is the effective mass,
  // kg
  Vector<Dim> participation = Vector<Dim>::Zero();
  Vector<Dim> mass_share = Vector<Dim>::Zero();  // effective mass over the mass that is free along the axis
  double translation_share = 0;                  // of φᵀ M φ; the rest is rotation
  double largest = 0;                            // largest displacement of a vertex, for φᵀ M φ = 1
  int body = 0;                                  // with the largest share of φᵀ M φ
  double body_share = 0;

  double frequency() const;  // Hz; 0 if ω² is not positive
};

template <int Dim>
struct Modes {
  std::string stage;                            // at whose end
  std::string reason{};                         // why there are none, one line
  std::vector<Mode<Dim>> list{};                // ascending ω²
  Vector<Dim> free_mass = Vector<Dim>::Zero();  // kg, by axis
  int free_bodies = 0, available = 0;           // available: number of all modes
  TangentAtRest tangent{};
  double shift = 0;  // rad²/s²
  int missing = 0;   // modes below the last one that were not found
  int factorisations = 0;
  long long solutions = 0;
};

// The place of the stage at whose end modes are sought: the named one, else the last that settles, else the last
// search. Nothing: there is none.
std::optional<int> stage_of_modes(const std::vector<StagePlan>& stages, const std::string& name);

// Of the state at the end of a simulation whose last stage was that one. Fails with a reason if the state is not at
// rest, nothing is fixed, or joints have no elastic tangent.
template <int Dim>
Modes<Dim> find_modes(const Prepared<Dim>& scene, const Progress<Dim>& end, int stage, int number);

// `phase` times the mode, its largest displacement scaled to `reach`, m, added to the state at rest
template <int Dim>
State<Dim> swung(const State<Dim>& rest, const Model<Dim>& model, const Mode<Dim>& mode, double reach, double phase);

// m: largest side of the box around the free bodies
template <int Dim>
double extent_of_free(const Model<Dim>& model);

}  // namespace voussoir
