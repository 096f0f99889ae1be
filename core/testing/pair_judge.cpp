#include "core/testing/pair_judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "core/contact/pair_geometry.hpp"
#include "core/slicing/block.hpp"
#include "core/testing/exact_contacts.hpp"
#include "core/testing/one_pair.hpp"
#include "core/testing/shapes.hpp"
#include "core/testing/workers.hpp"

namespace voussoir::families {
namespace {

using exact::Planes;
using exact::Point;
using exact::Quad;
using exact::Rational;
using exact::to_double;
using exact::to_quad;

constexpr double ulp = std::numeric_limits<double>::epsilon();

// the promise's fraction of the pair's size
constexpr double promised = 64 * ulp;

// and of an area: rounding of a sum over the section's corners
constexpr double promised_area = 1e-12;

// a unit vector's length: three squares, a sum, a root and a quotient
constexpr double unit_length = 8 * ulp;

template <int Dim>
struct Scene {
  Pair<Dim> pair;
  Planes planes;
  Rational value;         // s*
  bool answered = false;  // by the core's own program, cold and to its end, in the first body's frame
  double answer = 0;      // its value, m
  double size;            // m
  int faces_a, faces_b;

  Scene(const Case<Dim>& c, bool after)
      : pair{&c.a, &c.b, Matrix<Dim>::Identity(), after ? c.rotation_after : c.rotation,
             after ? c.offset_after : c.offset},
        planes(exact::planes_of(pair)),
        size(c.a.radius + c.b.radius),
        faces_a(static_cast<int>(c.a.faces.size())),
        faces_b(static_cast<int>(c.b.faces.size())) {
    value = optimum();
  }

  // The core's own program guesses the basis; exact arithmetic proves it, or cddlib starts without one.
  Rational optimum() {
    HalfSpaces<Dim> assembled;
    assemble<Dim>(pair, Vector<Dim>::Zero(), assembled);
    const FeasibilityResult<Dim> guess = solve_feasibility<Dim>(assembled, {});
    std::array<int, 4> basis;
    basis.fill(faces_a + faces_b);  // in the plane one of the lids, with a multiplier of 0
    std::copy(guess.basis.begin(), guess.basis.end(), basis.begin());
    const exact::ProgramBounds bounds = exact::feasibility_bounds(planes, basis);
    answered = guess.status == FeasibilityStatus::optimal;
    answer = guess.value;
    return bounds.proven && bounds.low == bounds.high ? bounds.low : exact::feasibility(planes).value;
  }

  // the support of a part; its rounded corners guess the faces that meet there
  Rational support(bool first, const Vector<Dim>& direction) const {
    const Polytope<Dim>& own = first ? *pair.a : *pair.b;
    const Vector<Dim> seen = first ? direction : Vector<Dim>(pair.rotation.transpose() * direction);
    int farthest = 0;
    for (std::size_t v = 1; v < own.vertices.size(); ++v)
      if (seen.dot(own.vertices[v]) > seen.dot(own.vertices[farthest])) farthest = static_cast<int>(v);
    std::vector<int> meeting = shapes::faces_at<Dim>(own, {farthest});
    if constexpr (Dim == 2) meeting.push_back(static_cast<int>(own.faces.size()));
    const Planes part_planes = part(first);
    const Point exactly = exact::point_of(direction);
    for (std::size_t i = 0; i < meeting.size(); ++i)
      for (std::size_t j = i + 1; j < meeting.size(); ++j)
        for (std::size_t k = j + 1; k < meeting.size(); ++k)
          if (const auto proven = exact::proven_support(part_planes, {meeting[i], meeting[j], meeting[k]}, exactly))
            return *proven;
    return exact::support(part_planes, exactly);
  }

  // one part's planes, closed in the plane by the lids
  Planes part(bool first) const {
    Planes list(planes.begin() + (first ? 0 : faces_a), planes.begin() + faces_a + (first ? 0 : faces_b));
    list.insert(list.end(), planes.begin() + faces_a + faces_b, planes.end());
    return list;
  }
};

template <int Dim>
class Judge {
 public:
  Judge(const Scene<Dim>& scene, const std::string& start, std::vector<Finding>& findings, Tally& tally)
      : scene_(scene), start_(start), findings_(findings), tally_(tally) {}

  void decision(const Contact<Dim>& contact, QueryLevel level) {
    count("decisions");
    const double value = scene_.value.get_d();
    switch (contact.status) {
      case ContactStatus::touching:
        count("touching");
        if (sgn(scene_.value) >= 0) wrong("touching, though s* >= 0", value);
        proof_of_touching(contact.proof);
        return;
      case ContactStatus::separated:
        count("separated");
        if (sgn(scene_.value) <= 0) wrong("separated, though s* <= 0", value);
        proof_of_separation(contact.proof);
        return;
      case ContactStatus::undecided:
        count("undecided");
        record("undecided band", std::abs(value), promised * scene_.size);
        return;
      case ContactStatus::no_normal:
        if (level == QueryLevel::decision) return broken("no normal although none was required", value);
        // a block around the middle of the other has no direction that is better than others: reported, not hidden
        count("no normal");
        if (!(-value > 0.1 * std::min(scene_.pair.a->inscribed_radius, scene_.pair.b->inscribed_radius)))
          broken("no normal, though not deep", value);
        return;
      default:
        broken("unanswered", static_cast<double>(contact.status));
    }
  }

  void program() {
    if (!scene_.answered) return broken("the program has no result", 0);
    record("program's value", std::abs(Rational(Rational(scene_.answer) - scene_.value).get_d()),
           promised * scene_.size);
  }

  void values(const ContactGeometry<Dim>& g) {
    count("values");
    record("length of the normal", std::abs(g.normal.norm() - 1), unit_length);
    const Point x = exact::point_of(g.point), n = exact::point_of(g.normal);
    const std::vector<std::optional<Quad>> distance =
        exact::distances_along(scene_.planes, scene_.faces_a, scene_.faces_b, x, n);
    const Quad end_a = exact::nearest(distance, 0, scene_.faces_a),
               end_b = exact::nearest(distance, scene_.faces_a, scene_.faces_b);
    record("overlap", std::abs(to_double(g.overlap - end_a - end_b)), promised * scene_.size);
    face("face of A", g.face_a, scene_.faces_a, 0, end_a, distance);
    face("face of B", g.face_b, scene_.faces_b, scene_.faces_a, end_b, distance);
    exact::Section section = exact::section(scene_.planes, x, n);
    if constexpr (Dim == 2) {
      section.area /= 2 * exact::lid_height(scene_.pair);
      section.sensitivity = lengthening(x, n);
    }
    const double allowed =
        promised_area * to_double(section.area) + promised * scene_.size * to_double(section.sensitivity);
    record("area", std::abs(to_double(g.area - section.area)), allowed);
  }

  // half the overlap times the root of the stiffness_factor is minus the value of the barrier, which is above the
  // program's
  void pressed(const ContactGeometry<Dim>& g) {
    count(g.overlap > 0 ? "pressed" : "not yet pressed");
    record("length of the normal", std::abs(g.normal.norm() - 1), unit_length);
    const double deeper = 0.5 * g.overlap * std::sqrt(g.stiffness_factor) + scene_.value.get_d();
    record("not deeper than the program", std::max(deeper, 0.0), promised * scene_.size);
    if (!(g.overlap >= 0 && g.stiffness_factor > 0 && g.stiffness_factor < 1 + unit_length))
      broken("overlap or stiffness_factor", g.stiffness_factor);
  }

  void same_decision(const Contact<Dim>& decision, const Contact<Dim>& whole) {
    const bool same = decision.status == whole.status ||
                      (decision.status == ContactStatus::touching && whole.status == ContactStatus::no_normal);
    if (!same) broken("another decision at the level of decisions", static_cast<double>(decision.status));
  }

 private:
  void proof_of_touching(const Proof<Dim>& proof) {
    if (proof.kind != ProofKind::interior_point) return broken("touching without an interior point", 0);
    positive(proof.margin);
    const Rational slack = exact::least_slack(scene_.planes, exact::point_of(proof.point));
    if (slack < Rational(proof.margin))
      broken("interior point: nearer to a plane than margin, by ulp of the size",
             in_ulp(Rational(proof.margin) - slack));
  }

  void proof_of_separation(const Proof<Dim>& proof) {
    positive(proof.margin);
    switch (proof.kind) {
      case ProofKind::multipliers:
        count("proofs by multipliers");
        if (scene_.value < Rational(proof.margin))
          broken("multipliers: s* below margin, by ulp of the size", in_ulp(Rational(proof.margin) - scene_.value));
        return;
      case ProofKind::separating_axis: {
        count("proofs by an axis");
        record("length of the axis", std::abs(proof.axis.norm() - 1), unit_length);
        const Rational end_of_a = scene_.support(true, proof.axis), start_of_b = -scene_.support(false, -proof.axis);
        if (end_of_a > Rational(proof.support))
          broken("axis: A beyond support, by ulp of the size", in_ulp(end_of_a - Rational(proof.support)));
        const Rational least = Rational(proof.support) + Rational(proof.margin);
        if (start_of_b < least)
          broken("axis: B before support + margin, by ulp of the size", in_ulp(least - start_of_b));
        return;
      }
      default:
        broken("separated without a proof", 0);
    }
  }

  void face(const std::string& name, int number, int faces, int first, const Quad& end,
            const std::vector<std::optional<Quad>>& distance) {
    if (number < 0 || number >= faces) return broken(name + ": none", number);
    if (!distance[first + number]) return broken(name + ": never met along the normal", number);
    record(name, to_double(*distance[first + number] - end), promised * scene_.size);
  }

  // in the plane: the growth of the section at its two ends when every plane moves out by 1
  Quad lengthening(const Point& x, const Point& n) const {
    const Quad along_x = to_quad(-n[1]), along_y = to_quad(n[0]);
    Quad ends[2] = {1e300, 1e300}, gains[2] = {0, 0};
    for (int i = 0; i < scene_.faces_a + scene_.faces_b; ++i) {
      const exact::Plane& p = scene_.planes[i];
      const Quad slope = to_quad(p.normal[0]) * along_x + to_quad(p.normal[1]) * along_y;
      if (slope == 0) continue;
      const int side = slope > 0 ? 0 : 1;
      const Quad steep = side ? -slope : slope, end = to_quad(p.offset - exact::dot(p.normal, x)) / steep;
      if (end < ends[side]) {
        ends[side] = end;
        gains[side] = 1 / steep;
      }
    }
    return gains[0] + gains[1];
  }

  // nearer to touching than 64 ulp the pair should have been left undecided, beyond that the decision is false
  void wrong(const std::string& decision, double value) {
    broken(decision + (std::abs(value) > promised * scene_.size ? ", by more than 64 ulp" : ", within 64 ulp"), value);
  }
  void positive(double margin) {
    if (!(margin > 0)) broken("a margin that is not positive", margin);
  }
  double in_ulp(const Rational& excess) const { return excess.get_d() / (ulp * scene_.size); }
  void count(const std::string& what) { ++tally_.counts[start_ + what]; }
  void record(const std::string& what, double error, double allowed) {
    const double used = error <= allowed && allowed == 0 ? 0 : error / allowed;
    double& worst = tally_.worst[start_ + what];
    worst = std::max(worst, used);
    if (!(used <= 1)) broken(what + ": error in units of the promise", used);
  }
  void broken(const std::string& promise, double figure) {
    findings_.push_back(
        {start_ + promise, fmt::format("{:.6g} (s* {:.6g}, size {:.6g})", figure, scene_.value.get_d(), scene_.size)});
  }

  const Scene<Dim>& scene_;
  const std::string start_;
  std::vector<Finding>& findings_;
  Tally& tally_;
};

template <int Dim>
Contact<Dim> resolve(Pair<Dim> pair, QueryLevel level, const Contact<Dim>& before,
                     const ContactSettings& settings = {}) {
  pair.level = level;
  const contacts::Outcome<Dim> outcome = contacts::resolve<Dim>(pair, settings, before);
  return outcome.contact;
}

template <int Dim>
bool same_proof(const Contact<Dim>& a, const Contact<Dim>& b) {
  return a.status == b.status && a.status != ContactStatus::no_normal && a.proof.kind == b.proof.kind &&
         a.proof.margin == b.proof.margin && a.proof.point == b.proof.point && a.proof.axis == b.proof.axis &&
         a.proof.support == b.proof.support;
}

// ---- one smallest case ----------------------------------------------------------------------------------------------

template <int Dim>
bool breaks(const Case<Dim>& c, const std::string& promise) {
  Tally unused;
  const std::vector<Finding> findings = judge(c, unused);
  return std::any_of(findings.begin(), findings.end(), [&](const Finding& f) { return f.promise == promise; });
}

template <int Dim>
std::optional<Polytope<Dim>> without(const Polytope<Dim>& part, std::size_t face) {
  HalfSpaces<Dim> planes = part.faces;
  planes.erase(planes.begin() + static_cast<long>(face));
  BlockResult<Dim> made = make_block<Dim>(planes, std::vector<int>(planes.size(), no_joint));
  if (made.status != BlockStatus::ok) return {};
  return std::move(made.part);
}

// faces are removed as long as the promise stays broken
template <int Dim>
Case<Dim> shrunk(Case<Dim> c, const std::string& promise) {
  for (Polytope<Dim> Case<Dim>::*part : {&Case<Dim>::a, &Case<Dim>::b})
    for (std::size_t face = (c.*part).faces.size(); face-- > 0;) {
      std::optional<Polytope<Dim>> smaller = without<Dim>(c.*part, face);
      if (!smaller) continue;
      Case<Dim> candidate = c;
      candidate.*part = *smaller;
      if (breaks(candidate, promise)) c = std::move(candidate);
    }
  return c;
}

struct Broken {
  long long times = 0, number = -1;
  std::size_t faces = 0;
  std::string figures;

  void add(const Broken& other) {
    times += other.times;
    if (number < 0 || other.faces < faces || (other.faces == faces && other.number < number)) {
      faces = other.faces;
      number = other.number;
      figures = other.figures;
    }
  }
};

// one line each, fields separated by tabs: written by a worker and read by its parent
void read_back(const std::string& text, Tally& tally, std::map<std::string, Broken>& broken) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields;
    std::istringstream rest(line);
    for (std::string field; std::getline(rest, field, '\t');)
      fields.push_back(field);
    if (fields[0] == "count")
      tally.counts[fields[1]] += std::stoll(fields[2]);
    else if (fields[0] == "worst")
      tally.worst[fields[1]] = std::max(tally.worst[fields[1]], std::stod(fields[2]));
    else
      broken[fields[1]].add({std::stoll(fields[2]), std::stoll(fields[3]), std::stoul(fields[4]), fields[5]});
  }
}

}  // namespace

void Tally::add(const Tally& other) {
  for (const auto& [what, count] : other.counts)
    counts[what] += count;
  for (const auto& [what, used] : other.worst)
    worst[what] = std::max(worst[what], used);
}

template <int Dim>
std::vector<Finding> judge(const Case<Dim>& c, Tally& tally) {
  std::vector<Finding> findings;
  const Scene<Dim> before(c, false), after(c, true);
  const Contact<Dim> cold = resolve<Dim>(before.pair, QueryLevel::area, {}),
                     decided = resolve<Dim>(before.pair, QueryLevel::decision, {}),
                     warm = resolve<Dim>(after.pair, QueryLevel::area, cold);
  Judge<Dim> judge_cold(before, "cold, ", findings, tally), judge_decided(before, "decision only, ", findings, tally),
      judge_warm(after, "warm, ", findings, tally);
  judge_cold.program();
  judge_cold.decision(cold, QueryLevel::area);
  judge_decided.same_decision(decided, cold);
  if (!same_proof(decided, cold)) judge_decided.decision(decided, QueryLevel::decision);
  judge_warm.decision(warm, QueryLevel::area);
  if (cold.touching()) judge_cold.values(cold.geometry);
  if (warm.touching()) judge_warm.values(warm.geometry);

  const ContactSettings on_path{.point = ContactPoint::central_path, .normal = ContactNormal::multipliers};
  const Contact<Dim> path_cold = resolve<Dim>(before.pair, QueryLevel::overlap, {}, on_path),
                     path_warm = resolve<Dim>(after.pair, QueryLevel::overlap, path_cold, on_path);
  Judge<Dim> judge_path_cold(before, "central path, cold, ", findings, tally),
      judge_path_warm(after, "central path, warm, ", findings, tally);
  judge_path_cold.decision(path_cold, QueryLevel::overlap);
  judge_path_warm.decision(path_warm, QueryLevel::overlap);
  if (path_cold.touching()) judge_path_cold.pressed(path_cold.geometry);
  if (path_warm.touching()) judge_path_warm.pressed(path_warm.geometry);
  return findings;
}

template <int Dim>
std::string judge_all(std::uint64_t seed, long long first, long long last, int processes, Tally& tally) {
  const auto work = [&](int worker, volatile long long& progress) {
    Tally own;
    std::map<std::string, Broken> broken;
    for (long long number = first + worker; number < last; number += processes) {
      progress = number;
      const Case<Dim> c = numbered_case<Dim>(seed, number);
      for (const Finding& f : judge(c, own))
        broken[f.promise].add({1, number, c.a.faces.size() + c.b.faces.size(), c.family + ": " + f.figures});
    }
    std::string text;
    for (const auto& [what, count] : own.counts)
      text += fmt::format("count\t{}\t{}\n", what, count);
    for (const auto& [what, used] : own.worst)
      text += fmt::format("worst\t{}\t{}\n", what, used);
    for (const auto& [promise, b] : broken)
      text += fmt::format("broken\t{}\t{}\t{}\t{}\t{}\n", promise, b.times, b.number, b.faces, b.figures);
    return text;
  };
  std::map<std::string, Broken> broken;
  for (const std::string& text : workers::in_processes(processes, work))
    read_back(text, tally, broken);

  std::string report;
  for (const auto& [promise, b] : broken)
    report += fmt::format("{} times: {}\n  numbered_case<{}>({}, {}), {}\n{}", b.times, promise, Dim, seed, b.number,
                          b.figures, literals(shrunk(numbered_case<Dim>(seed, b.number), promise)));
  return report;
}

template std::vector<Finding> judge<2>(const Case<2>&, Tally&);
template std::vector<Finding> judge<3>(const Case<3>&, Tally&);
template std::string judge_all<2>(std::uint64_t, long long, long long, int, Tally&);
template std::string judge_all<3>(std::uint64_t, long long, long long, int, Tally&);

}  // namespace voussoir::families
