#include "core/contact/reference_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/contact/bracketing.hpp"
#include "core/contact/extended_precision_overlap.hpp"
#include "core/contact/overlap_region.hpp"
#include "core/contact/pair_geometry.hpp"
#include "core/contact/rounding.hpp"
#include "core/geometry/half_space_inl.hpp"
#include "core/solvers/central_path.hpp"
#include "core/solvers/weighted_centre.hpp"

namespace voussoir {
namespace {

// regions thinner than this many roundings of a slack have no centre that can be distinguished from the points around
// it
constexpr double hardly_thicker = 4096;

template <int Dim>
double smallest_slack(const HalfSpaces<Dim>& planes, const Vector<Dim>& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const HalfSpace<Dim>& p : planes)
    least = std::min(least, -signed_distance(p, point));
  return least;
}

// unit, across the normal: the next thinnest direction, of the plane with the largest tangential part over its slack
template <int Dim>
Vector<Dim> thinnest_across(const HalfSpaces<Dim>& planes, const Vector<Dim>& point, const Vector<Dim>& normal) {
  Vector<Dim> thinnest = perpendicular(normal);
  double most = 0;
  for (const HalfSpace<Dim>& p : planes) {
    const Vector<Dim> across = p.normal - p.normal.dot(normal) * normal;
    const double slack = -signed_distance(p, point), length = across.norm();
    if (length > most * slack) {
      most = length / slack;
      thinnest = across / length;
    }
  }
  return thinnest;
}

// of as many factors together as stay far from overflow
class LogarithmOfProduct {
 public:
  void multiply(double factor) {
    product_ *= factor;
    if (product_ > 1e-150 && product_ < 1e150) return;
    sum_ += std::log(product_);
    product_ = 1;
  }
  void add(double logarithm) { sum_ += logarithm; }
  double sum() const { return sum_ + std::log(product_); }

 private:
  double sum_ = 0, product_ = 1;
};

// the data of one pair; kept between calls so that the step allocates no memory
template <int Dim>
struct Resolver {
  const Pair<Dim>& pair;
  const ContactSettings& settings;
  const Solvers<Dim>& solvers;
  Contact<Dim>& contact;
  KernelCounters& counters;
  HalfSpaces<Dim>& planes;
  std::span<const double> weights;  // of the planes; empty: all are 1

  Vector<Dim> origin;  // of the local frame, in the first body's frame: the centre of the smaller part
  double size;         // the smaller inscribed radius, m
  double tolerance;    // m
  double reach;        // m: no point of both parts is farther from the origin
  double rounding;     // m: of a slack
  double proven;       // m: margin of the proof that needs no second one; 0: none
  int faces_a;
  bool was_undecided;  // the step before
  Vector<Dim> start;
  FeasibilityResult<Dim> lp;
  bool lp_solved = false;
  CentralPathResult<Dim> path;

  // along which the program's value grows most as B moves, unit: it separates the parts, or nearly does; false when
  // there is none, one part deep inside the other
  bool separating_direction(Vector<Dim>& axis) const {
    PartMultipliers parts[2];
    add_program_multipliers(parts);
    axis = parts[0].gradient;
    const double length = axis.norm();
    if (!(length > parallel_gradients)) return false;
    axis /= length;
    return true;
  }

  void run_lp(const std::array<int, Dim + 1>& basis) {
    lp = solvers.feasibility(planes, {&basis, rounding, rounding / 64});
    ++counters.lp_solves;
    counters.lp_pivots += lp.pivots;
  }

  // true when the parts overlap; otherwise the contact's status is set
  bool solve_lp(const std::array<int, Dim + 1>& basis) {
    run_lp(basis);
    const bool answered = lp.status == FeasibilityStatus::optimal || lp.status == FeasibilityStatus::separated_early;
    if (!answered) {
      contact.status = ContactStatus::lp_not_converged;
      return false;
    }
    start = lp.point;
    if (const double bound = certified_lower_bound<Dim>(planes, lp, reach) - rounding; bound > 0) {
      contact.status = ContactStatus::separated;
      contact.proof.kind = ProofKind::multipliers;
      contact.proof.margin = bound;
      contact.proof.basis = lp.basis;
      separating_direction(contact.proof.axis);
      return false;
    }
    if (!(smallest_slack<Dim>(planes, start) > rounding + tolerance)) {
      contact.status = ContactStatus::undecided;
      contact.proof = {};
      contact.proof.basis = lp.basis;  // the next start of the program
      ++counters.undecided;
      return false;
    }
    lp_solved = true;
    return true;
  }

  bool establish_cold() {
    // the basis that separated the parts last time often still does; if not, the contact starts as any new one would
    const std::array<int, Dim + 1> old = contact.proof.basis;
    if (contact.proof.kind == ProofKind::multipliers && !solve_lp(old)) return false;
    contact.proof = {};
    return solve_lp(was_undecided ? old : pair.a->basis);
  }

  bool by_multipliers() const { return settings.normal == ContactNormal::multipliers; }
  bool on_central_path() const { return settings.point == ContactPoint::central_path; }
  double smoothing() const { return settings.smoothing * size; }

  // overlap is proven by the old contact point when it still lies inside, else by the LP; if its multipliers are
  // needed, it starts from the planes that were tight
  bool establish() {
    if (proven > 0) {
      start = contact.proof.point - origin;
      return true;
    }
    if (contact.proof.kind == ProofKind::interior_point && by_multipliers() && !on_central_path()) {
      const std::array<int, Dim + 1> old = contact.proof.basis;
      contact.proof = {};
      return solve_lp(old);
    }
    if (contact.proof.kind == ProofKind::interior_point && settings.point != ContactPoint::chebyshev) {
      start = contact.proof.point - origin;
      if (smallest_slack<Dim>(planes, start) > rounding + tolerance) return true;
    }
    if (contact.proof.kind == ProofKind::interior_point) contact.proof = {};
    return establish_cold();
  }

  bool find_centroid(Vector<Dim>& point) {
    OverlapRegion<Dim> region;
    if (!overlap_region<Dim>(planes, start, region)) return false;
    point = region.centroid;
    return smallest_slack<Dim>(planes, point) > 0;
  }

  // other solvers have no weights
  bool search_centre(Vector<Dim>& point) {
    const CentreRequest<Dim> request{start, settings.newton_tolerance, settings.newton_limit, contact.proof.axis};
    const CentreResult<Dim> centre =
        weights.empty() ? solvers.centre(planes, request) : solve_weighted_centre<Dim>(planes, weights, request);
    counters.newton_iterations += centre.iterations;
    point = centre.point;
    return centre.status == CentreStatus::converged;
  }

  bool find_centre(Vector<Dim>& point) {
    if (search_centre(point)) return true;
    // a warm start can be unlucky; a cold one is the definition
    if (proven != 0 || lp_solved) return false;
    return establish_cold() ? search_centre(point) : lp_solved;
  }

  bool find_central_point(Vector<Dim>& point) {
    path = follow_central_path<Dim>(planes,
                                    {start, smoothing(), settings.newton_tolerance, settings.newton_limit, weights});
    counters.newton_iterations += path.iterations;
    point = path.point;
    if (path.status != CentralPathStatus::converged) contact.status = ContactStatus::centre_not_converged;
    return path.status == CentralPathStatus::converged;
  }

  bool find_point(Vector<Dim>& point) {
    if (on_central_path()) return find_central_point(point);
    point = start;
    if (settings.point == ContactPoint::chebyshev) return true;
    if (settings.point == ContactPoint::centroid ? find_centroid(point) : find_centre(point)) return true;
    if (contact.status == ContactStatus::undecided) return false;
    // if the coordinates hardly distinguish one side of the region from the other, any point of it is as good
    point = start;
    if (smallest_slack<Dim>(planes, start) < hardly_thicker * rounding) return true;
    contact.status = ContactStatus::centre_not_converged;
    return false;
  }

  bool find_normal(const Vector<Dim>& point, Vector<Dim>& normal) {
    bool fallback = false;
    const bool found =
        contact_normal<Dim>(planes, faces_a, point, settings.potential_radius * size, normal, fallback, weights);
    if (fallback || !found) ++counters.normal_fallbacks;
    if (found) return true;
    if (!lp_solved) run_lp(pair.a->basis);
    if (separating_direction(normal)) return true;
    contact.status = ContactStatus::no_normal;
    return false;
  }

  bool measure_by_potential(const Vector<Dim>& point, Vector<Dim>& normal, double& overlap, int& face_a, int& face_b) {
    if (!find_normal(point, normal)) return false;
    const auto search =
        settings.overlap == OverlapSearch::bracketing ? &overlap_by_bracketing<Dim> : &overlap_along<Dim>;
    if (search(planes, faces_a, point, normal, overlap, face_a, face_b)) return true;
    contact.status = ContactStatus::no_face;
    return false;
  }

  // the multipliers of one part's planes: those of the program, or of its barrier
  struct PartMultipliers {
    Vector<Dim> gradient = Vector<Dim>::Zero();  // Σ λ a
    double weight = 0;                           // Σ λ
    double most = 0;                             // largest λ, at `face`
    int face = -1;

    void add(double multiplier, const Vector<Dim>& normal, int plane) {
      gradient += multiplier * normal;
      weight += multiplier;
      if (multiplier <= most) return;
      most = multiplier;
      face = plane;
    }
  };

  // the program's own, of its active set; returns its value
  double add_program_multipliers(PartMultipliers (&parts)[2]) const {
    for (int k = 0; k <= Dim; ++k)
      if (const int plane = lp.basis[k]; plane >= 0)
        parts[plane < faces_a ? 0 : 1].add(lp.multipliers[k], planes[plane].normal, plane);
    return lp.value;
  }

  // Those of its barrier; returns its value. Each plane's distance is taken relative to the diameter of its part, which
  // no point of both exceeds, and the two logarithms that any contact has, of a plane of each part at twice the
  // smoothing, are left out: so far planes and near ones add to the value, it is above the program's, and parts that do
  // not touch have no force.
  double add_barrier_multipliers(PartMultipliers (&parts)[2]) const {
    const double weight = smoothing(), diameter_a = 2 * pair.a->radius, diameter_b = 2 * pair.b->radius;
    LogarithmOfProduct logarithms;
    logarithms.multiply((diameter_a / (2 * weight)) * (diameter_b / (2 * weight)));
    for (int i = 0; i < static_cast<int>(planes.size()); ++i) {
      const double t = path.bound - signed_distance(planes[i], path.point);
      const double fraction = t / (i < faces_a ? diameter_a : diameter_b), share = weight_of(weights, i);
      if (share == 1)
        logarithms.multiply(fraction);
      else
        logarithms.add(share * std::log(fraction));
      parts[i < faces_a ? 0 : 1].add(share * weight / t, planes[i].normal, i);
    }
    return path.bound - weight * (logarithms.sum() + 2);
  }

  // When B moves, the program's value s grows by its gradient g at the program's point: -s/|g| is the overlap of the
  // features in the program's active set. |g| is 1/2 between faces, less at edges and corners; with 4|g|² of a
  // stiffness k the force is that of the potential 2 k s², which does not jump when other planes become tight.
  bool measure_by_multipliers(Vector<Dim>& normal, double& overlap, int& face_a, int& face_b) {
    PartMultipliers parts[2];
    const double value = on_central_path() ? add_barrier_multipliers(parts) : add_program_multipliers(parts);
    face_a = parts[0].face;
    face_b = parts[1].face;
    normal = parts[0].gradient;
    double length = normal.norm(), least = parallel_gradients;
    if (!(length > least)) {
      // The parts' gradients are opposite. If they nearly vanish, as in the tip of a needle, whose planes are
      // active and cancel, that of the part with the smaller sum of multipliers has kept its digits.
      const bool first = parts[0].weight <= parts[1].weight;
      if (!first) normal = -parts[1].gradient;
      length = normal.norm();
      least *= parts[first ? 0 : 1].weight;
    }
    if (!(length > least)) {
      contact.status = ContactStatus::no_normal;
      return false;
    }
    normal /= length;
    overlap = std::max(-value / length, 0.0);
    contact.geometry.stiffness_factor = 4 * length * length;
    return true;
  }

  // the centre of a region as thin as the rounding may round to its outside: the LP's point is as good; that of the
  // central path is outside a region thinner than the smoothing, and the start is not
  bool keep_inside(Vector<Dim>& point) {
    double margin = smallest_slack<Dim>(planes, point) - rounding;
    if (!(margin > 0)) {
      if (proven == 0 && !lp_solved && !on_central_path() && !establish_cold()) return false;
      point = start;
      margin = proven > 0 ? proven : smallest_slack<Dim>(planes, point) - rounding;
    }
    contact.proof = {.kind = ProofKind::interior_point, .margin = margin, .point = point + origin};
    if (lp_solved) contact.proof.basis = lp.basis;
    contact.geometry.point = pair.axes * contact.proof.point;
    return true;
  }

  void resolve() {
    contact.geometry = {};
    Vector<Dim> point, normal;
    double overlap = 0;
    int face_a = -1, face_b = -1;
    contact.status = ContactStatus::separated;
    if (!establish()) return;
    point = start;
    if (pair.level > QueryLevel::decision && !find_point(point)) return;
    if (!keep_inside(point)) return;
    contact.status = ContactStatus::touching;
    if (pair.level <= QueryLevel::point) return;
    const bool measured = by_multipliers() ? measure_by_multipliers(normal, overlap, face_a, face_b)
                                           : measure_by_potential(point, normal, overlap, face_a, face_b);
    if (!measured) return;
    if (overlap > settings.potential_radius * size) ++counters.deep_overlaps;
    ContactGeometry<Dim>& geometry = contact.geometry;
    if (pair.level == QueryLevel::area) {
      ++counters.areas;
      geometry.area = section_area<Dim>(planes, point, normal, 4 * std::min(pair.a->radius, pair.b->radius));
    }
    geometry.overlap = overlap;
    geometry.face_a = face_a;
    geometry.face_b = face_b - faces_a;
    geometry.normal = pair.axes * normal;
    contact.proof.axis = normal;
    contact.proof.tangent = thinnest_across<Dim>(planes, point, normal);
    if (!by_multipliers() && settings.overlap == OverlapSearch::closed_form && magnified(overlap, contact.proof.margin))
      measure_overlap_in_extended_precision(pair, contact);
  }
};

}  // namespace

template <int Dim>
void resolve_by_reference(const Pair<Dim>& pair, const ContactSettings& settings, const Solvers<Dim>& solvers,
                          Contact<Dim>& contact, bool fresh, KernelCounters& counters) {
  static thread_local HalfSpaces<Dim> planes;
  static thread_local std::vector<double> weights;
  const bool a_smaller = pair.a->radius < pair.b->radius;
  const Vector<Dim> origin = a_smaller ? pair.a->centre : Vector<Dim>(pair.offset + pair.rotation * pair.b->centre);
  assemble<Dim>(pair, origin, planes);
  assemble_weights(pair, weights);
  const double size = std::min(pair.a->inscribed_radius, pair.b->inscribed_radius);
  const double reach = 2 * std::min(pair.a->radius, pair.b->radius);
  const double coordinates =
      std::max(pair.a->radius, pair.b->radius) + origin.norm() + (origin - pair.offset).norm() + reach;
  Resolver<Dim>{.pair = pair,
                .settings = settings,
                .solvers = solvers,
                .contact = contact,
                .counters = counters,
                .planes = planes,
                .weights = weights,
                .origin = origin,
                .size = size,
                .tolerance = settings.tolerance * size,
                .reach = reach,
                .rounding = slack_rounding * coordinates,
                .proven = fresh ? contact.proof.margin : 0,
                .faces_a = static_cast<int>(pair.a->faces.size()),
                .was_undecided = contact.status == ContactStatus::undecided,
                .start = {},
                .lp = {},
                .path = {}}
      .resolve();
}

template void resolve_by_reference<2>(const Pair<2>&, const ContactSettings&, const Solvers<2>&, Contact<2>&, bool,
                                      KernelCounters&);
template void resolve_by_reference<3>(const Pair<3>&, const ContactSettings&, const Solvers<3>&, Contact<3>&, bool,
                                      KernelCounters&);

}  // namespace voussoir
