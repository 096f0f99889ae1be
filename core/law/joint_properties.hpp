// The constant properties of a joint.
#pragma once

#include <string>

namespace voussoir {

struct JointProperties {
  std::string name;
  double normal_stiffness = 0;      // Pa/m per area, or N/m when the stiffness is constant
  double shear_stiffness = 0;       // same unit
  double friction = 0;              // rad, 0 <= friction < pi/2
  bool constant_stiffness = false;  // N/m whatever the area, which then is never computed (but with sub-contacts)
  int sub_contacts = 1;             // points that carry a face, along each of its directions; 1: the contact's own
};

}  // namespace voussoir
