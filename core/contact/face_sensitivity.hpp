// How the force of a face on a face (face_integral.hpp) changes as the second body moves against the first, in closed
// form.
//
// If the second body moves by m(x) = t + w × (x - c), a point x of the mean plane follows along the plane's normal n by
// -β/2c, where β = b·m and c = |a - b|/2, and the overlap there changes by du = (β - u dc)/c. The polygon's sides move
// outwards by v: by s·m less (s·n) times the way along n, over the sine, where a plane s of the second part cuts,
// without s·m where one of the first does, and by du over the slope of u where the overlap ends. So
//
//   d ∫u dA = ∫ du dA + ∮ u v ds,   d ∫u x dA = ∫ (du x + u dx) dA + ∮ u v x ds,
//
// and so on. Left out are the squares of the overlap over the face's width: how the pull of an edge turns, and how its
// ends move.
#pragma once

#include <span>

#include "core/contact/face_integral.hpp"

namespace voussoir {

// By motion of the second body: translations along, then turns about, the axes of the planes through its centroid; m
// and rad. Places from the planes' origin; force and moment over k.
template <int Dim>
struct FaceSensitivity {
  static constexpr int S = spin_freedoms<Dim>;
  FixedMatrix<Dim, freedoms<Dim>> force, centre, pressure, gradient;  // m³/m, m/m, m/m; of the overlap along the plane
  FixedMatrix<S, freedoms<Dim>> moment;                               // m⁴/m
  FixedMatrix<1, freedoms<Dim>> area, volume, square, polar;          // m²/m, m³/m, m⁴/m, m⁴/m
};

// `a`, `b`: the faces; `centroid`: of the second body; integral, polygon and edges: of integrate_face.
template <int Dim>
FaceSensitivity<Dim> find_face_sensitivity(const HalfSpaces<Dim>& planes, int faces_a, const HalfSpace<Dim>& a,
                                           const HalfSpace<Dim>& b, const Vector<Dim>& centroid,
                                           const FaceIntegral<Dim>& integral, const PressedPolygon& polygon,
                                           std::span<const FaceEdge<Dim>> edges);

}  // namespace voussoir
