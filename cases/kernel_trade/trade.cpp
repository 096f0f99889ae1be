#include "cases/kernel_trade/trade.hpp"

#include <chrono>
#include <functional>
#include <stdexcept>

#include "core/testing/oracles.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::trade {
namespace {

using shapes::Random;

constexpr double potential_radius = 0.02;  // of the smaller inscribed radius: the default, above the largest overlap

// the whole kernel on one pair
Contact<3> resolve(const TouchingPair& pair, const ContactSettings& settings, const Contact<3>& before,
                   KernelCounters& counters) {
  const contacts::Outcome<3> outcome = contacts::touch<3>(pair.a, pair.b, pair.turn, pair.offset, settings, before);
  counters = outcome.counters;
  return outcome.contact;
}

double reach(const TouchingPair& pair) {
  return 4 * std::min(pair.a.radius, pair.b.radius);
}

}  // namespace

void place(TouchingPair& pair, bool face_on_face, double tilt, double overlap, Random& random) {
  const auto facing = [](const Polytope<3>& part, const Vector<3>& up) {
    return matrix(rotation_onto(part.faces.front().normal, up));
  };
  const Vector<3> up = Vector<3>::UnitZ();
  Matrix<3> turn_a = matrix(shapes::orientation<3>(random)), turn_b = matrix(shapes::orientation<3>(random));
  Vector<3> sideways = Vector<3>::Zero();
  if (face_on_face) {
    turn_a = facing(pair.a, up);
    const double about_up = shapes::uniform(random, 0, 6);
    const Eigen::AngleAxisd tilted(tilt, shapes::direction<3>(random));
    turn_b = (tilted * Eigen::AngleAxisd(about_up, up)).toRotationMatrix() * facing(pair.b, -up);
    sideways = {shapes::uniform(random, -0.3, 0.3), shapes::uniform(random, -0.3, 0.3), 0};
  }
  pair.turn = turn_a.transpose() * turn_b;
  // pushed together until the largest ball in the overlap has it as its diameter
  const auto value = [&](double distance) {
    pair.offset = turn_a.transpose() * (sideways + distance * up);
    pair.planes = pair.a.faces;
    for (const HalfSpace<3>& p : shapes::placed<3>(pair.b.faces, pair.turn, pair.offset))
      pair.planes.push_back(p);
    const FeasibilityResult<3> lp = solve_feasibility<3>(pair.planes, {&pair.a.basis});
    pair.start = lp.point;
    return lp.value;
  };
  double inside = 0, outside = pair.a.radius + pair.b.radius;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (inside + outside);
    (value(middle) < -0.5 * overlap ? inside : outside) = middle;
  }
  value(inside);
}

namespace {

// previous position of the second part: 1 % of the overlap away, rotated by as much over the size
Contact<3> step_before(const TouchingPair& pair, double overlap, Random& random) {
  TouchingPair earlier = pair;
  earlier.offset += 0.01 * overlap * shapes::direction<3>(random);
  earlier.turn = Eigen::AngleAxisd(0.01 * overlap / pair.size, shapes::direction<3>(random)) * pair.turn;
  KernelCounters counters;
  ContactSettings converged;
  converged.newton_tolerance = 1e-9;
  const Contact<3> contact = resolve(earlier, converged, {}, counters);
  if (!contact.touching()) throw std::logic_error("a pair of the study does not touch");
  return contact;
}

// converged in long double, and the area by Lasserre's recursion instead of clipping
void find_exact(TouchingPair& pair) {
  const Planes<long double> planes(pair.planes, pair.faces_a());
  pair.exact = solve<long double>(planes, pair.start.cast<long double>(), 1e-9L,
                                  static_cast<long double>(potential_radius * pair.size), reach(pair));
  if (!pair.exact.found) throw std::logic_error("long double finds no contact");
  pair.exact.area = oracle::section<3>(pair.planes, pair.exact.point, pair.exact.normal);
}

Answer<long double> in_long_double(const Contact<3>& contact) {
  Answer<long double> answer;
  answer.found = contact.touching();
  answer.point = contact.geometry.point.cast<long double>();
  answer.normal = contact.geometry.normal.cast<long double>();
  answer.overlap = contact.geometry.overlap;
  answer.area = contact.geometry.area;
  return answer;
}

// evaluates once for results and costs, then repeatedly for the time
Measured study(const std::vector<TouchingPair>& pairs, Family family, double tolerance,
               const std::function<Answer<long double>(const TouchingPair&, double& visits)>& ask) {
  Measured measured{.family = family, .tolerance = tolerance, .pairs = static_cast<int>(pairs.size())};
  std::array<std::vector<double>, quantities> all;
  for (const TouchingPair& pair : pairs) {
    const Answer<long double> answer = ask(pair, measured.visits);
    if (!answer.found) {
      ++measured.failed;
      continue;
    }
    const Errors errors = errors_of(pair, answer);
    for (int q = 0; q < quantities; ++q)
      all[q].push_back(errors[q]);
  }
  measured.visits /= measured.pairs;
  for (int q = 0; q < quantities && !all[q].empty(); ++q) {
    std::sort(all[q].begin(), all[q].end());
    measured.worst[q] = all[q].back();
    measured.median[q] = all[q][all[q].size() / 2];
  }

  const int runs = 25;
  using Clock = std::chrono::steady_clock;
  double least = std::numeric_limits<double>::infinity(), ignored = 0;
  for (int run = 0; run < runs; ++run) {
    const auto begin = Clock::now();
    for (const TouchingPair& pair : pairs)
      ask(pair, ignored);
    least = std::min(least, std::chrono::duration<double, std::nano>(Clock::now() - begin).count());
  }
  measured.nanoseconds = least / measured.pairs;
  return measured;
}

}  // namespace

std::vector<TouchingPair> make_pairs() {
  Random random(91);
  std::vector<Polytope<3>> solids;
  for (const shapes::Platonic& p : shapes::platonic_solids(1))
    solids.push_back(shapes::centred_block<3>(p.planes));
  for (const int planes : {6, 12})
    solids.push_back(shapes::centred_block<3>(shapes::random_planes<3>(random, planes, 1)));

  std::vector<TouchingPair> pairs;
  for (const Polytope<3>& solid : solids)
    for (const bool face_on_face : {true, false})
      for (const double overlap : {1e-2, 1e-3, 1e-4}) {
        TouchingPair& pair = pairs.emplace_back();
        pair.a = pair.b = solid;
        pair.size = solid.inscribed_radius;
        place(pair, face_on_face, 1e-5, overlap * pair.size, random);
        find_exact(pair);
        pair.before = step_before(pair, overlap * pair.size, random);
      }
  return pairs;
}

Errors errors_of(const TouchingPair& pair, const Answer<long double>& answer) {
  const Answer<long double>& exact = pair.exact;
  const Planes<long double> planes(pair.planes, pair.faces_a());
  long double distance = 0;
  for (int i = 0; i < planes.size(); ++i)
    distance += std::pow(planes.normals[i].dot(answer.point - exact.point) / planes.slack(i, exact.point), 2);
  const long double across = answer.normal.cross(exact.normal).norm(), along = answer.normal.dot(exact.normal);
  return {static_cast<double>(std::sqrt(distance)), static_cast<double>(std::atan2(across, along)),
          static_cast<double>(std::abs(answer.overlap / exact.overlap - 1)),
          static_cast<double>(std::abs(answer.area / exact.area - 1))};
}

Measured measure_kernel(const std::vector<TouchingPair>& pairs, Family family, double newton_tolerance) {
  ContactSettings settings;
  settings.potential_radius = potential_radius;
  settings.newton_tolerance = newton_tolerance;
  if (family == Family::centroid) settings.point = ContactPoint::centroid;
  if (family == Family::chebyshev) settings.point = ContactPoint::chebyshev;
  return study(pairs, family, newton_tolerance, [&](const TouchingPair& pair, double& visits) {
    KernelCounters counters;
    const Contact<3> contact = resolve(pair, settings, family == Family::warm ? pair.before : Contact<3>{}, counters);
    const double passes = static_cast<double>(counters.lp_solves + counters.lp_pivots + counters.newton_iterations) + 3;
    visits += passes * static_cast<double>(pair.planes.size());
    return in_long_double(contact);
  });
}

Measured measure_lp(const std::vector<TouchingPair>& pairs, double lp_tolerance) {
  return study(pairs, Family::lp_tolerance, lp_tolerance, [&](const TouchingPair& pair, double& visits) {
    Answer<long double> answer;
    const FeasibilityResult<3> lp =
        solve_feasibility<3>(pair.planes, {.start = &pair.a.basis, .tolerance = lp_tolerance * pair.size});
    const CentreResult<3> centre = solve_analytic_centre<3>(pair.planes, {lp.point});
    visits += (lp.pivots + 1 + centre.iterations + 3) * static_cast<double>(pair.planes.size());
    if (lp.status != FeasibilityStatus::optimal || !(lp.value < 0) || centre.status != CentreStatus::converged)
      return answer;
    Vector<3> normal;
    bool fallback = false;
    double overlap = 0;
    int face_a = 0, face_b = 0;
    answer.found =
        contact_normal<3>(pair.planes, pair.faces_a(), centre.point, potential_radius * pair.size, normal, fallback) &&
        overlap_along<3>(pair.planes, pair.faces_a(), centre.point, normal, overlap, face_a, face_b);
    if (!answer.found) return answer;
    answer.point = centre.point.cast<long double>();
    answer.normal = normal.cast<long double>();
    answer.overlap = overlap;
    answer.area = section_area<3>(pair.planes, centre.point, normal, reach(pair));
    return answer;
  });
}

template <class Real>
Measured measure_plain(const std::vector<TouchingPair>& pairs, Family family, double newton_tolerance) {
  return study(pairs, family, newton_tolerance, [&](const TouchingPair& pair, double& visits) {
    const Planes<Real> planes(pair.planes, pair.faces_a());
    const Answer<Real> mine =
        solve<Real>(planes, pair.start.template cast<Real>(), static_cast<Real>(newton_tolerance),
                    static_cast<Real>(potential_radius * pair.size), static_cast<Real>(reach(pair)));
    visits += (mine.iterations + 3) * static_cast<double>(pair.planes.size());
    Answer<long double> answer;
    answer.found = mine.found;
    answer.point = mine.point.template cast<long double>();
    answer.normal = mine.normal.template cast<long double>();
    answer.overlap = mine.overlap;
    answer.area = mine.area;
    return answer;
  });
}

template Measured measure_plain<float>(const std::vector<TouchingPair>&, Family, double);
template Measured measure_plain<double>(const std::vector<TouchingPair>&, Family, double);

void mark_front(std::vector<Measured>& settings_tried) {
  // a new contact cannot start warm, and other definitions of the point are not comparable
  const auto rivals = [](const Measured& o, const Measured& other) {
    const auto is_cold = [](Family f) { return f == Family::cold || f == Family::lp_tolerance; };
    return o.family == other.family || (is_cold(o.family) && is_cold(other.family));
  };
  for (Measured& o : settings_tried)
    o.on_front = (o.family <= Family::lp_tolerance) && o.failed == 0 &&
                 std::none_of(settings_tried.begin(), settings_tried.end(), [&](const Measured& other) {
                   return rivals(o, other) && other.failed == 0 && other.visits <= o.visits &&
                          other.worst_of_all() <= o.worst_of_all() &&
                          (other.visits < o.visits || other.worst_of_all() < o.worst_of_all());
                 });
}

const Measured* cheapest(const std::vector<Measured>& settings_tried, Family family, double error) {
  const Measured* best = nullptr;
  for (const Measured& o : settings_tried)
    if (o.family == family && o.failed == 0 && o.worst_of_all() <= error && (!best || o.visits < best->visits))
      best = &o;
  return best;
}

}  // namespace voussoir::trade
