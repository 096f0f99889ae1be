// Limit analysis of joints that slip without opening. With the gap of every corner shifted by its slip s,
// the associated program has the extra cost tan φ s N; at a fixed point s = |u_T| its mechanism obeys Coulomb's law
// without dilation (Acary, Cadoux, Lemaréchal & Malick 2011). There a force on a slipping corner costs exactly what it
// gains, so that the factor is not one number: normal forces which the loads do not ask for may add to it. The fixed
// point is reached from loose joints, s large, and with s = (1 + ε)|u_T|, so that such forces vanish. It is the lowest
// mechanism that was found; nothing proves that there is no lower one.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/limit/limit.hpp"

namespace voussoir {

// called after every round: how many there were, and the factor of the last
using RoundHook = std::function<void(int rounds, double factor)>;

struct EndOfFactor {
  double factor = 0, error = 0;
};

struct FactorEnds {
  LimitStatus status = LimitStatus::found;
  bool settled = false;          // the slips agree with the mechanism
  EndOfFactor least, largest;    // of forces that agree with the mechanism
  bool unbounded = false;        // there is no largest: self-stress may hold any load
  int rounds = 0, programs = 0;  // of the fixed points; solved
};

template <int Dim>
struct FactorWithoutDilation : FactorEnds {
  LimitState<Dim> state;      // forces of the least factor, and the mechanism
  std::vector<double> slips;  // of the mechanism, in the program's units
};

// Of the live loads, in addition to the dead ones, as find_load_factor; a negative factor: the dead loads alone are not
// carried. 50 to 600 programs. `neighbour`: slips of the same blocks' mechanism at another strength under the same live
// loads, from which this one is followed; none: joints begin loose.
template <int Dim>
FactorWithoutDilation<Dim> find_factor_without_dilation(const CornerAssembly<Dim>& assembly, const Loads<Dim>& dead,
                                                        const Loads<Dim>& live, const RoundHook& hook = {},
                                                        std::span<const double> neighbour = {});

// The strength of joints that do not dilate at which loads are just supported: where the largest and where the least
// factor of a further load in the direction of the mechanism of joints that dilate vanish.
struct StrengthEnds {
  LimitStatus status = LimitStatus::found;  // carries_nothing: not even at the strongest
  bool settled = false;
  std::optional<EndOfFactor> weakest, strongest;  // friction angle in rad, or factor of safety; none: beyond the range
  int rounds = 0, programs = 0;
};

template <int Dim>
struct StrengthWithoutDilation : StrengthEnds {
  LimitState<Dim> state;  // at the strongest, or where there is none at the weakest
};

// `dilating`: what find_critical_friction or find_factor_of_safety found of the same loads and faces: joints that do
// not dilate need as much strength or more.
template <int Dim>
StrengthWithoutDilation<Dim> find_critical_friction_without_dilation(const CornerAssembly<Dim>& assembly,
                                                                     const Loads<Dim>& loads,
                                                                     const std::vector<bool>& chosen,
                                                                     const CriticalStrength<Dim>& dilating,
                                                                     const RoundHook& hook = {});
template <int Dim>
StrengthWithoutDilation<Dim> find_factor_of_safety_without_dilation(const CornerAssembly<Dim>& assembly,
                                                                    const Loads<Dim>& loads,
                                                                    const std::vector<bool>& chosen,
                                                                    const CriticalStrength<Dim>& dilating,
                                                                    const RoundHook& hook = {});

}  // namespace voussoir
