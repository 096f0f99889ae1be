// The atlas: kernels, axes and verdicts.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace voussoir::atlas {

enum class Kernel { block, cut, decision, centre, normal, overlap, area };
inline constexpr std::array kernel_names{"block", "cut", "decision", "centre", "normal", "overlap", "area"};
inline constexpr int kernels = kernel_names.size();

// the parameter varied besides the depth
enum class Axis { thinness, angle, ratio, placed, made, faces };
inline constexpr std::array axis_names{"thinness", "angle", "ratio", "placed", "made", "faces"};
inline constexpr int axes = axis_names.size();

// in ascending order of alarm; not_asked: no result exists (no overlap, so no contact point)
enum class Verdict { not_asked, correct, warned, refused, wrong };
inline constexpr std::array verdict_names{"not asked", "correct", "warned", "refused", "wrong"};

inline Verdict worse(Verdict a, Verdict b) {
  return std::max(a, b);
}

// one kernel's result for one instance
struct Judgement {
  Verdict verdict = Verdict::not_asked;
  std::string reason;  // of a wrong result
  // error as a fraction of the promise; above 1 is wrong, and 0 if the result is yes or no
  double fraction = 0;
};

using Judgements = std::array<Judgement, kernels>;

inline Judgement& of(Judgements& all, Kernel kernel) {
  return all[static_cast<int>(kernel)];
}

}  // namespace voussoir::atlas
