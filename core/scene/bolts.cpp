#include "core/scene/bolts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/scene/bodies.hpp"
#include "core/scene/keys.hpp"
#include "text/angle.hpp"
#include "text/plain_text.hpp"

namespace voussoir {
namespace {

// a larger number is a mistake in a spacing
constexpr double most_bolts = 100'000;

double rays_of(const FanSpec& fan) {
  constexpr double rounding = 1e-9;  // of a spacing: the last ray is at to_deg
  return std::floor((fan.to - fan.from) / fan.spacing + rounding) + 1;
}

FanSpec read_fan(const Subject& subject, int dimension) {
  FanSpec fan;
  read_keys(*subject.node, "fan", fan);
  if (fan.to < fan.from)
    refuse(subject, "to_deg",
           "must not be less than from_deg (" + value_text(*subject.node->find("from_deg")) + "); swap the two");
  constexpr double whole_turn = 2 * std::numbers::pi, rounding = 1e-12;
  if (fan.to - fan.from > whole_turn + rounding)
    refuse(subject, "to_deg",
           fmt::format(
               "is more than 360 degrees beyond from_deg ({:g}): bolts would coincide; state at most from_deg + 360",
               to_degrees(fan.from)));
  if (dimension == 2 && !fan.axis.empty())
    refuse(subject, "axis", "the rays are in the plane because dimension = 2; remove it");
  const auto is_zero = [](double x) { return x == 0; };
  if (dimension == 3 && std::ranges::all_of(fan.axis, is_zero))
    refuse(subject, "axis", "the direction perpendicular to the rays is missing; write for example axis = [0, 1, 0]");
  return fan;
}

// m
double length_of(const BoltSpec& spec) {
  if (spec.fan) return spec.fan->length;
  double sum = 0;
  for (std::size_t i = 0; i < spec.from.size(); ++i)
    sum += (spec.to[i] - spec.from[i]) * (spec.to[i] - spec.from[i]);
  return std::sqrt(sum);
}

void check_law(const Subject& item, const BoltProperties& p) {
  if (p.yield && p.pretension > *p.yield)
    refuse(item, "pretension",
           "is more than yield (" + value_text(*item.node->find("yield")) + "); lower it, or raise yield");
  if (p.rupture_extension && !p.yield)
    refuse(item, "rupture_extension", "yield is missing: without it nothing extends plastically; add yield");
  if (p.dowel_strength && p.dowel_stiffness == 0)
    refuse(item, "dowel_strength", "dowel_stiffness is missing: without it no force acts across the bolt; add it");
}

// a larger number of nodes is a mistake in their spacing
constexpr double most_nodes = 10'000;

void check_grouted(const Subject& item, const BoltProperties& p, double length) {
  const std::string long_text = fmt::format("the bolt is {:g} m long", length);
  if (p.free_length >= length)
    refuse(item, "free_length",
           "leaves no grouted length, " + long_text + "; lower it, or write kind = \"end_anchored\"");
  if (p.node_spacing && *p.node_spacing > length)
    refuse(item, "node_spacing", "leaves no node, " + long_text + "; lower it, or leave it out");
  if (length > most_nodes * node_spacing(p, length))
    refuse(item, "node_spacing",
           fmt::format("makes {:.0f} nodes, more than {:.0f}, {}; raise it, or leave it out",
                       length / node_spacing(p, length), most_nodes, long_text));
  if (p.pretension > 0 && p.plate == Plate::none)
    refuse(item, "pretension", "requires a plate; write plate = \"tied\" or \"spring\", or remove it");
  if (p.bond_strength && p.pretension >= *p.bond_strength * (length - p.free_length))
    refuse(item, "pretension",
           fmt::format(
               "is not less than the strength of the grout, bond_strength times {:g} m; lower it, or lengthen the bolt",
               length - p.free_length));
}

BoltSpec read_bolt(const Subject& item, int dimension) {
  BoltSpec spec;
  spec.subject = item;
  read_keys(*item.node, "bolts", spec);
  read_keys(*item.node, "bolts", spec.properties);
  if (const auto fan = child(item, "fan")) spec.fan = read_fan(*fan, dimension);
  for (const Subject& repeat : children(item, "repeat")) {
    RepeatSpec& row = spec.repeat.emplace_back();
    read_keys(*repeat.node, "repeat", row);
    if (std::ranges::all_of(row.step, [](double x) { return x == 0; }))
      refuse(repeat, "step", "is zero: all bolts would coincide; write for example the distance between two bolts");
  }
  const bool line = !spec.from.empty() || !spec.to.empty();
  if (line && spec.fan) refuse(item, "fan", "bolts take either a fan or from and to; remove one");
  if (!line && !spec.fan)
    refuse(item, "from", "the position of the bolts is not stated; write from and to, or fan = { centre = […], … }");
  if (line && (spec.from.empty() || spec.to.empty()))
    refuse(item, spec.from.empty() ? "from" : "to", "a bolt needs both its collar, from, and its end, to; add it");
  if (line && spec.from == spec.to) refuse(item, "to", "is the same point as from: the bolt has no length; move it");
  if (dimension == 3 && spec.spacing)
    refuse(item, "spacing", "applies only if dimension = 2; in 3-D write repeat = [{ step = […], count = … }]");
  spec.properties.tension_only |= spec.properties.kind == BoltKind::end_anchored;
  double count = spec.fan ? rays_of(*spec.fan) : 1;
  for (const RepeatSpec& row : spec.repeat)
    count *= row.count;
  if (count > most_bolts)
    refuse(item, spec.fan ? "fan" : "repeat",
           fmt::format("makes {:.0f} bolts, more than {:.0f}; check spacing_deg and count", count, most_bolts));
  check_law(item, spec.properties);
  if (spec.properties.kind == BoltKind::grouted) check_grouted(item, spec.properties, length_of(spec));
  return spec;
}

// axes in the plane of a fan: to the right, and up
template <int Dim>
std::array<Vector<Dim>, 2> axes_of(const FanSpec& fan) {
  if constexpr (Dim == 2) {
    return {Vector<2>(1, 0), Vector<2>(0, 1)};
  } else {
    const Vector<3> axis = to_vector<3>(fan.axis).normalized();
    const Vector<3> level = Vector<3>(0, 0, 1).cross(axis);
    if (level.norm() < 1e-9) return {Vector<3>(1, 0, 0), Vector<3>(0, 1, 0)};
    const Vector<3> right = -level.normalized();
    return {right, right.cross(axis)};
  }
}

// collars and ends, world coordinates
template <int Dim>
std::vector<std::pair<Vector<Dim>, Vector<Dim>>> lines_of(const BoltSpec& spec) {
  std::vector<std::pair<Vector<Dim>, Vector<Dim>>> lines;
  if (spec.fan) {
    const FanSpec& fan = *spec.fan;
    const auto [right, up] = axes_of<Dim>(fan);
    const Vector<Dim> centre = to_vector<Dim>(fan.centre);
    for (int k = 0; k < static_cast<int>(rays_of(fan)); ++k) {
      const double angle = fan.from + k * fan.spacing;
      const Vector<Dim> ray = std::cos(angle) * right + std::sin(angle) * up;
      lines.emplace_back(centre + fan.start * ray, centre + (fan.start + fan.length) * ray);
    }
  } else {
    lines.emplace_back(to_vector<Dim>(spec.from), to_vector<Dim>(spec.to));
  }
  for (const RepeatSpec& row : spec.repeat) {
    const std::size_t count = lines.size();
    for (int k = 1; k < row.count; ++k)
      for (std::size_t i = 0; i < count; ++i) {
        const Vector<Dim> way = k * to_vector<Dim>(row.step);
        lines.emplace_back(lines[i].first + way, lines[i].second + way);
      }
  }
  return lines;
}

// number in a slice of 1 m
BoltProperties per_metre(BoltProperties p, double spacing) {
  p.spacing = spacing;
  for (double* value :
       {&p.stiffness, &p.axial_stiffness, &p.pretension, &p.dowel_stiffness, &p.bond_stiffness, &p.plate_stiffness})
    *value /= spacing;
  for (std::optional<double>* value : {&p.yield, &p.dowel_strength, &p.bond_strength})
    if (*value) **value /= spacing;
  return p;
}

}  // namespace

void read_bolts(const Subject& top, Scene& scene) {
  for (const Subject& item : children(top, "bolts"))
    scene.bolts.push_back(read_bolt(item, scene.dimension));
}

template <int Dim>
std::array<Vector<Dim>, 2> ray_axes(const std::vector<double>& axis) {
  FanSpec fan;
  fan.axis = axis;
  return axes_of<Dim>(fan);
}

template <int Dim>
void add_bolts(const Scene& scene, Model<Dim>& model) {
  std::vector<const BoltSpec*> specs;
  for (const BoltSpec& spec : scene.bolts)
    specs.push_back(&spec);
  std::ranges::sort(specs, {}, [](const BoltSpec* spec) { return spec->properties.name; });
  for (const BoltSpec* spec : specs) {
    int number = 0;
    for (const auto& [collar, toe] : lines_of<Dim>(*spec))
      model.bolts.push_back({.properties = static_cast<int>(model.bolt_properties.size()),
                             .number = ++number,
                             .collar = collar - model.origin,
                             .toe = toe - model.origin});
    model.bolt_properties.push_back(per_metre(spec->properties, spec->spacing.value_or(1)));
  }
}

template std::array<Vector<2>, 2> ray_axes<2>(const std::vector<double>&);
template std::array<Vector<3>, 2> ray_axes<3>(const std::vector<double>&);
template void add_bolts<2>(const Scene&, Model<2>&);
template void add_bolts<3>(const Scene&, Model<3>&);

}  // namespace voussoir
