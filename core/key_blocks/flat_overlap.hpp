// Overlaps of convex polygons on the two sides of one plane (in the plane: of segments of one line).
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/geometry/types.hpp"

namespace voussoir {

using FlatPoint = std::array<double, 2>;  // m; of a line the first coordinate alone

// Coordinates within a plane, in space along two edges of a face if they are not too oblique: faces of regular joint
// sets then fill their boxes, so that few pairs of boxes overlap in vain.
template <int Dim>
class PlaneFrame {
 public:
  PlaneFrame(const Vector<Dim>& normal, const Vector<Dim>& edge, const Vector<Dim>& next_edge);

  FlatPoint flat(const Vector<Dim>& point) const {
    return {first_coordinate_.dot(point), Dim == 3 ? second_coordinate_.dot(point) : 0};
  }
  Vector<Dim> place(const FlatPoint& point, double height) const {
    return height * normal_ + point[0] * first_ + point[1] * second_;
  }
  double unit_area() const { return unit_area_; }  // m² (2-D: m)

 private:
  Vector<Dim> normal_, first_, second_ = Vector<Dim>::Zero();
  Vector<Dim> first_coordinate_, second_coordinate_ = Vector<Dim>::Zero();  // the dual axes
  double unit_area_ = 1;
};

// the faces on one side of a plane
class FlatFaces {
 public:
  struct Face {
    int body, part, face;
    int joint;
    int first, corners;
    FlatPoint low, high;
    bool counter_clockwise;
    bool segment() const { return corners == 2; }
    double box() const { return (high[0] - low[0]) * (segment() ? 1 : high[1] - low[1]); }
  };

  void add(const FlatPoint& corner) { corners_.push_back(corner); }
  // of the corners since the last face; returns its area (of a segment its length)
  double end_face(int body, int part, int face, int joint);

  const std::vector<Face>& faces() const { return faces_; }
  const FlatPoint* corners(const Face& face) const { return corners_.data() + face.first; }

 private:
  std::vector<FlatPoint> corners_;
  std::vector<Face> faces_;
};

struct FlatOverlap {
  double area = 0;
  FlatPoint centroid{};
  std::vector<FlatPoint> corners;
};

// Calls `act` for every overlap of a face below and a face above whose area is more than `negligible` of the smaller
// box, in an order that depends on the faces alone. A grid of about a face per cell finds the pairs.
void for_overlaps(
    const FlatFaces& below, const FlatFaces& above, double negligible,
    const std::function<void(const FlatFaces::Face& below, const FlatFaces::Face& above, const FlatOverlap&)>& act);

}  // namespace voussoir
