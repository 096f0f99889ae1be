#include "reference/vaiont/section.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "text/angle.hpp"

using voussoir::degree;

namespace voussoir::reference::section_test {
namespace {

constexpr double vertical = std::numbers::pi / 2, rock = 40 * degree;

SectionLoads water(double above_the_seat) {
  SectionLoads loads;
  loads.table = {{0, 620 + above_the_seat}};
  return loads;
}

double critical_deg(const SlideSection& section, const SectionLoads& loads = {}, double cross = rock,
                    double cross_dip = vertical) {
  return critical_slide_friction(section_blocks(section, loads, cross_dip), cross, cross_dip) / degree;
}

// Second derivation: six balances of three blocks, solved together for the forces on the slide (inclined at its
// friction from the normal) and on the cross joints, with the force that must hold the toe. Zero at the critical
// friction.
double toe_force_by_balances(const std::vector<SectionBlock>& blocks, double slide, double cross) {
  Eigen::Matrix<double, 6, 6> equations = Eigen::Matrix<double, 6, 6>::Zero();  // R0 R1 R2, F01 F12, toe
  Eigen::Matrix<double, 6, 1> loads;
  for (int k = 0; k < 3; ++k) {
    const double from_vertical = blocks[k].dip - slide;  // the reaction's lean downslope
    equations(2 * k, k) = std::sin(from_vertical);
    equations(2 * k + 1, k) = std::cos(from_vertical);
    loads(2 * k) = -blocks[k].horizontal;
    loads(2 * k + 1) = blocks[k].vertical;
    if (k < 2) {
      equations(2 * k, 3 + k) = -std::cos(cross);  // its reaction on the next block pushes that block back and up
      equations(2 * k + 1, 3 + k) = std::sin(cross);
      equations(2 * k + 2, 3 + k) = std::cos(cross);
      equations(2 * k + 3, 3 + k) = -std::sin(cross);
    }
  }
  // the toe is held by a force inclined as on the cross joints, so that its horizontal part is the last of the sums
  equations(4, 5) = -std::cos(cross);
  equations(5, 5) = std::sin(cross);
  return equations.partialPivLu().solve(loads)(5) * std::cos(cross);
}

// Areas by strips, each from the slide to the surface.
struct Strips {
  double area = 0, lift = 0, push = 0;
};
template <typename Head>
Strips by_strips(double from, double to, const Head& head) {
  constexpr int strips = 200000;
  const std::vector<SectionPoint> floor{{20.8119, 1179.0372}, {718.3777, 644.0025}, {818.3777, 620}, {1214.3866, 620}},
      roof{{20.8119, 1179.0372}, {352, 1065}, {685, 850}, {920, 850}, {1214.3866, 620}};
  const auto at = [](const std::vector<SectionPoint>& line, double x) {
    std::size_t k = 1;
    while (k + 1 < line.size() && x > line[k].x)
      ++k;
    return line[k - 1].y + (line[k].y - line[k - 1].y) * (x - line[k - 1].x) / (line[k].x - line[k - 1].x);
  };
  Strips sum;
  const double dx = (to - from) / strips;
  for (int i = 0; i < strips; ++i) {
    const double x = from + (i + 0.5) * dx, low = at(floor, x), high = at(roof, x);
    sum.area += (high - low) * dx;
    const double wet = std::clamp(head(x), low, high) - low;
    sum.lift += 9810 * wet * dx;
    sum.push -= 9810 * wet * dx * (head(x + 1e-3) - head(x - 1e-3)) / 2e-3;
  }
  return sum;
}

const SectionLoads drawn_down{23500, {{900, 710}, {1137.590, 680}}, 9810, 0};

TEST(VaiontSection, Areas) {
  const std::vector<SectionBlock> blocks = section_blocks(vaiont_section(), {});
  ASSERT_EQ(blocks.size(), 3u);
  // the corners are rounded to 0.1 mm: half of it along sides of 800 m, and over the 100 m of the middle slide
  EXPECT_NEAR(blocks[0].area, 82972.70, 0.04);
  EXPECT_NEAR(blocks[1].area, 21799.88, 0.04);
  EXPECT_NEAR(blocks[2].area, 57227.59, 0.04);
  EXPECT_NEAR(blocks[0].area + blocks[1].area + blocks[2].area, 162000.16, 0.04);
  EXPECT_NEAR(blocks[0].dip / degree, 37.488297, 5e-6);
  EXPECT_NEAR(blocks[1].dip / degree, 13.497070, 3e-5);
  EXPECT_EQ(blocks[2].dip, 0);
  EXPECT_NEAR(vaiont_section(1.8 * degree).slide.back().x, 1230.98, 0.005);
  EXPECT_NEAR(vaiont_section(1.8 * degree).slide.back().y, 607.03, 0.005);
  EXPECT_NEAR(vaiont_section().slide.back().x, 1214.3866, 1e-9);
}

TEST(VaiontSection, WorkedValues) {
  EXPECT_NEAR(critical_deg(vaiont_section()), 16.598433, 5e-7);
  EXPECT_NEAR(critical_deg(vaiont_section(), water(90)), 18.292494, 5e-7);
  EXPECT_NEAR(critical_deg(vaiont_section(), {}, 30 * degree), 17.905055, 5e-7);
  EXPECT_NEAR(critical_deg(vaiont_section(1.8 * degree)), 17.35114, 5e-6);
  EXPECT_NEAR(critical_deg(vaiont_section(), drawn_down), 18.53413, 5e-6);
  const std::vector<SectionBlock> dry = section_blocks(vaiont_section(), {});
  EXPECT_NEAR(critical_horizontal_coefficient(dry, {25 * degree, rock}), 0.177074, 5e-7);
  EXPECT_NEAR(section_factor_of_safety(dry, {12 * degree, rock}), 0.770436, 5e-7);
}

// Cross joints dipping into the slope through both bends, beside limit analysis of the same three blocks. At 50 degrees
// that finds 7.13: one mechanism, here the blocks' translation, shows only that no less friction suffices.
TEST(VaiontSection, CrossJointsIntoTheSlope) {
  EXPECT_NEAR(critical_deg(vaiont_section(), {}, rock, 71.25 * degree), 14.58993, 1e-5);
  EXPECT_LT(critical_deg(vaiont_section(), {}, rock, 50 * degree), 7.13);
  EXPECT_GT(critical_deg(vaiont_section(), {}, rock, 50 * degree), 7.0);
}

TEST(VaiontSection, BySixBalances) {
  for (const SectionLoads& loads : {SectionLoads{}, water(30), water(90), drawn_down}) {
    const std::vector<SectionBlock> blocks = section_blocks(vaiont_section(), loads);
    const double slide = critical_slide_friction(blocks, rock, vertical), weight = blocks[0].vertical;
    EXPECT_NEAR(toe_force_by_balances(blocks, slide, rock) / weight, 0, 1e-12);
    EXPECT_NEAR(toe_force_by_balances(blocks, 0.2, rock) / section_forces(blocks, {0.2, rock}).back(), 1, 1e-12);
  }
}

TEST(VaiontSection, ByStrips) {
  const auto head = [](double x) { return 710 - 30 * std::clamp((x - 900) / 237.590, 0.0, 1.0); };
  const std::vector<SectionBlock> blocks = section_blocks(vaiont_section(), drawn_down);
  const double ends[] = {20.8119, 718.3777, 818.3777, 1214.3866};
  for (int k = 0; k < 3; ++k) {
    const Strips strips = by_strips(ends[k], ends[k + 1], head);
    EXPECT_NEAR(blocks[k].area, strips.area, 1e-6 * strips.area);
    EXPECT_NEAR(blocks[k].vertical, 23500 * strips.area - strips.lift, 1e-6 * 23500 * strips.area);
    EXPECT_NEAR(blocks[k].horizontal, strips.push, 1e-6 * 23500 * strips.area);
  }
}

// every force from block to block is a compression, and so the blocks stay together
TEST(VaiontSection, ForcesAreCompressions) {
  for (const SectionLoads& loads : {SectionLoads{}, water(90), drawn_down}) {
    const std::vector<SectionBlock> blocks = section_blocks(vaiont_section(), loads);
    const double slide = critical_slide_friction(blocks, rock, vertical);
    const std::vector<double> forces = section_forces(blocks, {slide, rock});
    EXPECT_GT(forces[0], 0);
    EXPECT_GT(forces[1], forces[0] - forces[1]);
    EXPECT_NEAR(forces[2] / forces[0], 0, 1e-12);
    EXPECT_NEAR(critical_horizontal_coefficient(blocks, {slide, rock}), 0, 1e-12);
    EXPECT_NEAR(section_factor_of_safety(blocks, {slide, rock}), 1, 1e-12);
  }
}

TEST(VaiontSection, Limits) {
  // a slide without bends: its own dip, whatever the water's level; a table as steep as it, above it: no contact force
  const SlideSection plane{{{0, 100}, {200, 0}, {300, 0}, {100, 100}}, {{0, 100}, {200, 0}}};
  for (const double level : {-1.0, 30.0, 200.0}) {
    SectionLoads loads;
    loads.table = {{0, level}};
    const std::vector<SectionBlock> blocks = section_blocks(plane, loads);
    EXPECT_NEAR(critical_slide_friction(blocks, rock, vertical), std::atan(0.5), 1e-12);
  }
  // a table parallel to the slide, above the rock: pushes and lifts by gamma_w
  SectionLoads full;
  full.table = {{-1000, 650}, {1000, -350}};
  const double lifted = 23500 - 9810, pushed = 9810 * 0.5;
  const std::vector<SectionBlock> blocks = section_blocks(plane, full);
  EXPECT_NEAR(blocks[0].horizontal / blocks[0].vertical, pushed / lifted, 1e-12);
  EXPECT_NEAR(section_forces(blocks, {std::atan(0.5) + std::atan2(pushed, lifted), rock}).back() / blocks[0].vertical,
              0, 1e-12);
  // water without weight, or below all, has no effect; smooth cross joints give less than rough ones
  EXPECT_NEAR(critical_deg(vaiont_section(), water(-1)), critical_deg(vaiont_section()), 1e-12);
  EXPECT_GT(critical_deg(vaiont_section(), {}, 0), critical_deg(vaiont_section(), {}, rock));
  // dry, the rock's unit weight does not matter; nor wet, if the water's changes with it
  SectionLoads heavy = water(90);
  heavy.unit_weight *= 7;
  heavy.water_unit_weight *= 7;
  EXPECT_NEAR(critical_deg(vaiont_section(), heavy), critical_deg(vaiont_section(), water(90)), 1e-12);
}

TEST(VaiontSection, Scaling) {
  SlideSection large = vaiont_section();
  for (std::vector<SectionPoint>* points : {&large.outline, &large.slide})
    for (SectionPoint& point : *points)
      point = {3 * point.x, 3 * point.y};
  SectionLoads wet;
  wet.table = {{0, 3 * 710.0}};
  EXPECT_NEAR(critical_deg(large, wet), critical_deg(vaiont_section(), water(90)), 1e-11);
}

TEST(VaiontSection, RefusesInvalidInput) {
  SectionLoads crooked;
  crooked.table = {{900, 710}, {800, 680}};
  EXPECT_THROW(section_blocks(vaiont_section(), crooked), std::invalid_argument);
  EXPECT_THROW(section_blocks({{{0, 0}, {1, 0}, {0, 1}}, {{0, 0}}}, {}), std::invalid_argument);
  EXPECT_THROW(section_blocks(vaiont_section(), {}, 0), std::invalid_argument);
  EXPECT_THROW(vaiont_section(0.5), std::invalid_argument);
  EXPECT_THROW(critical_slide_friction({{-0.1, 1, 1, 0}}, rock, vertical), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::section_test
