#include "app/check/check_records.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/check/blocks.hpp"
#include "app/check/check_line.hpp"
#include "core/load/response_spectrum.hpp"
#include "core/output/record_output.hpp"
#include "core/scene/judge_values.hpp"
#include "core/stage/medium.hpp"

namespace voussoir {
namespace {

// Shear waves that rise through blocks of one width: of the slowest by the joints of a block with a level top, as quiet
// sides take it, or else c = √(k a/ρ) of one family of joints. Each block is rigid, so that short waves do not pass.
struct BlockWaves {
  double stiffness = 0, width = 0, density = 0;                // Pa/m, m, kg/m³
  double of_joints = std::numeric_limits<double>::infinity();  // m/s; infinity: not known
  std::string properties;
  std::string unknown;  // why there is no such number

  double speed() const { return std::isfinite(of_joints) ? of_joints : std::sqrt(stiffness * width / density); }
  double frequency(double blocks_per_wave) const { return speed() / (blocks_per_wave * width); }
  std::string formula() const {
    if (std::isfinite(of_joints)) return fmt::format("c = {:.4g} m/s, of the joints' compliances together", of_joints);
    return fmt::format("c = √(k a/ρ) = {:.4g} m/s, k {:g} Pa/m of '{}', ρ {:g} kg/m³", speed(), stiffness, properties,
                       density);
  }
};

// m/s: of shear waves that rise through a block with a level top that a joint made; infinity: it has none
template <int Dim>
double rising_speed(const Model<Dim>& model, int body) {
  const Polytope<Dim>& part = model.bodies[body].parts.front();
  double slowest = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    if (part.joints[f] == no_joint || part.faces[f].normal[Dim - 1] < 1 - 1e-9) continue;
    try {
      const Vector<Dim> modulus = wave_stiffness(model, SideFace{body, 0, static_cast<int>(f)}).modulus;
      const double density = model.bodies[body].mass / volume(model.bodies[body]);
      slowest = std::sqrt(modulus.template head<Dim - 1>().minCoeff() / density);
    } catch (const ClosedSide&) {  // joints that do not yield to such waves
    }
  }
  return slowest;
}

// of the widest block and the softest joint, whose waves are the shortest
template <int Dim>
BlockWaves waves_of(const Model<Dim>& model) {
  constexpr double regular = 2;  // the widest over the narrowest block
  BlockWaves waves;
  double narrowest = std::numeric_limits<double>::infinity();
  int blocks = 0;
  for (const Body<Dim>& body : model.bodies) {
    if (!is_free(body)) continue;
    ++blocks;
    const double width = std::pow(volume(body), 1.0 / Dim);
    narrowest = std::min(narrowest, width);
    waves.width = std::max(waves.width, width);
    waves.density = std::max(waves.density, body.mass / volume(body));
    const int number = static_cast<int>(&body - model.bodies.data());
    if (body.parts.size() == 1) waves.of_joints = std::min(waves.of_joints, rising_speed(model, number));
  }
  if (blocks < 2) {
    waves.unknown = "one free block has no waves";
    return waves;
  }
  if (waves.width > regular * narrowest) {
    waves.unknown = fmt::format("blocks {:.3g} to {:.3g} m wide have no common speed of waves", narrowest, waves.width);
    return waves;
  }
  waves.stiffness = std::numeric_limits<double>::infinity();
  const std::vector<bool> used = properties_of_faces(model);
  for (std::size_t k = 0; k < model.properties.size(); ++k) {
    const JointProperties& p = model.properties[k];
    if (!used[k]) continue;
    if (p.constant_stiffness || p.laws.shear != StiffnessLaw::constant)
      waves.unknown = fmt::format("the shear stiffness of '{}' per area is not one number", p.name);
    if (p.shear_stiffness < waves.stiffness) {
      waves.stiffness = p.shear_stiffness;
      waves.properties = p.name;
    }
  }
  return waves;
}

void print_waves(const BlockWaves& waves, const GroundMotion& motion) {
  if (!waves.unknown.empty()) return print_line("", "blocks a wavelength: not estimated, " + waves.unknown);
  constexpr std::array<std::pair<double, const char*>, 2> wanted{
      {{10, "2.5"}, {16, "1"}}};  // % that a quiet side returns
  const FourierSpectrum spectrum = fourier_spectrum(motion);
  std::vector<std::string> parts;
  for (const auto& [blocks, returned] : wanted)
    parts.push_back(fmt::format("{:g} ({} %) up to {:.3g} Hz, above which {:.2g} % of its energy is", blocks, returned,
                                waves.frequency(blocks), 100 * share_above(spectrum, waves.frequency(blocks))));
  print_line("", fmt::format("blocks a wavelength: {}", fmt::join(parts, "; ")));
  print_line("", fmt::format("  shear waves by {}; a {:.3g} m", waves.formula(), waves.width));
}

void print_measures(const RecordMeasures& m) {
  std::string text;
  if (const auto& a = m.acceleration)
    text += fmt::format("PGA {:.5g} m/s² ({:.4g} g), ", a->peak, a->peak / standard_gravity);
  if (m.peak_velocity) text += fmt::format("PGV {:.5g} m/s, ", *m.peak_velocity);
  print_line("", text + fmt::format("PGD {:.5g} m", m.peak_displacement));
  if (const auto& a = m.acceleration)
    print_line("", fmt::format("Arias {:.5g} m/s, CAV {:.5g} m/s, 5 to 95 % of Arias in {:.4g} s from {:.4g} s on, "
                               "largest Fourier amplitude at {:.3g} Hz",
                               a->arias, a->cav, a->significant, a->significant_from, a->peak_frequency));
}

// rounding of sums leaves no true zero
double zero_if_negligible(double value, double scale) {
  constexpr double negligible = 1e-12;
  return std::abs(value) < negligible * scale ? 0 : value;
}

void print_end(const GroundMotion& motion, const RecordMeasures& m) {
  const double fastest = m.peak_velocity.value_or(0), farthest = m.peak_displacement;
  std::string text = "at its end ";
  if (m.peak_velocity) text += fmt::format("{:.3g} m/s and ", zero_if_negligible(m.end_velocity, fastest));
  text += fmt::format("{:.3g} m", zero_if_negligible(m.end_displacement, farthest));
  if (m.taken_off > 0)
    text += fmt::format("; without the correction {:.3g} m/s and {:.3g} m: it took off up to {:.2g} % of the peak",
                        motion.stated_end_velocity, motion.stated_end_displacement, 100 * m.taken_off);
  print_line("", text);
}

void print_response(const GroundMotion& motion) {
  std::vector<double> periods{0.1, 0.2, 0.5, 1, 2};
  std::erase_if(periods, [&](double period) { return period < 2 * motion.interval; });
  const std::vector<ResponseOrdinate> spectrum = response_spectrum(motion, periods);
  if (spectrum.empty()) return;
  std::vector<std::string> parts;
  for (const ResponseOrdinate& r : spectrum)
    parts.push_back(fmt::format("{:.4g} at {:g} s", r.pseudo_acceleration, r.period));
  print_line("", fmt::format("response, 5 % damped, m/s²: {}", fmt::join(parts, ", ")));
}

}  // namespace

template <int Dim>
void print_records(const Prepared<Dim>& prepared) {
  const std::vector<RecordRow> rows = record_rows(prepared.stages);
  if (rows.empty()) return;
  const BlockWaves waves = waves_of(prepared.model);
  for (const RecordRow& row : rows) {
    std::vector<std::string> direction;
    for (const double x : row.direction)
      direction.push_back(fmt::format("{:.4g}", zero_if_negligible(x, 1)));
    const std::string begins = row.motion->begins > 0 ? fmt::format(", from {:g} s on", row.motion->begins) : "";
    print_line(row.number == 1 ? "records" : "",
               fmt::format("{} {}: {} values at {:g} s, {:g} s along ({}) in stage {}{}", row.number, row.motion->name,
                           row.measures.count, row.measures.interval, row.measures.duration, fmt::join(direction, ", "),
                           row.stage, begins));
    print_measures(row.measures);
    print_end(*row.motion, row.measures);
    print_response(*row.motion);
    if (row.measures.acceleration) print_waves(waves, *row.motion);
  }
  print_line("",
             "positive values accelerate the ground along the direction; the blocks feel the opposite, as the "
             "force of 'voussoir blocks --seismic' is");
}

template void print_records<2>(const Prepared<2>&);
template void print_records<3>(const Prepared<3>&);

}  // namespace voussoir
