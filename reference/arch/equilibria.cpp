#include "reference/arch/equilibria.hpp"

#include <numbers>

namespace voussoir::reference {
namespace {

Plane turned(const Plane& v, double angle) {
  return Eigen::Rotation2Dd(angle) * v;
}

// turned by the angle, minus its original position, with all digits for small angles
Plane swing(const Plane& v, double angle) {
  const double sine = std::sin(angle), half = std::sin(0.5 * angle), versine = 2 * half * half;
  return {-versine * v.x() - sine * v.y(), sine * v.x() - versine * v.y()};
}

// A face pressed by `force` (N/m) at `crossing` from its middle: overlap `closing + slope s` if positive.
struct Bearing {
  double closing, slope, length;
};

std::optional<Bearing> press(double force, double crossing, double thickness, double stiffness) {
  if (!(force > 0) || !(std::abs(crossing) < 0.5 * thickness)) return {};
  if (std::abs(crossing) <= thickness / 6)
    return Bearing{force / (stiffness * thickness), 12 * force * crossing / (stiffness * std::pow(thickness, 3)),
                   thickness};
  // a triangle from the near end
  const double length = 3 * (0.5 * thickness - std::abs(crossing)), deepest = 2 * force / (stiffness * length);
  return Bearing{deepest - deepest / length * 0.5 * thickness, std::copysign(deepest / length, crossing), length};
}

}  // namespace

Plane Moved::way_of(const Plane& point) const {
  return place + swing(point, turn);
}

std::optional<March> march(const Arch& arch, const ArchJoints& joints, double thickness, const FootForce& foot,
                           int voussoirs, const PointLoad& load) {
  const double sector = std::numbers::pi / arch.voussoirs;
  const Voussoir voussoir = voussoir_of(arch, thickness);
  Plane force = foot.force;
  double moment = cross(Plane(arch.radius + foot.crossing, 0), force);  // about the centre of the circle
  March result;
  Moved& body = result.beyond;  // below the joint, then above it
  for (int k = 0; k <= voussoirs; ++k) {
    const double angle = 0.5 * std::numbers::pi - k * sector;
    const Plane out(std::sin(angle), std::cos(angle)), middle = arch.radius * out;
    const Plane way = body.way_of(middle), at = middle + way;

    // the joint's plane is half way between its two faces, over the length on which they face each other
    constexpr int rounds = 8;  // each reduces the error of the position to a hundredth
    Bearing bearing{0, 0, thickness};
    double crossing = 0, slip = 0;
    Plane along, normal;
    for (int i = 0; i < rounds; ++i) {
      along = turned(out, body.turn - 0.5 * bearing.slope);
      normal = Plane(-along.y(), along.x());
      const double pressure = force.dot(normal);
      const Plane between = at - 0.5 * bearing.closing * normal + 0.5 * slip * along;
      crossing = (moment - cross(between, force)) / pressure;
      const std::optional<Bearing> pressed =
          press(pressure, crossing, thickness - std::abs(slip), joints.normal_stiffness);
      if (!pressed) return {};
      bearing = *pressed;
      slip = -force.dot(along) / (joints.shear_stiffness * bearing.length);
    }
    body.turn -= bearing.slope;
    body.place = way - bearing.closing * normal + slip * along - swing(middle, body.turn);
    result.joints.push_back({angle, crossing, bearing.slope, bearing.length});

    if (k == voussoirs) break;
    const double above = angle - 0.5 * sector;
    const Plane heavy = voussoir.centroid * Plane(std::sin(above), std::cos(above));
    force.y() -= voussoir.weight;
    moment -= voussoir.weight * (heavy + body.way_of(heavy)).x();
    if (arch.voussoirs - 1 - k != load.voussoir) continue;
    result.loaded = body;
    force.y() -= load.force;
    moment -= load.force * (load.point + body.way_of(load.point)).x();
  }
  return result;
}

}  // namespace voussoir::reference
