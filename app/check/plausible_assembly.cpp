#include "app/check/plausible_assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "app/check/plausible_support.hpp"
#include "core/contact/integrable.hpp"
#include "core/model/body_title.hpp"
#include "core/model/water_surfaces.hpp"
#include "core/run/reduction.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// piles and slopes begin with this many blocks; two on one another are a mechanism of their own
constexpr std::size_t few_blocks = 3;

// of the smaller inscribed radius: so deep inside another block is the middle of none that only touches it
constexpr double deep_inside = 0.5;

template <int Dim>
bool is_free(const Body<Dim>& body) {
  return body.present && !body.fixed && !body.prescribed && !body.parts.empty();
}

template <int Dim>
bool may_turn(const Body<Dim>& body) {
  return is_free(body) && std::any_of(body.free_rotation.begin(), body.free_rotation.end(), [](bool f) { return f; });
}

// cannot follow gravity: fixed, driven, or restrained along all axes that it acts on
template <int Dim>
bool is_held(const Model<Dim>& model, const Body<Dim>& body) {
  if (!is_free(body)) return true;
  for (int k = 0; k < Dim; ++k)
    if (body.free_translation[k] && model.gravity[k] != 0) return false;
  return true;
}

// groups of bodies that chains of near pairs join
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int body) {
    while (parent_[body] != body)
      body = parent_[body] = parent_[parent_[body]];
    return body;
  }
  void join(int a, int b) { parent_[find(a)] = find(b); }

 private:
  std::vector<int> parent_;
};

// in water, which may carry it
template <int Dim>
bool is_wet(const State<Dim>& state, int body) {
  const auto acts = [&](Source source) {
    const std::vector<Load<Dim>>& loads = state.loads.by_source[source];
    return !loads.empty() && !loads[static_cast<std::size_t>(body)].force.isZero(0);
  };
  return acts(Source::water) || acts(Source::water_pressure);
}

template <int Dim>
void judge_ties(const Model<Dim>& model, const State<Dim>& state, std::vector<std::string>& warnings) {
  if (model.gravity.norm() == 0) return;
  Groups groups(model.bodies.size());
  for (const Contact<Dim>& contact : state.contacts.list)
    groups.join(model.parts[contact.part_a].body, model.parts[contact.part_b].body);
  const int count = static_cast<int>(model.bodies.size());
  std::set<int> tied;
  for (int b = 0; b < count; ++b)
    if (model.bodies[b].present && is_held(model, model.bodies[b])) tied.insert(groups.find(b));
  std::map<int, std::vector<int>> untied;
  for (int b = 0; b < count; ++b)
    if (is_free(model.bodies[b]) && !tied.contains(groups.find(b))) untied[groups.find(b)].push_back(b);

  std::vector<int> alone;
  std::size_t together = 0;
  const std::vector<int>* first_group = nullptr;
  for (const auto& [root, bodies] : untied) {
    if (bodies.size() == 1) {
      if (!is_wet(state, bodies.front())) alone.push_back(bodies.front());
      continue;
    }
    together += bodies.size();
    if (!first_group || bodies.front() < first_group->front()) first_group = &bodies;
  }
  std::sort(alone.begin(), alone.end());
  if (alone.size() == 1)
    warnings.push_back(fmt::format("block {} has no neighbour: it begins by falling", name_of(model, alone.front())));
  if (alone.size() > 1)
    warnings.push_back(fmt::format("{} blocks have no neighbour, {} the first: they begin by falling", alone.size(),
                                   name_of(model, alone.front())));
  if (together > 0)
    warnings.push_back(fmt::format(
        "{} blocks, {} the first, are near one another, but no chain of near blocks ties them to a fixed one: they "
        "begin by falling; fix what should hold them",
        together, name_of(model, first_group->front())));
}

// whether the middle of a part lies well inside another, as both stand before the first step
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
    warnings.push_back(fmt::format("blocks {} and {} lie in one another: was one of them stated twice? remove it",
                                   name_of(model, model.parts[a].body), name_of(model, model.parts[b].body)));
    return;  // one tells
  }
}

// the properties with which a pair meets, or will meet once loaded: blocks that one joint cut apart do not overlap yet
template <int Dim>
std::optional<int> properties_between(const Model<Dim>& model, const Contact<Dim>& contact) {
  if (contact.touching()) return contact.properties;
  const std::vector<int>&a = model.polytope(contact.part_a).joints, &b = model.polytope(contact.part_b).joints;
  for (const int joint : a)
    if (joint != no_joint && std::find(b.begin(), b.end(), joint) != b.end()) return model.joints[joint].properties;
  return std::nullopt;
}

// blocks that may turn and rest on others that may, where one point carries each face
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
      fmt::format("{} free blocks rest on one another on one point a face, which resists no spin, nor rocking as a "
                  "face does: slopes "
                  "and piles give way too early; set {}{} = 2 or more, or restrain what does not turn",
                  blocks.size(), integrable ? "contact.face = \"integrated\", or " : "", keys));
}

// a stage that leaves nothing to move
template <int Dim>
void judge_last_block(const Prepared<Dim>& prepared, std::vector<std::string>& warnings) {
  const auto moves = [](const Body<Dim>& body) { return body.present && (!body.fixed || body.prescribed); };
  Model<Dim> model = prepared.model;
  bool before = std::any_of(model.bodies.begin(), model.bodies.end(), moves);
  for (const StagePlan& stage : prepared.stages) {
    const Change& change = stage.change;
    if (change.fix.empty() && change.release.empty() && change.remove.empty() && change.excavate.empty() &&
        change.move.empty())
      continue;
    model = apply(std::move(model), change);
    const bool after = std::any_of(model.bodies.begin(), model.bodies.end(), moves);
    if (before && !after)
      warnings.push_back(
          fmt::format("stage.{} {} the last free block: nothing is left to move; keep one, or end before", stage.name,
                      change.remove.empty() && change.excavate.empty() ? "fixes" : "removes"));
    before = after;
  }
}

// The largest change of a free block's water force as it moves by a way along a horizontal axis, of its weight.
struct WaterLeft {
  double most = 0;
  int body = 0;
};

template <int Dim>
WaterLeft find_water_left(const Model<Dim>& model, const WaterValues& values, double way) {
  WaterLeft left;
  WaterSurfaces<Dim> surfaces;
  find_surfaces(model, values, 1, surfaces);
  for (int b = 0; b < static_cast<int>(model.bodies.size()); ++b) {
    const Body<Dim>& body = model.bodies[b];
    const double weight = body.mass * model.gravity.norm();
    if (!is_free(body) || !(weight > 0)) continue;
    const Vector<Dim> here = water_load<Dim>(model, surfaces, b, {.centroid = body.reference}).force;
    for (int axis = 0; axis < Dim - 1; ++axis)
      for (const double by : {way, -way}) {
        const Standing<Dim> moved{.centroid = body.reference + by * Vector<Dim>::Unit(axis)};
        const double change = (water_load<Dim>(model, surfaces, b, moved).force - here).norm() / weight;
        if (change > left.most) left = {change, b};
      }
  }
  return left;
}

// A table stays in place while blocks move: in a search they may leave their water before they count as failed.
template <int Dim>
void judge_searches_in_water(const Prepared<Dim>& prepared, std::vector<std::string>& warnings) {
  constexpr double may_leave = 5e-4;  // of the weight: some 0.03 degrees of friction
  const Model<Dim>& model = prepared.model;
  if (model.waters.empty()) return;
  WaterValues values = initial_water(model);
  for (const StagePlan& stage : prepared.stages) {
    for (const WaterPlan& change : stage.water)
      values[change.water] = change.to;
    const auto* search = std::get_if<ReducePlan>(&stage.plan);
    if (!search) continue;
    const double way = failure_displacement_of(model, *search);
    const WaterLeft left = find_water_left(model, values, way);
    if (left.most <= may_leave) continue;
    warnings.push_back(
        fmt::format("stage.{}: before block {} has moved by {:.3g} m and counts as failed, the force of its water "
                    "changes by {:.2g} % of its weight, for a table stays in place; that may be {:.2g} degrees of "
                    "friction: state failure_displacement = {:.1g} or less",
                    stage.name, name_of(model, left.body), way, 100 * left.most, to_degrees(left.most),
                    way * may_leave / left.most));
  }
}

// A stress that grows from a surface: one below all blocks presses none, one high above them is hardly meant.
template <int Dim>
void judge_in_situ(const Prepared<Dim>& prepared, std::vector<std::string>& warnings) {
  constexpr double deep = 3000;  // m
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Body<Dim>& body : prepared.model.bodies)
    for (const Polytope<Dim>& part : body.parts)
      for (const Vector<Dim>& v : part.vertices) {
        const double height = prepared.model.origin[Dim - 1] + body.reference[Dim - 1] + v[Dim - 1];
        low = std::min(low, height);
        high = std::max(high, height);
      }
  for (const StagePlan& stage : prepared.stages)
    for (const BoundaryPlan& plan : stage.change.boundary) {
      if (!plan.in_situ) continue;
      const double surface = plan.in_situ->surface;
      const std::string begins = fmt::format("stage.{}.boundary: in_situ.surface = {:g} m lies ", stage.name, surface);
      if (surface <= low) warnings.push_back(begins + "below every block: there is no stress; elevations are in m");
      if (surface > high + deep)
        warnings.push_back(
            begins + fmt::format("{:.3g} m above every block; elevations are in m, is it right?", surface - high));
    }
}

// rad: the friction below which a joint slips under horizontal stresses of these ratios to the vertical one
template <int Dim>
double least_friction(const Vector<Dim>& normal, const InSituPlan& in_situ) {
  Vector<Dim> ratios = Vector<Dim>::Constant(in_situ.k0);
  if constexpr (Dim == 3) ratios[1] = in_situ.k0_y.value_or(in_situ.k0);
  ratios[Dim - 1] = 1;
  const Vector<Dim> traction = ratios.cwiseProduct(normal);
  const double across = traction.dot(normal);
  return std::atan2((traction - across * normal).norm(), across);
}

// Joints that slip as the stresses are put on, which then are not those that were asked for (Boon 2013, 5.4.1).
template <int Dim>
void judge_generation(const Prepared<Dim>& prepared, std::vector<std::string>& warnings) {
  Model<Dim> model = prepared.model;
  for (const StagePlan& stage : prepared.stages) {
    model = apply(std::move(model), stage.change);
    double needed = 0, stated = 0;
    std::string name;
    for (const BoundaryPlan& plan : stage.change.boundary)
      for (const Joint<Dim>& joint : model.joints) {
        if (!plan.in_situ || joint.holds) continue;
        const JointProperties& properties = model.properties[joint.properties];
        const double least = least_friction<Dim>(joint.plane.normal, *plan.in_situ);
        if (least <= properties.friction + 1e-9 || least <= needed) continue;
        needed = least;
        stated = properties.friction;
        name = joint.name;
      }
    if (needed > 0)
      warnings.push_back(fmt::format(
          "stage.{}: joint '{}' slips while in-situ stresses are put on, which it holds from a friction of "
          "{:.1f} deg on, and has {:.1f}: state a higher friction_deg in this stage, and the true one in the "
          "next",
          stage.name, name, to_degrees(needed), to_degrees(stated)));
  }
}

}  // namespace

template <int Dim>
std::string name_of(const Model<Dim>& model, int body) {
  const std::string title = title_of(model, body);
  return model.bodies[body].name.empty() ? fmt::format("{} ({})", body, title) : title;
}

// blocks that were stated into each other fly apart
template <int Dim>
void judge_first_contacts(const Prepared<Dim>& prepared, const Model<Dim>& model, const State<Dim>& state,
                          std::vector<std::string>& warnings) {
  for (const Contact<Dim>& contact : state.contacts.list) {
    if (!contact.touching()) continue;
    const int a = model.parts[contact.part_a].body, b = model.parts[contact.part_b].body;
    const double size = std::min(model.bodies[a].size, model.bodies[b].size);
    if (contact.geometry.overlap <= prepared.settings.contact.potential_radius * size) continue;
    warnings.push_back(
        fmt::format("blocks {} and {} overlap by {:.2g} m at the start, {:.2g} of the smaller inscribed radius: check "
                    "their vertices, planes or box",
                    name_of(model, a), name_of(model, b), contact.geometry.overlap, contact.geometry.overlap / size));
    return;  // one tells
  }
}

template <int Dim>
void judge_assembly(const Prepared<Dim>& prepared, const Model<Dim>& model, const State<Dim>& state,
                    std::vector<std::string>& warnings) {
  judge_ties(model, state, warnings);
  judge_first_contacts(prepared, model, state, warnings);
  judge_places(model, state, warnings);
  judge_points(model, prepared.settings.contact, state, warnings);
  judge_last_block(prepared, warnings);
  judge_bolts(model, state, warnings);
  judge_linings(model, state, warnings);
  judge_in_situ(prepared, warnings);
  judge_generation(prepared, warnings);
  judge_searches_in_water(prepared, warnings);
}

template std::string name_of<2>(const Model<2>&, int);
template std::string name_of<3>(const Model<3>&, int);
template void judge_assembly<2>(const Prepared<2>&, const Model<2>&, const State<2>&, std::vector<std::string>&);
template void judge_assembly<3>(const Prepared<3>&, const Model<3>&, const State<3>&, std::vector<std::string>&);

}  // namespace voussoir
