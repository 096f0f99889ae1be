// The contact of two parts in any place and order: for users and tests without a model.
#pragma once

#include "core/base/settings.hpp"
#include "core/contact/contact.hpp"
#include "core/contact/pair.hpp"
#include "core/solvers/solvers.hpp"

namespace voussoir {

// the pose of a part
template <int Dim>
struct Pose {
  Vector<Dim> position = Vector<Dim>::Zero();  // of the part's origin, world axes, m
  Matrix<Dim> axes = Matrix<Dim>::Identity();  // part's frame -> world, orthonormal to rounding; may mirror
};

template <int Dim>
struct ContactBetween {
  ContactStatus status = ContactStatus::separated;  // `apart` never occurs: no boxes are compared
  // Pose::position of one of the two, the same one in either order; m
  Vector<Dim> origin = Vector<Dim>::Zero();
  // World axes; the point relative to `origin`, so that it keeps its digits far from the world's; the normal from the
  // first part given to the second, face_a of the first. Set while touching, as far as the level goes.
  ContactGeometry<Dim> geometry;
};

// Resolves the pair without a start. The parts are put in an order of their own first, by their faces, then by their
// placements: (a, b) and (b, a) give the same bits, but for the sign of the normal and the places of the faces.
// Far from the world's origin only the difference of the positions counts, rounded once.
// Throws std::invalid_argument when a part has no faces, or when a number of a placement is not finite or its axes are
// off orthonormal by more than rounding.
template <int Dim>
ContactBetween<Dim> contact_between(const Polytope<Dim>& a, const Pose<Dim>& at_a, const Polytope<Dim>& b,
                                    const Pose<Dim>& at_b, QueryLevel level = QueryLevel::area,
                                    const ContactSettings& settings = {}, const Solvers<Dim>& solvers = {});

}  // namespace voussoir
