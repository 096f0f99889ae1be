// The points at which a face presses on another within an implicit step: of the smaller face, where it lies on the
// larger one, each with its own overlap, below zero where they are apart. Points and weights belong to the faces, not
// to what presses of them at the moment, so that the springs' energy follows the motion also where a face opens.
#pragma once

#include <vector>

#include "core/contact/pair.hpp"

namespace voussoir {

template <int Dim>
struct FacePoint {
  Vector<Dim> place;             // m, from the first body's centroid
  double overlap = 0, area = 0;  // m, m²
};

// frame of the first body
template <int Dim>
struct FacePoints {
  Vector<Dim> normal = Vector<Dim>::Zero();  // of the larger face, from the first to the second, unit
  Vector<Dim> centre = Vector<Dim>::Zero();  // m: of the common area
  double area = 0;                           // m²: of it
  double polar = 0;                          // m⁴, 3-D: Σ A |y - centre|² of the points
  std::vector<FacePoint<Dim>> points;
};

// `inside`: a point near both faces, m. In the plane the composite rule of Simpson over the common length, in space the
// rule of degree three with the vertices on the triangles about the centre of the common polygon: where all of a face
// presses, force, moment and stiffness are exact. False, without points: the faces are not nearly parallel, or nothing
// is common to them.
template <int Dim>
bool find_face_points(const Pair<Dim>& pair, const Vector<Dim>& inside, int face_a, int face_b, FacePoints<Dim>& found);

}  // namespace voussoir
