#include "core/contact/region_integral.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace voussoir {
namespace {

// A region so much smaller than the simplex may have lost a corner to the simplex's rounding: it is cut again from a
// smaller one.
constexpr double lost_corners = 1e5;

// of the simplex: cuts leave corners no farther off than this, unless their planes all but depend on each other
constexpr double cut_error = 1e-10;

// as often as this
constexpr int most_passes = 8;

// of the simplex: the corners of a smaller region are recomputed from their planes
constexpr double small = 1e-4;

// Planes as bits of a word: those of the parts from bit 0, the simplex's own behind them, t >= 0 last.
using Planes = std::uint64_t;
constexpr int base = 63, most_planes = 58;
constexpr Planes of_simplex = ((Planes{1} << base) - 1) & ~((Planes{1} << most_planes) - 1);

constexpr Planes bit(int plane) {
  return Planes{1} << plane;
}

// whether so few planes are among these; counting them all takes longer without an instruction for it
template <int Count>
bool fewer_than(Planes planes) {
  for (int k = 1; k < Count; ++k)
    planes &= planes - 1;
  return planes == 0;
}

template <int Dim>
struct Corner {
  Vector<Dim> x;
  double t;
  Planes on;     // that pass through it
  double slack;  // of the plane that cuts
};

enum class CutResult { as_it_was, smaller, nothing_left, no_bit_left };

template <int Dim>
struct LiftedPolytope {
  std::vector<Corner<Dim>> corners, fresh;
  std::array<int, most_planes> plane;  // the plane of each bit

  // {x_i >= -half, t >= 0, Σ x_i + t <= bound of the cube}
  void begin(double half) {
    const double edge = (2 * Dim + 1) * half;
    Planes all = bit(base);
    for (int i = 0; i <= Dim; ++i)
      all |= bit(most_planes + i);
    corners.clear();
    for (int k = 0; k <= Dim + 1; ++k) {  // the corner opposite to plane k
      Corner<Dim> c{Vector<Dim>::Constant(-half), 0, all, 0};
      if (k < Dim) {
        c.x[k] += edge;
        c.on &= ~bit(most_planes + k);
      } else if (k == Dim) {
        c.t = edge;
        c.on &= ~bit(base);
      } else {
        c.on &= ~bit(most_planes + Dim);
      }
      corners.push_back(c);
    }
  }

  // whether two corners are the ends of an edge
  bool joined(const Corner<Dim>& a, const Corner<Dim>& b) const {
    const Planes both = a.on & b.on;
    if (fewer_than<Dim>(both)) return false;
    if (fewer_than<Dim + 2>(a.on) || fewer_than<Dim + 2>(b.on)) return true;  // one of them is on no more planes
    return std::ranges::none_of(corners,
                                [&](const Corner<Dim>& c) { return &c != &a && &c != &b && (c.on & both) == both; });
  }

  // no corner is beyond a plane of either part that is as far from the origin
  double reach() const {
    double reach = 0;
    for (const Corner<Dim>& c : corners)
      reach = std::max(reach, c.x.norm() + c.t);
    return reach;
  }

  // The part of it in {a·x + t <= d}. It may be empty, or no bit may be free.
  CutResult cut(const HalfSpace<Dim>& p, int number) {
    double least = 0;
    Planes used = 0;
    for (Corner<Dim>& c : corners) {
      c.slack = p.offset - p.normal.dot(c.x) - c.t;
      least = std::min(least, c.slack);
      used |= c.on;
    }
    if (!(least < 0)) return CutResult::as_it_was;
    const int own = std::countr_one(used);
    if (own >= most_planes) return CutResult::no_bit_left;
    plane[own] = number;
    fresh.clear();
    for (Corner<Dim>& in : corners) {
      if (in.slack < 0) continue;
      fresh.push_back(in);
      if (in.slack == 0) {
        fresh.back().on |= bit(own);
        continue;
      }
      for (const Corner<Dim>& out : corners) {
        if (!(out.slack < 0) || !joined(in, out)) continue;
        const double way = in.slack / (in.slack - out.slack);
        fresh.push_back({in.x + way * (out.x - in.x), in.t + way * (out.t - in.t), (in.on & out.on) | bit(own), 0});
      }
    }
    std::swap(corners, fresh);
    return corners.size() > Dim + 1 ? CutResult::smaller : CutResult::nothing_left;
  }
};

// What is left in the equations a·x + t = d of the planes that meet at a corner.
template <int Dim>
FixedMatrix<Dim + 1, 1> off_planes(const HalfSpaces<Dim>& planes, const Vector<Dim>& shift,
                                   const LiftedPolytope<Dim>& polytope, const Corner<Dim>& c) {
  FixedMatrix<Dim + 1, 1> off;
  Planes left = c.on;
  for (int k = 0; k <= Dim; ++k, left &= left - 1) {
    const int b = std::countr_zero(left);
    off[k] = -c.t;
    if (b == base) continue;
    const HalfSpace<Dim>& p = planes[polytope.plane[b]];
    off[k] = (p.offset - p.normal.dot(shift)) - p.normal.dot(c.x) - c.t;
  }
  return off;
}

// The inverse of those equations' matrix: times off_planes it is the way to where the planes meet. False where more
// planes meet than determine the corner, or where they nearly depend on each other.
template <int Dim>
bool find_way_to_planes(const HalfSpaces<Dim>& planes, const LiftedPolytope<Dim>& polytope, const Corner<Dim>& c,
                        FixedMatrix<Dim + 1, Dim + 1>& way) {
  if (!fewer_than<Dim + 2>(c.on) || (c.on & of_simplex) != 0) return false;
  FixedMatrix<Dim + 1, Dim + 1> rows;
  Planes left = c.on;
  for (int k = 0; k <= Dim; ++k, left &= left - 1) {
    const int b = std::countr_zero(left);
    if (b == base)
      rows.row(k) = FixedMatrix<1, Dim + 1>::Unit(Dim);
    else
      rows.row(k) << planes[polytope.plane[b]].normal.transpose(), 1;
  }
  bool independent = false;
  rows.computeInverseWithCheck(way, independent);
  return independent;
}

template <int Dim>
void go(const FixedMatrix<Dim + 1, 1>& step, Corner<Dim>& c) {
  c.x += step.template head<Dim>();
  c.t += step[Dim];
}

// Corners without the errors of the cuts; one that its planes do not determine is kept.
template <int Dim>
void sharpen(const HalfSpaces<Dim>& planes, const Vector<Dim>& shift, double half, LiftedPolytope<Dim>& polytope) {
  for (Corner<Dim>& c : polytope.corners) {
    FixedMatrix<Dim + 1, Dim + 1> way;
    if (!find_way_to_planes(planes, polytope, c, way)) continue;
    const FixedMatrix<Dim + 1, 1> step = way * off_planes(planes, shift, polytope, c);
    if (step.norm() < cut_error * half) go<Dim>(step, c);
  }
}

// the position of a direction on a full turn, 0 to 4, growing with its angle
double way_round(double x, double y) {
  const double length = std::abs(x) + std::abs(y);
  if (!(length > 0)) return 0;
  return y >= 0 ? 1 - x / length : 3 + x / length;
}

// ---- pieces of the surface between two facets --------------------------------------------------------------------

// Its area as a vector, of either direction, and phi on it.
template <int Dim>
struct Piece {
  Vector<Dim> area = Vector<Dim>::Zero();
  double weight = 0;                        // ∫ phi dS
  double square = 0;                        // ∫ phi² dS
  Vector<Dim> lever = Vector<Dim>::Zero();  // ∫ phi x dS
};

// The corners at which two of the polytope's facets meet, in their order around the piece.
struct PieceCorners {
  int plane_a, plane_b;
  std::vector<int> at;
};

void put_in_order(const LiftedPolytope<2>&, const Vector<2>&, std::vector<int>&) {}

// `normal`: of any length, near the piece's own
void put_in_order(const LiftedPolytope<3>& polytope, const Vector<3>& normal, std::vector<int>& at) {
  if (at.size() <= 3) return;
  const Vector<3> n = normal.normalized(), e = perpendicular(n), f = n.cross(e);
  Vector<3> middle = Vector<3>::Zero();
  for (const int c : at)
    middle += polytope.corners[c].x;
  middle /= static_cast<double>(at.size());
  static thread_local std::vector<std::pair<double, int>> round;
  round.clear();
  for (const int c : at) {
    const Vector<3> from = polytope.corners[c].x - middle;
    round.emplace_back(way_round(e.dot(from), f.dot(from)), c);
  }
  std::ranges::sort(round, {}, [](const auto& r) { return r.first; });
  for (std::size_t k = 0; k < at.size(); ++k)
    at[k] = round[k].second;
}

template <int Dim>
struct Pieces {
  std::vector<PieceCorners> list;
  int count = 0;  // of the list: the others keep their storage

  // `energy`: also those between facets of one part, on which no force acts
  void find(const HalfSpaces<Dim>& planes, int faces_a, bool energy, const LiftedPolytope<Dim>& polytope) {
    Planes used = 0;
    for (const Corner<Dim>& c : polytope.corners)
      used |= c.on;
    used &= bit(most_planes) - 1;
    count = 0;
    for (Planes i = used; i != 0; i &= i - 1)
      for (Planes j = i & (i - 1); j != 0; j &= j - 1) {
        const int p = polytope.plane[std::countr_zero(i)], q = polytope.plane[std::countr_zero(j)];
        if (!energy && (p < faces_a) == (q < faces_a)) continue;
        const Planes both = (i & -i) | (j & -j);
        if (count == static_cast<int>(list.size())) list.emplace_back();
        PieceCorners& piece = list[count];
        piece.at.clear();
        for (std::size_t c = 0; c < polytope.corners.size(); ++c)
          if ((polytope.corners[c].on & both) == both) piece.at.push_back(static_cast<int>(c));
        if (piece.at.size() < Dim) continue;
        piece.plane_a = p;
        piece.plane_b = q;
        put_in_order(polytope, Vector<Dim>(planes[p].normal - planes[q].normal), piece.at);
        ++count;
      }
  }
};

Piece<2> measure(const std::vector<Corner<2>>& corners, const std::vector<int>& at) {
  Piece<2> piece;
  if (at.size() != 2) return piece;
  const Corner<2>&p = corners[at[0]], &q = corners[at[1]];
  piece.area = perpendicular(Vector<2>(q.x - p.x));
  const double length = piece.area.norm();
  piece.weight = 0.5 * length * (p.t + q.t);
  piece.square = length / 3 * (p.t * p.t + p.t * q.t + q.t * q.t);
  piece.lever = length / 6 * ((2 * p.t + q.t) * p.x + (p.t + 2 * q.t) * q.x);
  return piece;
}

void add_triangle(const Corner<3>& p, const Corner<3>& q, const Corner<3>& r, Piece<3>& piece) {
  const Vector<3> triangle = 0.5 * (q.x - p.x).cross(r.x - p.x);
  const double area = triangle.norm(), sum = p.t + q.t + r.t;
  piece.area += triangle;
  piece.weight += area / 3 * sum;
  piece.square += area / 12 * (sum * sum + p.t * p.t + q.t * q.t + r.t * r.t);
  piece.lever += area / 12 * ((sum + p.t) * p.x + (sum + q.t) * q.x + (sum + r.t) * r.x);
}

Piece<3> measure(const std::vector<Corner<3>>& corners, const std::vector<int>& at) {
  Piece<3> piece;
  for (std::size_t k = 1; k + 1 < at.size(); ++k)
    add_triangle(corners[at[0]], corners[at[k]], corners[at[k + 1]], piece);
  return piece;
}

// Points on the surface between two facets are the centres of balls in the region that touch both planes; the points
// straight below them, towards either plane, fill the region. So the energy is a sum over all pairs of planes,
//
//   ∫ phi dV = Σ |a_i - a_j|/2 ∫ phi² dS,
//
// where |a_i - a_j|/2 is the cosine between the surface and either plane; the force is one over those of two parts.
template <int Dim>
void sum_up(const HalfSpaces<Dim>& planes, const Vector<Dim>& shift, int faces_a, const Pieces<Dim>& pieces,
            const std::vector<Corner<Dim>>& corners, RegionIntegral<Dim>& region) {
  region = {};
  double weight = 0;
  Vector<Dim> lever = Vector<Dim>::Zero(), whole = Vector<Dim>::Zero();
  for (int k = 0; k < pieces.count; ++k) {
    const int p = pieces.list[k].plane_a, q = pieces.list[k].plane_b;
    const Vector<Dim> apart = planes[p].normal - planes[q].normal;
    const Piece<Dim> piece = measure(corners, pieces.list[k].at);
    region.square += 2 * apart.norm() * piece.square;
    if ((p < faces_a) == (q < faces_a)) continue;
    const double length = piece.area.norm();
    if (!(length > 0)) continue;
    // from the first part to the second
    const bool along = (piece.area.dot(apart) > 0) == (p < faces_a);
    const Vector<Dim> n = (along ? 1 : -1) / length * piece.area;
    region.force += 2 * piece.weight * n;
    region.moment += 2 * moment(piece.lever, n);
    whole += length * n;
    weight += piece.weight;
    lever += piece.lever;
  }
  if (!(weight > 0)) return;
  region.pressure = lever / weight;
  for (const Corner<Dim>& c : corners)
    region.spread = std::max(region.spread, (c.x - region.pressure).squaredNorm());
  region.pressure += shift;
  region.moment += moment(shift, region.force);
  region.area = whole.norm();
}

// The corners of the region and where their origin lies.
template <int Dim>
RegionStatus cut_region(const HalfSpaces<Dim>& planes, double reach, LiftedPolytope<Dim>& polytope,
                        Vector<Dim>& shift) {
  static thread_local std::vector<std::pair<double, int>> order;  // nearest first: the others soon cut no corner
  double half = reach, extent = 0;
  shift.setZero();
  for (int pass = 0; pass < most_passes; ++pass) {
    order.clear();
    for (int i = 0; i < static_cast<int>(planes.size()); ++i)
      order.emplace_back(planes[i].offset - planes[i].normal.dot(shift), i);
    std::ranges::sort(order);
    polytope.begin(half);
    double reached = std::numeric_limits<double>::infinity();  // no corner is beyond a plane so far off
    for (const auto& [offset, i] : order) {
      if (offset >= reached) break;
      const CutResult result = polytope.cut({planes[i].normal, offset}, i);
      if (result == CutResult::nothing_left) return RegionStatus::empty;
      if (result == CutResult::no_bit_left) return RegionStatus::too_many_planes;
      if (result == CutResult::as_it_was && std::isinf(reached)) reached = polytope.reach();
    }
    Vector<Dim> low = polytope.corners[0].x, high = low, middle = Vector<Dim>::Zero();
    for (const Corner<Dim>& c : polytope.corners) {
      low = low.cwiseMin(c.x);
      high = high.cwiseMax(c.x);
      middle += c.x;
    }
    extent = (high - low).maxCoeff();
    if (!(extent > 0)) return RegionStatus::empty;
    const Vector<Dim> centre = middle / static_cast<double>(polytope.corners.size());
    if (extent * lost_corners >= half) {
      for (Corner<Dim>& c : polytope.corners)
        c.x -= centre;
      shift += centre;
      break;
    }
    shift += centre;
    half = 2 * extent;
  }
  if (extent < small * half) sharpen(planes, shift, half, polytope);
  return RegionStatus::ok;
}

}  // namespace

template <int Dim>
RegionStatus integrate_region(const HalfSpaces<Dim>& planes, int faces_a, double reach, RegionIntegral<Dim>& region) {
  static thread_local LiftedPolytope<Dim> polytope;
  static thread_local Pieces<Dim> pieces;
  Vector<Dim> shift;
  const RegionStatus status = cut_region(planes, reach, polytope, shift);
  if (status != RegionStatus::ok) return status;
  pieces.find(planes, faces_a, true, polytope);
  sum_up(planes, shift, faces_a, pieces, polytope.corners, region);
  return region.square > 0 && region.area > 0 ? RegionStatus::ok : RegionStatus::empty;
}

template <int Dim>
bool integrate_moved_regions(const HalfSpaces<Dim>& planes, int faces_a, double reach, bool energy,
                             std::span<const HalfSpaces<Dim>> moved, std::span<RegionIntegral<Dim>> regions) {
  static thread_local LiftedPolytope<Dim> polytope;
  static thread_local Pieces<Dim> pieces;
  static thread_local std::vector<FixedMatrix<Dim + 1, Dim + 1>> ways;
  static thread_local std::vector<Corner<Dim>> there;
  Vector<Dim> shift;
  if (cut_region(planes, reach, polytope, shift) != RegionStatus::ok) return false;
  ways.resize(polytope.corners.size());
  for (std::size_t i = 0; i < ways.size(); ++i)
    if (!find_way_to_planes(planes, polytope, polytope.corners[i], ways[i])) return false;
  pieces.find(planes, faces_a, energy, polytope);
  for (std::size_t k = 0; k < moved.size(); ++k) {
    there = polytope.corners;
    for (std::size_t i = 0; i < ways.size(); ++i)
      go<Dim>(ways[i] * off_planes(moved[k], shift, polytope, polytope.corners[i]), there[i]);
    sum_up(moved[k], shift, faces_a, pieces, there, regions[k]);
    if (!(regions[k].area > 0)) return false;
  }
  return true;
}

template RegionStatus integrate_region<2>(const HalfSpaces<2>&, int, double, RegionIntegral<2>&);
template RegionStatus integrate_region<3>(const HalfSpaces<3>&, int, double, RegionIntegral<3>&);
template bool integrate_moved_regions<2>(const HalfSpaces<2>&, int, double, bool, std::span<const HalfSpaces<2>>,
                                         std::span<RegionIntegral<2>>);
template bool integrate_moved_regions<3>(const HalfSpaces<3>&, int, double, bool, std::span<const HalfSpaces<3>>,
                                         std::span<RegionIntegral<3>>);

}  // namespace voussoir
