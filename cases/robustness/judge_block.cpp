#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "cases/robustness/judges.hpp"
#include "core/slicing/slice.hpp"
#include "core/testing/exact_referee.hpp"

namespace voussoir::atlas {
namespace {

using exact::Quad;
using exact::to_double;

// make_block's own tolerances (slicing/block.cpp): corners closer than this fraction of the extent are one, and a plane
// that cuts off no ball larger than this fraction of the inscribed radius is dropped
constexpr double merged = 1e-10;

// a block reported as empty contains no ball larger than this fraction of the coordinates
constexpr double room = 1e-10;

// Largest increase of the volume by dropping such a plane: V >= radius x surface / 3, and a cap that holds only such a
// ball is a few of its diameters thick
constexpr double dropped_volume = 1e-9;

// slice's tolerance: a joint whose section holds no circle larger than this fraction of the inscribed radius does not
// cut
constexpr double cut_tolerance = 1e-10;

double support(const std::vector<std::array<double, 3>>& points, const Vector<3>& u) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const auto& p : points)
    highest = std::max(highest, u[0] * p[0] + u[1] * p[1] + u[2] * p[2]);
  return highest;
}

double support(const std::vector<Vector<3>>& points, const Vector<3>& u) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const Vector<3>& p : points)
    highest = std::max(highest, u.dot(p));
  return highest;
}

// the input as make_block sees it: unit normals
HalfSpaces<3> normalised(HalfSpaces<3> planes) {
  for (HalfSpace<3>& p : planes) {
    const double length = p.normal.norm();
    p.normal /= length;
    p.offset /= length;
  }
  return planes;
}

double extent_of(const std::vector<Vector<3>>& vertices, const Vector<3>& centre) {
  double extent = 0;
  for (const Vector<3>& v : vertices)
    extent = std::max(extent, (v - centre).norm());
  return extent;
}

// The solid of a part's own faces, and the same with its planes moved in and out by the rounding: volume and supports
// grow with the planes, so these bracket them.
struct Bracket {
  exact::Solid inner, middle, outer;
};

// vertices, volume, centroid and inertia against the part's own planes
Judgement judge_part(const Polytope<3>& part, double band, double* spread_of_volume = nullptr) {
  const exact::Planes faces = exact::planes_of(part.faces);
  const Bracket b{exact::solid(exact::grown(faces, -band)), exact::solid(faces),
                  exact::solid(exact::grown(faces, band))};
  const double extent = extent_of(part.vertices, part.centre);
  const double low = to_double(b.inner.volume), high = to_double(b.outer.volume), spread = high - low;
  const double volume_fraction =
      std::abs(to_double(Quad(part.mass.volume) - b.middle.volume)) / (0.5 * spread + merged * merged * high);
  if (!(volume_fraction <= 1))
    return wrong(fmt::format("volume {:.17g}, exactly {:.17g}, bracket {:.3g}", part.mass.volume,
                             to_double(b.middle.volume), spread));

  // the centroid moves by no more than the fraction of the volume that moved, times the extent
  double centroid_error = 0;
  for (int k = 0; k < 3; ++k)
    centroid_error = std::max(centroid_error, std::abs(to_double(Quad(part.mass.centroid[k]) - b.middle.centroid[k])));
  const double centroid_fraction = centroid_error / (spread / high * 2 * extent + band);
  if (!(centroid_fraction <= 1)) return wrong(fmt::format("centroid off by {:.3g}", centroid_error));

  // the body's tensor about its centroid
  const Body<3> body = make_body<3>({part}, 1);
  Matrix<3> tensor = body.principal_axes * body.inertia.asDiagonal() * body.principal_axes.transpose();
  double inertia_error = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Quad expected = -b.middle.second_moment[i][j];
      if (i == j)
        for (int k = 0; k < 3; ++k)
          expected += b.middle.second_moment[k][k];
      inertia_error = std::max(inertia_error, std::abs(to_double(Quad(tensor(i, j)) - expected)));
    }
  const double inertia_fraction = inertia_error / (4 * extent * extent * spread + 4 * band * extent * high);
  if (!(inertia_fraction <= 1))
    return wrong(fmt::format("inertia off by {:.3g} of {:.3g}", inertia_error, tensor.trace()));

  // supports in the faces' directions and in some others
  double support_fraction = 0;
  for (std::size_t f = 0; f < part.faces.size() + 7; ++f) {
    Vector<3> u(std::sin(1.0 + f), std::sin(2.3 * f), std::cos(3.1 * f));
    u = f < part.faces.size() ? part.faces[f].normal : Vector<3>(u.normalized());
    const double found = support(part.vertices, u), least = support(b.inner.corners, u),
                 most = support(b.outer.corners, u);
    const double allowed = merged * extent + band;
    support_fraction = std::max({support_fraction, (least - found) / allowed, (found - most) / allowed});
  }
  if (!(support_fraction <= 1)) return wrong(fmt::format("a vertex is off by {:.3g} of the promise", support_fraction));
  // a face that bounds nothing may remain only if rounding cannot decide it
  for (const HalfSpace<3>& f : part.faces)
    if (support(b.outer.corners, f.normal) < f.offset) return wrong("a face that bounds nothing");
  if (spread_of_volume) *spread_of_volume = spread;
  return {Verdict::correct, "", std::max({volume_fraction, centroid_fraction, inertia_fraction, support_fraction})};
}

Judgement judge_refusal(const exact::Planes& planes, BlockStatus status, double coordinates) {
  const double band = whole_chain * coordinates;
  const exact::Program ball = exact::feasibility(planes);
  const double value = ball.bounded ? ball.value.get_d() : -std::numeric_limits<double>::infinity();
  if (status == BlockStatus::empty && value < -std::max(band, room * coordinates))
    return wrong(fmt::format("empty, with a ball of {:.3g}", -value));
  if (status == BlockStatus::open) return wrong("open, though it is closed");  // every instance is closed
  if (status == BlockStatus::bad_plane) return wrong("a bad plane, though all are planes");
  return {Verdict::refused, "", 0};
}

Judgement judge_made(const HalfSpaces<3>& planes) {
  const BlockResult<3> made = make_block<3>(planes, std::vector<int>(planes.size(), no_joint));
  const exact::Planes input = exact::planes_of(normalised(planes));
  double coordinates = 0;
  for (const HalfSpace<3>& p : planes)
    coordinates = std::max(coordinates, std::abs(p.offset));
  if (made.status != BlockStatus::ok) return judge_refusal(input, made.status, coordinates);

  const Polytope<3>& part = made.part;
  const double band = whole_chain * std::max(coordinates, part.radius);
  const double ball = -exact::feasibility(exact::planes_of(part.faces)).value.get_d();
  if (std::abs(ball - part.inscribed_radius) > band + merged * ball) return wrong("the inscribed ball is off");
  double spread = 0;
  Judgement judgement = judge_part(part, band, &spread);
  if (judgement.verdict == Verdict::wrong) return judgement;

  // dropped planes: nothing lost, or no more than the stated band
  const double kept = to_double(exact::solid(exact::planes_of(part.faces)).volume);
  const double whole = to_double(exact::solid(input).volume);
  if (kept > whole * (1 + dropped_volume) + spread)
    return wrong(fmt::format("a needed plane was dropped: {:.3g}", kept / whole - 1));
  if (kept > whole + spread) judgement.verdict = Verdict::warned;  // more than planes moved by rounding lose
  return judgement;
}

Judgement judge_pieces(const Polytope<3>& block, const HalfSpace<3>& joint) {
  SlicingCounters counters;
  const std::vector<Polytope<3>> pieces = slice<3>(block, {{joint, 0}}, {}, counters);
  const exact::Planes faces = exact::planes_of(block.faces);
  const exact::Plane plane = exact::planes_of(HalfSpaces<3>{joint})[0];
  const double value = exact::section_feasibility(faces, plane).value.get_d();
  const double band = whole_chain * (block.radius + std::abs(joint.offset));
  const double limit = -cut_tolerance * block.inscribed_radius;
  if (counters.undone > 0)
    return value > band ? wrong("tried to cut a block that it misses") : Judgement{Verdict::refused, "", 0};
  if (pieces.size() == 1) {
    if (value < limit - band) return wrong(fmt::format("not cut, though the section holds a circle of {:.3g}", -value));
    return {value < 0 ? Verdict::warned : Verdict::correct, "", 0};
  }
  if (value > limit + band) return wrong(fmt::format("cut, though s* = {:.3g}", value));

  Judgement judgement{value > limit - band ? Verdict::warned : Verdict::correct, "", 0};
  double spreads = 0, spread = 0;
  for (const Polytope<3>& piece : pieces) {
    const Judgement j = judge_part(piece, whole_chain * std::max(piece.radius, block.radius), &spread);
    spreads += spread;
    if (j.verdict == Verdict::wrong) return j;
    judgement.fraction = std::max(judgement.fraction, j.fraction);
  }
  const double sum = pieces[0].mass.volume + pieces[1].mass.volume, whole = to_double(exact::solid(faces).volume);
  const double fraction = std::abs(sum - whole) / (dropped_volume * whole + spreads);
  if (fraction > 1) return wrong(fmt::format("the pieces' volumes miss the block's by {:.3g}", sum / whole - 1));
  return judgement;
}

}  // namespace

// the referee throws if the faces of a part do not close it: then the part is wrong
Judgement judge_block(const HalfSpaces<3>& planes) {
  try {
    return judge_made(planes);
  } catch (const std::logic_error& problem) {
    return wrong(problem.what());
  }
}

Judgement judge_cut(const Polytope<3>& block, const HalfSpace<3>& joint) {
  try {
    return judge_pieces(block, joint);
  } catch (const std::logic_error& problem) {
    return wrong(problem.what());
  }
}

}  // namespace voussoir::atlas
