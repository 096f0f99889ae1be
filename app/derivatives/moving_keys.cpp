#include "app/derivatives/moving_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>

#include "core/geometry/half_space.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr double no_end = std::numeric_limits<double>::infinity();

enum class KeyForm {
  number,
  dip,        // beyond 0 the plane dips to the other side
  direction,  // around the compass
  normal,     // a plane's point, along its upward normal
  size,       // of a vector, which keeps its direction
  entries,    // of a vector, one at a time
  last,       // entry of a vector
  heights     // of the points (x, h) of a table
};

// One row: which keys, and what about them. Shown unit and usual change are those of rock engineering.
struct MovingRow {
  std::string_view pattern;  // "*": every table of a list
  KeyForm form = KeyForm::number;
  std::string_view unit;
  double shown = 1;
  std::string_view shown_unit;
  double usual = 1;
  bool usual_is_share = false;  // of the value
  KeyScale scale = KeyScale::share;
  double low = -no_end, high = no_end;
  MovedAnswer moves = MovedAnswer::of_rigid_blocks;  // run: nothing else
};

constexpr double kilo = 1e3, mega = 1e6, giga = 1e9;
constexpr double unit_weight = 0;  // shown and usual: the density of 1 kN/m³ under the scene's gravity
constexpr double below_90 = 89.9;  // deg: friction is less than 90

// clang-format off
constexpr std::array moving_rows{
    MovingRow{"joint_properties.*.friction_deg", KeyForm::number, "deg", 1, "deg", 1, false, KeyScale::angle, 0, below_90},
    MovingRow{"stage.*.friction_deg", KeyForm::number, "deg", 1, "deg", 1, false, KeyScale::angle, 0, below_90},
    MovingRow{"stage.*.friction.*.friction_deg", KeyForm::number, "deg", 1, "deg", 1, false, KeyScale::angle, 0, below_90},
    MovingRow{"joint_properties.*.cohesion", KeyForm::number, "Pa", 10 * kilo, "10 kPa", 10 * kilo, false, KeyScale::share, 0},
    MovingRow{"joint_properties.*.jrc", KeyForm::number, "1", 1, "1", 1, false, KeyScale::share, 0, 40},
    MovingRow{"joint_properties.*.jcs", KeyForm::number, "Pa", 10 * mega, "10 MPa", 0.1, true, KeyScale::share, 0},
    MovingRow{"joints.*.dip", KeyForm::dip, "deg", 1, "deg", 1, false, KeyScale::angle, 0, 90},
    MovingRow{"joints.*.dip_direction", KeyForm::direction, "deg", 1, "deg", 1, false, KeyScale::angle},
    MovingRow{"joints.*.point", KeyForm::normal, "m", 1, "m", 0.1, false, KeyScale::length},
    MovingRow{"joint_sets.*.dip", KeyForm::dip, "deg", 1, "deg", 1, false, KeyScale::angle, 0, 90},
    MovingRow{"joint_sets.*.dip_direction", KeyForm::direction, "deg", 1, "deg", 1, false, KeyScale::angle},
    MovingRow{"domain.planes.*.dip", KeyForm::dip, "deg", 1, "deg", 1, false, KeyScale::angle, 0, 90},
    MovingRow{"domain.planes.*.dip_direction", KeyForm::direction, "deg", 1, "deg", 1, false, KeyScale::angle},
    MovingRow{"domain.planes.*.point", KeyForm::normal, "m", 1, "m", 0.1, false, KeyScale::length},
    MovingRow{"domain.box.min", KeyForm::entries, "m", 1, "m", 0.1, false, KeyScale::length},
    MovingRow{"domain.box.max", KeyForm::entries, "m", 1, "m", 0.1, false, KeyScale::length},
    MovingRow{"blocks.*.box.min", KeyForm::entries, "m", 1, "m", 0.1, false, KeyScale::length},
    MovingRow{"blocks.*.box.max", KeyForm::entries, "m", 1, "m", 0.1, false, KeyScale::length},
    MovingRow{"water.*.level", KeyForm::number, "m", 1, "m", 1, false, KeyScale::length},
    MovingRow{"water.*.pressure", KeyForm::number, "Pa", 10 * kilo, "10 kPa", 0.1, true, KeyScale::share, 0},
    MovingRow{"water.*.table", KeyForm::heights, "m", 1, "m", 1, false, KeyScale::length},
    MovingRow{"water.*.table.point", KeyForm::last, "m", 1, "m", 1, false, KeyScale::length},
    MovingRow{"water.*.table.dip", KeyForm::dip, "deg", 1, "deg", 1, false, KeyScale::angle, 0, 80},
    MovingRow{"water.*.table.dip_direction", KeyForm::direction, "deg", 1, "deg", 1, false, KeyScale::angle},
    MovingRow{"water.*.unit_weight", KeyForm::number, "N/m3", kilo, "kN/m3", 0.02, true, KeyScale::share, 0},
    MovingRow{"stage.*.water.*.level", KeyForm::number, "m", 1, "m", 1, false, KeyScale::length},
    MovingRow{"stage.*.water.*.pressure", KeyForm::number, "Pa", 10 * kilo, "10 kPa", 0.1, true, KeyScale::share, 0},
    MovingRow{"stage.*.water.*.table", KeyForm::heights, "m", 1, "m", 1, false, KeyScale::length},
    MovingRow{"stage.*.water.*.table.point", KeyForm::last, "m", 1, "m", 1, false, KeyScale::length},
    MovingRow{"density", KeyForm::number, "kg/m3", unit_weight, "kN/m3", unit_weight, false, KeyScale::share, 0},
    MovingRow{"blocks.*.density", KeyForm::number, "kg/m3", unit_weight, "kN/m3", unit_weight, false, KeyScale::share, 0},
    MovingRow{"gravity", KeyForm::size, "m/s2", 1, "m/s2", 0.01, false, KeyScale::share, 0},
    MovingRow{"bolts.*.yield", KeyForm::number, "N", 100 * kilo, "100 kN", 0.1, true, KeyScale::share, 0},
    MovingRow{"bolts.*.pretension", KeyForm::number, "N", 100 * kilo, "100 kN", 0.1, true, KeyScale::share, 0},
    MovingRow{"bolts.*.dowel_strength", KeyForm::number, "N", 100 * kilo, "100 kN", 0.1, true, KeyScale::share, 0},
    MovingRow{"bolts.*.bond_strength", KeyForm::number, "N/m", 100 * kilo, "100 kN/m", 0.1, true, KeyScale::share, 0},
    MovingRow{"stage.*.force.*.force", KeyForm::size, "N", 100 * kilo, "100 kN", 0.1, true, KeyScale::share, 0},
    MovingRow{"joint_properties.*.normal_stiffness", KeyForm::number, "Pa/m", giga, "GPa/m", 0.1, true, KeyScale::share, 0, no_end, MovedAnswer::run},
    MovingRow{"joint_properties.*.shear_stiffness", KeyForm::number, "Pa/m", giga, "GPa/m", 0.1, true, KeyScale::share, 0, no_end, MovedAnswer::run},
};
// clang-format on

constexpr const char* axis_names[] = {"x", "y", "z"};
constexpr double water_unit_weight = 9810;  // N/m³, the key's default

std::vector<double> entries_of(const Node* list) {
  std::vector<double> entries;
  if (!list || list->kind != Node::Kind::list) return entries;
  for (const Node& item : list->items)
    if (item.is_number()) entries.push_back(item.number);
  return entries.size() == list->items.size() ? entries : std::vector<double>();
}

std::string vector_override(const std::string& key, const std::vector<double>& entries) {
  return fmt::format("{}=[{}]", key, fmt::join(entries, ", "));
}

double length_of(const std::vector<double>& entries) {
  double square = 0;
  for (const double x : entries)
    square += x * x;
  return std::sqrt(square);
}

const Node* number_in(const Node& table, std::string_view key) {
  const Node* node = table.find(key);
  return node && node->is_number() ? node : nullptr;
}

double around_compass(double direction) {
  const double turned = std::fmod(direction, 360);
  return turned < 0 ? turned + 360 : turned;
}

class KeyFinder {
 public:
  explicit KeyFinder(const Node& tree) : tree_(tree) {
    const Node* dimension = number_in(tree, "dimension");
    dimension_ = dimension && dimension->number == 2 ? 2 : 3;
    const double gravity = length_of(entries_of(tree.find("gravity")));
    density_of_unit_ = kilo / (gravity > 0 ? gravity : 9.81);
  }

  std::vector<MovingKey> find(MovedAnswer of) {
    for (const MovingRow& row : moving_rows)
      if (row.moves == MovedAnswer::of_rigid_blocks || row.moves == of) search(row, row.pattern, tree_, "");
    return std::move(found_);
  }

 private:
  void search(const MovingRow& row, std::string_view rest, const Node& table, const std::string& path) {
    const std::size_t dot = rest.find('.');
    const std::string_view key = rest.substr(0, dot);
    const std::string full = key_path(path, key);
    if (dot == std::string_view::npos) return add(row, table, path, full, key);
    const Node* next = table.find(key);
    if (!next) return;
    rest.remove_prefix(dot + 1);
    if (rest.starts_with("*.")) {
      if (next->is_list_of_tables())
        for (std::size_t i = 0; i < next->items.size(); ++i)
          search(row, rest.substr(2), next->items[i], item_path(full, next->items[i], i));
    } else if (next->kind == Node::Kind::table) {
      search(row, rest, *next, full);
    }
  }

  MovingKey start(const MovingRow& row, const std::string& key, double value) const {
    MovingKey moving{.key = key,
                     .unit = std::string(row.unit),
                     .value = value,
                     .shown = row.shown,
                     .shown_unit = std::string(row.shown_unit),
                     .scale = row.scale};
    if (row.shown == unit_weight) moving.shown = density_of_unit_;
    moving.usual = row.usual == unit_weight ? density_of_unit_
                   : row.usual_is_share     ? row.usual * std::abs(value)
                                            : row.usual;
    moving.below = value - row.low;
    moving.above = row.high - value;
    return moving;
  }

  void add(const MovingRow& row, const Node& table, const std::string& path, const std::string& full,
           std::string_view key) {
    switch (row.form) {
      case KeyForm::number:
        return add_number(row, table, full, key);
      case KeyForm::dip:
        return add_dip(row, table, path, full);
      case KeyForm::direction:
        return add_direction(row, table, full);
      case KeyForm::normal:
        return add_normal(row, table, full);
      case KeyForm::heights:
        return add_heights(row, table, full);
      case KeyForm::size:
        return add_size(row, entries_of(table.find(key)), full);
      case KeyForm::entries:
      case KeyForm::last:
        return add_entries(row, entries_of(table.find(key)), full);
    }
  }

  void add_number(const MovingRow& row, const Node& table, const std::string& full, std::string_view key) {
    const Node* node = number_in(table, key);
    double value = node ? node->number : 0;
    if (key == "unit_weight" && !node && !table.find("pressure")) value = water_unit_weight;
    // a share of zero is no step: nothing acts there
    if (value == 0 && (row.scale == KeyScale::share || !node)) return;
    MovingKey moving = start(row, full, value);
    moving.overrides = [full, value](double distance) {
      return std::vector<std::string>{fmt::format("{}={}", full, value + distance)};
    };
    found_.push_back(std::move(moving));
  }

  void add_dip(const MovingRow& row, const Node& table, const std::string& path, const std::string& full) {
    const Node* dip = number_in(table, "dip");
    const Node* stated = number_in(table, "dip_direction");
    if (!dip || table.find("normal") || (!stated && dimension_ == 3)) return;
    const double value = dip->number, direction = stated ? stated->number : 90;
    MovingKey moving = start(row, full, value);
    moving.below = no_end;  // through 0 to the other side, with the same upward normal
    moving.overrides = [=](double distance) {
      const double turned = value + distance;
      std::vector<std::string> all{fmt::format("{}={}", full, std::abs(turned))};
      if (turned < 0)
        all.push_back(fmt::format("{}={}", key_path(path, "dip_direction"), around_compass(direction + 180)));
      if (turned >= 0 && !stated) all.push_back(fmt::format("{}={}", key_path(path, "dip_direction"), direction));
      return all;
    };
    found_.push_back(std::move(moving));
  }

  void add_direction(const MovingRow& row, const Node& table, const std::string& full) {
    const Node* direction = number_in(table, "dip_direction");
    if (!direction || dimension_ == 2 || table.find("normal")) return;
    const double value = direction->number;
    MovingKey moving = start(row, full, value);
    moving.overrides = [full, value](double distance) {
      return std::vector<std::string>{fmt::format("{}={}", full, around_compass(value + distance))};
    };
    found_.push_back(std::move(moving));
  }

  // positive: to the side above the plane
  void add_normal(const MovingRow& row, const Node& table, const std::string& full) {
    const std::vector<double> point = entries_of(table.find("point"));
    std::vector<double> normal = entries_of(table.find("normal"));
    const Node* dip = number_in(table, "dip");
    const Node* direction = number_in(table, "dip_direction");
    if (normal.empty() && dip) {
      const double down = dip->number * degree, trend = (direction ? direction->number : 90) * degree;
      const Vector<3> in_space = upward_normal_3d(down, trend);
      const Vector<2> in_plane = upward_normal_2d(down, trend);
      normal = dimension_ == 3 ? std::vector<double>(in_space.begin(), in_space.end())
                               : std::vector<double>(in_plane.begin(), in_plane.end());
    }
    if (point.empty() || normal.size() != point.size()) return;
    if (normal.back() < 0)
      for (double& x : normal)
        x = -x;
    MovingKey moving = start(row, full + " along its normal", 0);
    moving.overrides = [full, point, normal](double distance) {
      std::vector<double> moved = point;
      for (std::size_t k = 0; k < moved.size(); ++k)
        moved[k] += distance * normal[k];
      return std::vector<std::string>{vector_override(full, moved)};
    };
    found_.push_back(std::move(moving));
  }

  void add_size(const MovingRow& row, const std::vector<double>& entries, const std::string& full) {
    const double size = length_of(entries);
    if (!(size > 0)) return;
    MovingKey moving = start(row, full + ", its size", size);
    moving.overrides = [full, entries, size](double distance) {
      std::vector<double> scaled = entries;
      for (double& x : scaled)
        x *= 1 + distance / size;
      return std::vector<std::string>{vector_override(full, scaled)};
    };
    found_.push_back(std::move(moving));
  }

  void add_entries(const MovingRow& row, const std::vector<double>& entries, const std::string& full) {
    for (std::size_t k = row.form == KeyForm::last && !entries.empty() ? entries.size() - 1 : 0; k < entries.size();
         ++k) {
      const char* axis = entries.size() == 3 ? axis_names[k] : axis_names[k % 2];
      MovingKey moving = start(row, fmt::format("{}, {}", full, axis), entries[k]);
      moving.overrides = [full, entries, k](double distance) {
        std::vector<double> moved = entries;
        moved[k] += distance;
        return std::vector<std::string>{vector_override(full, moved)};
      };
      found_.push_back(std::move(moving));
    }
  }

  // each height, then all of them
  void add_heights(const MovingRow& row, const Node& table, const std::string& full) {
    const Node* list = table.find("table");
    if (!list || list->kind != Node::Kind::list || list->items.empty()) return;
    std::vector<std::vector<double>> points;
    for (const Node& item : list->items)
      if (points.emplace_back(entries_of(&item)).size() != 2) return;
    for (std::size_t k = 0; k <= points.size(); ++k) {
      const bool all = k == points.size();
      MovingKey moving =
          start(row, full + (all ? ", all points up" : fmt::format(", point {} up", k + 1)), all ? 0 : points[k][1]);
      moving.overrides = [full, points, k, all](double distance) {
        std::vector<std::string> texts;
        for (std::size_t j = 0; j < points.size(); ++j)
          texts.push_back(fmt::format("[{}, {}]", points[j][0], points[j][1] + (all || j == k ? distance : 0)));
        return std::vector<std::string>{fmt::format("{}=[{}]", full, fmt::join(texts, ", "))};
      };
      found_.push_back(std::move(moving));
    }
  }

  const Node& tree_;
  int dimension_ = 3;
  double density_of_unit_ = 0;  // kg/m³
  std::vector<MovingKey> found_;
};

}  // namespace

std::vector<MovingKey> moving_keys(const Node& tree, MovedAnswer of) {
  return KeyFinder(tree).find(of);
}

}  // namespace voussoir
