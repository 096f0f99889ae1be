// The properties of a joint: what its laws (joint_law.hpp, elastic_coulomb.hpp) are made of.
#pragma once

#include <string>

namespace voussoir {

// Laws beside the plain one (linear springs, constant friction, no strength in tension): bits of JointProperties::laws.
// A joint without any costs one comparison more than if there were none.
enum JointLaw : unsigned {
  linear_normal = 1,   // kn = normal_stiffness + normal_growth σ
  power_normal = 2,    // kn = normal_stiffness (σ / 1 Pa)^normal_exponent
  linear_shear = 4,    // ks = shear_stiffness + shear_growth σ
  power_shear = 8,     // ks = shear_stiffness (σ / 1 Pa)^shear_exponent
  hardening = 16,      // tan φ (1 - e^(-β/u)), u = hardening_slip (σ / 1 Pa)^hardening_exponent, β plastic slip
  softening = 32,      // tan φ - softening_drop (1 - e^(-β/softening_slip))
  tension_bond = 64,   // tensile strength until the bond breaks
  cohesion_bond = 128  // cohesion until the bond breaks
};

struct JointProperties {
  std::string name;
  // Pa/m per area, or N/m when the stiffness is constant; where it depends on stress: without stress (linear), or at
  // 1 Pa (power)
  double normal_stiffness = 0;
  double shear_stiffness = 0;       // same unit
  double friction = 0;              // rad, 0 <= friction < pi/2; of hardening the last, of softening the first
  bool constant_stiffness = false;  // N/m whatever the area, which then is never computed (but with sub-contacts)
  int sub_contacts = 1;             // points that carry a face, along each of its directions; 1: the contact's own

  unsigned laws = 0;                                  // JointLaw; those below that no law uses are zero
  double normal_growth = 0, shear_growth = 0;         // 1/m
  double normal_exponent = 0, shear_exponent = 0;     // 0 < . < 1
  double hardening_slip = 0, hardening_exponent = 0;  // m at 1 Pa; 1
  double softening_drop = 0, softening_slip = 0;      // 1; m
  double tension = 0, cohesion = 0;                   // Pa

  bool bonds() const { return laws & (tension_bond | cohesion_bond); }
};

}  // namespace voussoir
