#include "core/scene/judge_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>

#include "core/model/water_surfaces.hpp"
#include "core/potential/particle.hpp"
#include "core/potential/valid_shape.hpp"
#include "core/scene/bodies.hpp"
#include "core/scene/judge_bonds.hpp"
#include "core/scene/judge_records.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/keys/ranges.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// Checks of single keys are in the key table; these compare several.

// m: width of a free block. Smaller ones are grains, larger ones mountains
constexpr double least_block = 0.01, most_block = 500;

// largest extent of a block over the smallest width of one: blocks of a wall and of the hill below it
constexpr double widest_ratio = 300;

// shear over normal stiffness: tests on rock joints give 0.01 to 1
constexpr double least_shear_fraction = 0.005;

// a coordinate of less than this fraction of the scene is close to zero; if given in km, every coordinate is
constexpr double small_fraction = 1e-3;

// the gaps of a regular series differ by less, relative to the larger
constexpr double series_tolerance = 5e-4;

// degrees: an angle given in radians, converted to degrees, is a whole number within this rounding
constexpr double whole_degree = 0.002;

// blocks that are smaller than this fraction of their distance from the scene's centre have lost half of their digits
constexpr double lost_fraction = 1e-9;

using Warnings = std::vector<std::string>;

std::string text(double number) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.3g", number);
  return buffer;
}

double length(const Node& node) {
  if (node.is_number()) return std::abs(node.number);
  double square = 0;
  for (const Node& item : node.items)
    square += item.number * item.number;
  return std::sqrt(square);
}

bool is_numeric(const KeyRow& row) {
  return row.type == KeyType::number || row.type == KeyType::integer || row.type == KeyType::vector ||
         row.type == KeyType::spin;
}

// a position in the scene, not a size
bool is_coordinate(const KeyRow& row) {
  return row.unit == "m" && (row.type == KeyType::vector || row.key == "offset" || row.key == "level");
}

const Node* entry(const Node& node, std::size_t place) {
  if (node.is_number()) return place == 0 ? &node : nullptr;
  return place < node.items.size() ? &node.items[place] : nullptr;
}

// any direction from 0 to 360 degrees is valid; radians are recognised by their digits
bool is_radians_of_whole_degrees(double x) {
  const double degrees = to_degrees(x);
  return degrees > 1 && degrees <= 360 && std::abs(degrees - std::round(degrees)) < whole_degree;
}

struct TableJudge {
  double extent;  // of the scene, m
  Warnings& warnings;
  const Node* list = nullptr;            // the list that this table belongs to, if any
  std::vector<std::string_view> keys{};  // from that table to the value

  void value(const KeyRow& row, const Node& node, const std::string& path) {
    const double size = length(node);
    if (!row.plausible.holds(size))
      warnings.push_back(complaint(node, path,
                                   "is unusual, " + plausible_text(row) + " is usual; " +
                                       (row.mistake.empty() ? "is the value right?" : std::string(row.mistake))));
    else if (row.mistake == keys::angle_mistake && is_radians_of_whole_degrees(size))
      warnings.push_back(
          complaint(node, path, "is " + text(to_degrees(size)) + " deg in radians; " + std::string(row.mistake)));
    if (is_coordinate(row) && has_small_entry(node))
      warnings.push_back(complaint(node, path,
                                   "contains a coordinate that is close to zero in a scene of " + text(extent) +
                                       " m; coordinates are in m, was it given in km?"));
  }

  bool is_small(double x) const { return x != 0 && std::abs(x) <= small_fraction * extent; }

  bool has_small_entry(const Node& node) const {
    for (std::size_t k = 0; const Node* number = entry(node, k); ++k)
      if (is_small(number->number) && !in_series(number->number, k)) return true;
    return false;
  }

  // one of at least three equally spaced coordinates in the tables of a list: the first of joints at 0.05, 0.10, 0.15
  // m, …
  bool in_series(double x, std::size_t place) const {
    std::vector<double> all;
    for (std::size_t i = 0; list && i < list->items.size(); ++i) {
      const Node* node = &list->items[i];
      for (std::size_t k = 0; node && k < keys.size(); ++k)
        node = node->find(keys[k]);
      if (const Node* number = node ? entry(*node, place) : nullptr; number && number->is_number())
        all.push_back(number->number);
    }
    // a series of only small ones may be in km throughout
    if (std::all_of(all.begin(), all.end(), [&](double other) { return other == 0 || is_small(other); })) return false;
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (std::size_t i = 2; i < all.size(); ++i) {
      const double gap = all[i - 1] - all[i - 2], next = all[i] - all[i - 1];
      const bool regular = std::abs(gap - next) <= series_tolerance * std::max(gap, next);
      if (regular && (x == all[i - 2] || x == all[i - 1] || x == all[i])) return true;
    }
    return false;
  }

  void table(const Node& node, const Groups& groups, const std::string& path) {
    for (const Member& member : node.members) {
      const KeyRow& row = *find_row(groups, member.key);
      const std::string here = key_path(path, member.key);
      keys.push_back(member.key);
      if (is_numeric(row)) value(row, member.value, here);
      if (row.type == KeyType::table || (row.type == KeyType::surface && member.value.kind == Node::Kind::table))
        table(member.value, row.holds, here);
      if (row.type == KeyType::tables)
        for (std::size_t i = 0; i < member.value.items.size(); ++i)
          TableJudge{extent, warnings, &member.value}.table(member.value.items[i], row.holds,
                                                            item_path(here, member.value.items[i], i));
      keys.pop_back();
    }
  }
};

void judge_gravity(const Scene& scene, Warnings& warnings) {
  if (!scene.gravity) return;
  const Subject top{scene.tree.get(), ""};
  const double down = -scene.gravity->back();
  if (down < 0) {
    warnings.push_back(complaint(top, "gravity", "points upwards; the last entry is normally negative"));
    return;
  }
  double aside = 0;
  for (std::size_t k = 0; k + 1 < scene.gravity->size(); ++k)
    aside = std::hypot(aside, (*scene.gravity)[k]);
  if (aside > down)
    warnings.push_back(complaint(top, "gravity", "points more sideways than down; the last entry is the vertical one"));
}

void judge_properties(const PropertiesSpec& spec, Warnings& warnings) {
  const JointProperties& p = spec.properties;
  const std::string other = " normal_stiffness (" + value_text(*spec.subject.node->find("normal_stiffness")) + ")";
  if (p.shear_stiffness > p.normal_stiffness)
    warnings.push_back(complaint(
        spec.subject, "shear_stiffness",
        "exceeds" + other + "; joints are softer in shear: were the two swapped, or is the " + "unit of one wrong?"));
  if (p.shear_stiffness < least_shear_fraction * p.normal_stiffness)
    warnings.push_back(
        complaint(spec.subject, "shear_stiffness",
                  "is very small compared with" + other + ", 0.01 to 1 times it is usual; is the unit of one wrong?"));
}

// if it is not stated which of several applies; the outer faces of one domain do not meet, those of blocks given
// directly do
void judge_default(const Scene& scene, Warnings& warnings) {
  const auto is_default = [](const PropertiesSpec& p) { return p.properties.name == "default"; };
  const std::vector<PropertiesSpec>& all = scene.properties;
  if (all.size() < 2 || scene.blocks.empty() || std::any_of(all.begin(), all.end(), is_default)) return;
  warnings.push_back(
      complaint(all.front().subject, "name",
                "applies to contacts of faces that no joint made (sides of the domain, walls, blocks given directly), "
                "because it is the first; name the joint_properties meant for them default"));
}

// a block and the keys of its shape
template <int Dim>
std::string described(const Model<Dim>& model, const Body<Dim>& body) {
  if (!body.name.empty())
    return "block " + body.name + " (blocks." + body.name + ": vertices; box min, max; planes normal, offset or point)";
  std::string place;
  for (int k = 0; k < Dim; ++k)
    place += (k ? ", " : "") + text(model.origin[k] + body.reference[k]);
  return "the block at (" + place + ") (domain.box min, max; domain.planes, joints: dip, dip_direction, point)";
}

template <int Dim>
void judge_sizes(const Scene& scene, const Model<Dim>& model, Warnings& warnings) {
  const auto by_size = [](const Body<Dim>& a, const Body<Dim>& b) { return inscribed_radius(a) < inscribed_radius(b); };
  const auto by_radius = [](const Body<Dim>& a, const Body<Dim>& b) { return a.radius < b.radius; };
  const Body<Dim>& thinnest = *std::min_element(model.bodies.begin(), model.bodies.end(), by_size);
  const Body<Dim>& largest = *std::max_element(model.bodies.begin(), model.bodies.end(), by_radius);
  const std::string file = scene.file + ": ";
  const double thickness = 2 * inscribed_radius(thinnest);
  if (thickness < least_block)
    warnings.push_back(file + described(model, thinnest) + " is " + text(thickness) +
                       " m thick; coordinates are in m, were they given in km, or is it a sliver "
                       "(slicing.smallest_inscribed_radius)?");
  for (const Body<Dim>& body : model.bodies)
    if (!body.fixed && 2 * inscribed_radius(body) > most_block) {
      warnings.push_back(file + described(model, body) + " is " + text(2 * inscribed_radius(body)) +
                         " m thick; coordinates are in m, were they given in mm?");
      break;
    }
  if (largest.radius > widest_ratio * thickness / 2)
    warnings.push_back(file + described(model, largest) + " reaches " + text(largest.radius) + " m, " +
                       text(2 * largest.radius / thickness) + " times the inscribed radius of " +
                       described(model, thinnest) + "; is a coordinate of one in the wrong unit" +
                       (thinnest.name.empty() ? ", or is it a sliver (slicing.smallest_inscribed_radius)?" : "?"));
  for (const Body<Dim>& body : model.bodies)
    if (body.size < lost_fraction * body.reference.norm()) {
      warnings.push_back(file + described(model, body) + " is " + text(body.reference.norm()) +
                         " m from the scene's centre, so that its size of " + text(body.size) +
                         " m loses its digits; is a coordinate in the wrong unit?");
      break;
    }
}

// Diagonal of the box around all blocks, bounded by a multiple of the smallest block, so that one coordinate that is
// too large does not make all others look small.
template <int Dim>
double extent_of(const Model<Dim>& model) {
  Vector<Dim> low = model.bodies.front().reference, high = low;
  double thinnest = inscribed_radius(model.bodies.front());
  for (const Body<Dim>& body : model.bodies)
    thinnest = std::min(thinnest, inscribed_radius(body));
  for (const Body<Dim>& body : model.bodies)
    for (const Polytope<Dim>& part : body.parts)
      for (const Vector<Dim>& v : part.vertices) {
        low = low.cwiseMin(body.reference + v);
        high = high.cwiseMax(body.reference + v);
      }
  return std::min((high - low).norm(), widest_ratio * thinnest);
}

// a plane that bounds the domain contains some of its corners
template <int Dim>
void judge_domain(const Scene& scene, const Model<Dim>& model, Warnings& warnings) {
  if (!scene.domain || scene.domain->planes.empty()) return;
  constexpr double on_plane = 1e-9;  // of the domain's extent: far above the rounding of its corners
  const Polytope<Dim> domain = make_domain<Dim>(scene, model.origin);
  for (const DomainPlaneSpec& spec : scene.domain->planes) {
    const HalfSpace<Dim> plane = to_half_space<Dim>(spec.plane, model.origin);
    const bool bounds = std::any_of(domain.vertices.begin(), domain.vertices.end(), [&](const Vector<Dim>& v) {
      return std::abs(signed_distance(plane, v)) <= on_plane * domain.radius;
    });
    if (!bounds)
      warnings.push_back(
          complaint(spec.subject, "point", "the plane misses the domain and bounds nothing; is it in m?"));
  }
}

template <int Dim>
void judge_joints(const Scene& scene, const Model<Dim>& model, Warnings& warnings) {
  if (!scene.domain) return;
  std::vector<bool> cuts(model.joints.size(), false);
  for (const Body<Dim>& body : model.bodies)
    for (const Polytope<Dim>& part : body.parts)
      for (const int joint : part.joints)
        if (joint != no_joint) cuts[joint] = true;
  for (std::size_t j = 0; j < scene.joints.size(); ++j)
    if (!cuts[j])
      warnings.push_back(
          complaint(*scene.joints[j].subject.node, scene.joints[j].subject.path,
                    "cuts no block: it or its outline misses the domain, or its blocks would be smaller than "
                    "slicing.smallest_inscribed_radius, or the blocks that it cut were excavated"));
}

// parameters of potential particles that are legal but far from usual or tested ones
template <int Dim>
void judge_particles(const Scene& scene, const Model<Dim>& model, Warnings& warnings) {
  constexpr double sharpest = 1e-4;  // r over R: contacts are tested down to it
  constexpr double widest = 10;      // R over the smallest radius that encloses
  for (const BlockSpec& block : scene.blocks) {
    const ParticleSpec& spec = block.particle;
    if (block.shape != BlockShape::potential || *spec.sphericity == 1) continue;
    const Polytope<Dim> part = make_solid<Dim>(scene, block, model.origin);
    const PotentialShape<Dim>& shape = part.particle->shape;
    const double least = enclosing_radius<Dim>(shape.planes, shape.corner_radius, shape.centre);
    if (shape.corner_radius < sharpest * least)
      warnings.push_back(complaint(
          block.subject, "corner_radius",
          "is " + text(shape.corner_radius / least) +
              " of the particle's radius: below 1e-4 the contact solver may fail by rounding; for sharp edges use "
              "a block of half-spaces"));
    if (shape.sphere_radius > widest * least)
      warnings.push_back(complaint(block.subject, "sphere_radius",
                                   "is " + text(shape.sphere_radius / least) +
                                       " times the smallest radius that encloses the particle: its sphere, and "
                                       "therefore k, have almost no effect; leave it out for the smallest radius"));
  }
}

// depths of the corners of all blocks below a surface, m: least and greatest
template <int Dim>
std::pair<double, double> depths_below(const std::vector<double>& numbers, const Model<Dim>& model) {
  std::vector<WaterStretch<Dim>> surface;
  list_stretches<Dim>(numbers, surface);
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const Body<Dim>& body : model.bodies)
    for (const Polytope<Dim>& part : body.parts)
      for (const Vector<Dim>& v : part.vertices) {
        const double depth = greatest_depth<Dim>(body.reference + v, 0, surface);
        least = std::min(least, depth);
        greatest = std::max(greatest, depth);
      }
  return {least, greatest};
}

const char* surface_key(const WaterSurfaceSpec& surface) {
  return surface.level ? "level" : "table";
}

// a surface that is far above all blocks
template <int Dim>
void judge_height(const Subject& subject, const WaterSurfaceSpec& surface, const std::vector<double>& numbers,
                  const Model<Dim>& model, Warnings& warnings) {
  constexpr double far_above = 10;  // times the extent of the blocks
  const double least = depths_below(numbers, model).first;
  if (least > far_above * extent_of(model))
    warnings.push_back(complaint(subject, surface_key(surface),
                                 "is " + text(least) + " m above every block; elevations are in m, is it right?"));
}

// water that wets nothing, is far above all blocks, or lifts blocks
template <int Dim>
void judge_water(const Scene& scene, const Prepared<Dim>& prepared, Warnings& warnings) {
  const Model<Dim>& model = prepared.model;
  for (std::size_t w = 0; w < model.waters.size(); ++w) {
    const Water& water = model.waters[w];
    const WaterSpec& spec = scene.waters[w];
    const bool changes = std::ranges::any_of(prepared.stages, [&](const StagePlan& stage) {
      return std::ranges::any_of(stage.water, [&](const WaterPlan& p) { return p.water == static_cast<int>(w); });
    });
    if (water.uniform) continue;
    judge_height(spec.subject, spec.surface, water.values, model, warnings);
    if (!changes && depths_below(water.values, model).second <= 0)
      warnings.push_back(complaint(spec.subject, surface_key(spec.surface),
                                   "is below every block and wets none; elevations are in m, is it right?"));
  }
  for (std::size_t s = 0; s < scene.stages.size(); ++s)
    for (std::size_t k = 0; k < scene.stages[s].water.size(); ++k) {
      const WaterPlan& plan = prepared.stages[s].water[k];
      const WaterChangeSpec& spec = scene.stages[s].water[k];
      if (!model.waters[plan.water].uniform) judge_height(spec.subject, spec.surface, plan.to, model, warnings);
    }
  constexpr double in_balance = 1e-6;  // relative rounding of a floating block's weight and buoyancy
  const std::vector<Load<Dim>> loads = water_loads_at_reference(model);
  for (std::size_t b = 0; b < loads.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    const double weight = -body.mass * model.gravity[Dim - 1], lift = loads[b].force[Dim - 1];
    if (body.fixed || lift <= std::max((1 + in_balance) * weight, 0.0)) continue;
    const bool weightless = model.gravity.isZero(0);
    warnings.push_back(scene.file + ": " + described(model, body) + " weighs " + text(weight) +
                       " N, and water lifts it by " + text(lift) + " N: it floats or is pushed up; " +
                       (weightless ? "state gravity" : "is the density that of wet rock?"));
    break;
  }
}

// factors that the stage never reaches
void judge_factors(const StageSpec& stage, Warnings& warnings) {
  const auto* plan = std::get_if<RunPlan>(&stage.plan.plan);
  for (const auto& [key, list] : stage.chosen)
    for (const SelectorSpec& spec : list) {
      TimeFactor factor;
      if (key == "move" || key == "force") read_keys(*spec.subject.node, "factor", factor);
      if (plan && !factor.times.empty() && factor.times.back() > plan->duration)
        warnings.push_back(complaint(
            spec.subject, "times_s",
            "continues beyond duration_s (" + text(plan->duration) + "), the end of the stage; is the table in s?"));
    }
}

// Tables of mapped joints contain traces and faces of a few metres: as infinite joints they cut far more blocks than
// there are.
template <int Dim>
void judge_endless(const Scene& scene, const Model<Dim>& model, Warnings& warnings) {
  constexpr std::size_t many = 10;  // blocks for each joint
  if (model.bodies.size() > many * scene.joints.size())
    if (const std::string told = endless_joints(scene, model.bodies.size()); !told.empty())
      warnings.push_back(scene.file + ": " + told);
}

}  // namespace

std::string endless_joints(const Scene& scene, std::size_t blocks) {
  if (scene.slicing.ends == JointEnds::ignored) return {};
  std::size_t count = 0;
  std::string file;
  for (const JointSpec& joint : scene.joints) {
    const auto& source = joint.subject.node->place.source;
    if (!source || source->ends_with(".toml") || *source == scene.file) continue;
    if (joint.outline.shape != OutlineForm::none || joint.within || !joint.ends_at.empty()) return {};
    file = *source;
    ++count;
  }
  if (count == 0) return {};
  return "all " + std::to_string(count) + " joints of '" + one_line(file, 60) +
         "' are infinite, because it has no column shape with length and width (in 2-D length); they cut " +
         std::to_string(blocks) + " blocks";
}

template <int Dim>
std::vector<bool> properties_of_faces(const Model<Dim>& model) {
  std::vector<bool> used(model.properties.size(), false);
  for (const Body<Dim>& body : model.bodies) {
    bool by_joint = false;
    for (const Polytope<Dim>& part : body.parts)
      for (const int joint : part.joints)
        if (joint != no_joint) used[model.joints[joint].properties] = by_joint = true;
    // the outer faces of blocks cut by joints do not meet other faces; a block given directly has only outer faces
    if (!by_joint && !used.empty()) used[model.default_properties] = true;
  }
  return used;
}

template std::vector<bool> properties_of_faces<2>(const Model<2>&);
template std::vector<bool> properties_of_faces<3>(const Model<3>&);

template <int Dim>
std::vector<std::string> judge_values(const Scene& scene, const Prepared<Dim>& prepared) {
  Warnings warnings = scene.remarks;
  TableJudge{extent_of(prepared.model), warnings}.table(*scene.tree, {""}, "");
  judge_gravity(scene, warnings);
  const std::vector<bool> used = properties_of_faces(prepared.model);
  for (std::size_t p = 0; p < scene.properties.size(); ++p)
    if (used[p]) judge_properties(scene.properties[p], warnings);
  judge_default(scene, warnings);
  std::ranges::move(judge_bonds(scene), std::back_inserter(warnings));
  for (const StageSpec& stage : scene.stages)
    judge_factors(stage, warnings);
  for (const StageSpec& stage : scene.stages)
    judge_records(stage, warnings);
  judge_water<Dim>(scene, prepared, warnings);
  judge_domain<Dim>(scene, prepared.model, warnings);
  judge_joints<Dim>(scene, prepared.model, warnings);
  judge_endless<Dim>(scene, prepared.model, warnings);
  judge_sizes<Dim>(scene, prepared.model, warnings);
  judge_particles<Dim>(scene, prepared.model, warnings);
  return warnings;
}

template std::vector<std::string> judge_values<2>(const Scene&, const Prepared<2>&);
template std::vector<std::string> judge_values<3>(const Scene&, const Prepared<3>&);

}  // namespace voussoir
