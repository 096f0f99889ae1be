// The zones of the stereonet, and block theory for every pair, on 200 joints of three Fisher sets.
#include "core/key_blocks/kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/geometry/half_space.hpp"
#include "text/csv_table.hpp"

namespace voussoir::kinematics_test {
namespace {

std::vector<KinematicJoint> joints_of_file() {
  std::stringstream text;
  text << std::ifstream(std::string(VOUSSOIR_SOURCE_DIR) + "/core/testing/kinematic_joints.csv").rdbuf();
  const std::string table = text.str();
  CsvReader reader(table);
  const std::size_t set = reader.find("set").value(), dip = reader.find("dip_deg").value(),
                    direction = reader.find("dip_direction_deg").value();
  std::vector<KinematicJoint> joints;
  for (CsvRow row; reader.next(row);)
    joints.push_back({upward_normal_3d(std::stod(std::string(row.cells[dip].text)) * degree,
                                       std::stod(std::string(row.cells[direction].text)) * degree),
                      row.cells[set].text.back() - '1'});
  return joints;
}

KinematicRequest request_of(double dip, double direction, double friction) {
  return {.face = {dip * degree, direction * degree}, .friction = friction * degree};
}

// counts by angles and by vectors, of two programs that share nothing with ours
TEST(Kinematics, CountsAreThoseOfAnotherProgram) {
  const std::vector<KinematicJoint> joints = joints_of_file();
  struct Expected {
    KinematicRequest request;
    std::array<long, 2> plane;
    std::array<long, 4> wedge;
    std::array<long, 2> flexural;
    std::array<long, 3> lines, bases;
  };
  const Expected all[] = {
      {request_of(70, 180, 30), {73, 46}, {7028, 4849, 1947, 1223}, {42, 42}, {126, 88, 1782}, {46, 3, 2}},
      {request_of(65, 185, 35), {69, 50}, {5640, 3877, 2225, 1362}, {38, 37}, {144, 106, 3025}, {50, 4, 2}},
      {request_of(80, 190, 25), {81, 68}, {8254, 5630, 2206, 1433}, {41, 41}, {529, 87, 889}, {68, 1, 0}}};
  for (const Expected& expected : all) {
    const KinematicCounts found = count_kinematic(expected.request, joints);
    EXPECT_EQ(found.joints, 200);
    EXPECT_EQ(found.pairs, 19900);
    EXPECT_EQ(found.pairs_of_sets, 13100);
    EXPECT_EQ((std::array{found.plane_sliding, found.plane_sliding_within}), expected.plane);
    EXPECT_EQ((std::array{found.wedge_primary, found.wedge_primary_of_sets, found.wedge_secondary,
                          found.wedge_secondary_of_sets}),
              expected.wedge);
    EXPECT_EQ((std::array{found.flexural_toppling, found.flexural_toppling_net}), expected.flexural);
    EXPECT_EQ(found.direct_lines, expected.lines);
    EXPECT_EQ(found.direct_bases, expected.bases);
  }
}

// by plunge above friction or not: both, F < 1 and F >= 1; one, F < 1 and F >= 1; buried
using PairTable = std::array<std::array<long, 5>, 2>;

// That program has 1025 for 1026: it takes the lower end of a horizontal line, of two joints with one dip direction,
// from rounding.
TEST(Kinematics, BlockTheoryFindsWhatTheOverlayMisses) {
  const std::vector<KinematicJoint> joints = joints_of_file();
  const std::pair<KinematicRequest, PairTable> all[] = {
      {request_of(70, 180, 30), {{{4020, 1074, 1462, 0, 472}, {0, 2163, 951, 351, 542}}}},
      {request_of(65, 185, 35), {{{2722, 1412, 1199, 0, 307}, {0, 2691, 1058, 416, 607}}}},
      {request_of(80, 190, 25), {{{5084, 708, 1859, 0, 603}, {0, 1840, 1026, 91, 443}}}}};
  for (const auto& [request, expected] : all) {
    PairTable found{};
    for (const PairVerdict& pair : judge_pairs(request, joints)) {
      const int place =
          pair.motion == WedgeMotion::buried ? 4 : 2 * (pair.motion == WedgeMotion::on_one) + (*pair.factor >= 1);
      ++found[!pair.primary][place];
    }
    EXPECT_EQ(found, expected);
  }
}

TEST(Kinematics, APairHasTheFactorOfItsWedge) {
  const std::vector<KinematicJoint> joints{{upward_normal_3d(45 * degree, 120 * degree)},
                                           {upward_normal_3d(60 * degree, 230 * degree)}};
  const auto pairs = judge_pairs(request_of(75, 180, 30), joints);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].motion, WedgeMotion::on_both);
  // Hoek & Bray: F = sin β / sin(ξ/2) · tan φ / tan ψ, by the two normal forces in the plane normal to the line
  const Vector<3>&a = joints[0].normal, &b = joints[1].normal, &l = pairs[0].line;
  const Vector<3> across = Vector<3>(0, 0, -1) - l * -l.z();
  const double cosine = a.dot(b), det = 1 - cosine * cosine;
  const double first = -(across.dot(a) - cosine * across.dot(b)) / det,
               second = -(across.dot(b) - cosine * across.dot(a)) / det;
  EXPECT_NEAR(*pairs[0].factor, (first + second) * std::tan(30 * degree) / -l.z(), 1e-12);
}

TEST(Kinematics, AnOverhangingFaceLetsLinesOutThatAFaceOfTheSameStrikeHolds) {
  const std::vector<KinematicJoint> joint{{upward_normal_3d(80 * degree, 0)}};  // into a face that dips to the south
  EXPECT_EQ(count_kinematic(request_of(80, 180, 30), joint).plane_sliding, 0);
  EXPECT_EQ(count_kinematic(request_of(110, 180, 30), joint).plane_sliding, 1);
}

}  // namespace
}  // namespace voussoir::kinematics_test
