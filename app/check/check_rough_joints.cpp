#include "app/check/check_rough_joints.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/base/shown_unit.hpp"
#include "app/check/blocks.hpp"
#include "app/check/check_line.hpp"
#include "core/joint_laws/barton_bandis.hpp"

namespace voussoir {

std::vector<std::string> rough_joint_text(const JointProperties& p) {
  const BartonBandis& law = p.barton_bandis;
  std::vector<std::string> lines;
  lines.push_back(
      law.sample_length > 0
          ? fmt::format("Barton and Bandis: JRC {:g}, JCS {} of a sample of {:g} m; {:.4g}, {} of blocks of {:g} m",
                        law.sample_jrc, quantity_text(law.sample_jcs, "Pa"), law.sample_length, law.jrc,
                        quantity_text(law.jcs, "Pa"), law.block_length)
          : fmt::format("Barton and Bandis: JRC {:g}, JCS {} as stated: no scale correction without sample_length_m",
                        law.jrc, quantity_text(law.jcs, "Pa")));
  lines.push_back(
      law.mobilisation == Mobilisation::table
          ? fmt::format("mobilised by slip: peak at {:.3g} mm of plastic slip, {:g} deg left at 100 times that",
                        1e3 * law.peak_slip, to_degrees(p.friction))
          : "without mobilisation: the peak strength at any slip");
  lines.push_back(law.dilation_share > 0
                      ? fmt::format("dilates at {:g} of the mobilised roughness angle", law.dilation_share)
                      : "does not dilate");
  if (const double capped = stress_at_largest_angle(p); capped > 0)
    lines.push_back(
        fmt::format("peak angle 70 deg, the largest, below a normal stress of {}", quantity_text(capped, "Pa")));
  return lines;
}

template <int Dim>
std::string rough_joint_angles(const Model<Dim>& model, int properties) {
  const double g = model.gravity.norm();
  if (g == 0) return {};
  const auto looks_down = [&](const Polytope<Dim>& part, std::size_t f) {
    return std::max(part.faces[f].normal.dot(model.gravity) / g, 0.0);
  };
  // Pa: faces that look down share the weight by their areas, as they do if the joints are as stiff in shear; one plane
  // has W cos θ/A
  std::vector<double> stresses;
  for (const Body<Dim>& body : model.bodies) {
    if (!moves(body)) continue;
    double shared = 0;
    for (const Polytope<Dim>& part : body.parts)
      for (std::size_t f = 0; f < part.faces.size(); ++f)
        if (const double slope = looks_down(part, f); slope > 0 && part.joints[f] != no_joint)
          shared += face_area<Dim>(part, static_cast<int>(f));
    for (const Polytope<Dim>& part : body.parts)
      for (std::size_t f = 0; f < part.faces.size(); ++f) {
        const int joint = part.joints[f];
        if (joint == no_joint || model.joints[joint].properties != properties) continue;
        if (const double slope = looks_down(part, f); slope > 0) stresses.push_back(body.mass * g * slope / shared);
      }
  }
  if (stresses.empty()) return {};
  std::ranges::sort(stresses);
  const auto angle = [&](double stress) { return to_degrees(peak_friction(model.properties[properties], stress)); };
  const double least = stresses.front(), median = stresses[stresses.size() / 2], most = stresses.back();
  return fmt::format(
      "peak angle {:.3g}, {:.3g}, {:.3g} deg at {}, {}, {}: least, median and largest stress of a face "
      "under its own block alone",
      angle(least), angle(median), angle(most), quantity_text(least, "Pa"), quantity_text(median, "Pa"),
      quantity_text(most, "Pa"));
}

template <int Dim>
void print_set_aside(const Prepared<Dim>& prepared) {
  std::vector<JointProperties> properties = prepared.model.properties;
  for (const StagePlan& stage : prepared.stages) {
    const std::vector<JointProperties> before = properties;
    set_friction(stage.change, properties);
    for (std::size_t p = 0; p < properties.size(); ++p) {
      if (!properties[p].states_barton_bandis()) continue;
      const bool now = properties[p].laws.set_aside, was = before[p].laws.set_aside;
      if (now && (!was || properties[p].friction != before[p].friction))
        print_line(
            "", fmt::format("Coulomb's friction of {:g} deg replaces Barton and Bandis' law of '{}' from stage {} on",
                            to_degrees(properties[p].friction), properties[p].name, stage.name));
      if (was && !now)
        print_line("", fmt::format("Barton and Bandis' law of '{}' acts again from stage {} on", properties[p].name,
                                   stage.name));
    }
  }
}

template std::string rough_joint_angles<2>(const Model<2>&, int);
template std::string rough_joint_angles<3>(const Model<3>&, int);
template void print_set_aside<2>(const Prepared<2>&);
template void print_set_aside<3>(const Prepared<3>&);

}  // namespace voussoir
