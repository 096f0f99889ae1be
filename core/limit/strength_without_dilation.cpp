#include <algorithm>
#include <cmath>
#include <limits>

#include "core/limit/strength.hpp"
#include "core/limit/without_dilation.hpp"

namespace voussoir {
namespace {

constexpr double first_step = 0.01;  // of the range of the measure: from what joints that dilate need
constexpr double longer = 2.5;       // each further step
constexpr int most_trials_of_an_end = 25;
constexpr int most_lower = 4;   // mechanisms that are found beyond a root
constexpr double accurate = 3;  // times a factor's error: a trial whose factor is nearer to zero is the root

// factors at a strength
struct TrialWithoutDilation {
  double at = 0;
  EndOfFactor least, largest;  // infinite where forces grow without bound
  bool settled = true;
  std::vector<double> slips;  // of the mechanism
};

// A load on every body along its velocity in the mechanism, its weight on the fastest. Under gravity alone the
// velocities' sum over all weights may vanish, as that of a symmetric arch, and has no part along gravity.
template <int Dim>
Loads<Dim> load_along(const CornerAssembly<Dim>& assembly, const std::vector<BodyVelocity<Dim>>& velocities) {
  double fastest = 0;
  for (const BodyVelocity<Dim>& velocity : velocities)
    fastest = std::max(fastest, velocity.velocity.norm());
  Loads<Dim> loads(assembly.bodies.size());
  if (fastest > 0)
    for (std::size_t b = 0; b < velocities.size(); ++b)
      if (assembly.bodies[b].moves()) loads[b].force = assembly.bodies[b].weight / fastest * velocities[b].velocity;
  return loads;
}

template <int Dim>
class SearchWithoutDilation {
 public:
  SearchWithoutDilation(const CornerAssembly<Dim>& assembly, const Loads<Dim>& loads, const Strength<Dim>& strength,
                        const CriticalStrength<Dim>& dilating, double needed, const RoundHook& hook)
      : trial_(assembly),
        loads_(loads),
        live_(load_along(assembly, dilating.state.velocities)),
        strength_(strength),
        needed_(needed),
        hook_(hook) {}

  StrengthWithoutDilation<Dim> find() {
    const bool driven = std::ranges::any_of(live_, [](const Load<Dim>& load) { return !load.force.isZero(0); });
    if (!driven) return result_.status = LimitStatus::carries_nothing, result_;
    if (!raise(needed_)) return result_;
    find_roots();
    // What was followed from weaker joints need not be the lowest: once more from loose joints, beyond the root.
    for (int again = 0; again < most_lower && result_.strongest; ++again) {
      const double beyond = result_.strongest->factor + 2 * result_.strongest->error;
      if (beyond >= strength_.strongest) break;
      if (!add(beyond, {})) return result_;
      const auto at_it = std::ranges::find(trials_, beyond, &TrialWithoutDilation::at);
      if (at_it->least.factor >= 0 || !at_it->settled) break;
      std::erase_if(trials_, [&](const TrialWithoutDilation& trial) { return trial.at > beyond; });
      if (!raise(beyond)) return result_;
      find_roots();
    }
    if (!result_.weakest && !result_.strongest) result_.status = LimitStatus::carries_nothing;
    return result_;
  }

 private:
  // from a strength up, in growing steps, until a trial stands; false: no mechanism was found at one of them
  bool raise(double from) {
    if (trials_.empty() && !add(from, {})) return false;
    for (double step = first_step * strength_.strongest; trials_.back().least.factor < 0; step *= longer) {
      const double next = std::min(from + step, strength_.strongest);
      if (!add(next, trials_.back().slips)) return false;
      if (next == strength_.strongest) break;
    }
    return true;
  }

  // solves at a strength; false: no mechanism was found there
  bool add(double at, const std::vector<double>& neighbour) {
    strength_.weaken(at, trial_);
    FactorWithoutDilation<Dim> found = find_factor_without_dilation(
        trial_, loads_, live_,
        hook_ ? RoundHook([&](int rounds, double factor) { hook_(result_.rounds + rounds, factor); }) : RoundHook(),
        neighbour);
    result_.rounds += found.rounds;
    result_.programs += found.programs;
    constexpr EndOfFactor unbounded{std::numeric_limits<double>::infinity(), 0};
    TrialWithoutDilation trial{at, found.least, found.unbounded ? unbounded : found.largest, found.settled,
                               std::move(found.slips)};
    if (found.status == LimitStatus::carries_any)
      trial = {at, unbounded, unbounded, true, {}};
    else if (found.status != LimitStatus::found)
      return result_.status = found.status, false;
    if (trials_.empty() || trial.least.factor <= 0) result_.state = std::move(found.state);
    trials_.push_back(std::move(trial));
    std::ranges::sort(trials_, {}, &TrialWithoutDilation::at);
    return true;
  }

  void find_roots() {
    result_.settled = true;
    result_.weakest = root_of(&TrialWithoutDilation::largest);
    result_.strongest = root_of(&TrialWithoutDilation::least);
  }

  // Where an end of the factor vanishes, by the rule of false position with halved ordinates (Illinois) between the
  // trials on either side.
  std::optional<EndOfFactor> root_of(EndOfFactor TrialWithoutDilation::*end) {
    double halved_low = 1, halved_high = 1;
    int last_side = 0;
    for (int k = 0; k < most_trials_of_an_end; ++k) {
      const auto above = std::ranges::find_if(trials_, [&](const auto& trial) { return (trial.*end).factor > 0; });
      if (above == trials_.end()) return {};
      if (above == trials_.begin()) return EndOfFactor{above->at, strength_.tolerance};  // as joints that dilate
      const TrialWithoutDilation low = *(above - 1), high = *above;
      const EndOfFactor at_low = low.*end, at_high = high.*end;
      const double width = high.at - low.at;
      // what joints that dilate need these need too, whether their slips settle there or not
      const bool settled = high.settled && (low.settled || low.at == needed_);
      double next = low.at + 0.5 * width;
      if (std::isfinite(at_high.factor)) {
        const double slope = (at_high.factor - at_low.factor) / width, root = low.at - at_low.factor / slope;
        const bool near_low = -at_low.factor <= accurate * at_low.error,
                   near_high = at_high.factor <= accurate * at_high.error;
        if (near_low || near_high || width <= strength_.tolerance) {
          result_.settled = result_.settled && settled;
          return EndOfFactor{root, strength_.tolerance + std::min(width, (at_low.error + at_high.error) / slope +
                                                                             std::min(root - low.at, high.at - root))};
        }
        const double weighted = halved_low * at_low.factor, other = halved_high * at_high.factor;
        next = low.at - weighted * width / (other - weighted);
      } else if (width <= strength_.tolerance) {
        result_.settled = result_.settled && settled;
        return EndOfFactor{next, width};
      }
      if (!add(std::clamp(next, low.at + 0.01 * width, high.at - 0.01 * width), low.slips)) return {};
      const auto added = std::ranges::find_if(trials_, [&](const auto& trial) { return trial.at > low.at; });
      const int side = ((*added).*end).factor > 0 ? 1 : -1;
      halved_low = side == 1 && last_side == 1 ? 0.5 * halved_low : 1;
      halved_high = side == -1 && last_side == -1 ? 0.5 * halved_high : 1;
      last_side = side;
    }
    return {};
  }

  CornerAssembly<Dim> trial_;
  const Loads<Dim>& loads_;
  Loads<Dim> live_;
  const Strength<Dim>& strength_;
  double needed_;
  const RoundHook& hook_;
  std::vector<TrialWithoutDilation> trials_;  // by strength
  StrengthWithoutDilation<Dim> result_;
};

}  // namespace

template <int Dim>
StrengthWithoutDilation<Dim> find_critical_friction_without_dilation(const CornerAssembly<Dim>& assembly,
                                                                     const Loads<Dim>& loads,
                                                                     const std::vector<bool>& chosen,
                                                                     const CriticalStrength<Dim>& dilating,
                                                                     const RoundHook& hook) {
  const Strength<Dim> strength = friction_of<Dim>(chosen);
  return SearchWithoutDilation<Dim>(assembly, loads, strength, dilating, dilating.collapses, hook).find();
}

template <int Dim>
StrengthWithoutDilation<Dim> find_factor_of_safety_without_dilation(const CornerAssembly<Dim>& assembly,
                                                                    const Loads<Dim>& loads,
                                                                    const std::vector<bool>& chosen,
                                                                    const CriticalStrength<Dim>& dilating,
                                                                    const RoundHook& hook) {
  const Strength<Dim> strength = remaining_strength(assembly, chosen);
  StrengthWithoutDilation<Dim> found =
      SearchWithoutDilation<Dim>(assembly, loads, strength, dilating, 1 / (1 + dilating.collapses), hook).find();
  for (std::optional<EndOfFactor>* end : {&found.weakest, &found.strongest})
    if (*end) {
      const double factor = factor_at((*end)->factor);
      *end = EndOfFactor{factor, (*end)->error * (1 + factor) * (1 + factor)};
    }
  return found;
}

template StrengthWithoutDilation<2> find_critical_friction_without_dilation(const CornerAssembly<2>&, const Loads<2>&,
                                                                            const std::vector<bool>&,
                                                                            const CriticalStrength<2>&,
                                                                            const RoundHook&);
template StrengthWithoutDilation<3> find_critical_friction_without_dilation(const CornerAssembly<3>&, const Loads<3>&,
                                                                            const std::vector<bool>&,
                                                                            const CriticalStrength<3>&,
                                                                            const RoundHook&);
template StrengthWithoutDilation<2> find_factor_of_safety_without_dilation(const CornerAssembly<2>&, const Loads<2>&,
                                                                           const std::vector<bool>&,
                                                                           const CriticalStrength<2>&,
                                                                           const RoundHook&);
template StrengthWithoutDilation<3> find_factor_of_safety_without_dilation(const CornerAssembly<3>&, const Loads<3>&,
                                                                           const std::vector<bool>&,
                                                                           const CriticalStrength<3>&,
                                                                           const RoundHook&);

}  // namespace voussoir
