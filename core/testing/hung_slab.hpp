// A fixed roof, and under it a block of 4 m by 1 m that only bolts support, for tests.
#pragma once

#include <string>

namespace voussoir::hung_slab {

inline const std::string slab = R"(
dimension = 2
gravity = [0, -10]
density = 2500
domain = { box = { min = [0, 0], max = [4, 3] } }
equilibrium = { unbalanced = 1e-9 }
joint_properties = [{ name = "bed", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40, sub_contacts = 2 }]
[[joints]]
name = "bed"
dip = 0
point = [0, 1]
[[fix]]
above = ["bed"]
)";
inline constexpr double weight = 4 * 2500 * 10;  // N/m

inline std::string stage(const std::string& more, const std::string& name = "settle") {
  return "[[stage]]\nname = \"" + name + "\"\nkind = \"settle\"\n" + more + "\n";
}
inline const std::string hang = stage("gravity_ramp_s = 1\ninstall = [\"roof\"]");

}  // namespace voussoir::hung_slab
