#include "core/scene/read_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/half_space.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/read_plane.hpp"

namespace voussoir {
namespace {

bool is_table(const WaterSurfaceSpec& surface) {
  return !surface.table.empty() || surface.plane;
}

// exactly one of level, table and pressure
void check_one_surface(const Subject& table) {
  const char* first = nullptr;
  for (const char* key : {"level", "table", "pressure"}) {
    if (!table.node->find(key)) continue;
    if (first)
      refuse(table, key,
             fmt::format("is stated together with {}; a water takes only one of level, table and pressure, remove one",
                         first));
    first = key;
  }
  if (!first)
    refuse(table, "level",
           "elevation of the water; write for example level = 90, or a table of points, or pressure = 1000 (Pa)");
}

void check_points(const Subject& table, const std::vector<std::vector<double>>& points) {
  if (points.size() < 2)
    refuse(table, "table",
           "needs at least two points (x, h); for a horizontal water level write level = its elevation");
  for (std::size_t k = 1; k < points.size(); ++k)
    if (!(points[k][0] > points[k - 1][0]))
      refuse(table, "table",
             fmt::format("must have points of ascending x, but point {} at x = {:g} is not beyond x = {:g}; put them "
                         "in order, each x once",
                         k + 1, points[k][0], points[k - 1][0]));
}

WaterSurfaceSpec read_surface(const Subject& table, int dimension) {
  check_one_surface(table);
  WaterSurfaceSpec surface;
  read_keys(*table.node, "water_surface", surface);
  const Node* stated = table.node->find("table");
  if (stated && dimension == 3) {
    surface.plane = read_plane(*child(table, "table"), "water_table", dimension);
  } else if (stated) {
    for (const Node& point : stated->items)
      surface.table.push_back({point.items[0].number, point.items[1].number});
    check_points(table, surface.table);
  }
  return surface;
}

// the numbers of a plane: h at the file's origin, its gradient
std::vector<double> numbers_of(const PlaneSpec& plane) {
  const Vector<3> normal = upward_normal_3d(plane.dip, plane.dip_direction);
  const double along_x = -normal[0] / normal[2], along_y = -normal[1] / normal[2];
  return {plane.point[2] - along_x * plane.point[0] - along_y * plane.point[1], along_x, along_y};
}

// The numbers that a surface states; a level takes the points of the previous numbers, or of a later table.
std::vector<double> numbers_of(const WaterSurfaceSpec& surface, std::vector<double> like, int dimension) {
  if (surface.pressure) return {*surface.pressure};
  if (surface.plane) return numbers_of(*surface.plane);
  if (surface.level && dimension == 3) return {*surface.level, 0, 0};
  if (surface.level) {
    if (like.empty()) return {0, *surface.level};
    for (std::size_t k = 1; k < like.size(); k += 2)
      like[k] = *surface.level;
    return like;
  }
  std::vector<double> numbers;
  for (const std::vector<double>& point : surface.table)
    numbers.insert(numbers.end(), point.begin(), point.end());
  return numbers;
}

// largest change of the heights or of the pressure
double largest_change(const std::vector<double>& from, const std::vector<double>& to, bool uniform, int dimension) {
  double largest = 0;
  for (std::size_t k = 0; k < from.size(); ++k)
    if (uniform || dimension == 3 || k % 2 == 1) largest = std::max(largest, std::abs(to[k] - from[k]));
  return largest;
}

// s: duration of the change
double time_of(const WaterChangeSpec& change, const WaterSpec& water, const WaterPlan& plan, int dimension) {
  if (change.duration && change.rate)
    refuse(change.subject, "rate",
           "is stated together with duration_s; a change takes only one of the two, remove one");
  if (change.duration) return *change.duration;
  if (!change.rate)
    refuse(change.subject, "duration_s",
           "a change of water needs a duration: write duration_s, or rate; in a settle stage by relaxation it is the "
           "duration of a ramp, "
           "like gravity_ramp_s");
  const bool tilts =
      dimension == 3 && plan.from.size() == 3 && (plan.from[1] != plan.to[1] || plan.from[2] != plan.to[2]);
  if (tilts)
    refuse(change.subject, "rate",
           "has no meaning if the water table changes its dip, since the rise then differs from place to place; write "
           "duration_s");
  return largest_change(plan.from, plan.to, water.surface.pressure.has_value(), dimension) / *change.rate;
}

void check_stage(const WaterChangeSpec& change, const StagePlan& stage, double time) {
  const char* key = change.duration ? "duration_s" : "rate";
  if (const auto* run = std::get_if<RunPlan>(&stage.plan); run && time > run->duration)
    refuse(change.subject, key,
           fmt::format("makes the change last {:g} s, but the stage ends after {:g} s (duration_s); shorten the change "
                       "or lengthen the stage",
                       time, run->duration));
  if (const auto* settle = std::get_if<SettlePlan>(&stage.plan); settle && time >= settle->time_limit)
    refuse(change.subject, key,
           fmt::format("makes the change last {:g} s, which must be less than time_limit_s ({:g}): equilibrium needs "
                       "constant water; "
                       "shorten the change or raise the limit",
                       time, settle->time_limit));
}

WaterPlan plan_of(const WaterChangeSpec& change, const WaterSpec& water, int number, const std::vector<double>& now,
                  int dimension) {
  if (change.surface.pressure.has_value() != water.surface.pressure.has_value())
    refuse(change.subject,
           change.surface.pressure ? "pressure"
           : change.surface.level  ? "level"
                                   : "table",
           water.surface.pressure
               ? "the water is a constant pressure; state the pressure that it changes to"
               : "the water has a level or a table; state the level or the table that it changes to");
  WaterPlan plan{.water = number, .from = now, .to = numbers_of(change.surface, now, dimension)};
  if (plan.to.size() != now.size())
    refuse(
        change.subject, "table",
        fmt::format(
            "has {} points, but the water has {}; state the same number, since each point changes to its new position",
            plan.to.size() / 2, now.size() / 2));
  return plan;
}

int find_water(const std::vector<WaterSpec>& waters, const WaterChangeSpec& change) {
  std::vector<std::string> names;
  for (std::size_t w = 0; w < waters.size(); ++w) {
    if (waters[w].name == change.name) return static_cast<int>(w);
    names.push_back(waters[w].name);
  }
  refuse(change.subject, "name", "no water of this name; " + suggestion(change.name, names));
}

// the first table of a water in any stage: earlier levels take its points
std::vector<double> first_table(const WaterSpec& water, const std::vector<StageSpec>& stages, int dimension) {
  for (const StageSpec& stage : stages)
    for (const WaterChangeSpec& change : stage.water)
      if (change.name == water.name && is_table(change.surface)) return numbers_of(change.surface, {}, dimension);
  return {};
}

}  // namespace

std::vector<WaterSpec> read_waters(const Subject& scene, int dimension) {
  std::vector<WaterSpec> waters;
  for (const Subject& item : children(scene, "water")) {
    WaterSpec water;
    water.subject = item;
    read_keys(*item.node, "water", water);
    water.surface = read_surface(item, dimension);
    if (water.surface.pressure && item.node->find("unit_weight"))
      refuse(item, "unit_weight", "is stated together with a pressure, which is constant over the depth; remove one");
    waters.push_back(std::move(water));
  }
  return waters;
}

void read_water_changes(std::vector<WaterSpec>& waters, std::vector<StageSpec>& stages, int dimension) {
  for (StageSpec& stage : stages)
    for (const Subject& item : children(stage.subject, "water")) {
      WaterChangeSpec& change = stage.water.emplace_back();
      change.subject = item;
      read_keys(*item.node, "water_change", change);
      change.surface = read_surface(item, dimension);
    }
  std::vector<std::vector<double>> now;
  for (WaterSpec& water : waters) {
    water.numbers = numbers_of(
        water.surface, water.surface.level ? first_table(water, stages, dimension) : std::vector<double>(), dimension);
    now.push_back(water.numbers);
  }
  for (StageSpec& stage : stages)
    for (const WaterChangeSpec& change : stage.water) {
      const int w = find_water(waters, change);
      WaterPlan plan = plan_of(change, waters[w], w, now[w], dimension);
      plan.ramp = time_of(change, waters[w], plan, dimension);
      check_stage(change, stage.plan, plan.ramp);
      now[w] = plan.to;
      stage.plan.water.push_back(std::move(plan));
    }
}

}  // namespace voussoir
