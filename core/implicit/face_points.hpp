// The points at which a face presses on another within an implicit step: of the smaller face, where it lies on the
// larger one, each with its own overlap, below zero where they are apart. They cover what presses at the begin or the
// end of the step: all of the common area, or, of a face that leans, what is near its edge or corner.
#pragma once

#include <vector>

#include "core/contact/pair.hpp"

namespace voussoir {

template <int Dim>
struct FacePoint {
  Vector<Dim> place;             // m, from the first body's centroid
  double overlap = 0, area = 0;  // m, m²
};

// what presses of a face: its area, the centre of that, and in 3-D its polar moment about the centre
template <int Dim>
struct PressedArea {
  double area = 0, polar = 0;                // m², m⁴
  Vector<Dim> centre = Vector<Dim>::Zero();  // m, from the first body's centroid
};

// frame of the first body
template <int Dim>
struct FacePoints {
  Vector<Dim> normal = Vector<Dim>::Zero();  // of the larger face, from the first to the second, unit
  PressedArea<Dim> all, begin, end;          // that the points cover; that presses at the ends of the step
  std::vector<FacePoint<Dim>> points;
};

// Of the second body relative to the first over a step, at a place y from the first's centroid: shift + turn × y, m.
// `drawn`, m: by so much the pair has been drawn together, against this direction, to see where it meets.
template <int Dim>
struct RelativeMotion {
  Vector<Dim> shift = Vector<Dim>::Zero();
  Spin<Dim> turn = Spin<Dim>::Zero();
  Vector<Dim> drawn = Vector<Dim>::Zero();
  double passed = 0.5;  // of the motion: leads from the start to the pair's pose
};

// `inside`: a point near both faces, m. In the
// plane the composite rule of Simpson over the length, in space the rule of degree three with the vertices on the
// triangles about the centre of the polygon: where all of it presses, force, moment and stiffness are exact. No points:
// nothing presses. False: the faces are not nearly parallel.
template <int Dim>
bool find_face_points(const Pair<Dim>& pair, const Vector<Dim>& inside, int face_a, int face_b,
                      const RelativeMotion<Dim>& motion, FacePoints<Dim>& found);

}  // namespace voussoir
