#include "core/run/search_rules.hpp"

#include <fmt/format.h>

#include "core/run/run.hpp"

namespace voussoir {
namespace {

std::string failed_by_displacement(const TrialCriteria& c) {
  if (c.plan.failure_fraction == 0)
    return fmt::format("failed: a body moved more than {:.3g} m", c.failure_displacement);
  return fmt::format("failed: bodies of {:g} of the free mass moved more than {:.3g} m", c.plan.failure_fraction,
                     c.failure_displacement);
}

// of equal increments, the error is outside the error bar
std::string newton_rule(const Settings& settings, bool follows_slip) {
  if (settings.statics.method != Statics::newton) return "";
  if (follows_slip) return "; by Newton's method, in increments that follow the slip";
  return fmt::format(
      "; by Newton's method in {} increment{} per trial: the error due to slip integrated in large increments is not "
      "in the error bar",
      settings.statics.increments, settings.statics.increments == 1 ? "" : "s");
}

}  // namespace

std::string failed_rule(const TrialCriteria& c) {
  if (c.watches)
    return "failed: the strength that the motion requires falls in a straight line after ten elastic displacements, "
           "or a body moved by a tenth of its inscribed radius";
  const std::string why =
      c.not_watched.empty() ? "" : fmt::format(" (not by the required strength: {})", c.not_watched);
  return failed_by_displacement(c) + why;
}

std::string stable_and_failed_rule(const TrialCriteria& c) {
  return fmt::format("stable: unbalanced ratio below {:.0e}; ", c.settings.equilibrium.unbalanced) + failed_rule(c) +
         newton_rule(c.settings, c.watches);
}

std::string bisection_rule(const TrialCriteria& c, CriticalBy by) {
  const std::string rule = "bisection from the last stable state; " + stable_and_failed_rule(c);
  switch (by) {
    case CriticalBy::required_strength:
      return rule + "; result: the strength required at no displacement";
    case CriticalBy::bracket_of_turning:
      return rule +
             "; result: the bracket; the bar contains what the stiffness of the faces on which blocks turn adds to "
             "the strength of rigid blocks";
    case CriticalBy::stable_fit:
      return rule + "; result: the fit through the stable trials, s = s0 + b u^(-1/2) - a u, at no displacement";
    case CriticalBy::bracket:
      return rule;
  }
  return rule;
}

std::string hangs_on_bolts(const std::optional<double>& use) {
  return fmt::format(
      "the blocks hang on their bolts at any factor: they are in equilibrium without the strength that it divides; the "
      "bolts' own reserve, capacity over force, is then {}",
      use && *use > 0 ? fmt::format("{:.4g}", 1 / *use) : "not limited: they have no yield");
}

template <int Dim>
std::string farthest_mover(const Model<Dim>& model, const State<Dim>& state, const std::vector<Vector<Dim>>& begin,
                           const std::function<double(int)>& failure) {
  int body = -1;
  double most = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const double moved = (state.bodies.motions[b].displacement - begin[b]).norm();
    if (model.bodies[b].fixed || moved <= most) continue;
    most = moved;
    body = static_cast<int>(b);
  }
  if (body < 0) return "no body has moved";
  const Motion<Dim>& motion = state.bodies.motions[body];
  const double speed = motion.velocity.norm(), away = motion.velocity.dot(motion.displacement - begin[body]) / most;
  return fmt::format("{} has moved by {:.3g} m of the {:.3g} m that are failure and {} at {:.2g} m/s",
                     label_of(model, body), most, failure(body), away > 0.5 * speed ? "creeps" : "oscillates", speed);
}

template std::string farthest_mover<2>(const Model<2>&, const State<2>&, const std::vector<Vector<2>>&,
                                       const std::function<double(int)>&);
template std::string farthest_mover<3>(const Model<3>&, const State<3>&, const std::vector<Vector<3>>&,
                                       const std::function<double(int)>&);

}  // namespace voussoir
