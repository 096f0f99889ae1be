#include "app/check/judge_contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "app/check/blocks.hpp"
#include "core/contact/integrable.hpp"
#include "core/potential/particle.hpp"
#include "core/scene/judge_values.hpp"

namespace voussoir {
namespace {

constexpr double large_overlap_fraction = 0.01;  // of the inscribed radius: blocks visibly sink into each other
constexpr double least_overlap_fraction = 1e-9;  // stiffer than rock can be: rounding becomes visible
constexpr double large_overlap = 0.01;           // m: joints in rock close by a millimetre or so

// least number of blocks of a pile or slope; two on one another are a mechanism of their own
constexpr std::size_t few_blocks = 3;

// of the smaller inscribed radius: a block that only touches another has its middle less deep inside it
constexpr double deep_inside = 0.5;

template <int Dim>
bool may_turn(const Body<Dim>& body) {
  return is_free(body) && std::any_of(body.free_rotation.begin(), body.free_rotation.end(), [](bool f) { return f; });
}

// blocks that were stated into each other fly apart
template <int Dim>
void judge_stated_overlaps(const ContactSettings& settings, const Model<Dim>& model, const State<Dim>& state,
                           std::vector<std::string>& warnings) {
  for (const Contact<Dim>& contact : state.contacts.list) {
    if (!contact.touching()) continue;
    const int a = model.parts[contact.part_a].body, b = model.parts[contact.part_b].body;
    const double size = std::min(model.bodies[a].size, model.bodies[b].size);
    if (contact.geometry.overlap <= settings.potential_radius * size) continue;
    warnings.push_back(
        fmt::format("blocks {} and {} overlap by {:.2g} m at the start, {:.2g} of the smaller inscribed radius: check "
                    "their vertices, planes or box",
                    name_of(model, a), name_of(model, b), contact.geometry.overlap, contact.geometry.overlap / size));
    return;  // one warning is enough
  }
}

// whether the middle of a part is well inside another before the first step
template <int Dim>
bool holds_middle(const Model<Dim>& model, int outer, int inner, double depth) {
  const Body<Dim>&a = model.bodies[model.parts[outer].body], &b = model.bodies[model.parts[inner].body];
  const Vector<Dim> middle = model.polytope(inner).centre + (b.reference - a.reference);
  const HalfSpaces<Dim>& faces = model.polytope(outer).faces;
  return std::all_of(faces.begin(), faces.end(),
                     [&](const HalfSpace<Dim>& face) { return signed_distance(face, middle) < -depth; });
}

template <int Dim>
void judge_places(const Model<Dim>& model, const State<Dim>& state, std::vector<std::string>& warnings) {
  for (const Contact<Dim>& contact : state.contacts.list) {
    const int a = contact.part_a, b = contact.part_b;
    const double depth = deep_inside * std::min(model.polytope(a).inscribed_radius, model.polytope(b).inscribed_radius);
    if (!holds_middle(model, a, b, depth) && !holds_middle(model, b, a, depth)) continue;
    warnings.push_back(fmt::format("blocks {} and {} are inside one another: was one of them stated twice? remove it",
                                   name_of(model, model.parts[a].body), name_of(model, model.parts[b].body)));
    return;  // one warning is enough
  }
}

// the properties of a pair's contact, now or once loaded: blocks that one joint separates do not overlap yet
template <int Dim>
std::optional<int> properties_between(const Model<Dim>& model, const Contact<Dim>& contact) {
  if (contact.touching()) return contact.properties;
  const std::vector<int>&a = model.polytope(contact.part_a).joints, &b = model.polytope(contact.part_b).joints;
  for (const int joint : a)
    if (joint != no_joint && std::find(b.begin(), b.end(), joint) != b.end()) return model.joints[joint].properties;
  return std::nullopt;
}

// blocks that may rotate and rest on others that may, with one contact point per face
template <int Dim>
void judge_points(const Model<Dim>& model, const ContactSettings& settings, const State<Dim>& state,
                  std::vector<std::string>& warnings) {
  if (model.gravity.norm() == 0) return;
  std::set<int> blocks, properties;
  for (const Contact<Dim>& contact : state.contacts.list) {
    const int a = model.parts[contact.part_a].body, b = model.parts[contact.part_b].body;
    if (!may_turn(model.bodies[a]) || !may_turn(model.bodies[b])) continue;
    const std::optional<int> between = properties_between(model, contact);
    if (!between || model.properties[*between].sub_contacts > 1 || is_integrated(settings, model.properties[*between]))
      continue;
    blocks.insert({a, b});
    properties.insert(*between);
  }
  if (blocks.size() < few_blocks) return;
  std::string keys;
  bool integrable = true;
  for (const int p : properties)
    integrable = integrable && can_be_integrated(model.properties[p]);
  for (const int p : properties)
    keys += fmt::format("{}joint_properties.{}.sub_contacts", keys.empty() ? "" : ", ", model.properties[p].name);
  warnings.push_back(
      fmt::format("{} free blocks rest on one another with one contact point per face, which resists neither spin nor "
                  "rocking: slopes "
                  "and piles fail too early; set {}{} = 2 or more, or restrain blocks that do not rotate",
                  blocks.size(), integrable ? "contact.face = \"integrated\", or " : "", keys));
}

}  // namespace

template <int Dim>
void judge_first_contacts(const ContactSettings& settings, const Model<Dim>& model, const State<Dim>& state,
                          std::vector<std::string>& warnings) {
  judge_stated_overlaps(settings, model, state, warnings);
  judge_places(model, state, warnings);
  judge_points(model, settings, state, warnings);
}

void judge_overlaps(const ContactSettings& contact, const Forecast& forecast, std::vector<std::string>& warnings) {
  const double radius = contact.potential_radius, fraction = forecast.overlap_fraction;
  const std::string units = "or check the units of normal_stiffness (Pa/m), density, gravity and the geometry (m)";
  if (fraction > radius)
    warnings.push_back(
        fmt::format("blocks sink by {:.2g} of their inscribed radius under their own weight, more than "
                    "contact.potential_radius = {:.2g}: raise normal_stiffness, or potential_radius, {}",
                    fraction, radius, units));
  else if (fraction > large_overlap_fraction)
    warnings.push_back(fmt::format(
        "blocks sink by {:.2g} of their inscribed radius under their own weight: raise normal_stiffness, {}", fraction,
        units));
  else if (fraction > 0 && fraction < least_overlap_fraction)
    warnings.push_back(
        fmt::format("blocks sink by only {:.2g} of their inscribed radius under their own weight: lower "
                    "normal_stiffness, {}",
                    fraction, units));
  if (forecast.overlap > large_overlap)
    warnings.push_back(fmt::format(
        "joints close by {:.2g} m under the weight of one block, rock joints by a millimetre: raise normal_stiffness, "
        "{}",
        forecast.overlap, units));
}

template <int Dim>
void judge_multipliers(const ContactSettings& contact, const Model<Dim>& model, std::vector<std::string>& warnings) {
  if (contact.smoothing != ContactSettings{}.smoothing && contact.point != ContactPoint::central_path)
    warnings.push_back("contact.smoothing acts only with contact.point = \"central_path\"");
  const auto of_half_spaces = [&](const PartId& id) { return !is_particle(model.bodies[id.body].parts[id.part]); };
  if (contact.normal != ContactNormal::multipliers || std::ranges::none_of(model.parts, of_half_spaces)) return;
  const char* const keeps = "contact.normal = \"multipliers\" keeps energy only with";
  if (contact.point != ContactPoint::central_path && contact.point != ContactPoint::chebyshev)
    warnings.push_back(fmt::format("{} contact.point = \"central_path\"", keeps));
  const std::vector<bool> used = properties_of_faces(model);
  bool constant = true;
  for (std::size_t p = 0; p < used.size(); ++p)
    constant &= !used[p] || model.properties[p].constant_stiffness;
  if (!constant) warnings.push_back(fmt::format("{} joint_properties.constant_stiffness = true", keeps));
}

template void judge_first_contacts<2>(const ContactSettings&, const Model<2>&, const State<2>&,
                                      std::vector<std::string>&);
template void judge_first_contacts<3>(const ContactSettings&, const Model<3>&, const State<3>&,
                                      std::vector<std::string>&);
template void judge_multipliers<2>(const ContactSettings&, const Model<2>&, std::vector<std::string>&);
template void judge_multipliers<3>(const ContactSettings&, const Model<3>&, std::vector<std::string>&);

}  // namespace voussoir
