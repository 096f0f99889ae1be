// Shared by the definitions of the problems.
#pragma once

#include <string>

#include "verification/problems/problem.hpp"

namespace voussoir::problems {

constexpr double standard_gravity = 9.81;       // m/s2
constexpr Stiffness stiff_joint{100e9, 100e9};  // Pa/m: stiff beside every block here
extern const std::string tilt_protocol;         // words: how a tilt is sought

// one joint between all pairs of blocks
JointOf one_joint(double friction_deg, const Stiffness& stiff, const std::optional<Stiffness>& stated);

// gravity (m/s2) inclined towards +x by an angle (deg)
Point inclined_gravity(double angle_deg);

// gravity that grows from nothing in its own direction within 1 s, and is held
std::vector<GravityAt> grown(const Point& gravity);

// bisection to 0.005 deg of gravity turned from -z towards +x; fails at the upper end
Search tilt_search(double lower, double upper);

}  // namespace voussoir::problems
