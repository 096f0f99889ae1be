// Limit analysis of joints whose strength over the normal stress is Barton and Bandis' peak envelope. Its programs have
// straight cones, so each such face takes the envelope's tangent at its mean normal stress, and the analysis is
// repeated. Where the envelope is concave, tangents lie above it: what they do not support, it does not support either,
// and every round's answer is an upper bound.
//
// A factor of safety is enclosed (feasible directions after Topkis & Veinott 1967): forces in equilibrium are mixed
// from those of all rounds so that the least strength over shear force of the faces, a lower bound, is largest.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "core/joint_laws/barton_bandis.hpp"
#include "core/limit/evidence.hpp"

namespace voussoir {

// Of a face, N: the sum of its normal forces, and of the sizes of its shear forces
struct FaceResultant {
  double normal = 0, shear = 0;
};

inline constexpr double envelope_agreement = 1e-6;  // relative, of a factor's bounds or of two rounds' answers
inline constexpr int most_rounds_of_tangents = 60;

// The faces of `Problem` have properties, friction and cohesion. It has
//   faces, properties                     of the model
//   weight_on(face), area_of(face)        N, from which the first stress is taken; m²
//   force_on(forces, f), mix(a, b, share) of LimitState::forces
template <class Problem>
class FollowEnvelope {
 public:
  using Faces = std::remove_cvref_t<decltype(Problem::faces)>;

  explicit FollowEnvelope(const Problem& problem) : problem_(problem), straight_(problem.faces) {
    for (std::size_t f = 0; f < straight_.size(); ++f)
      if (!problem.properties.empty() && is_rough(f)) rough_.push_back(f);
    for (const std::size_t f : rough_)
      take_tangent(f, problem.weight_on(straight_[f]));
  }

  // The factor that divides the strength of the chosen faces, by find(faces).
  template <class Find>
  auto factor(const Find& find, const std::vector<bool>& chosen) {
    const auto divides = [&](std::size_t f) { return chosen[f]; };
    if (!std::ranges::all_of(rough_, divides)) return repeat(find, [](const auto& found) { return found.stands; });
    auto best = find(straight_);
    if (rough_.empty() || best.status != LimitStatus::found) return best;
    auto forces = best.state.forces;
    std::vector<std::remove_cvref_t<decltype(forces)>> seen{forces};
    int programs = best.evidence.programs, rounds = 1;
    double lower = least_ratio(forces, chosen);
    constexpr std::size_t most_seen = 30;
    constexpr int sweeps = 2;
    for (; rounds < most_rounds_of_tangents; ++rounds) {
      if (best.collapses - lower <= envelope_agreement * best.collapses) break;
      for (const std::size_t f : rough_)
        take_tangent(f, problem_.force_on(forces, f).normal);
      const auto found = find(straight_);
      programs += found.evidence.programs;
      if (found.status != LimitStatus::found) break;
      if (found.collapses < best.collapses) best = found;
      if (seen.size() == most_seen) seen.erase(seen.begin());
      seen.push_back(found.state.forces);
      for (int sweep = 0; sweep < sweeps; ++sweep)
        for (const auto& other : seen)
          forces = problem_.mix(forces, other, best_share(forces, other, chosen));
      lower = least_ratio(forces, chosen);
    }
    best.stands = std::min(lower, best.collapses);
    best.state.forces = forces;
    best.evidence.programs = programs;
    best.evidence.rounds_of_tangents = rounds;
    best.evidence.tangents_agree = best.collapses - best.stands <= envelope_agreement * best.collapses;
    return best;
  }

  // Any other answer, of which `number` is sought: until two rounds agree, later ones with smaller changes of stress.
  template <class Find, class Number>
  auto repeat(const Find& find, const Number& number) {
    auto answer = find(straight_);
    if (rough_.empty()) return answer;
    std::vector<double> taken(straight_.size(), 0.0);
    constexpr int full_rounds = 8;  // without damping
    for (int rounds = 1, programs = answer.evidence.programs;; ++rounds) {
      answer.evidence.rounds_of_tangents = rounds;
      answer.evidence.programs = programs;
      // tangents do not support the load, or it asks for no strength
      if (answer.status != LimitStatus::found) return answer;
      for (const std::size_t f : rough_) {
        const double normal = problem_.force_on(answer.state.forces, f).normal;
        taken[f] += (normal - taken[f]) / (1 + (rounds - 1) / full_rounds);
        take_tangent(f, taken[f]);
      }
      if (rounds == most_rounds_of_tangents) break;
      const double last = number(answer);
      auto next = find(straight_);
      programs += next.evidence.programs;
      if (next.status == LimitStatus::found) {
        const bool agrees = std::abs(number(next) - last) <= envelope_agreement * std::max(1.0, std::abs(number(next)));
        if (agrees) {
          next.evidence.rounds_of_tangents = rounds + 1;
          next.evidence.programs = programs;
          return next;
        }
      }
      answer = std::move(next);
    }
    answer.evidence.tangents_agree = false;
    return answer;
  }

 private:
  bool is_rough(std::size_t f) const {
    return problem_.properties[problem_.faces[f].properties].follows_barton_bandis();
  }

  void take_tangent(std::size_t f, double normal_force) {
    const auto& face = problem_.faces[f];
    const EnvelopeTangent tangent =
        envelope_tangent(problem_.properties[face.properties], std::max(0.0, normal_force) / problem_.area_of(face));
    straight_[f].friction = tangent.friction;
    straight_[f].cohesion = face.cohesion + tangent.cohesion;
  }

  // N, undivided
  double strength(std::size_t f, double normal_force) const {
    const auto& face = problem_.faces[f];
    const double area = problem_.area_of(face), pressed = std::max(0.0, normal_force);
    const double angle =
        is_rough(f) ? peak_friction(problem_.properties[face.properties], pressed / area) : face.friction;
    return pressed * std::tan(angle) + face.cohesion * area;
  }

  // of the chosen faces; the others are within their cones in every round
  template <class Forces>
  double least_ratio(const Forces& forces, const std::vector<bool>& chosen) const {
    double least = std::numeric_limits<double>::max();
    for (std::size_t f = 0; f < straight_.size(); ++f) {
      if (!chosen[f]) continue;
      const FaceResultant force = problem_.force_on(forces, f);
      if (force.shear > 0) least = std::min(least, strength(f, force.normal) / force.shear);
    }
    return least;
  }

  // of the second forces, by golden sections: the ratio has one maximum, since strength is concave
  template <class Forces>
  double best_share(const Forces& first, const Forces& second, const std::vector<bool>& chosen) const {
    constexpr double golden = 0.618033988749895;
    constexpr int sections = 40;
    const auto at = [&](double share) { return least_ratio(problem_.mix(first, second, share), chosen); };
    double low = 0, high = 1, a = 1 - golden, b = golden, at_a = at(a), at_b = at(b);
    for (int i = 0; i < sections; ++i) {
      if (at_a < at_b) {
        low = a, a = b, at_a = at_b, b = low + golden * (high - low), at_b = at(b);
      } else {
        high = b, b = a, at_b = at_a, a = high - golden * (high - low), at_a = at(a);
      }
    }
    const double share = 0.5 * (low + high);
    return at(1) >= at(share) ? 1 : share;
  }

  const Problem& problem_;
  Faces straight_;
  std::vector<std::size_t> rough_;
};

}  // namespace voussoir
