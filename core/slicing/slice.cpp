#include "core/slicing/slice.hpp"

#include <algorithm>
#include <cmath>

#include "core/optimise/feasibility.hpp"
#include "core/slicing/block.hpp"

namespace voussoir {
namespace {

// a joint this close to a block's surface (times the inscribed radius) does not cut it
constexpr double cut_tolerance = 1e-10;

// columns span the plane with this unit normal
Eigen::Matrix<double, 2, 1> plane_axes(const Vector<2>& n) {
  return perpendicular(n);
}
Eigen::Matrix<double, 3, 2> plane_axes(const Vector<3>& n) {
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = perpendicular(n);
  axes.col(1) = n.cross(axes.col(0));
  return axes;
}

// Eq. 3.7 written in the plane's own coordinates y, x = x0 + E y: min s : (a_i E)·y - (d_i - a_i·x0) <= s
template <int Dim>
bool cuts(const HalfSpace<Dim>& plane, const Polytope<Dim>& block, SlicingCounters& counters) {
  const double distance = signed_distance<Dim>(plane, block.centre);
  const double extent = block.radius + block.centre.norm();
  if (std::abs(distance) < 0.999 * block.inscribed_radius) return true;  // through the inscribed ball
  if (std::abs(distance) > 2 * extent) return false;                     // beyond the bounding sphere

  const Vector<Dim> x0 = block.centre - distance * plane.normal;
  const auto axes = plane_axes(plane.normal);
  HalfSpaces<Dim - 1> section(block.faces.size());
  for (std::size_t i = 0; i < section.size(); ++i)
    section[i] = {axes.transpose() * block.faces[i].normal, -signed_distance<Dim>(block.faces[i], x0)};
  ++counters.lp_solves;
  const FeasibilityResult<Dim - 1> r = solve_feasibility<Dim - 1>(section, {});
  return r.value < -cut_tolerance * block.inscribed_radius;
}

template <int Dim>
BlockResult<Dim> child(const Polytope<Dim>& block, const HalfSpace<Dim>& plane, int joint) {
  HalfSpaces<Dim> faces = block.faces;
  std::vector<int> joints = block.joints;
  faces.push_back(plane);
  joints.push_back(joint);
  return make_block<Dim>(faces, joints);
}

}  // namespace

template <int Dim>
std::vector<Polytope<Dim>> slice(const Polytope<Dim>& domain, const std::vector<Cut<Dim>>& joints,
                                 const SlicingLimits& limits, SlicingCounters& counters) {
  std::vector<Polytope<Dim>> blocks{domain};
  for (const Cut<Dim>& joint : joints) {
    std::vector<Polytope<Dim>> next;
    next.reserve(blocks.size());
    for (Polytope<Dim>& block : blocks) {
      if (!cuts(joint.plane, block, counters)) {
        next.push_back(std::move(block));
        continue;
      }
      // cut right through: both sides get the joint as a new face
      BlockResult<Dim> below = child<Dim>(block, joint.plane, joint.joint);
      BlockResult<Dim> above = child<Dim>(block, {-joint.plane.normal, -joint.plane.offset}, joint.joint);
      const bool sound = below.status == BlockStatus::ok && above.status == BlockStatus::ok &&
                         below.part.inscribed_radius >= limits.smallest_inscribed_radius &&
                         above.part.inscribed_radius >= limits.smallest_inscribed_radius;
      if (!sound) {
        ++counters.undone;
        next.push_back(std::move(block));
        continue;
      }
      ++counters.cuts;
      next.push_back(std::move(below.part));
      next.push_back(std::move(above.part));
    }
    blocks = std::move(next);
    if (blocks.size() > limits.most_blocks) {
      counters.given_up = true;
      break;
    }
  }
  std::sort(blocks.begin(), blocks.end(),
            [](const Polytope<Dim>& a, const Polytope<Dim>& b) { return in_order(a.mass, b.mass); });
  return blocks;
}

template std::vector<Polytope<2>> slice<2>(const Polytope<2>&, const std::vector<Cut<2>>&, const SlicingLimits&,
                                           SlicingCounters&);
template std::vector<Polytope<3>> slice<3>(const Polytope<3>&, const std::vector<Cut<3>>&, const SlicingLimits&,
                                           SlicingCounters&);

}  // namespace voussoir
