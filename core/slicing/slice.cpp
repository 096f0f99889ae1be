#include "core/slicing/slice.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <deque>
#include <map>
#include <numeric>
#include <optional>

#include "core/base/on_threads.hpp"
#include "core/geometry/half_space_inl.hpp"
#include "core/slicing/block.hpp"

namespace voussoir {
namespace {

// a joint this close to a block's surface (times the inscribed radius) does not cut it
constexpr double cut_tolerance = 1e-10;

// A cut that leaves no more than this of the coordinates beyond it leaves no block (block.hpp): vertices, whose own
// rounding this is, need no closer check.
constexpr double vertex_rounding = 8 * std::numeric_limits<double>::epsilon();

// the work is handed to threads in about as many pieces, for any number of threads
constexpr std::size_t handed_out = 256;

template <int Dim>
using Cuts = std::vector<Cut<Dim>>;

// a block that is not finished, and the joints that may yet cut it, in slicing order
template <int Dim>
struct Piece {
  Draft<Dim> block;
  std::vector<int> joints;
};

template <int Dim>
struct Harvest {
  std::vector<Polytope<Dim>> blocks;
  SlicingCounters counters;
};

// Whether a block may reach to both sides of the plane, and below every bound of the extent, by ball and vertices in
// place of the programs of Eq. 3.17: a block that the linear program would find deeper than its tolerance has vertices
// deeper than half of it.
template <int Dim>
bool may_meet(const Cut<Dim>& cut, const Draft<Dim>& block) {
  const Vector<Dim>& centre = block.ball.point;
  if (!((cut.extent.centre - centre).norm() <= cut.extent.radius + block.extent)) return false;
  const double distance = signed_distance<Dim>(cut.plane, centre);
  if (std::abs(distance) > block.extent) return false;

  const double margin =
      std::max(cut_tolerance / 2 * block.inscribed_radius(), vertex_rounding * (centre.norm() + block.extent));
  const auto reaches_below = [&](const HalfSpace<Dim>& plane) {
    return std::any_of(block.vertices.begin(), block.vertices.end(),
                       [&](const Vector<Dim>& v) { return signed_distance<Dim>(plane, v) < -margin; });
  };
  return reaches_below(cut.plane) && reaches_below({-cut.plane.normal, -cut.plane.offset}) &&
         std::all_of(cut.extent.bounds.begin(), cut.extent.bounds.end(), reaches_below);
}

// Eq. 3.16 in the joint's own coordinates y, x = x0 + E y: min s : (a_i E)·y - (d_i - a_i·x0) <= s over the block's
// faces and the extent's bounds
template <int Dim>
bool meets(const Cut<Dim>& cut, const Draft<Dim>& block, SlicingCounters& counters) {
  const double distance = signed_distance<Dim>(cut.plane, block.ball.point);
  const bool through_ball = std::abs(distance) < 0.999 * block.inscribed_radius();
  if (through_ball && cut.extent.infinite()) return true;

  const Vector<Dim> x0 = block.ball.point - distance * cut.plane.normal;
  const auto axes = plane_axes(cut.plane.normal);
  HalfSpaces<Dim - 1> section;
  section.reserve(block.faces.size() + cut.extent.bounds.size());
  for (const HalfSpaces<Dim>* planes : {&block.faces, &cut.extent.bounds})
    for (const HalfSpace<Dim>& p : *planes)
      section.push_back({axes.transpose() * p.normal, -signed_distance<Dim>(p, x0)});
  ++counters.lp_solves;
  return solve_feasibility<Dim - 1>(section, {}).value < -cut_tolerance * block.inscribed_radius();
}

template <int Dim>
double aspect_ratio(const Draft<Dim>& block, AspectMeasure measure) {
  Vector<Dim> low = block.vertices.front(), high = low;
  for (const Vector<Dim>& v : block.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  if (measure == AspectMeasure::box) return (high - low).maxCoeff() / (high - low).minCoeff();
  double radius = 0;
  for (const Vector<Dim>& v : block.vertices)
    radius = std::max(radius, (v - low - 0.5 * (high - low)).norm());
  return radius / block.inscribed_radius();
}

template <int Dim>
bool sound(const Draft<Dim>& block, const SlicingLimits& limits) {
  if (block.inscribed_radius() < limits.smallest_inscribed_radius) return false;
  return std::isinf(limits.largest_aspect_ratio) ||
         aspect_ratio(block, limits.aspect_measure) <= limits.largest_aspect_ratio;
}

// the joints of a parent from `first` on that may cut its child
template <int Dim>
std::vector<int> handed_on(const std::vector<int>& joints, std::size_t first, const Cuts<Dim>& cuts,
                           const Draft<Dim>& child, const SlicingLimits& limits, SlicingCounters& counters) {
  if (!limits.culling) return {joints.begin() + first, joints.end()};
  std::vector<int> some;
  counters.tests += static_cast<long long>(joints.size() - first);
  for (std::size_t k = first; k < joints.size(); ++k)
    if (may_meet(cuts[joints[k]], child)) some.push_back(joints[k]);
  return some;
}

template <int Dim>
using PiecePair = std::pair<Piece<Dim>, Piece<Dim>>;

// cuts the piece by the first of its joints that meets it; nothing when none does
template <int Dim>
std::optional<PiecePair<Dim>> split(const Piece<Dim>& piece, const Cuts<Dim>& cuts, const SlicingLimits& limits,
                                    SlicingCounters& counters) {
  for (std::size_t k = 0; k < piece.joints.size(); ++k) {
    const Cut<Dim>& cut = cuts[piece.joints[k]];
    if (!meets(cut, piece.block, counters)) continue;
    // cut right through: both sides get the joint as a new face
    PiecePair<Dim> children;
    auto& [below, above] = children;
    const HalfSpace<Dim> reversed{-cut.plane.normal, -cut.plane.offset};
    // a piece cut by a construction joint stays one body with its surroundings, or is removed: an outline is exact
    const auto suits = [&](const Draft<Dim>& child) {
      return cut.kind == JointKind::construction || sound(child, limits);
    };
    const bool made = cut_draft(piece.block, cut.plane, cut.joint, below.block) == BlockStatus::ok &&
                      suits(below.block) &&
                      cut_draft(piece.block, reversed, cut.joint, above.block) == BlockStatus::ok && suits(above.block);
    if (!made) {
      ++counters.undone;
      continue;
    }
    ++counters.cuts;
    if (cut.fixed_side != JointSide::below)
      below.joints = handed_on(piece.joints, k + 1, cuts, below.block, limits, counters);
    if (cut.fixed_side != JointSide::above)
      above.joints = handed_on(piece.joints, k + 1, cuts, above.block, limits, counters);
    return children;
  }
  return {};
}

template <int Dim>
void harvest(Piece<Dim>&& piece, Harvest<Dim>& result) {
  BlockResult<Dim> block = finish(std::move(piece.block));
  assert(block.status == BlockStatus::ok);
  if (block.status == BlockStatus::ok)
    result.blocks.push_back(std::move(block.part));
  else
    result.counters.given_up = true;
}

// A piece becomes two, which are open, or a finished block; `made` counts the cuts of all pieces.
template <int Dim, class Pieces>
void advance(Piece<Dim>&& piece, const Cuts<Dim>& cuts, const SlicingLimits& limits, std::atomic<std::size_t>& made,
             Pieces& open, Harvest<Dim>& result) {
  if (auto children = split(piece, cuts, limits, result.counters)) {
    ++made;
    open.push_back(std::move(children->first));
    open.push_back(std::move(children->second));
  } else {
    harvest(std::move(piece), result);
  }
}

// All blocks of a piece, depth first, so that few are unfinished at a time.
template <int Dim>
void cut_up(Piece<Dim> first, const Cuts<Dim>& cuts, const SlicingLimits& limits, std::atomic<std::size_t>& made,
            Harvest<Dim>& result) {
  std::vector<Piece<Dim>> open;
  open.push_back(std::move(first));
  while (!open.empty() && made <= limits.most_blocks) {
    Piece<Dim> piece = std::move(open.back());
    open.pop_back();
    advance(std::move(piece), cuts, limits, made, open, result);
  }
}

// The largest pieces of the work, breadth first, and blocks that are finished before.
template <int Dim>
std::deque<Piece<Dim>> hand_out(Piece<Dim> first, const Cuts<Dim>& cuts, const SlicingLimits& limits,
                                std::atomic<std::size_t>& made, Harvest<Dim>& result) {
  std::deque<Piece<Dim>> open;
  open.push_back(std::move(first));
  while (!open.empty() && open.size() < handed_out && made <= limits.most_blocks) {
    Piece<Dim> piece = std::move(open.front());
    open.pop_front();
    advance(std::move(piece), cuts, limits, made, open, result);
  }
  return open;
}

void add(SlicingCounters& total, const SlicingCounters& some) {
  total.tests += some.tests;
  total.lp_solves += some.lp_solves;
  total.cuts += some.cuts;
  total.undone += some.undone;
  total.given_up = total.given_up || some.given_up;
}

template <int Dim>
std::vector<Polytope<Dim>> in_canonical_order(std::vector<Harvest<Dim>>& harvests) {
  std::vector<Polytope<Dim>*> places;
  for (Harvest<Dim>& h : harvests)
    for (Polytope<Dim>& block : h.blocks)
      places.push_back(&block);
  std::sort(places.begin(), places.end(),
            [](const Polytope<Dim>* a, const Polytope<Dim>* b) { return in_order(a->mass, b->mass); });
  std::vector<Polytope<Dim>> blocks;
  blocks.reserve(places.size());
  for (Polytope<Dim>* block : places)
    blocks.push_back(std::move(*block));
  return blocks;
}

}  // namespace

template <int Dim>
std::vector<Polytope<Dim>> slice(const Polytope<Dim>& domain, const std::vector<Cut<Dim>>& cuts,
                                 const SlicingLimits& limits, SlicingCounters& counters) {
  std::vector<int> every(cuts.size());
  std::iota(every.begin(), every.end(), 0);
  std::atomic<std::size_t> made = 1;
  std::vector<Harvest<Dim>> harvests(1);
  Piece<Dim> root{make_draft(domain), {}};
  root.joints = handed_on(every, 0, cuts, root.block, limits, harvests[0].counters);
  std::deque<Piece<Dim>> pieces = hand_out(std::move(root), cuts, limits, made, harvests[0]);

  const int count = static_cast<int>(pieces.size());
  harvests.resize(1 + pieces.size());
  on_threads(limits.threads, count, [&](int i) { cut_up(std::move(pieces[i]), cuts, limits, made, harvests[1 + i]); });

  for (const Harvest<Dim>& h : harvests)
    add(counters, h.counters);
  // beyond the largest number some blocks may have been left uncut
  counters.given_up = counters.given_up || made > limits.most_blocks;
  return counters.given_up ? std::vector<Polytope<Dim>>{} : in_canonical_order(harvests);
}

template <int Dim>
std::vector<int> boundary_parts(const std::vector<Polytope<Dim>>& parts, const std::vector<Cut<Dim>>& cuts) {
  // a side that such a joint leaves in one piece is never cut again, and keeps its face
  std::map<int, const Cut<Dim>*> boundaries;
  for (const Cut<Dim>& cut : cuts)
    if (cut.fixed_side != JointSide::none) boundaries[cut.joint] = &cut;
  std::vector<int> whole;
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (std::size_t f = 0; f < parts[p].faces.size(); ++f) {
      const auto at = boundaries.find(parts[p].joints[f]);
      if (at == boundaries.end()) continue;
      const bool below = parts[p].faces[f].normal.dot(at->second->plane.normal) > 0;
      if (below != (at->second->fixed_side == JointSide::below)) continue;
      whole.push_back(static_cast<int>(p));
      break;
    }
  return whole;
}

template std::vector<Polytope<2>> slice<2>(const Polytope<2>&, const std::vector<Cut<2>>&, const SlicingLimits&,
                                           SlicingCounters&);
template std::vector<Polytope<3>> slice<3>(const Polytope<3>&, const std::vector<Cut<3>>&, const SlicingLimits&,
                                           SlicingCounters&);
template std::vector<int> boundary_parts<2>(const std::vector<Polytope<2>>&, const std::vector<Cut<2>>&);
template std::vector<int> boundary_parts<3>(const std::vector<Polytope<3>>&, const std::vector<Cut<3>>&);

}  // namespace voussoir
