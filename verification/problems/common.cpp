#include "verification/problems/common.hpp"

#include <cmath>

#include "text/angle.hpp"

namespace voussoir::problems {

const std::string tilt_protocol =
    "Each trial starts from the beginning, at rest, with one tilt. Gravity has its direction from the start; it grows "
    "from nothing "
    "to "
    "9.81 m/s2 within 1 s, linearly, and is held until 3.5 s. Bisection of the tilt to 0.005 deg between the ends of "
    "`search`. Damping of the code's own choice, stated in answer.csv as `# setting`.";

JointOf one_joint(double friction_deg, const Stiffness& stiff, const std::optional<Stiffness>& stated) {
  JointOf joint;
  joint.friction_deg = friction_deg;
  joint.stiff = stiff;
  joint.stated = stated;
  return joint;
}

Point inclined_gravity(double angle_deg) {
  const double angle = angle_deg * degree;
  return standard_gravity * Point(std::sin(angle), 0, -std::cos(angle));
}

std::vector<GravityAt> grown(const Point& gravity) {
  return {{0, Point::Zero()}, {1, gravity}};
}

Search tilt_search(double lower, double upper) {
  Search search;
  search.parameter = "tilt_deg";
  search.lower = lower;
  search.upper = upper;
  search.tolerance = 0.005;
  search.fails_at_upper = true;
  search.kind = SearchKind::gravity_direction;
  search.axis = {0, -1, 0};
  return search;
}

}  // namespace voussoir::problems
