#include "app/check/motion_damping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voussoir {
namespace {

constexpr double low = 1, high = 10;  // Hz: what earthquakes contain

std::string percent_text(double at_low, double at_high) {
  constexpr double percent = 100;
  if (at_low == at_high) return fmt::format("{:.2g} %", percent * at_low);
  return fmt::format("{:.2g} % at {:g} Hz, {:.2g} % at {:g} Hz", percent * at_low, low, percent * at_high, high);
}

}  // namespace

DampingRatios damping_at(double frequency, const DampingSettings& damping, double joint_frequency) {
  DampingRatios ratios;
  ratios.joints = damping.joint_ratio * frequency / damping.joint_frequency;
  if (joint_frequency > 0) ratios.viscous = damping.viscous_ratio * std::min(frequency / joint_frequency, 1.0);
  ratios.local = std::log((1 + damping.local) / (1 - damping.local)) / (2 * std::numbers::pi);
  return ratios;
}

std::string motion_damping_text(const DampingSettings& damping, double joint_frequency) {
  const DampingRatios slow = damping_at(low, damping, joint_frequency),
                      fast = damping_at(high, damping, joint_frequency);
  std::string text;
  const auto add = [&](bool acts, const std::string& what) {
    if (acts) text += (text.empty() ? "" : "; ") + what;
  };
  add(damping.joint_ratio > 0, "joint_ratio " + percent_text(slow.joints, fast.joints));
  add(slow.viscous > 0, "viscous_ratio, normal to joints, at most " + percent_text(slow.viscous, fast.viscous));
  add(damping.viscous_ratio > 0 && slow.viscous == 0, "viscous_ratio, normal to joints, below that of a block's swing");
  add(damping.local > 0, "local " + percent_text(slow.local, fast.local));
  return (text.empty() ? "no dashpot damps the motion (0 % of critical at 1 and 10 Hz)"
                       : "of critical damping: " + text) +
         "; slip takes the rest";
}

}  // namespace voussoir
