// A face on a face as an integrated face contact. Both faces cross in a line (or are parallel); the mean plane contains
// it and halves the angle between them. Measured along the mean plane's normal n, from one face to the other, the
// overlap is linear:
//
//   u(y) = (d_a + d_b - (a + b)·y) / c,   c = |a - b| / 2,   n = (a - b) / |a - b|
//
// where a·y = d_a and b·y = d_b are the faces. The contact polygon P is the part of the mean plane inside all other
// planes of both parts, with u >= 0. With k, Pa/m, energy and force on the second part are
//
//   E = ½ k ∫ u² dA,   F = n k ∫ u dA and more,   n k ∫ u dA at the centre of pressure ∫ u y dA / ∫ u dA.
//
// They are the derivative of E in every motion of the second part, edges included. Besides n k ∫ u dA, an edge of P
// due to a side plane s of either part gains or loses stressed area, and the mean plane turns and shifts with the
// faces: with q the sine between s and the mean plane and ± for the second and the first part,
//
//   F = k n ∫ u dA - k/4 Σ 1/q ∮ u² p ds,   p = (s·n) (a + b) / |a - b| ± s,
//   M = k ∫ u y × n dA - k (b × a)/|a - b|² ∫ u² dA - k/4 Σ 1/q ∮ u² y × p ds.
//
// So a block on a wider one is pushed along the wider one's normal at any tilt, while the mean plane's normal tilts by
// half as much. Blocks whose edges are flush, as in masonry, push each other along the mean plane's normal: there E has
// a crest, and the smallest projection of one edge would determine the side of the force. Within ten overlaps, about
// the displacement by shear springs, both share the edge; that much of E's derivative, u over the width of the face, is
// left out.
#pragma once

#include <vector>

#include "core/geometry/half_space.hpp"
#include "core/joint_laws/face_friction.hpp"

namespace voussoir {

// Two faces, planes of one frame, count as parallel within this angle of their outward normals being opposite (cosine
// of 30 degrees): beyond it the mean plane is so inclined to both that the overlap across it is no longer a closure.
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
  bool flush = false;                          // an edge belongs to both parts
  Vector<Dim> force = Vector<Dim>::Zero();     // on the second part, over k, m^Dim
  Spin<Dim> moment = Spin<Dim>::Zero();        // about the origin of the planes, over k, m^(Dim + 1)
};

// A side of the contact polygon (2-D: an end, `from` and `to` the same), which a plane of either part cuts or, as plane
// no_plane, the end of the overlap. It pulls by ∫ u² ds over the sine to its plane, times `pull`.
inline constexpr int no_plane = -1;
template <int Dim>
struct FaceEdge {
  int plane = no_plane;
  int twin = no_plane;                                                       // a flush plane of the other part
  Vector<Dim> from, to;                                                      // m, from the planes' origin
  double overlap_from = 0, overlap_to = 0;                                   // m
  Vector<Dim> pull = Vector<Dim>::Zero(), twin_pulls = Vector<Dim>::Zero();  // both planes'; how the twin's differs
  double twin_per_behind = 0, twin_per_overlap = 0;  // 1/m: change of its share with how far it is behind, and with u
};

// Integrates over the contact polygon of one face of each part. `planes`: of both parts, the first `faces_a` the first
// one's, seen from a point in the overlap; `face_b` counts in all planes. `reach`, m: no point of both parts is farther
// from there along any axis. False, without a result, if the faces do not press on each other or are not parallel
// (parallel_faces). The polygon is about the centre of the area, in 2-D without corners. For planes as given, the
// relative errors of area, ∫ u, ∫ u², J are below 1e-12, those of centres below 1e-12 of the polygon's extent, times
// one over the sine of the least angle between the mean plane and a side plane that bounds it: the rounding of a side
// plane's normal moves it by as much. Polygons more than 250 times as long as wide (extent² over area) lose digits in
// proportion: the edges' directions are rounded in the mean plane, three products each, at up to 6 times the extent.
// `edges`, if asked for: of the polygon.
template <int Dim>
bool integrate_face(const HalfSpaces<Dim>& planes, int faces_a, int face_a, int face_b, double reach,
                    FaceIntegral<Dim>& face, PressedPolygon& polygon, std::vector<FaceEdge<Dim>>* edges = nullptr);

}  // namespace voussoir
