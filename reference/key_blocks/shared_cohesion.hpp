#pragma once

#include "reference/wedge/wedge.hpp"

// A rigid wedge on two elastic joints whose cohesion slip takes: which factor of safety does it have? `cohesion_force`
// of its planes is that of whole joints. Factors divide cohesion and tan(friction).
namespace voussoir::reference {

struct ElasticWedge {
  Wedge wedge;
  double area_a = 0, area_b = 0;  // m^2
};

// The factor at which the first joint slips: elastic displacement d under the load R,
// sum A [kn n n' + ks (1 - n n')] d = R, then the least (c A + N tan phi)/T. `ratio` ks/kn; 0: of its limit.
double first_slip_factor(const ElasticWedge& block, double ratio);

// Cohesion that the first slip takes completely: the greater of the factors of the first slip and of friction alone.
// The wedge stands up to it. It stands further if the joint that is left carries what the other loses, as a joint with
// much more cohesion does.
double brittle_factor(const ElasticWedge& block, double ratio);

// c(beta) = c_r + (c - c_r) exp(-beta/slip) on both joints, c_r = residual c: the wedge moves along its line by u, each
// joint has ks (u - beta) = (c(beta) + N tan(phi)/A)/F, and the factor is the largest at which the greatest sum of
// their shear forces is the driving force. For ks/kn -> 0. Throws std::invalid_argument on snap-back.
double softening_factor(const ElasticWedge& block, double residual, double slip, double shear_stiffness);

}  // namespace voussoir::reference
