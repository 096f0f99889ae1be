// Limit analysis of joints whose strength over the normal stress is Barton and Bandis' peak envelope. Its programs have
// straight cones, so each such face takes the envelope's tangent at its mean normal stress, and the analysis is
// repeated until its forces agree with the envelope. Where the envelope is concave, tangents lie above it: what they do
// not support, it does not support either.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/joint_laws/barton_bandis.hpp"
#include "core/limit/limit.hpp"

namespace voussoir {

// the resultant of a face's forces, N
struct FaceForce {
  double normal = 0, shear = 0;
};

inline constexpr double envelope_agreement = 1e-6;  // of the answer, and of the strength that shear exceeds
inline constexpr int most_rounds_of_tangents = 60;

// the divisor of strengths that are as stated
inline constexpr auto undivided = [](const auto&, std::size_t) { return 1.0; };

// `faces` have properties, friction and cohesion. With find(faces) that returns an answer with `evidence` and
// `state.forces`; weight_on(face), N, from which the first stress is taken; area_of(face), m²; force_on(answer, f); and
// number_of(answer), at which the strength of a face is divided by divisor_of(answer, f).
template <class Face, class Find, class WeightOn, class AreaOf, class ForceOn, class NumberOf, class DivisorOf>
auto follow_envelope(const std::vector<JointProperties>& properties, const std::vector<Face>& faces, const Find& find,
                     const WeightOn& weight_on, const AreaOf& area_of, const ForceOn& force_on,
                     const NumberOf& number_of, const DivisorOf& divisor_of) {
  const auto is_rough = [](const JointProperties& p) { return p.follows_barton_bandis(); };
  if (std::ranges::none_of(properties, is_rough)) return find(faces);
  std::vector<std::size_t> rough;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (is_rough(properties[faces[f].properties])) rough.push_back(f);
  if (rough.empty()) return find(faces);

  std::vector<Face> straight = faces;
  const auto take_tangent = [&](std::size_t f, double normal_force) {
    const EnvelopeTangent tangent =
        envelope_tangent(properties[faces[f].properties], std::max(0.0, normal_force) / area_of(faces[f]));
    straight[f].friction = tangent.friction;
    straight[f].cohesion = faces[f].cohesion + tangent.cohesion;
  };
  for (const std::size_t f : rough)
    take_tangent(f, weight_on(faces[f]));

  double last = 0;
  for (int rounds = 1, programs = 0;; ++rounds) {
    auto answer = find(straight);
    programs += answer.evidence.programs;
    answer.evidence.programs = programs;
    answer.evidence.rounds_of_tangents = rounds;
    // tangents do not support the load, or it asks for no strength
    if (answer.status != LimitStatus::found) return answer;
    double exceeded = 0;
    for (const std::size_t f : rough) {
      const FaceForce force = force_on(answer, f);
      const double stress = std::max(0.0, force.normal) / area_of(faces[f]),
                   strength =
                       stress * std::tan(peak_friction(properties[faces[f].properties], stress)) + faces[f].cohesion;
      exceeded = std::max(exceeded, force.shear * divisor_of(answer, f) - strength * area_of(faces[f]));
      take_tangent(f, force.normal);
    }
    answer.evidence.beyond_envelope = exceeded;
    const double number = number_of(answer);
    const bool agrees = rounds > 1 && std::abs(number - last) <= envelope_agreement * std::max(1.0, std::abs(number));
    if (agrees || rounds == most_rounds_of_tangents) {
      answer.evidence.tangents_agree = agrees;
      return answer;
    }
    last = number;
  }
}

}  // namespace voussoir
