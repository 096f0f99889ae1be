#include "core/joint_laws/barton_bandis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voussoir {
namespace {

// plastic slip over that at the peak, and the mobilised part of the roughness (Barton, Bandis & Bakhtar 1985)
constexpr std::array<double, mobilisation_kinks> slips{0.3, 0.6, 1, 2, 4, 10, 25, 100};
constexpr std::array<double, mobilisation_kinks> mobilised{0, 0.75, 1, 0.85, 0.7, 0.5, 0.4, 0};

// of the stress over that of the walls: the angle of a joint that is hardly pressed remains finite
constexpr double least_stress = 1e-200;

// the roughness that is mobilised, and its slope over x; linear between the rows
struct Mobilised {
  double fraction = 0, slope = 0;
};
Mobilised mobilised_at(double x) {
  if (x < slips.front() || x >= slips.back()) return {};
  const std::size_t k = std::ranges::upper_bound(slips, x) - slips.begin() - 1;
  const double slope = (mobilised[k + 1] - mobilised[k]) / (slips[k + 1] - slips[k]);
  return {mobilised[k] + slope * (x - slips[k]), slope};
}

// the mean of what is mobilised between two x: exact, each row of the table by its middle
double mean_mobilised(double from, double to) {
  if (to <= slips.front() || from >= slips.back()) return 0;
  if (!(to > from)) return mobilised_at(to).fraction;
  double sum = 0;
  for (std::size_t k = 0; k + 1 < slips.size(); ++k) {
    const double low = std::max(from, slips[k]), high = std::min(to, slips[k + 1]);
    if (high > low) sum += mobilised_at(0.5 * (low + high)).fraction * (high - low);
  }
  return sum / (to - from);
}

bool mobilises_roughness(const BartonBandis& law) {
  return law.mobilisation == Mobilisation::table && law.peak_slip > 0;
}

}  // namespace

void scale_to_blocks(BartonBandis& law) {
  law.jrc = law.sample_jrc;
  law.jcs = law.sample_jcs;
  if (law.block_length > 0 && law.sample_length > 0) {
    const double ratio = law.block_length / law.sample_length;
    law.jrc *= std::pow(ratio, -0.02 * law.sample_jrc);
    law.jcs *= std::pow(ratio, -0.03 * law.sample_jrc);
  }
  law.peak_slip = law.block_length > 0 ? law.block_length / 500 * std::pow(law.jrc / law.block_length, 0.33) : 0;
}

double roughness_angle(const JointProperties& p, double stress) {
  const BartonBandis& law = p.barton_bandis;
  if (stress >= law.jcs) return 0;
  const double angle = law.jrc * std::log10(law.jcs / std::max(stress, least_stress * law.jcs)) * degree;
  return std::min(angle, largest_friction_angle - p.friction);
}

double peak_friction(const JointProperties& p, double stress) {
  return p.friction + roughness_angle(p, stress);
}

EnvelopeTangent envelope_tangent(const JointProperties& p, double stress) {
  const double tangent = std::tan(peak_friction(p, stress)), jrc = p.barton_bandis.jrc * degree;
  if (stress <= stress_at_largest_angle(p)) return {largest_friction_angle, 0};
  if (stress >= p.barton_bandis.jcs) return {p.friction, 0};
  const double slope = std::max(0.0, tangent - jrc / std::numbers::ln10 * (1 + tangent * tangent));
  return {std::atan(slope), stress * (tangent - slope)};
}

double stress_at_largest_angle(const JointProperties& p) {
  const BartonBandis& law = p.barton_bandis;
  const double most = to_degrees(largest_friction_angle - p.friction);
  return law.jrc > 0 && most < 200 * law.jrc ? law.jcs * std::pow(10, -most / law.jrc) : 0;
}

MobilisedAngle mobilised_angle(const JointProperties& p, double slip, double stress) {
  const BartonBandis& law = p.barton_bandis;
  if (!mobilises_roughness(law)) return {peak_friction(p, stress), 0};
  const double x = slip / law.peak_slip;
  if (x < slips.front()) return {p.friction * x / slips.front(), p.friction / slips.front() / law.peak_slip};
  const Mobilised now = mobilised_at(x);
  const double roughness = roughness_angle(p, stress);
  return {p.friction + now.fraction * roughness, now.slope * roughness / law.peak_slip};
}

MobilisedOver mobilised_over(const JointProperties& p, double from, double to) {
  const BartonBandis& law = p.barton_bandis;
  return {mobilises_roughness(law) ? mean_mobilised(from / law.peak_slip, to / law.peak_slip) : 1, 0.5 * (from + to)};
}

double barton_bandis_dilation(const JointProperties& p, const MobilisedOver& slip, double stress,
                              double strength_factor) {
  if (slip.fraction == 0) return 0;
  const double roughness = roughness_angle(p, stress),
               angle = p.barton_bandis.dilation_share * slip.fraction * roughness;
  const double friction =
      mobilises_roughness(p.barton_bandis) ? mobilised_angle(p, slip.middle, stress).angle : p.friction + roughness;
  if (strength_factor == 1) return std::tan(std::min(angle, friction));
  return std::min(std::tan(angle), std::tan(friction) / strength_factor);
}

double steepest_roughness(const JointProperties& p) {
  return std::tan(p.barton_bandis.dilation_share * (largest_friction_angle - p.friction));
}

std::array<double, mobilisation_kinks> slips_of_kinks(const JointProperties& p) {
  std::array<double, mobilisation_kinks> at = slips;
  const double scale = mobilises_roughness(p.barton_bandis) ? p.barton_bandis.peak_slip : 0;
  for (double& slip : at)
    slip *= scale;
  return at;
}

}  // namespace voussoir
