// A face on a face carried as a whole. Both faces cross in a line (or are parallel); the mean plane holds it and halves
// the angle between them. Measured along the mean plane's normal n, from one face to the other, the overlap is linear:
//
//   u(y) = (d_a + d_b - (a + b)·y) / c,   c = |a - b| / 2,   n = (a - b) / |a - b|
//
// where a·y = d_a and b·y = d_b are the faces. The contact polygon P is what lies inside of all other planes of both
// parts on the mean plane, and where u >= 0. With k, Pa/m, energy and force on the second part are
//
//   E = ½ k ∫ u² dA,   F = n k ∫ u dA and more,   n k ∫ u dA at the centre of pressure ∫ u y dA / ∫ u dA.
//
// They are the derivative of E in every motion of the second part, edges included. Besides n k ∫ u dA, an edge of P
// that a side plane s of either part makes gains or loses what is under stress there, and the mean plane turns and
// shifts with the faces: with q the sine between s and the mean plane and ± for the second and the first part,
//
//   F = k n ∫ u dA - k/4 Σ 1/q ∮ u² p ds,   p = (s·n) (a + b) / |a - b| ± s,
//   M = k ∫ u y × n dA - k (b × a)/|a - b|² ∫ u² dA - k/4 Σ 1/q ∮ u² y × p ds.
//
// So a block on a wider one is pushed along the wider one's normal, however it leans, where the mean plane's leans by
// half as much. Blocks whose edges are flush, as in masonry, push each other along the mean plane's normal: there E has
// a crest, and which edge stands out by how little would decide to whose side force goes. Within ten overlaps, about
// what shear springs shift them by, both share the edge; that much of E's derivative, u over the width of the face, is
// left out.
#pragma once

#include "core/geometry/half_space.hpp"
#include "core/joint_laws/face_friction.hpp"

namespace voussoir {

// Two faces, planes of one frame, count as parallel within this angle of their outward normals being opposite (cosine
// of 30 degrees): beyond it the mean plane leans on both so much that the overlap across it is no closure any more.
inline constexpr double parallel_faces = 0.86602540378443865;

template <int Dim>
struct FaceIntegral {
  Vector<Dim> normal = Vector<Dim>::Zero();    // of the mean plane, from the first part to the second, unit
  double area = 0;                             // m² (2-D: m, unit thickness)
  Vector<Dim> centre = Vector<Dim>::Zero();    // of the area, m
  double volume = 0;                           // ∫ u dA, m³
  Vector<Dim> pressure = Vector<Dim>::Zero();  // its centre, m
  double square = 0;                           // ∫ u² dA, m⁴: E is half of it, times k
  double polar = 0;                            // ∫ |y - centre|² dA, m⁴: the twisting stiffness over ks
  double least_sine2 = 1;                      // squared sine of the least angle to a side plane that bounds it
  bool flush = false;                          // an edge is both parts'
  Vector<Dim> force = Vector<Dim>::Zero();     // on the second part, over k, m^Dim
  Spin<Dim> moment = Spin<Dim>::Zero();        // about the origin of the planes, over k, m^(Dim + 1)
};

// Integrates over the contact polygon of one face of each part. `planes`: of both parts, the first `faces_a` the first
// one's, seen from a point in the overlap; `face_b` counts in all planes. `reach`, m: no point of both parts
// lies farther from there along any axis. False, and nothing is said, where the faces do not press on each other or are
// not parallel (parallel_faces). The polygon is about the centre of the area, in 2-D without corners. Of planes as they
// are given, area, ∫ u, ∫ u², J are right to 1e-12 of themselves, centres to 1e-12 of the polygon's extent, times one
// over the sine of the least angle between the mean plane and a side plane that bounds it: so much does the rounding of
// a side plane's normal move it. Polygons more than 250 times as long as wide (extent² over area) lose digits in
// proportion: the edges' directions are rounded in the mean plane, three products each, at up to 6 times the extent.
template <int Dim>
bool integrate_face(const HalfSpaces<Dim>& planes, int faces_a, int face_a, int face_b, double reach,
                    FaceIntegral<Dim>& face, PressedPolygon& polygon);

}  // namespace voussoir
