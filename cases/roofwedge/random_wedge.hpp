// Random roof wedges whose collapse the reference finds, and the motion of the rock that brings them under stress.
#pragma once

#include <fmt/format.h>

#include <array>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "core/geometry/types.hpp"
#include "reference/roofwedge/roofwedge.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {

inline constexpr double roof_half_width = 4;  // m, of the model

struct DrawnRoofWedge {
  reference::RoofWedge wedge;
  double k0 = 0;
  double truth = 0;  // deg, of its collapse
};

// what the rock behind a joint does: a point inside of it; its displacement, m
struct RoofMove {
  Vector<3> inside, way;
};

inline Vector<3> roof_vector(const reference::Vector3& v) {
  return {v[0], v[1], v[2]};
}

// as a scene states it
inline std::string list_of(const Vector<3>& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v[0], v[1], v[2]);
}

// in the roof, each opposite to the plane of its number
inline std::array<Vector<3>, 3> roof_corners(const reference::RoofWedge& wedge,
                                             const reference::RoofWedgeFaces& faces) {
  std::array<Vector<3>, 3> corner;
  for (int i = 0; i < 3; ++i) {
    const Vector<3> line = roof_vector(faces.normal[(i + 1) % 3]).cross(roof_vector(faces.normal[(i + 2) % 3]));
    corner[i] = Vector<3>(0, 0, wedge.height) - wedge.height / line[2] * line;
  }
  return corner;
}

inline bool fits_in_roof(const std::array<Vector<3>, 3>& corner) {
  constexpr double least_width = 0.3;  // m, of the wedge's sides in the roof
  for (int i = 0; i < 3; ++i)
    if (corner[i].cwiseAbs().maxCoeff() > 0.95 * roof_half_width ||
        (corner[i] - corner[(i + 1) % 3]).norm() < least_width)
      return false;
  return true;
}

// deg, if the reference applies: no joint opens or slips before friction falls, and a search from 60 to 10 covers it
inline std::optional<double> roof_collapse(const reference::RoofWedge& wedge) {
  constexpr double settles = 50, falls = 12;  // deg
  try {
    if (!fits_in_roof(roof_corners(wedge, reference::roof_wedge_faces(wedge)))) return {};
    if (reference::first_slip(wedge).friction > settles * degree) return {};
    const reference::RoofWedgeState state = reference::collapse(wedge);
    if (state.friction < falls * degree || state.step_error > 1e-3 * degree) return {};
    return state.friction / degree;
  } catch (const std::invalid_argument&) {  // no wedge
    return {};
  } catch (const std::domain_error&) {  // a joint opens
    return {};
  }
}

// As in scene.toml: the rock behind each joint closes in until the joint transfers the traction of the stress.
inline std::array<RoofMove, 3> roof_moves(const reference::RoofWedge& wedge) {
  const reference::RoofWedgeFaces faces = reference::roof_wedge_faces(wedge);
  const std::array<Vector<3>, 3> corner = roof_corners(wedge, faces);
  std::array<RoofMove, 3> moves;
  for (int i = 0; i < 3; ++i) {
    const Vector<3> n = roof_vector(faces.normal[i]);
    const Vector<3> traction = Vector<3>(wedge.stress[0], wedge.stress[1], wedge.stress[2]).cwiseProduct(n);
    const Vector<3> normal = n.dot(traction) * n;
    const Vector<3> middle = (Vector<3>(0, 0, wedge.height) + corner[(i + 1) % 3] + corner[(i + 2) % 3]) / 3;
    moves[i] = {middle - 0.01 * n, normal / wedge.normal_stiffness + (traction - normal) / wedge.shear_stiffness};
  }
  return moves;
}

// 1 m high; horizontal stress of 0.03 to 0.15 MPa, that over the vertical K0 = 0.8 to 4. Symmetric: about a vertical
// plane.
inline DrawnRoofWedge random_roof_wedge(boost::random::mt19937_64& random, bool symmetric) {
  const auto between = [&](double low, double high) {
    return boost::random::uniform_real_distribution<double>(low, high)(random);
  };
  while (true) {
    std::array<double, 3> dip{}, off{};
    for (int i = 0; i < 3; ++i) {
      dip[i] = between(45, 75);
      off[i] = between(-30, 30);
    }
    if (symmetric) {
      dip[2] = dip[1];
      off[0] = 0;
      off[2] = -off[1];
    }
    const double turned = between(0, 360), horizontal = between(0.03e6, 0.15e6), k0 = between(0.8, 4);
    reference::RoofWedge wedge;
    for (int i = 0; i < 3; ++i) {
      wedge.planes[i].dip = dip[i] * degree;
      wedge.planes[i].dip_direction = std::fmod(turned + 120 * i + off[i] + 360, 360) * degree;
    }
    wedge.stress = {horizontal, horizontal, horizontal / k0, 0, 0, 0};
    wedge.normal_stiffness = 3e9 * std::pow(10, between(0, 1));
    wedge.shear_stiffness = wedge.normal_stiffness * std::pow(10, between(-0.7, 0.3));
    if (const std::optional<double> truth = roof_collapse(wedge)) return {wedge, k0, *truth};
  }
}

}  // namespace voussoir::cases
