#include "app/blocks/kinematics_text.hpp"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "core/geometry/plunge_trend.hpp"
#include "core/run/checkpoint.hpp"
#include "text/csv_table.hpp"

namespace voussoir {
namespace {

const char* word_of(WedgeMotion motion) {
  switch (motion) {
    case WedgeMotion::on_both:
      return "slides on both";
    case WedgeMotion::on_one:
      return "slides on one";
    case WedgeMotion::buried:
      break;
  }
  return "buried";
}

std::string row(const ZoneCount& counted) {
  const auto& [zone, count, of] = counted;
  return fmt::format("  {:<58} {:>9} of {:>9}{:>7.1f} %\n", zone, count, of, of > 0 ? 100.0 * count / of : 0.0);
}

std::string row(const ZonePairs& pairs) {
  return fmt::format("  {:<48} {:>9} {:>9} {:>9}\n", pairs.zone, pairs.below_one, pairs.at_least_one, pairs.buried);
}

// The number of degrees as it was stated: of those that are these radians the one with the fewest digits.
double stated_degrees(double radians) {
  for (int digits = 1; digits < std::numeric_limits<double>::max_digits10; ++digits)
    if (const double stated = std::stod(fmt::format("{:.{}g}", to_degrees(radians), digits));
        stated * degree == radians)
      return stated;
  return to_degrees(radians);
}

}  // namespace

std::vector<ZoneCount> zone_counts(const KinematicRequest& request, const KinematicCounts& counts) {
  const LateralLimits& limits = request.limits;
  const auto within = [](const char* what, double limit) {
    return fmt::format("{} {:g} deg", what, to_degrees(limit));
  };
  const std::string direct = within("within", limits.direct_toppling);
  return {
      {"plane sliding, any direction", counts.plane_sliding, counts.joints},
      {within("plane sliding, within", limits.plane_sliding) + " of the face's direction", counts.plane_sliding_within,
       counts.joints},
      {"wedge sliding, primary zone", counts.wedge_primary, counts.pairs},
      {"wedge sliding, primary zone, joints of different sets", counts.wedge_primary_of_sets, counts.pairs_of_sets},
      {"wedge sliding, secondary zone (perhaps on one plane)", counts.wedge_secondary, counts.pairs},
      {"wedge sliding, secondary zone, joints of different sets", counts.wedge_secondary_of_sets, counts.pairs_of_sets},
      {within("flexural toppling, within", limits.flexural_toppling) + " (Goodman's rule)", counts.flexural_toppling,
       counts.joints},
      {"flexural toppling, by the great circle of the slip limit", counts.flexural_toppling_net, counts.joints},
      {"direct toppling, lines " + direct + ", zone 1", counts.direct_lines[0], counts.pairs},
      {"direct toppling, lines " + direct + ", zone 2 (steep)", counts.direct_lines[1], counts.pairs},
      {"direct toppling, oblique lines, zone 3", counts.direct_lines[2], counts.pairs},
      {"direct toppling, bases " + direct + ", zone 1 (slides too)", counts.direct_bases[0], counts.joints},
      {"direct toppling, bases " + direct + ", zone 2", counts.direct_bases[1], counts.joints},
      {"direct toppling, oblique bases, zone 3", counts.direct_bases[2], counts.joints}};
}

std::vector<ZonePairs> zone_pairs(const std::vector<PairVerdict>& pairs) {
  ZonePairs primary{"line steeper than the friction (primary zone)"}, flatter{"line flatter"};
  for (const PairVerdict& pair : pairs) {
    ZonePairs& zone = pair.primary ? primary : flatter;
    (!pair.factor ? zone.buried : *pair.factor < 1 ? zone.below_one : zone.at_least_one) += 1;
  }
  return {primary, flatter};
}

std::string kinematics_summary(const KinematicRequest& request, const KinematicCounts& counts,
                               const std::vector<PairVerdict>& pairs, const std::string& title) {
  std::string text = fmt::format(
      "{} - kinematic analysis of {} joints: face {:g}/{:03g}, friction {:g} deg\n"
      "a screen of directions: neither the joints' places and sizes, nor water, cohesion and supports are counted\n",
      title, counts.joints, to_degrees(request.face.dip), to_degrees(request.face.direction),
      to_degrees(request.friction));
  for (const ZoneCount& counted : zone_counts(request, counts))
    text += row(counted);
  text += fmt::format("block theory on the {} pairs whose line leaves the face, the block above both planes:\n",
                      pairs.size());
  text += fmt::format("  {:<48} {:>9} {:>9} {:>9}\n", "", "F < 1", "F >= 1", "buried");
  const std::vector<ZonePairs> judged = zone_pairs(pairs);
  for (const ZonePairs& zone : judged)
    text += row(zone);
  text += fmt::format(
      "the overlay is safe on neither side: pairs with F < 1 outside of the primary zone: {}; without inside: {}\n",
      judged[1].below_one, judged[0].at_least_one + judged[0].buried);
  return text;
}

std::string kinematics_json(const KinematicRequest& request, const KinematicCounts& counts,
                            const std::vector<PairVerdict>& pairs, const std::vector<NamedJoint>& joints,
                            const std::string& title, const std::string& hash) {
  nlohmann::json json = {{"schema", "voussoir.kinematics"},
                         {"schema_version", 1},
                         {"title", title},
                         {"input_hash", hash},
                         {"program", build_name()},
                         {"face_dip_deg", stated_degrees(request.face.dip)},
                         {"face_direction_deg", stated_degrees(request.face.direction)},
                         {"friction_deg", stated_degrees(request.friction)},
                         {"limits_deg",
                          {{"plane_sliding", stated_degrees(request.limits.plane_sliding)},
                           {"flexural_toppling", stated_degrees(request.limits.flexural_toppling)},
                           {"direct_toppling", stated_degrees(request.limits.direct_toppling)}}},
                         {"counts", nlohmann::json::array()},
                         {"pairs", nlohmann::json::array()},
                         {"joints", nlohmann::json::array()}};
  for (const ZoneCount& counted : zone_counts(request, counts))
    json["counts"].push_back({{"mode", counted.zone}, {"count", counted.count}, {"of", counted.of}});
  for (const ZonePairs& zone : zone_pairs(pairs))
    json["pairs"].push_back({{"zone", zone.zone},
                             {"below_one", zone.below_one},
                             {"at_least_one", zone.at_least_one},
                             {"buried", zone.buried}});
  for (const NamedJoint& joint : joints)
    json["joints"].push_back(
        {{"name", joint.name}, {"set", joint.set}, {"normal", {joint.normal.x(), joint.normal.y(), joint.normal.z()}}});
  return json.dump(1) + "\n";
}

std::string kinematic_pairs_csv(const std::vector<PairVerdict>& pairs, const std::vector<NamedJoint>& joints) {
  std::string table =
      "joint_a,joint_b,line_plunge_deg,line_trend_deg,zone,motion,direction_plunge_deg,direction_trend_deg,factor\n";
  for (const PairVerdict& pair : pairs) {
    const auto [plunge, trend] = plunge_and_trend(pair.line);
    const auto [down, towards] = plunge_and_trend(pair.direction);
    table += fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_cell(joints[pair.first].name),
                         csv_cell(joints[pair.second].name), csv_cell(plunge), csv_cell(trend),
                         pair.primary ? "primary" : "flatter", word_of(pair.motion), pair.factor ? csv_cell(down) : "",
                         pair.factor ? csv_cell(towards) : "", csv_cell(pair.factor));
  }
  return table;
}

}  // namespace voussoir
