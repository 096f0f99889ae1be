#include "core/output/support_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace voussoir {
namespace {

// the entry of this name, a new one if there is none
template <class Entry>
Entry& entry_of(std::vector<Entry>& entries, const std::string& name) {
  const auto known = std::ranges::find(entries, name, &Entry::name);
  if (known != entries.end()) return *known;
  entries.push_back({.name = name});
  return entries.back();
}

void keep_larger(std::optional<double>& largest, const std::optional<double>& value) {
  if (value) largest = std::max(largest.value_or(0), *value);
}

std::string count_text(int count, const char* what) {
  return count == 0 ? "" : fmt::format("; {} {} {}", count, count == 1 ? "has" : "have", what);
}

}  // namespace

SupportsCarry supports_carry(const Results& results, int stage) {
  SupportsCarry carry;
  std::set<std::pair<std::string, int>> seen, yielded, broken, slipped;
  const auto once = [](auto& set, const BoltRow& row) { return set.emplace(row.bolts, row.bolt).second; };
  for (const BoltRow& row : results.bolts) {
    if (row.stage != stage) continue;
    BoltsCarry& bolts = entry_of(carry.bolts, row.bolts);
    bolts.bolts += once(seen, row);
    if (bolts.bolt == 0 || std::abs(row.force) > std::abs(bolts.force)) {
      bolts.force = row.force;
      bolts.bolt = row.bolt;
      bolts.joint = row.joint;
    }
    bolts.shear = std::max(bolts.shear, std::abs(row.shear));
    keep_larger(bolts.use, row.use);
    bolts.yielded += row.plastic != 0 && once(yielded, row);
    bolts.broken += row.broken && once(broken, row);
    bolts.slipped += row.slip.value_or(0) > 0 && once(slipped, row);
  }
  for (const LiningRow& row : results.linings) {
    if (row.stage != stage) continue;
    LiningCarries& lining = entry_of(carry.linings, row.lining);
    if (lining.thrust_node == 0 || std::abs(row.forces.thrust) > std::abs(lining.thrust)) {
      lining.thrust = row.forces.thrust;
      lining.thrust_node = row.node;
    }
    if (lining.moment_node == 0 || std::abs(row.forces.moment) > std::abs(lining.moment)) {
      lining.moment = row.forces.moment;
      lining.moment_node = row.node;
    }
    lining.pressure = std::max(lining.pressure, row.pressure);
    keep_larger(lining.use, row.use);
  }
  return carry;
}

std::string text_of(const BoltsCarry& bolts) {
  std::string text = fmt::format("bolts {}: {} {}, at most {:.3g} kN (bolt {}, {})", bolts.name, bolts.bolts,
                                 bolts.bolts == 1 ? "bolt" : "bolts", bolts.force / 1000, bolts.bolt,
                                 bolts.joint == 0 ? "plate" : fmt::format("joint {}", bolts.joint));
  if (bolts.shear > 0) text += fmt::format(", {:.3g} kN across", bolts.shear / 1000);
  if (bolts.use) text += fmt::format(", {:.3g} % of yield", 100 * *bolts.use);
  return text + count_text(bolts.yielded, "yielded") + count_text(bolts.broken, "broken") +
         count_text(bolts.slipped, "slipped in the rock");
}

std::string text_of(const LiningCarries& lining) {
  std::string text = fmt::format(
      "lining {}: thrust {:.3g} kN/m (node {}), moment {:.3g} kN m/m (node {}), rock pressure {:.3g} kPa", lining.name,
      lining.thrust / 1000, lining.thrust_node, lining.moment / 1000, lining.moment_node, lining.pressure / 1000);
  if (lining.use) text += fmt::format(", {:.3g} % of its strength", 100 * *lining.use);
  return text;
}

}  // namespace voussoir
