#include "core/scene/stated_bodies.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/geometry/eigen_pairs.hpp"
#include "core/potential/particle.hpp"
#include "core/scene/bodies.hpp"
#include "core/scene/particles.hpp"
#include "core/slicing/block.hpp"

namespace voussoir {
namespace {

// of the smaller part's volume: far above the rounding of stated corners, far below a change of results
constexpr double least_overlap = 1e-6;

template <int Dim>
struct Box {
  Vector<Dim> low, high;
};

template <int Dim>
Box<Dim> box_of(const Polytope<Dim>& part) {
  Box<Dim> box{part.vertices.front(), part.vertices.front()};
  for (const Vector<Dim>& v : part.vertices) {
    box.low = box.low.cwiseMin(v);
    box.high = box.high.cwiseMax(v);
  }
  return box;
}

template <int Dim>
Box<Dim> intersection(const Box<Dim>& a, const Box<Dim>& b) {
  return {a.low.cwiseMax(b.low), a.high.cwiseMin(b.high)};
}

template <int Dim>
bool is_empty(const Box<Dim>& box) {
  return (box.low.array() >= box.high.array()).any();
}

// The axes of a part, scaled by its width along each: in these coordinates the part is round, so that no relevant
// overlap is too thin to be a block (BlockStatus::flat), however thin the part is.
template <int Dim>
Matrix<Dim> round_axes_of(const Polytope<Dim>& part) {
  const Vector<Dim>& c = part.mass.centroid;
  const EigenPairs<Dim> own = eigen_pairs<Dim>(part.mass.second_moment / part.mass.volume - c * c.transpose());
  // no convex part spreads less than its inscribed ball: a bound if rounding leaves nothing
  const double least = 0.1 * part.inscribed_radius;
  const Vector<Dim> widths = own.values.cwiseMax(least * least).cwiseSqrt();
  return own.vectors * widths.asDiagonal();
}

template <int Dim>
double shared_by_planes(const Polytope<Dim>& smaller, const Polytope<Dim>& larger) {
  const Matrix<Dim> axes = round_axes_of(smaller);
  HalfSpaces<Dim> planes;
  for (const Polytope<Dim>* part : {&smaller, &larger})
    for (const HalfSpace<Dim>& face : part->faces)
      planes.push_back(
          {axes.transpose() * face.normal, face.offset - face.normal.dot(Vector<Dim>(smaller.mass.centroid))});
  const BlockResult<Dim> shared = make_block<Dim>(planes, std::vector<int>(planes.size(), no_joint));
  return shared.status == BlockStatus::ok ? std::abs(axes.determinant()) * shared.part.mass.volume : 0;
}

template <int Dim>
bool contains(const Polytope<Dim>& part, const Vector<Dim>& point) {
  if (is_particle(part)) return outside_by<Dim>(part, point) <= 0;
  return std::ranges::all_of(part.faces, [&](const auto& face) { return signed_distance<Dim>(face, point) <= 0; });
}

// midpoints of the cells of a box that are in both parts
template <int Dim>
double shared_by_points(const Polytope<Dim>& a, const Polytope<Dim>& b, const Box<Dim>& box) {
  constexpr int cells = Dim == 2 ? 300 : 40;  // along each axis: a relevant lens fills about 20 cells
  const Vector<Dim> size = box.high - box.low;
  const int layers = Dim == 2 ? 1 : cells;
  long inside = 0;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < layers; ++k) {
        const std::array<int, 3> cell{i, j, k};
        Vector<Dim> point = box.low;
        for (int axis = 0; axis < Dim; ++axis)
          point[axis] += (cell[axis] + 0.5) / cells * size[axis];
        inside += contains(a, point) && contains(b, point);
      }
  return static_cast<double>(inside) / (cells * cells * layers) * size.prod();
}

[[noreturn]] void refuse_pair(const BlockSpec& first, const BlockSpec& second, int dimension, double shared,
                              double fraction, bool about) {
  // the owner of a body states no part_of
  const bool of_second = !second.part_of.empty();
  const BlockSpec &part = of_second ? second : first, &other = of_second ? first : second;
  refuse(part.subject, "part_of",
         fmt::format("overlaps part '{}' of the same body by {}{:.6g} {}, {:.3g} of the smaller one; parts of one body "
                     "may touch but not overlap (by more than 1e-6 of the smaller one), since mass, weight, contact "
                     "area and water would count twice: end one part at the face of the other",
                     one_line(other.name, 60), about ? "about " : "", shared, dimension == 2 ? "m²" : "m³", fraction));
}

// Common volume of two parts, m³ (2-D: m²): exact for half-spaces, to a few percent for potential particles. Zero for
// parts that only touch.
template <int Dim>
double shared_volume(const Polytope<Dim>& a, const Polytope<Dim>& b, const Box<Dim>& box) {
  if (is_particle(a) || is_particle(b)) return shared_by_points(a, b, box);
  return a.mass.volume < b.mass.volume ? shared_by_planes(a, b) : shared_by_planes(b, a);
}

// the first two parts of a body that overlap; `stated` holds the table of each part
template <int Dim>
void refuse_overlaps(const std::vector<Polytope<Dim>>& parts, const std::vector<const BlockSpec*>& stated) {
  std::vector<Box<Dim>> boxes;
  for (const Polytope<Dim>& part : parts)
    boxes.push_back(box_of(part));
  for (std::size_t j = 1; j < parts.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const Box<Dim> box = intersection(boxes[i], boxes[j]);
      if (is_empty(box)) continue;
      const double shared = shared_volume(parts[i], parts[j], box);
      const double fraction = shared / std::min(parts[i].mass.volume, parts[j].mass.volume);
      if (fraction > least_overlap)
        refuse_pair(*stated[i], *stated[j], Dim, shared, fraction, is_particle(parts[i]) || is_particle(parts[j]));
    }
}

// the block to whose body a further part belongs
const BlockSpec& owner_of(const Scene& scene, const BlockSpec& part) {
  std::vector<std::string> owners;
  for (const BlockSpec& block : scene.blocks) {
    if (!block.part_of.empty()) continue;
    if (block.name == part.part_of) return block;
    owners.push_back(block.name);
  }
  refuse(part.subject, "part_of", "no body has this name; " + suggestion(part.part_of, owners));
}

}  // namespace

template <int Dim>
std::vector<StatedBody<Dim>> stated_bodies(const Scene& scene, const Vector<Dim>& origin) {
  std::map<std::string, std::vector<Polytope<Dim>>> parts;
  std::map<std::string, std::vector<const BlockSpec*>> stated;
  for (const BlockSpec& block : scene.blocks) {
    Polytope<Dim> part = make_solid<Dim>(scene, block, origin);
    if (block.shape == BlockShape::potential) part = finish_particle<Dim>(block, std::move(part));
    const std::string& owner = block.part_of.empty() ? block.name : owner_of(scene, block).name;
    parts[owner].push_back(std::move(part));
    stated[owner].push_back(&block);
  }
  std::vector<StatedBody<Dim>> bodies;
  for (const BlockSpec& block : scene.blocks) {
    if (!block.part_of.empty()) continue;
    refuse_overlaps(parts[block.name], stated[block.name]);
    bodies.push_back({&block, std::move(parts[block.name])});
  }
  return bodies;
}

template std::vector<StatedBody<2>> stated_bodies<2>(const Scene&, const Vector<2>&);
template std::vector<StatedBody<3>> stated_bodies<3>(const Scene&, const Vector<3>&);

}  // namespace voussoir
