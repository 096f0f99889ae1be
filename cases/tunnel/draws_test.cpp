// Rows of several draws: read back as they were written, and counted against Boon (2013), table 5.1.
#include "cases/tunnel/draws.hpp"

#include <gtest/gtest.h>

#include "text/angle.hpp"
#include "text/file_fault.hpp"

namespace voussoir::cases::draws_test {
namespace {

using reference::Kind;
using reference::Mechanism;
using reference::Place;

// opening 1: 60E 40E 80W; wedge of 40E and 80W, no second mechanism
Opening made(Mechanism roof, Mechanism right = {Place::right_wall}) {
  Opening opening{opening_rows()[0], {}, {}};
  for (const int dip : opening.row.dips)
    opening.sets.push_back({std::abs(dip) * degree, dip > 0});
  opening.found = {roof, {Place::left_wall}, right, {Place::floor}};
  return opening;
}

const Opening as_published = made({Place::roof, Kind::wedge, 2, 1, 12.5}),
              otherwise = made({Place::roof, Kind::wedge, 0, 2, 3}, {Place::right_wall, Kind::slide, 1, -1, 2.25}),
              holds = made({Place::roof});

TEST(Draws, LettersThatFit) {
  const DrawRow wedge = draw_row(as_published, 0, "x"), other = draw_row(otherwise, 1, "x"),
                none = draw_row(holds, 2, "x");
  EXPECT_EQ(wedge.roof_kind, "W");
  EXPECT_EQ(wedge.second_kind, "-r") << "nothing at the walls, more or less in the roof";
  EXPECT_EQ(other.roof_kind, "");
  EXPECT_EQ(other.second_place, "s2wt") << "one wall fails, not both";
  EXPECT_EQ(other.second_kind, "s") << "along 40E, the shallowest";
  EXPECT_EQ(none.roof_kind, "");
  EXPECT_EQ(none.second_place, "-");
}

TEST(Draws, ReadBackAsWritten) {
  const std::string csv = draws_csv({draw_row(as_published, 0, "fnv1a64:0"), draw_row(holds, 2, "fnv1a64:1")});
  EXPECT_EQ(draws_csv(read_draws(csv)), csv);
  EXPECT_NE(csv.find("wedge 80W/40E,12.5,'-,0,"), std::string::npos) << csv;
  std::string unknown = csv;
  unknown.replace(unknown.find("\n1,") + 1, 1, "25");
  EXPECT_THROW(read_draws(unknown), FileFault);
}

TEST(Draws, AgreementIsCountedAndComparedWithChance) {
  const std::vector<DrawRow> rows{draw_row(as_published, 0, ""), draw_row(otherwise, 1, ""), draw_row(holds, 2, "")};
  const DrawsAgree found = draws_agree(rows, 1);
  EXPECT_EQ(found.draws, 3);
  EXPECT_EQ(found.roof, 2);
  EXPECT_EQ(found.roof_kind, 2);
  EXPECT_EQ(found.roof_sets, 1);
  EXPECT_EQ(found.second_place, 2);
  EXPECT_EQ(found.second_kind, 2);
  EXPECT_EQ(draws_agree(rows, 2).draws, 0);
  // of the 23 others 8 have the wedge of the widest pair, 5 no second mechanism
  const DrawsAgree chance = by_chance({rows[0]});
  EXPECT_NEAR(chance.draws, 1, 1e-12);
  EXPECT_NEAR(chance.roof_sets, 8.0 / 23, 1e-12);
  EXPECT_NEAR(chance.second_kind, 6.0 / 23, 1e-12) << "one more loses more of its roof alone";
}

TEST(Draws, TableHasOursBesideTheThesis) {
  const std::string table =
      agreement_table({draw_row(as_published, 0, ""), draw_row(otherwise, 1, ""), draw_row(as_published, 2, "")});
  EXPECT_NE(
      table.find("| 1 | 60E 40E 80W 35° | wedge 40E/80W; - | 3 | 3 | 3 | 2 | 2 | 2 | wedge 80W/40E 2, wedge 60E/80W "
                 "1 | slide 40E 1 | 9.3, 0.0, 0.8 |\n"),
      std::string::npos)
      << table;
  EXPECT_NE(table.find("| all 3 | | | | 3 | 3 | 2 | 2 | 2 |"), std::string::npos) << table;
}

}  // namespace
}  // namespace voussoir::cases::draws_test
