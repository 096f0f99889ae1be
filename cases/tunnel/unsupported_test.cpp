// Openings without support: mechanisms of failure, named by a rule, compared with Boon (2013), table 5.1.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "cases/tunnel/openings.hpp"
#include "verification/case_report.hpp"

namespace voussoir::cases::unsupported_test {
namespace {

using reference::Place;
using verification::Bound;
using verification::CaseReport;
using verification::Cost;

const std::string thesis = "Boon (2013), section 5.2";

Cost cost(const Opening& opening) {
  return {opening.evaluations, opening.seconds};
}

const OpeningRow& row(int number) {
  return opening_rows()[number - 1];
}

void check_lower_friction(CaseReport& report, const Opening& lower, const Opening& higher) {
  report.record({fmt::format("rock lost at {}° over that at {}°, openings {} and {}", lower.row.friction,
                             higher.row.friction, lower.row.number, higher.row.number),
                 "1",
                 verification::Kind::limit,
                 "comparison: the same blocks: less friction holds no more",
                 1,
                 {0.05, 0, Bound::at_least},
                 "a block of the mean size of 2.3 m2 of some fifty may be held by another mechanism"},
                lower.lost_area() / higher.lost_area(), cost(lower));
}

// The Long ones compare openings of the same blocks with more and with less friction.
TEST(Unsupported, TheRoofLosesBlocks) {
  CaseReport report("tunnel", {"whether opening 11 loses blocks above the springline"});
  const Opening opening = dig(row(11), 0, 0.4, "opening_11", {"time.fraction=0.9"});  // the Long ones: 0.5, and 0.2
  report.report("rock lost in 0.4 s, opening 11", "m2", opening.lost_area(), "roof: " + words(opening, Place::roof),
                cost(opening));
  report.record({"whether opening 11 loses blocks above the springline",
                 "1",
                 verification::Kind::published,
                 thesis,
                 1,
                 {0, 0},
                 "1: it does"},
                opening.above_springline > 0);
  report.record(
      {"whether opening 11 fails all round", "1", verification::Kind::published, thesis, 0, {0, 0}, "0: it does not"},
      opening.at(Place::floor).kind != reference::Kind::none);
}

TEST(UnsupportedLong, TwentyFourOpenings) {
  CaseReport report("tunnel", {"openings that lose blocks above the springline"});
  std::ofstream table(verification::case_output("tunnel") / "openings.csv");
  table << "number,friction_deg,roof,roof_m2,left_wall,left_m2,right_wall,right_m2,floor,floor_m2,thesis,roof_kind,"
           "second_place,second_kind,farthest_m\n";
  std::vector<Opening> openings;
  int other_draws = 0, roofs = 0, round = 0, roof_kinds = 0, places = 0, kinds = 0;
  for (const OpeningRow& r : opening_rows()) {
    int seed = 0;
    openings.push_back(dig(r, seed, 0.5, fmt::format("opening_{}", r.number)));
    // if no block falls in this draw, in another one of a few
    constexpr int most_draws = 3;
    while (openings.back().above_springline == 0 && ++seed < most_draws)
      openings.back() = dig(r, seed, 0.5, fmt::format("opening_{}", r.number));
    other_draws += seed > 0;
    const Opening& opening = openings.back();
    const Agreement agrees = agreement(opening);
    table << fmt::format("{},{}", r.number, r.friction);
    bool all = true;
    for (const Place place : {Place::roof, Place::left_wall, Place::right_wall, Place::floor}) {
      table << fmt::format(",{},{:.1f}", words(opening, place), opening.at(place).area);
      all = all && opening.at(place).kind != reference::Kind::none;
    }
    table << fmt::format(",{}{},{},{},{},{:.2f}", r.first, r.second, agrees.roof_kind, agrees.second_place,
                         agrees.second_kind, opening.farthest)
          << std::endl;
    roofs += opening.above_springline > 0;
    round += all;
    roof_kinds += agrees.roof_kind;
    places += agrees.second_place;
    kinds += agrees.second_kind;
  }
  report.record({"openings that lose blocks above the springline",
                 "1",
                 verification::Kind::published,
                 thesis,
                 24,
                 {0, 0},
                 "a count"},
                roofs);
  report.record({"openings that fail all round", "1", verification::Kind::published, thesis, 0, {0, 0}, "a count"},
                round);
  report.report("openings that hold in their first draw, of 24", "1", other_draws, "thesis: none, one draw each");
  report.report("openings that lose blocks within 45° of the crown, of 24", "1",
                std::ranges::count_if(openings, [](const Opening& o) { return o.at(Place::roof).area > 0; }),
                "thesis: all");
  report.report("kinds in the roof as in table 5.1, of 24", "1", roof_kinds, "one draw");
  report.report("places of the second mechanism as in table 5.1, of 24", "1", places, "one draw");
  report.report("kinds of the second mechanism as in table 5.1, of 24", "1", kinds, "one draw");
  for (const auto& [lower, higher] : {std::pair(11, 12), {13, 14}, {15, 16}})
    check_lower_friction(report, openings[lower - 1], openings[higher - 1]);
}

// Effect of fixing the rock beyond 20 m and of long time steps.
TEST(UnsupportedLong, HeldRockAndTimeSteps) {
  CaseReport report("tunnel");
  const auto dug = [](const std::vector<std::string>& more) { return dig(row(1), 0, 0.5, "", more); };
  const Opening plain = dug({}), fine = dug({"time.fraction=0.2"}),
                whole = dug({R"(stage.dig.fix=[{ side = ["left", "right"] }])"});
  report.report("rock lost in 0.5 s, opening 1", "m2", plain.lost_area(), words(plain, Place::roof), cost(plain));
  for (const auto& [name, other] :
       {std::pair("steps of 0.2 of the limit", fine), {"nothing held but the sides", whole}}) {
    report.report(fmt::format("rock lost in 0.5 s, opening 1, {}", name), "m2", other.lost_area(),
                  words(other, Place::roof), cost(other));
    report.record({fmt::format("roof of opening 1 fails alike, {}", name),
                   "1",
                   verification::Kind::limit,
                   "comparison: the same kind of mechanism, of the same sets",
                   1,
                   {0, 0},
                   "a count"},
                  words(plain, Place::roof) == words(other, Place::roof));
  }
}

}  // namespace
}  // namespace voussoir::cases::unsupported_test
