// Limit analysis of joints that slip without opening. With the gap of every corner shifted by its slip s,
// the associated program has the extra cost tan φ s N; at a fixed point s = |u_T| its mechanism obeys Coulomb's law
// without dilation (Acary, Cadoux, Lemaréchal & Malick 2011). There a force on a slipping corner costs exactly what it
// gains, so that the factor is not one number: normal forces which the loads do not ask for may add to it. The fixed
// point is reached from loose joints, s large, and with s = (1 + ε)|u_T|, so that such forces vanish. It is the lowest
// mechanism that was found; nothing proves that there is no lower one.
#pragma once

#include "core/limit/limit.hpp"

namespace voussoir {

struct EndOfFactor {
  double factor = 0, error = 0;
};

template <int Dim>
struct FactorWithoutDilation {
  LimitStatus status = LimitStatus::found;
  bool settled = false;          // the slips agree with the mechanism
  EndOfFactor least, largest;    // of forces that agree with the mechanism
  bool unbounded = false;        // there is no largest: self-stress may hold any load
  int rounds = 0, programs = 0;  // of the fixed points; solved
  LimitState<Dim> state;         // forces of the least factor, and the mechanism
};

// Of the live loads, in addition to the dead ones, as find_load_factor; a negative factor: the dead loads alone are not
// carried. 90 to 600 programs.
template <int Dim>
FactorWithoutDilation<Dim> find_factor_without_dilation(const CornerAssembly<Dim>& assembly, const Loads<Dim>& dead,
                                                        const Loads<Dim>& live);

}  // namespace voussoir
