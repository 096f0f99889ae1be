#include "reference/tunnel/network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "reference/tunnel/blocks.hpp"
#include "reference/tunnel/ring_moment.hpp"

using namespace voussoir::reference::network;

namespace voussoir::reference::network_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double kn = 5e9, ks = 0.5e9;

Block ground(const Polygon& polygon) {
  return {{polygon}, {true, true, true}};
}

std::string refusal(const Network& network) {
  try {
    solve(network);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Network, HungBlock) {
  Network network;
  network.blocks = {ground(box(-2, 1, 2, 2)), {{box(-1, 0, 1, 1)}}};
  network.blocks[1].held[0] = true;
  network.blocks[1].load[1] = -6e4;
  for (const double x : {-0.8, 0.0, 0.8})
    network.bolts.push_back({0, 1, {x, 1.5}, {x, 0.5}, {0, -1}, 2e8});
  const Solution even = solve(network);
  for (const BoltForce& bolt : even.bolts)
    EXPECT_NEAR(bolt.axial, 2e4, 1e-8);
  EXPECT_NEAR(even.blocks[1][1], -1e-4, 1e-16);
  // two bolts, weight off their middle: the lever rule, and the resulting rotation
  network.bolts.erase(network.bolts.begin() + 1);
  network.blocks[1].load = {};
  add_force(network.blocks[1], {0.4, 0.7}, {0, -6e4});
  const Solution lever = solve(network);
  EXPECT_NEAR(lever.bolts[0].axial, 1.5e4, 1e-8);
  EXPECT_NEAR(lever.bolts[1].axial, 4.5e4, 1e-8);
  EXPECT_NEAR(lever.blocks[1][2], -3e4 / 2e8 / 1.6, 1e-15);
  EXPECT_NEAR(displacement(network, lever, 1, {0.8, 0.1})[1], -4.5e4 / 2e8, 1e-15);
}

// As stiff as a mass with a joint every L, E = kn L and G = ks L (Eqs 5.6, 5.7, 6.1, 6.2). Square blocks of side L on
// each other, pressed, pushed and turned at the top: every joint shortens by N/(kn L), slips by V/(ks L) and turns by M
// over kn L³/12, or kn L³/16 if its two points have no spread of their own.
TEST(Network, Column) {
  constexpr int count = 6;
  constexpr double side = 2, pressed = 3e5, pushed = 1e4;
  for (const bool with_spread : {true, false}) {
    Network network;
    network.blocks.push_back(ground(box(-3, -1, 3, 0)));
    for (int i = 0; i < count; ++i)
      network.blocks.push_back({{box(-1, side * i, 1, side * (i + 1))}});
    network.springs = springs(faces(network.blocks, 1e-6), 2, kn, ks, with_spread);
    ASSERT_EQ(network.springs.size(), 2u * count);
    const double top = count * side;
    add_force(network.blocks.back(), {0, top}, {pushed, -pressed});
    const Solution solution = solve(network);
    const double bending = kn * side * side * side / (with_spread ? 12 : 16);
    double across = 0, turn = 0;
    for (int i = 0; i < count; ++i) {
      const double above = top - side * i;  // of the push over this joint
      turn -= pushed * above / bending;
      across += pushed / (ks * side) + pushed * above / bending * above;
    }
    EXPECT_NEAR(solution.blocks.back()[2], turn, 1e-12 * std::abs(turn));
    const Point moved = displacement(network, solution, count, {0, top});
    EXPECT_NEAR(moved[0], across, 1e-11 * across);
    EXPECT_NEAR(moved[1], -count * pressed / (kn * side), 1e-13);
    // the lowest joint: total force and moment of its two springs, force by force
    double thrust = 0, shear = 0, couple = 0;
    for (int i = 0; i < 2; ++i) {
      const SpringForce& force = solution.springs[i];
      thrust += force.normal;
      shear += force.shear;
      couple += force.couple + network.springs[i].at[0] * force.normal;
    }
    EXPECT_NEAR(thrust, pressed, 1e-6);
    EXPECT_NEAR(shear, pushed, 1e-6);  // normal up: turned by 90° it points left, as does the joint's force
    EXPECT_NEAR(couple, pushed * top, 1e-6);
    EXPECT_LT(solution.unbalanced, 1e-12);
  }
}

TEST(Network, PretensionOverJoints) {
  for (const int joints : {1, 10}) {
    Network network;
    network.blocks.push_back(ground(box(-1, -1, 1, 0)));
    for (int i = 0; i < joints; ++i)
      network.blocks.push_back({{box(-0.5, i, 0.5, i + 1)}});
    const std::vector<Face> joined = faces(network.blocks, 1e-6);
    network.springs = springs(joined, 2, 1e9, 1e8);
    network.bolts = bolts_across(joined, {0, joints - 0.5}, {0, -0.5}, 2e8, 0.0336, 1e7, 1e5);
    ASSERT_EQ(network.bolts.size(), static_cast<std::size_t>(joints));
    const Solution solution = solve(network);
    for (const BoltForce& bolt : solution.bolts) {
      EXPECT_NEAR(bolt.axial, 1e5 * 1e9 / (1e9 + 2e8), 1e-6);
      EXPECT_NEAR(bolt.across, 0, 1e-6);
    }
    for (const SpringForce& spring : solution.springs)
      EXPECT_NEAR(spring.normal, 0.5 * solution.bolts[0].axial, 1e-6);
  }
}

// One joint at an angle to its bolt, which is a dowel too: springs add up in one frame.
TEST(Network, BoltAndDowelAcrossOneJoint) {
  Network network;
  network.blocks = {ground(box(-1, -1, 1, 0)), {{box(-1, 0, 1, 2)}}};
  const std::vector<Face> joint = faces(network.blocks, 1e-6);
  network.springs = springs(joint, 2, 1e9, 1e8);
  const double angle = 0.5, axial = 3e8, across = 7e7;
  const Point toe{-std::sin(angle), -std::cos(angle)};
  network.bolts = bolts_across(joint, {-toe[0], -toe[1]}, toe, axial, 0, across);
  ASSERT_EQ(network.bolts.size(), 1u);
  EXPECT_EQ(network.bolts[0].first, 1);
  network.blocks[1].held[2] = true;
  network.blocks[1].load = {2e5, 1e5, 0};
  const Solution solution = solve(network);
  const double c = std::cos(angle), s = std::sin(angle);
  const double xx = 2e8 + axial * s * s + across * c * c, yy = 2e9 + axial * c * c + across * s * s,
               xy = (axial - across) * s * c, det = xx * yy - xy * xy;
  const double x = (2e5 * yy - 1e5 * xy) / det, y = (1e5 * xx - 2e5 * xy) / det;
  EXPECT_NEAR(solution.blocks[1][0], x, 1e-15);
  EXPECT_NEAR(solution.blocks[1][1], y, 1e-15);
  EXPECT_NEAR(solution.bolts[0].axial, axial * (x * s + y * c), 1e-7);
  // the turned axis is (cos, -sin); the second block does not move, the first drags it along
  EXPECT_NEAR(solution.bolts[0].across, across * (x * c - y * s), 1e-7);
}

// A dowel off the centroids: the forces on both blocks have one line of action, so that the assembly stays in balance.
TEST(Network, DowelKeepsTheBalanceOfMoments) {
  Network network;
  network.blocks = {ground(box(-1, -1, 1, 0)), {{box(-1, 0, 1, 2)}}};
  network.springs = springs(faces(network.blocks, 1e-6), 2, 1e9, 1e8);
  network.bolts = {{1, 0, {0.3, 0.4}, {0.3, -0.2}, {0, -1}, 1e8, 5e8}};
  add_force(network.blocks[1], {1, 1.7}, {1e5, 0});
  const Solution solution = solve(network);
  double moment = 1.7 * -1e5;  // about the origin, on the upper block
  for (std::size_t i = 0; i < 2; ++i)
    moment += network.springs[i].at[0] * solution.springs[i].normal + solution.springs[i].couple;
  moment += 0.3 * -solution.bolts[0].axial;       // pulls it down
  moment += -(-0.2) * -solution.bolts[0].across;  // turned axis (1, 0): on the second across, on this minus that
  EXPECT_NEAR(moment, 0, 1e-6);
}

// Installed after half of the load, bolt and dowel take half of their forces under the full load, pretension apart.
TEST(Network, InstalledUnderLoad) {
  Network network;
  network.blocks = {ground(box(-1, -1, 1, 0)), {{box(-1, 0, 1, 2)}}};
  network.springs = springs(faces(network.blocks, 1e-6), 2, 1e9, 1e8);
  Network bare = network;
  add_force(bare.blocks[1], {1, 1.7}, {0.5e5, 0.2e5});
  network.bolts = {{1, 0, {0.3, 0.4}, {0.5, -0.2}, {std::sqrt(0.1), -std::sqrt(0.9)}, 1e8, 5e8}};
  add_force(network.blocks[1], {1, 1.7}, {1e5, 0.4e5});
  const BoltForce at_once = solve(network).bolts[0];
  install(network, solve(bare));
  const BoltForce late = solve(network).bolts[0];
  ASSERT_GT(std::abs(at_once.axial), 1e3);
  ASSERT_GT(std::abs(at_once.across), 1e3);
  EXPECT_NEAR(late.axial, at_once.axial / 2, 1e-7);
  EXPECT_NEAR(late.across, at_once.across / 2, 1e-7);
  network.blocks.pop_back();
  EXPECT_THROW(install(network, solve(bare)), std::invalid_argument);
}

// Long beam on springs, load in the middle: w = P b/(2 k), M = P/(4 b), b = (k/4EI)^(1/4) (Hetényi 1946).
TEST(Network, BeamOnAnElasticFoundation) {
  constexpr double ei = 56.25e6, foundation = 1e9, load = 1e5;
  const double b = std::pow(foundation / (4 * ei), 0.25);
  double error[2];
  for (const int finer : {0, 1}) {
    const int half = 200 << finer;
    const double beam = 12 / b / half;
    Network network;
    network.blocks = {ground(box(-30, -1, 30, 0))};
    network.lining = {{}, false, 7.5e9, ei, {}};
    for (int i = -half; i <= half; ++i)
      network.lining.nodes.push_back({{beam * i, 0}});
    network.lining.nodes[half].load[1] = -load;
    const Face face{0, -1, {30, 0}, {-30, 0}, {0, 1}};
    tie_to_wall(network.lining, {face}, foundation, 1e6, 1e-9);
    const Solution solution = solve(network);
    const BeamForce& middle = solution.beams[half];
    EXPECT_NEAR(solution.nodes[half][1], -load * b / (2 * foundation), 2e-3 * load * b / (2 * foundation));
    EXPECT_NEAR(middle.start_moment, -load / (4 * b), 2e-3 * load / (4 * b));  // bent outwards: the inside is above
    EXPECT_NEAR(middle.start_moment, solution.beams[half - 1].end_moment, 1e-6);
    const double own = foundation * beam * -solution.nodes[half][1];  // of the tie under the load
    EXPECT_NEAR(middle.shear, (load - own) / 2, 1e-4);
    EXPECT_NEAR(middle.thrust, 0, 1e-6);
    error[finer] = std::abs(middle.start_moment + load / (4 * b));
  }
  EXPECT_NEAR(error[0] / error[1], 4, 0.1);
}

Lining ring(int count, double radius, double axial, double bending) {
  Lining lining{{}, true, axial, bending, {}};
  for (int i = 0; i < count; ++i)
    lining.nodes.push_back({{radius * std::cos(2 * pi * i / count), radius * std::sin(2 * pi * i / count)}});
  return lining;
}

void press(Lining& lining, int i, double pressure) {
  const double count = static_cast<double>(lining.nodes.size());
  const Point& at = lining.nodes[i].at;
  const double force = 2 * std::sin(pi / count) * pressure;  // over a chord, along the unit radius times the radius
  lining.nodes[i].load = {-force * at[0], -force * at[1], 0};
}

TEST(Network, RingUnderUniformPressure) {
  constexpr int count = 96;
  Network network;
  network.lining = ring(count, 5, 7.5e9, 56.25e6);
  network.lining.nodes[0].held = {true, true, true};
  for (int i = 0; i < count; ++i)
    press(network.lining, i, 1e5);
  for (const BeamForce& beam : solve(network).beams) {
    EXPECT_NEAR(beam.thrust, 5e5, 1e-3);
    EXPECT_NEAR(beam.start_moment, 0, 1e-2);
    EXPECT_NEAR(beam.shear, 0, 1e-2);
  }
}

// p cos 2t on an inextensible ring: M = p a²/3 at the greatest pressure, w = p a⁴/(9 EI)
TEST(Network, RingUnderAnOvalPressure) {
  constexpr double radius = 5, ei = 56.25e6, pressure = 1e5;
  double error[2];
  for (const int finer : {0, 1}) {
    const int count = 48 << finer;
    Network network;
    network.lining = ring(count, radius, 1e14, ei);
    for (int i = 0; i < count; ++i)
      press(network.lining, i, pressure * std::cos(4 * pi * i / count));
    network.lining.nodes[0].held = {false, true, true};  // symmetric: no reaction
    network.lining.nodes[count / 2].held = {false, true, false};
    network.lining.nodes[count / 4].held = {true, false, false};
    const Solution solution = solve(network);
    const double moment = solution.beams[0].start_moment;
    error[finer] = std::abs(moment / (pressure * radius * radius / 3) - 1);
    EXPECT_LT(error[finer], 5e-3);
    EXPECT_NEAR(solution.beams[count / 4].start_moment, -moment, 1e-6 * moment);
    EXPECT_NEAR(solution.nodes[0][0] / -(pressure * std::pow(radius, 4) / (9 * ei)), 1, 5e-3);
    const double slope = (solution.beams[0].end_moment - moment) /
                         std::hypot(radius * (1 - std::cos(2 * pi / count)), radius * std::sin(2 * pi / count));
    EXPECT_NEAR(solution.beams[0].shear, slope, 1e-6 * std::abs(slope));
  }
  EXPECT_NEAR(error[0] / error[1], 4, 0.2);
}

// A lining of twelve straight sides, pressed by d = 1 mm by rigid sides without friction. Each side is a beam on an
// elastic foundation, EI w'''' + K w = K d, w'(±h) = 0, and its ends yield to the thrust of the sides, w(h)
// tan²(pi/12) EA/h = K int (d - w) over half a side: 4.97708 kN, -595.35 and 297.57 N m; 967.499 kN, -89017.7, 32401.4
// N m.
TEST(Network, TwelveSidesPressedInwards) {
  constexpr int sides = 12, beams = 20;
  constexpr double inscribed = 5;
  const double half = inscribed * std::tan(pi / sides);
  const auto on_side = [&](int side, double from_middle, double outwards) {
    const double angle = 2 * pi * side / sides, r = inscribed + outwards;
    return Point{r * std::cos(angle) - from_middle * std::sin(angle),
                 r * std::sin(angle) + from_middle * std::cos(angle)};
  };
  const auto pressed = [&](double interface) {
    Network network;
    network.lining = {{}, true, 7.5e9, 56.25e6, {}};
    Polygon outline;
    for (int side = 0; side < sides; ++side) {
      Block rock =
          ground({on_side(side, -half, 0), on_side(side, -half, 1), on_side(side, half, 1), on_side(side, half, 0)});
      const double angle = 2 * pi * side / sides;
      rock.imposed = {-1e-3 * std::cos(angle), -1e-3 * std::sin(angle), 0};
      network.blocks.push_back(rock);
      outline.push_back(on_side(side, -half, 0));
      for (int i = 0; i < beams; ++i)
        network.lining.nodes.push_back({on_side(side, half * (2.0 * i / beams - 1), 0)});
    }
    tie_to_wall(network.lining, wall(network.blocks, outline, 1e-6), interface, 0, 1e-6);
    EXPECT_EQ(network.lining.ties.size(), static_cast<std::size_t>(sides * (beams + 1)));
    return solve(network);
  };
  const Solution soft = pressed(1e6), stiff = pressed(1e9);
  for (int side = 0; side < sides; ++side) {
    const BeamForce &vertex = soft.beams[side * beams], &middle = soft.beams[side * beams + beams / 2];
    EXPECT_NEAR(vertex.thrust, 4977.08, 1e-3 * 4977.08);
    EXPECT_NEAR(vertex.start_moment, -595.35, 1e-2 * 595.35);
    EXPECT_NEAR(middle.start_moment, 297.57, 1e-2 * 297.57);
    const BeamForce &hard = stiff.beams[side * beams], &centre = stiff.beams[side * beams + beams / 2];
    EXPECT_NEAR(hard.thrust, 967499, 1e-3 * 967499);
    EXPECT_NEAR(hard.start_moment, -89017.7, 1e-2 * 89017.7);
    EXPECT_NEAR(centre.start_moment, 32401.4, 1e-2 * 32401.4);
  }
  // a soft interface presses evenly: the ripple of a polygon under pressure
  const double pressure = soft.beams[0].thrust / inscribed;
  const auto vertex = voussoir::reference::polygon_under_pressure(pressure, inscribed / std::cos(pi / sides), sides, 0);
  EXPECT_NEAR(soft.beams[0].start_moment, vertex.moment, 2e-2 * std::abs(vertex.moment));
}

TEST(Network, RefusesLooseBlocksByName) {
  Network network;
  network.blocks = {ground(box(-1, -1, 1, 0)), {{box(-1, 0, 1, 1)}}, {{box(-1, 1, 1, 2)}}, {{box(-1, 2, 1, 3)}}};
  network.springs = springs(faces(network.blocks, 1e-6), 2, kn, ks);
  EXPECT_EQ(refusal(network), "");
  Network parted = network;
  std::erase_if(parted.springs, [](const Spring& s) { return s.second == 2; });
  EXPECT_NE(refusal(parted).find("block 2 is loose"), std::string::npos) << refusal(parted);
  Network hinged = network;  // one point: it may turn about it
  hinged.springs = springs(faces(network.blocks, 1e-6), 1, kn, ks, false);
  EXPECT_NE(refusal(hinged).find("mechanism"), std::string::npos) << refusal(hinged);
  EXPECT_NE(refusal(hinged).find("block "), std::string::npos);
  Network slipping = network;
  for (Spring& s : slipping.springs)
    if (s.second == 3) s.shear_stiffness = 0;
  EXPECT_NE(refusal(slipping).find("block 3 is loose, moving in x"), std::string::npos) << refusal(slipping);
  Network free_ring;
  free_ring.lining = ring(12, 5, 1e9, 1e7);
  EXPECT_NE(refusal(free_ring).find("node 0 of the lining is loose"), std::string::npos) << refusal(free_ring);
}

TEST(Network, RefusesBadNumbersByName) {
  Network good;
  good.blocks = {ground(box(-1, -1, 1, 0)), {{box(-1, 0, 1, 1)}}};
  good.springs = springs(faces(good.blocks, 1e-6), 2, kn, ks);
  good.bolts = {{1, 0, {0, 0.5}, {0, -0.5}, {0, -1}, 1e8}};
  ASSERT_EQ(refusal(good), "");
  const auto said = [&](auto&& spoil) {
    Network bad = good;
    spoil(bad);
    return refusal(bad);
  };
  EXPECT_NE(said([](Network& n) { n.springs[1].normal = {0, 2}; }).find("spring 1"), std::string::npos);
  EXPECT_NE(said([](Network& n) { n.springs[1].second = 7; }).find("spring 1"), std::string::npos);
  EXPECT_NE(said([](Network& n) { n.springs[0].length = 0; }).find("spring 0"), std::string::npos);
  EXPECT_NE(said([](Network& n) { n.springs[0].shear_stiffness = -1; }).find("spring 0"), std::string::npos);
  EXPECT_NE(said([](Network& n) { n.bolts[0].first = 0; }).find("bolt 0"), std::string::npos);
  EXPECT_NE(said([](Network& n) { n.bolts[0].axis = {0, 0}; }).find("bolt 0"), std::string::npos);
  EXPECT_NE(said([](Network& n) { std::ranges::reverse(n.blocks[1].parts[0]); }).find("block 1"), std::string::npos);
  EXPECT_NE(said([](Network& n) { n.blocks[1].parts.clear(); }).find("block 1"), std::string::npos);
  EXPECT_NE(said([](Network& n) { n.lining = ring(2, 5, 1e9, 1e7); }).find("lining"), std::string::npos);
  EXPECT_NE(said([](Network& n) { n.lining = ring(12, 5, 1e9, 0); }).find("EI"), std::string::npos);
  EXPECT_NE(said([](Network& n) {
              n.lining = ring(12, 5, 1e9, 1e7);
              std::ranges::reverse(n.lining.nodes);
            }).find("counter-clockwise"),
            std::string::npos);
  EXPECT_NE(said([](Network& n) {
              n.lining.ties.push_back({0, 0, {0, 1}, 1, 1e6, 0});
            }).find("ties"),
            std::string::npos);
}

}  // namespace
}  // namespace voussoir::reference::network_test
