#include "app/blocks/kinematics_text.hpp"

#include <fmt/format.h>

#include "core/geometry/plunge_trend.hpp"
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

std::string row(const std::string& mode, long count, long of) {
  return fmt::format("  {:<58} {:>9} of {:>9}{:>7.1f} %\n", mode, count, of, of > 0 ? 100.0 * count / of : 0.0);
}

struct PairCounts {
  long below_one = 0, at_least_one = 0, buried = 0;

  void add(const PairVerdict& pair) { (!pair.factor ? buried : *pair.factor < 1 ? below_one : at_least_one) += 1; }
  std::string row(const char* zone) const {
    return fmt::format("  {:<48} {:>9} {:>9} {:>9}\n", zone, below_one, at_least_one, buried);
  }
};

}  // namespace

std::string kinematics_summary(const KinematicRequest& request, const KinematicCounts& counts,
                               const std::vector<PairVerdict>& pairs, const std::string& title) {
  const auto& [face, friction, limits] = request;
  std::string text = fmt::format(
      "{} - kinematic analysis of {} joints: face {:g}/{:03g}, friction {:g} deg\n"
      "a screen of directions: neither the joints' places and sizes, nor water, cohesion and supports are counted\n",
      title, counts.joints, to_degrees(face.dip), to_degrees(face.direction), to_degrees(friction));
  text += row("plane sliding, any direction", counts.plane_sliding, counts.joints);
  text += row(fmt::format("plane sliding, within {:g} deg of the face's direction", to_degrees(limits.plane_sliding)),
              counts.plane_sliding_within, counts.joints);
  text += row("wedge sliding, primary zone", counts.wedge_primary, counts.pairs);
  text +=
      row("wedge sliding, primary zone, joints of different sets", counts.wedge_primary_of_sets, counts.pairs_of_sets);
  text += row("wedge sliding, secondary zone (perhaps on one plane)", counts.wedge_secondary, counts.pairs);
  text += row("wedge sliding, secondary zone, joints of different sets", counts.wedge_secondary_of_sets,
              counts.pairs_of_sets);
  text += row(fmt::format("flexural toppling, within {:g} deg (Goodman's rule)", to_degrees(limits.flexural_toppling)),
              counts.flexural_toppling, counts.joints);
  text += row("flexural toppling, by the great circle of the slip limit", counts.flexural_toppling_net, counts.joints);
  const std::string direct = fmt::format("within {:g} deg", to_degrees(limits.direct_toppling));
  text += row("direct toppling, lines " + direct + ", zone 1", counts.direct_lines[0], counts.pairs);
  text += row("direct toppling, lines " + direct + ", zone 2 (steep)", counts.direct_lines[1], counts.pairs);
  text += row("direct toppling, oblique lines, zone 3", counts.direct_lines[2], counts.pairs);
  text += row("direct toppling, bases " + direct + ", zone 1 (slides too)", counts.direct_bases[0], counts.joints);
  text += row("direct toppling, bases " + direct + ", zone 2", counts.direct_bases[1], counts.joints);
  text += row("direct toppling, oblique bases, zone 3", counts.direct_bases[2], counts.joints);
  PairCounts primary, others;
  for (const PairVerdict& pair : pairs)
    (pair.primary ? primary : others).add(pair);
  text += fmt::format("block theory on the {} pairs whose line leaves the face, the block above both planes:\n",
                      pairs.size());
  text += fmt::format("  {:<48} {:>9} {:>9} {:>9}\n", "", "F < 1", "F >= 1", "buried");
  text += primary.row("line steeper than the friction (primary zone)");
  text += others.row("line flatter");
  text += fmt::format(
      "the overlay is safe on neither side: pairs with F < 1 outside of the primary zone: {}; without inside: {}\n",
      others.below_one, primary.at_least_one + primary.buried);
  return text;
}

std::string kinematic_pairs_csv(const std::vector<PairVerdict>& pairs, const std::vector<std::string>& names) {
  std::string table =
      "joint_a,joint_b,line_plunge_deg,line_trend_deg,zone,motion,direction_plunge_deg,direction_trend_deg,factor\n";
  for (const PairVerdict& pair : pairs) {
    const auto [plunge, trend] = plunge_and_trend(pair.line);
    const auto [down, towards] = plunge_and_trend(pair.direction);
    table +=
        fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_cell(names[pair.first]), csv_cell(names[pair.second]),
                    csv_cell(plunge), csv_cell(trend), pair.primary ? "primary" : "flatter", word_of(pair.motion),
                    pair.factor ? csv_cell(down) : "", pair.factor ? csv_cell(towards) : "", csv_cell(pair.factor));
  }
  return table;
}

}  // namespace voussoir
