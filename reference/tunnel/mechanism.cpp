#include "reference/tunnel/mechanism.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace voussoir::reference {
namespace {

Place place_of(const BlockMotion& block, double roof_half_angle) {
  const double from_crown = std::abs(std::atan2(block.x, block.y));
  if (from_crown <= roof_half_angle) return Place::roof;
  if (from_crown >= std::numbers::pi - roof_half_angle) return Place::floor;
  return block.x < 0 ? Place::left_wall : Place::right_wall;
}

// unit vector down the trace
std::pair<double, double> down(const JointSet& set) {
  return {set.to_right ? std::cos(set.dip) : -std::cos(set.dip), -std::sin(set.dip)};
}

bool is_lost(const BlockMotion& block, const MechanismRule& rule) {
  return std::hypot(block.dx, block.dy) > rule.moved;
}

// The boundary of the lost blocks of a place towards blocks that did not move, m: lengths of each set by side, as seen
// from the moved blocks.
struct Bounds {
  double all = 0;
  std::vector<double> left, right, beneath;
};

int longest(const std::vector<double>& lengths) {
  int found = -1;
  for (std::size_t s = 0; s < lengths.size(); ++s)
    if (lengths[s] > 0 && (found < 0 || lengths[s] > lengths[found])) found = static_cast<int>(s);
  return found;
}

Bounds bounds_of(Place place, const std::vector<BlockMotion>& blocks, const std::vector<JointStretch>& joints,
                 std::size_t sets, const MechanismRule& rule) {
  Bounds found;
  found.left.assign(sets, 0);
  found.right.assign(sets, 0);
  found.beneath.assign(sets, 0);
  for (const JointStretch& joint : joints) {
    const bool first_lost = is_lost(blocks[joint.first], rule), second_lost = is_lost(blocks[joint.second], rule);
    if (first_lost == second_lost) continue;
    if (place_of(blocks[first_lost ? joint.first : joint.second], rule.roof_half_angle) != place) continue;
    found.all += joint.length;
    if (joint.set < 0) continue;
    const double outward = first_lost ? 1 : -1;
    (outward * joint.nx < 0 ? found.left : found.right)[joint.set] += joint.length;
    if (outward * joint.ny < 0) found.beneath[joint.set] += joint.length;
  }
  return found;
}

// Whether traces of these sets, at the left and the right flank, meet above the part between them: the left one rises
// to the right of the other. Both are angles of the upward direction from the right, in 0..pi.
bool narrows_upwards(const JointSet& left, const JointSet& right) {
  const auto up = [](const JointSet& set) { return set.to_right ? std::numbers::pi - set.dip : set.dip; };
  return up(left) < up(right);
}

void name_kind(Mechanism& found, const Bounds& bounds, double turned_area, const std::vector<JointSet>& sets,
               const MechanismRule& rule) {
  if (found.place != Place::roof && turned_area >= rule.turned_share * found.area) {
    found.kind = Kind::topple;
    return;
  }
  const double needed = rule.flank_share * bounds.all;
  const int left = longest(bounds.left), right = longest(bounds.right), beneath = longest(bounds.beneath);
  if (left >= 0 && right >= 0 && left != right && bounds.left[left] > needed && bounds.right[right] > needed &&
      narrows_upwards(sets[left], sets[right])) {
    found.kind = Kind::wedge;
    found.first_set = left;
    found.second_set = right;
    return;
  }
  if (beneath >= 0 && bounds.beneath[beneath] > needed) {
    const auto [x, y] = down(sets[beneath]);
    const double off = std::atan2(std::abs(x * found.dy - y * found.dx), x * found.dx + y * found.dy);
    if (off <= rule.along) {
      found.kind = Kind::slide;
      found.first_set = beneath;
      return;
    }
  }
  found.kind = Kind::fall;
}

void check(const std::vector<BlockMotion>& blocks, const std::vector<JointStretch>& joints, std::size_t sets) {
  const int count = static_cast<int>(blocks.size());
  for (const JointStretch& joint : joints)
    if (joint.first < 0 || joint.first >= count || joint.second < 0 || joint.second >= count ||
        joint.set >= static_cast<int>(sets))
      throw std::invalid_argument("a joint names a block or a set that does not exist");
}

}  // namespace

std::vector<Mechanism> mechanisms(const std::vector<BlockMotion>& blocks, const std::vector<JointStretch>& joints,
                                  const std::vector<JointSet>& sets, const MechanismRule& rule) {
  check(blocks, joints, sets.size());
  std::vector<Mechanism> all;
  for (const Place place : {Place::roof, Place::left_wall, Place::right_wall, Place::floor}) {
    Mechanism found;
    found.place = place;
    double turned = 0;
    for (const BlockMotion& block : blocks) {
      if (!is_lost(block, rule) || place_of(block, rule.roof_half_angle) != place) continue;
      found.area += block.area;
      found.dx += block.area * block.dx;
      found.dy += block.area * block.dy;
      if (std::abs(block.turn) * std::sqrt(block.area) > 0.5 * std::hypot(block.dx, block.dy)) turned += block.area;
    }
    if (found.area > 0) {
      found.dx /= found.area;
      found.dy /= found.area;
    }
    if (found.area >= rule.least_area)
      name_kind(found, bounds_of(place, blocks, joints, sets.size(), rule), turned, sets, rule);
    all.push_back(found);
  }
  return all;
}

}  // namespace voussoir::reference
