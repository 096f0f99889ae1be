#include "core/scene/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/scene/bodies.hpp"
#include "core/scene/keys.hpp"

namespace voussoir {
namespace {

// What one key alone tells stands in the key table; these compare several.

// m: breadth of a free block. Smaller ones are grains, larger ones mountains
constexpr double least_block = 0.01, most_block = 500;

// largest extent of a block over the smallest breadth of one: blocks of a wall and of the hill it stands on
constexpr double widest_ratio = 300;

// stiffness in shear over that across the joint: tests on rock joints give 0.01 to 1
constexpr double least_shear_share = 0.005;

// a coordinate of less than this share of the scene is next to its zero; given in km, any coordinate is
constexpr double small_share = 1e-3;

// smaller blocks so far from the scene's centre have lost half of their digits
constexpr double lost_share = 1e-9;

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

// a place in the scene, not a size
bool is_coordinate(const KeyRow& row) {
  return row.unit == "m" && (row.type == KeyType::vector || row.key == "offset");
}

struct TableJudge {
  double extent;  // of the scene, m
  Warnings& warnings;

  void value(const KeyRow& row, const Node& node, const std::string& path) {
    const double size = length(node);
    if (!row.usual.holds(size))
      warnings.push_back(complaint(node, path,
                                   "is unusual, " + usual_text(row) + " is usual; " +
                                       (row.slip.empty() ? "is the value right?" : std::string(row.slip))));
    if (is_coordinate(row) && has_small_entry(node))
      warnings.push_back(complaint(node, path,
                                   "holds a coordinate that is next to nothing in a scene of " + text(extent) +
                                       " m; coordinates are in m, was it given in km?"));
  }

  bool has_small_entry(const Node& node) {
    if (node.is_number()) return node.number != 0 && std::abs(node.number) <= small_share * extent;
    return std::any_of(node.items.begin(), node.items.end(), [&](const Node& item) { return has_small_entry(item); });
  }

  void table(const Node& node, const Groups& groups, const std::string& path) {
    for (const Member& member : node.members) {
      const KeyRow& row = *find_row(groups, member.key);
      const std::string here = key_path(path, member.key);
      if (is_numeric(row)) value(row, member.value, here);
      if (row.type == KeyType::table) table(member.value, row.holds, here);
      if (row.type != KeyType::tables) continue;
      for (std::size_t i = 0; i < member.value.items.size(); ++i)
        table(member.value.items[i], row.holds, item_path(here, member.value.items[i], i));
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
    warnings.push_back(complaint(top, "gravity", "points more aside than down; the last entry is the vertical one"));
}

void judge_properties(const PropertiesSpec& spec, Warnings& warnings) {
  const JointProperties& p = spec.properties;
  const std::string other = " normal_stiffness (" + value_text(*spec.subject.node->find("normal_stiffness")) + ")";
  if (p.shear_stiffness > p.normal_stiffness)
    warnings.push_back(complaint(
        spec.subject, "shear_stiffness",
        "exceeds" + other + "; joints are softer in shear: were the two swapped, or is the " + "unit of one wrong?"));
  if (p.shear_stiffness < least_shear_share * p.normal_stiffness)
    warnings.push_back(
        complaint(spec.subject, "shear_stiffness",
                  "is tiny beside" + other + ", 0.01 to 1 times it is usual; is the unit of one wrong?"));
}

// where nobody said which of several serves
void judge_default(const Scene& scene, Warnings& warnings) {
  const auto is_default = [](const PropertiesSpec& p) { return p.properties.name == "default"; };
  const std::vector<PropertiesSpec>& all = scene.properties;
  if (all.size() < 2 || std::any_of(all.begin(), all.end(), is_default)) return;
  warnings.push_back(complaint(all.front().subject, "name",
                               "serves where faces meet that no joint made (sides of the domain, walls, blocks given "
                               "directly), because it is the first; name the joint_properties meant for them default"));
}

// a block and the keys that shape it
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
  const auto by_size = [](const Body<Dim>& a, const Body<Dim>& b) { return a.size < b.size; };
  const auto by_radius = [](const Body<Dim>& a, const Body<Dim>& b) { return a.radius < b.radius; };
  const Body<Dim>& thinnest = *std::min_element(model.bodies.begin(), model.bodies.end(), by_size);
  const Body<Dim>& largest = *std::max_element(model.bodies.begin(), model.bodies.end(), by_radius);
  const std::string file = scene.file + ": ";
  if (2 * thinnest.size < least_block)
    warnings.push_back(file + described(model, thinnest) + " is " + text(2 * thinnest.size) +
                       " m thick; coordinates are in m, were they given in km, or is it a sliver "
                       "(slicing.smallest_inscribed_radius)?");
  for (const Body<Dim>& body : model.bodies)
    if (!body.fixed && 2 * body.size > most_block) {
      warnings.push_back(file + described(model, body) + " is " + text(2 * body.size) +
                         " m thick; coordinates are in m, were they given in mm?");
      break;
    }
  if (largest.radius > widest_ratio * thinnest.size)
    warnings.push_back(file + described(model, largest) + " reaches " + text(largest.radius) + " m, " +
                       text(largest.radius / thinnest.size) + " times the inscribed radius of " +
                       described(model, thinnest) + "; is a coordinate of one in the wrong unit?");
  for (const Body<Dim>& body : model.bodies)
    if (body.size < lost_share * body.reference.norm()) {
      warnings.push_back(file + described(model, body) + " lies " + text(body.reference.norm()) +
                         " m from the scene's centre, where its size of " + text(body.size) +
                         " m loses its digits; is a coordinate in the wrong unit?");
      break;
    }
}

// Diagonal of the box that holds every block; at most what the smallest block makes plausible, so that one coordinate
// too large does not make all the others look small.
template <int Dim>
double extent_of(const Model<Dim>& model) {
  Vector<Dim> low = model.bodies.front().reference, high = low;
  double thinnest = model.bodies.front().size;
  for (const Body<Dim>& body : model.bodies)
    thinnest = std::min(thinnest, body.size);
  for (const Body<Dim>& body : model.bodies)
    for (const Polytope<Dim>& part : body.parts)
      for (const Vector<Dim>& v : part.vertices) {
        low = low.cwiseMin(body.reference + v);
        high = high.cwiseMax(body.reference + v);
      }
  return std::min((high - low).norm(), widest_ratio * thinnest);
}

// a plane that bounds the domain holds some of its corners
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
      warnings.push_back(complaint(*scene.joints[j].subject.node, scene.joints[j].subject.path,
                                   "cuts no block: it or its outline misses the domain, or its blocks would be smaller "
                                   "than slicing.smallest_inscribed_radius or what it cut was excavated"));
}

// factors that the stage never reaches
void judge_moves(const StageSpec& stage, Warnings& warnings) {
  const auto* plan = std::get_if<RunPlan>(&stage.plan.plan);
  for (std::size_t i = 0; plan && i < stage.moves.size(); ++i) {
    const std::vector<double>& times = stage.plan.change.move[i].factor.times;
    if (!times.empty() && times.back() > plan->duration)
      warnings.push_back(complaint(
          stage.moves[i].subject, "times_s",
          "goes on beyond duration_s (" + text(plan->duration) + "), when the stage ends; is the table in s?"));
  }
}

}  // namespace

template <int Dim>
std::vector<std::string> implausible_values(const Scene& scene, const Prepared<Dim>& prepared) {
  Warnings warnings;
  TableJudge{extent_of(prepared.model), warnings}.table(*scene.tree, {""}, "");
  judge_gravity(scene, warnings);
  for (const PropertiesSpec& p : scene.properties)
    judge_properties(p, warnings);
  judge_default(scene, warnings);
  for (const StageSpec& stage : scene.stages)
    judge_moves(stage, warnings);
  judge_domain<Dim>(scene, prepared.model, warnings);
  judge_joints<Dim>(scene, prepared.model, warnings);
  judge_sizes<Dim>(scene, prepared.model, warnings);
  return warnings;
}

template std::vector<std::string> implausible_values<2>(const Scene&, const Prepared<2>&);
template std::vector<std::string> implausible_values<3>(const Scene&, const Prepared<3>&);

}  // namespace voussoir
