#include "benchmarks/judge/judge.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/testing/shapes.hpp"

namespace voussoir::benchmarks {
namespace {

// Planes within this fraction of the smaller inscribed radius of the point may turn a normal: the rounding of published
// kernels, ours among them (ContactSettings::potential_radius).
constexpr double rounding_radius = 0.02;
// a normal's length: of single precision
constexpr double unit_error = 1e-6;
// generators that span no plane or no space
constexpr double flat = 1e-12;

Vector<3> vector_of(const double (&x)[3]) {
  return {x[0], x[1], x[2]};
}

bool usable(std::int32_t flag) {
  return flag == 0 || flag == 1;
}

bool finite(const double (&x)[3]) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

// the numbers are read only if the blocks touch
bool usable(const voussoir_answer& answer) {
  if (!usable(answer.touch) || !usable(answer.has_point) || !usable(answer.has_normal)) return false;
  if (answer.touch == 0) return true;
  return (!answer.has_point || finite(answer.point)) && (!answer.has_normal || finite(answer.normal)) &&
         (answer.overlap_kind == VOUSSOIR_NO_OVERLAP || std::isfinite(answer.overlap));
}

double furthest(const std::vector<Vector<3>>& vertices, const Vector<3>& n) {
  double most = -std::numeric_limits<double>::max();
  for (const Vector<3>& v : vertices)
    most = std::max(most, v.dot(n));
  return most;
}

double beyond(const HalfSpaces<3>& planes, const Vector<3>& x) {
  double most = -std::numeric_limits<double>::max();
  for (const HalfSpace<3>& p : planes)
    most = std::max(most, signed_distance(p, x));
  return most;
}

// from the point to where the direction leaves the block, m; infinite if it never does
double exit_along(const HalfSpaces<3>& planes, const Vector<3>& x, const Vector<3>& direction) {
  double least = std::numeric_limits<double>::infinity();
  for (const HalfSpace<3>& p : planes) {
    const double rate = p.normal.dot(direction);
    if (rate > flat) least = std::min(least, -signed_distance(p, x) / rate);
  }
  return least;
}

// the outward normals of A's planes and the reversed ones of B's that are near the point
std::vector<Vector<3>> nearby_normals(const ExactPair& pair, double reach, const Vector<3>& point) {
  std::vector<Vector<3>> list;
  for (const HalfSpace<3>& p : pair.a)
    if (signed_distance(p, point) >= -reach) list.push_back(p.normal);
  for (const HalfSpace<3>& p : pair.b)
    if (signed_distance(p, point) >= -reach) list.push_back(-p.normal);
  return list;
}

double overlap_error(const ExactPair& pair, const voussoir_answer& answer) {
  const Vector<3> x = vector_of(answer.point), n = vector_of(answer.normal);
  switch (answer.overlap_kind) {
    case VOUSSOIR_NO_OVERLAP:
      return 0;
    case VOUSSOIR_SMALLEST_TRANSLATION:
      return std::abs(answer.overlap - pair.smallest_translation);
    case VOUSSOIR_DEEPEST_POINT:
      return std::abs(answer.overlap + 2 * pair.lp_optimum);
    case VOUSSOIR_ALONG_NORMAL:
      if (!answer.has_point || !answer.has_normal) break;
      // from the point ahead to the end of A and back to the end of B (Boon 2013, Eq. 3.36)
      return std::abs(answer.overlap - exit_along(pair.a, x, n) - exit_along(pair.b, x, -n));
    default:
      break;
  }
  return std::numeric_limits<double>::infinity();
}

// B in axes of its own: the mean of its vertices as origin, turned by an angle of the pair's
struct Turned {
  HalfSpaces<3> planes;
  std::vector<Vector<3>> vertices;
  voussoir_pose pose;

  Turned(const Polytope<3>& block, int number) {
    Vector<3> centre = Vector<3>::Zero();
    for (const Vector<3>& v : block.vertices)
      centre += v / static_cast<double>(block.vertices.size());
    const Matrix<3> turn = Eigen::AngleAxisd(0.7 + number, Vector<3>(1, 2, 3).normalized()).toRotationMatrix();
    for (const HalfSpace<3>& p : block.faces)
      planes.push_back({turn.transpose() * p.normal, p.offset - p.normal.dot(centre)});
    for (const Vector<3>& v : block.vertices)
      vertices.push_back(turn.transpose() * (v - centre));
    pose = pose_of(turn, centre);
  }
};

struct Judging {
  const Kernel& kernel;
  const ExactPair& pair;
  Verdict& verdict;

  void error(int& count, const std::string& sentence) {
    ++count;
    if (verdict.first_error.empty()) verdict.first_error = fmt::format("{}: {}", pair.name(), sentence);
  }

  void run() {
    ++verdict.pairs;
    const Polytope<3> a = shapes::block<3>(pair.a), b = shapes::block<3>(pair.b);
    const Turned turned(b, pair.number);
    const PreparedBlock first(kernel, pair.a, a.vertices), second(kernel, turned.planes, turned.vertices);
    voussoir_answer decision{}, contact{};
    const std::int32_t failed_decision =
        kernel.contact(first.handle(), second.handle(), &turned.pose, VOUSSOIR_DECISION, &decision);
    const std::int32_t failed_contact =
        kernel.contact(first.handle(), second.handle(), &turned.pose, VOUSSOIR_CONTACT, &contact);
    if (failed_decision != 0 || failed_contact != 0)
      return error(verdict.unusable, fmt::format("fails with {} and {}", failed_decision, failed_contact));
    if (!usable(decision.touch) || !usable(contact))
      return error(verdict.unusable, "gives a number that is not finite, or a flag that is neither 0 nor 1");
    const std::int32_t truth = pair.touch ? 1 : 0;
    if (decision.touch != truth || contact.touch != truth)
      error(verdict.decisions,
            fmt::format("touch {} (decision) and {} (contact), exact {}", decision.touch, contact.touch, truth));
    if (pair.touch && contact.touch == 1) judge_contact(a, b, contact);
  }

  void judge_contact(const Polytope<3>& a, const Polytope<3>& b, const voussoir_answer& answer) {
    const ContactErrors errors = contact_errors(pair, a, b, answer);
    // of an angle: it moves a point by the length tolerance at the inscribed radius, the shortest lever of a block
    const double length = length_tolerance(pair), angle = length / std::min(a.inscribed_radius, b.inscribed_radius);
    ++verdict.contacts;
    verdict.points_given += answer.has_point;
    verdict.normals_given += answer.has_normal;
    verdict.overlaps_given += answer.overlap_kind != VOUSSOIR_NO_OVERLAP;
    verdict.worst_point = std::max(verdict.worst_point, errors.point);
    // a direction of the smallest translation is a normal, though faces far from the point may make it
    const bool is_smallest = errors.translation <= length,
               must_be = answer.overlap_kind == VOUSSOIR_SMALLEST_TRANSLATION;
    if (!is_smallest) verdict.worst_normal = std::max(verdict.worst_normal, errors.normal);
    verdict.worst_overlap = std::max(verdict.worst_overlap, errors.overlap);
    if (errors.point > length)
      error(verdict.points, fmt::format("the point is {:.3g} m outside a block", errors.point));
    if (!is_smallest && errors.normal > angle)
      error(verdict.normals,
            fmt::format("the normal is {:.3g} rad outside the cone of the faces there", errors.normal));
    else if (!is_smallest && must_be)
      error(verdict.normals,
            fmt::format("along the normal B must move {:.3g} m more than the smallest translation, {:.6g} m",
                        errors.translation, pair.smallest_translation));
    if (errors.overlap > length)
      error(verdict.overlaps, fmt::format("the overlap {:.6g} m is {:.3g} m off", answer.overlap, errors.overlap));
  }
};

// the direction's distance from the sums of two or three generators whose weights are not negative, 1 if they are
double distance_from(const Vector<3>& p, const Vector<3>& q, const Vector<3>& direction) {
  const double pq = p.dot(q), pd = p.dot(direction), qd = q.dot(direction), det = 1 - pq * pq;
  if (det < flat) return 1;
  const double u = (pd - pq * qd) / det, v = (qd - pq * pd) / det;
  return u < 0 || v < 0 ? 1 : (direction - u * p - v * q).norm();
}

bool inside(const Vector<3>& p, const Vector<3>& q, const Vector<3>& r, const Vector<3>& direction) {
  const double det = p.dot(q.cross(r));
  if (std::abs(det) < flat) return false;
  return direction.dot(q.cross(r)) / det >= 0 && direction.dot(r.cross(p)) / det >= 0 &&
         direction.dot(p.cross(q)) / det >= 0;
}

}  // namespace

// By Caratheodory, the nearest sum needs no more than three of them.
double angle_outside(const std::vector<Vector<3>>& generators, const Vector<3>& direction) {
  double least = 2, nearest = std::numbers::pi;
  for (std::size_t i = 0; i < generators.size(); ++i) {
    const double cosine = generators[i].dot(direction);
    nearest = std::min(nearest, std::atan2(generators[i].cross(direction).norm(), cosine));
    for (std::size_t j = 0; j < i; ++j) {
      least = std::min(least, distance_from(generators[i], generators[j], direction));
      for (std::size_t k = 0; k < j; ++k)
        if (inside(generators[i], generators[j], generators[k], direction)) return 0;
    }
  }
  return std::min(nearest, least < 1 ? std::asin(least) : std::numbers::pi);
}

ContactErrors contact_errors(const ExactPair& pair, const Polytope<3>& a, const Polytope<3>& b,
                             const voussoir_answer& answer) {
  ContactErrors errors;
  const Vector<3> x = vector_of(answer.point), n = vector_of(answer.normal);
  if (answer.has_point) errors.point = std::max({beyond(pair.a, x), beyond(pair.b, x), 0.0});
  errors.overlap = overlap_error(pair, answer);
  if (!answer.has_normal) return errors;
  if (std::abs(n.norm() - 1) > unit_error) {
    errors.normal = std::numbers::pi;
    errors.translation = std::numeric_limits<double>::infinity();
    return errors;
  }
  // a point outside has been counted, and says nothing about the normal
  const bool point_serves = answer.has_point && errors.point <= length_tolerance(pair);
  const double reach =
      std::max(rounding_radius * std::min(a.inscribed_radius, b.inscribed_radius), 2 * std::abs(pair.lp_optimum));
  errors.normal = angle_outside(nearby_normals(pair, reach, point_serves ? x : pair.centroid), n);
  errors.translation = furthest(a.vertices, n) + furthest(b.vertices, -n) - pair.smallest_translation;
  return errors;
}

Verdict sum_of(const std::vector<Verdict>& verdicts, const std::string& state) {
  Verdict sum;
  for (const Verdict& v : verdicts) {
    if (!state.empty() && v.state != state) continue;
    sum.pairs += v.pairs;
    sum.contacts += v.contacts;
    sum.decisions += v.decisions;
    sum.unusable += v.unusable;
    sum.points += v.points;
    sum.normals += v.normals;
    sum.overlaps += v.overlaps;
    if (sum.first_error.empty()) sum.first_error = v.first_error;
  }
  return sum;
}

std::vector<Verdict> judge_kernel(const Kernel& kernel, const PairFile& file) {
  std::vector<Verdict> verdicts;
  for (const ExactPair& pair : file.pairs) {
    if (verdicts.empty() || verdicts.back().shape != pair.shape || verdicts.back().state != pair.state) {
      verdicts.emplace_back();
      verdicts.back().shape = pair.shape;
      verdicts.back().state = pair.state;
    }
    Judging{kernel, pair, verdicts.back()}.run();
  }
  return verdicts;
}

}  // namespace voussoir::benchmarks
