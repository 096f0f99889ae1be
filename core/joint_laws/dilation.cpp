#include "core/joint_laws/dilation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/joint_laws/barton_bandis.hpp"

namespace voussoir {
namespace {

// parts of a return on which the excess is looked at
constexpr int parts_of_return = 32;

// The root between `low`, where the excess is positive, and `high`, where it is not: secants, of which the end that
// stays is weighted down (Anderson and Bjorck 1973), else halves.
double root_between(const SlipExcess& excess, double low, double at_low, double high, double at_high) {
  if (std::abs(at_high) <= excess.noise) return high;
  constexpr int limit = 2 * std::numeric_limits<double>::digits;
  double best = high;
  int side = 0;  // the end that moved last
  for (int i = 0; i < limit; ++i) {
    double next = low + (high - low) * (at_low / (at_low - at_high));
    if (!(next > low && next < high) || i % 4 == 3) next = 0.5 * (low + high);
    if (!(next > low && next < high)) break;
    const double at = excess.at(next);
    const bool done = std::abs(next - best) <= std::numeric_limits<double>::epsilon() * next;
    best = next;
    if (std::abs(at) <= excess.noise || done) break;
    const auto weight = [&](double last) {
      const double left = 1 - at / last;
      return left > 0 ? left : 0.5;
    };
    if (at > 0) {
      if (side > 0) at_high *= weight(at_low);
      low = next;
      at_low = at;
      side = 1;
    } else {
      if (side < 0) at_low *= weight(at_high);
      high = next;
      at_high = at;
      side = -1;
    }
  }
  return best;
}

}  // namespace

double dilation_in_force(const JointProperties& p, double friction, double strength_factor) {
  if (p.laws.friction != FrictionLaw::softening) return std::tan(std::min(p.dilation, friction));
  return std::min(std::tan(p.dilation), std::max(std::tan(friction) - p.softening_drop / strength_factor, 0.0));
}

double steepest_dilation(const JointProperties& p) {
  if (!p.dilates()) return 0;
  return p.follows_barton_bandis() ? steepest_roughness(p) : std::tan(p.dilation);
}

double rise_at(const JointProperties& p, double tangent, double offset) {
  if (p.laws.dilation == DilationLaw::constant) return tangent * std::min(offset, p.dilation_until);
  if (p.laws.dilation == DilationLaw::falling)
    return -tangent * p.dilation_decay * std::expm1(-offset / p.dilation_decay);
  return 0;
}

double OffsetPath::length(double slip) const {
  return across == 0 ? std::abs(along + slip) : std::sqrt((along + slip) * (along + slip) + across * across);
}

double first_slip(const JointProperties& p, const OffsetPath& path, const SlipExcess& excess,
                  std::span<const double> kinks) {
  const double most = excess.most;
  std::array<double, 16> ends;
  std::size_t count = 0;
  const auto add = [&](double slip) {
    if (slip > 0 && slip < most) ends[count++] = slip;
  };
  const double limit = p.laws.dilation == DilationLaw::constant ? p.dilation_until : 0;
  if (limit > path.across) {
    const double half = std::sqrt((limit - path.across) * (limit + path.across));
    add(-path.along - half);
    add(half - path.along);
  }
  add(-path.along);
  std::ranges::for_each(kinks, add);
  ends[count++] = most;
  const std::span<double> sorted(ends.data(), count);
  std::ranges::sort(sorted);
  double low = 0, at_low = excess.at_zero;
  const auto go_to = [&](double next, double& found) {
    const double at = excess.at(next);
    if (!(at > 0)) {
      found = root_between(excess, low, at_low, next, at);
      return true;
    }
    low = next;
    at_low = at;
    return false;
  };
  double slip = most;
  const double returns_until = std::clamp(-path.along, 0.0, most);
  for (const double end : sorted) {
    if (!(end > low)) continue;
    const int parts = low < returns_until && !excess.falls ? parts_of_return : 1;
    const double begin = low;
    for (int k = 1; k < parts; ++k)
      if (go_to(begin + (end - begin) * k / parts, slip)) return slip;
    if (go_to(end, slip)) return slip;
  }
  return slip;
}

}  // namespace voussoir
