// Derivatives of block theory's least factor, against closed forms differentiated by the chain rule in 60 digits.
#include "app/blocks/blocks_derivatives.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/testing/derivative_row.hpp"
#include "core/scene/scene.hpp"
#include "text/angle.hpp"

namespace voussoir::blocks_derivatives_test {
namespace {

namespace fs = std::filesystem;
using Overrides = std::vector<std::string>;

DerivativeTable derivatives_of(const char* file, const Overrides& overrides) {
  return blocks_derivatives(read_scene(fs::path(VOUSSOIR_SOURCE_DIR) / file, overrides), {});
}

bool is_still(const DerivativeTable& table, const std::string& key) {
  return std::ranges::find(table.still, key) != table.still.end();
}

struct Expected {
  const char* key;
  double value;  // by the key's unit
};

// F = tan φ / tan φ* of joints without cohesion and one friction angle: φ* = atan(tan φ / F), in degrees
double of_critical(double by_factor, double factor, double tan_friction) {
  return -by_factor * tan_friction / (factor * factor + tan_friction * tan_friction) / degree;
}

// `scale`: the table's derivatives by the key's unit
void expect_critical(const DerivativeTable& table, double friction_deg, const std::vector<Expected>& expected,
                     double relative) {
  const double tangent = std::tan(friction_deg * degree), factor = table.base.value.value();
  for (const auto& [key, value] : expected) {
    const Derivative& found = row_of(table, key).derivative;
    ASSERT_TRUE(found.value) << key;
    const double error = of_critical(*found.value, factor, tangent) - value;
    EXPECT_LE(std::abs(error), relative * std::abs(value)) << key;
    // the bar holds, beside the digits of the reference and of the conversion
    const double bar = std::abs(of_critical(found.bar, factor, tangent)) + 4e-13 * std::abs(value);
    EXPECT_LE(std::abs(error), bar) << key;
  }
}

struct DryWedge {
  double dip_a, direction_a, dip_b, direction_b, critical, by_dip_a, by_direction_a, by_dip_b;
};

// critical friction and its derivatives, deg/deg; a turn of both directions is a turn of the scene
constexpr DryWedge dry_wedges[] = {
    {40, 130, 60, 220, 33.3572214088341, 0.60753378651706, 0.29961971769537, 0.22224978710471},
    {45, 105, 70, 235, 21.9125339592438, 0.33974309591724, 0.47301843174119, 0.14216198169903},
    {56.137086019032, 121.61900653746, 56.137086019032, 238.38099346254, 28.9185592849554, 0.31538621807732,
     0.47404673447933, 0.31538621807732},
    {50, 160, 65, 220, 49.3081637927137, 0.74425965231912, 0.19624884167141, 0.31404160204499}};

TEST(BlocksDerivatives, DryWedgesAreThoseOfTheClosedForm) {
  for (const DryWedge& wedge : dry_wedges) {
    const DerivativeTable table = derivatives_of(
        "cases/wedge/scene.toml",
        {fmt::format("joints.A.dip={}", wedge.dip_a), fmt::format("joints.A.dip_direction={}", wedge.direction_a),
         fmt::format("joints.B.dip={}", wedge.dip_b), fmt::format("joints.B.dip_direction={}", wedge.direction_b),
         "joint_properties.rock.friction_deg=50"});
    const double tangent = std::tan(50 * degree);
    EXPECT_NEAR(std::atan(tangent / *table.base.value) / degree, wedge.critical, 1e-11);
    expect_critical(table, 50,
                    {{"joints.A.dip", wedge.by_dip_a},
                     {"joints.A.dip_direction", wedge.by_direction_a},
                     {"joints.B.dip", wedge.by_dip_b},
                     {"joints.B.dip_direction", -wedge.by_direction_a}},
                    1e-9);
    const double turn = *row_of(table, "joints.A.dip_direction").derivative.value +
                        *row_of(table, "joints.B.dip_direction").derivative.value;
    EXPECT_LE(std::abs(turn), 1e-10 * std::abs(*row_of(table, "joints.A.dip_direction").derivative.value));
    // d ln F/d ln tan φ = 1
    EXPECT_NEAR(*row_of(table, "joint_properties.rock.friction_deg").derivative.value,
                *table.base.value * degree / (std::sin(50 * degree) * std::cos(50 * degree)), 1e-10);
    EXPECT_TRUE(is_still(table, "density"));
    EXPECT_TRUE(is_still(table, "domain.planes.slope face.dip"));
  }
}

TEST(BlocksDerivatives, WetWedgesAreThoseOfTheClosedForm) {
  struct WetWedge {
    double pressure, critical;
    std::vector<Expected> by;
  };
  const double per_pa = 1e-3, per_density = 9.81e-3;
  const WetWedge wedges[] = {{500,
                              39.0719116555938,
                              {{"joints.A.dip", 0.81519649637083},
                               {"joints.A.dip_direction", 0.37092281824094},
                               {"joints.B.dip", 0.37343417871256},
                               {"joints.B.dip_direction", -0.42022887543105},
                               {"domain.planes.slope face.dip", -0.15673778777468},
                               {"domain.planes.slope face.dip_direction", 0.049306057190107},
                               {"water.joints.pressure", 13.079660628974 * per_pa},
                               {"density", -0.33332468473431 * per_density}}},
                             {1000,
                              46.6373269504962,
                              {{"joints.A.dip", 1.1070984021083},
                               {"joints.A.dip_direction", 0.46320778093733},
                               {"joints.B.dip", 0.60514981889762},
                               {"joints.B.dip_direction", -0.59440886497209},
                               {"domain.planes.slope face.dip", -0.41707183330357},
                               {"domain.planes.slope face.dip_direction", 0.13120108403477},
                               {"water.joints.pressure", 17.402178871368 * per_pa},
                               {"density", -0.88696120649174 * per_density}}}};
  for (const WetWedge& wedge : wedges) {
    const DerivativeTable table =
        derivatives_of("cases/water/wedge_pressure.toml", {fmt::format("water.joints.pressure={}", wedge.pressure)});
    EXPECT_NEAR(std::atan(std::tan(70 * degree) / *table.base.value) / degree, wedge.critical, 1e-10);
    expect_critical(table, 70, wedge.by, 1e-9);
  }
}

// the crack 4 m behind the crest, where the joint of 35 degrees is 9.11 m below the top; fill: of the crack
Overrides plane_failure(double fill) {
  const double back = 20 / std::tan(60 * degree) + 4, foot = back * std::tan(35 * degree);
  return {fmt::format("domain.planes.face.point=[0, 0]"), fmt::format("joints.crack.point=[{}, 0]", back),
          fmt::format("water.crack and joint.table=[[0, 0], [{}, {}]]", back, foot + fill * (20 - foot)),
          fmt::format("density={}", 26e3 / 9.81)};
}

TEST(BlocksDerivatives, PlaneFailureIsThatOfTheClosedForm) {
  const double per_n = 1e-3, per_density = 9.81e-3;
  const std::string level = "water.crack and joint.table, point 2 up",
                    water_weight = "water.crack and joint.unit_weight";
  expect_critical(derivatives_of("cases/water/scene.toml", plane_failure(0.5)), 75,
                  {{"joints.joint.dip", 0.47398342166397},
                   {"domain.planes.face.dip", -0.36577791565673},
                   {level.c_str(), 2.407794811769},
                   {"density", -0.33505859469066 * per_density},
                   {water_weight.c_str(), 0.88802481773264 * per_n}},
                  1e-9);
  expect_critical(derivatives_of("cases/water/scene.toml", plane_failure(1)), 75,
                  {{"joints.joint.dip", 0.57655036788276},
                   {"domain.planes.face.dip", -1.1104412921573},
                   {level.c_str(), 3.905264784285},
                   {"density", -1.0171825113298 * per_density},
                   {water_weight.c_str(), 2.695896564177 * per_n}},
                  1e-9);
}

TEST(BlocksDerivatives, PlaneFailureWithCohesionIsThatOfTheClosedForm) {
  struct Filled {
    double fill, factor, by_cohesion, by_friction, by_joint, by_face, by_crack, by_water, by_weight;
  };
  // by_joint, by_face: with the water's height above the joint and the crack's distance from the crest kept
  const Filled rows[] = {{0.5, 1.23545015609479, 0.010929739928608, 0.032168460241008, -0.040731361541354,
                          -0.0038105869517597, 0.0050019596926128, -0.08342761527413, -0.0013580578035097},
                         {1, 0.826615675426373, 0.0095527620112599, 0.019141503838247, -0.039739346124458,
                          0.0032986723640053, 0.020815694726141, -0.091446352752046, 0.011896064607646}};
  const double back = 20 / std::tan(60 * degree) + 4;
  // keys hold the water's level and the crack's place: the height falls as its foot rises, the distance as the crest
  // moves
  const double height_by_joint = -back / std::pow(std::cos(35 * degree), 2) * degree,
               distance_by_face = 20 / std::pow(std::sin(60 * degree), 2) * degree;
  for (const Filled& row : rows) {
    const DerivativeTable table = derivatives_of("cases/water/safety.toml", plane_failure(row.fill));
    EXPECT_NEAR(*table.base.value, row.factor, 1e-13);
    const std::pair<std::string, double> expected[] = {
        {"joint_properties.joint.cohesion", 1e-3 * row.by_cohesion},
        {"stage.critical.friction.joint.friction_deg", row.by_friction},
        {"joints.joint.dip", row.by_joint + row.by_water * height_by_joint},
        {"domain.planes.face.dip", row.by_face + row.by_crack * distance_by_face},
        {"water.crack and joint.table, point 2 up", row.by_water},
        {"density", 9.81e-3 * row.by_weight}};
    for (const auto& [key, value] : expected) {
      const Derivative& found = row_of(table, key).derivative;
      ASSERT_TRUE(found.value) << key;
      EXPECT_LE(std::abs(*found.value - value), 1e-9 * std::abs(value)) << key << " " << row.fill;
      EXPECT_LE(std::abs(*found.value - value), found.bar + 1e-12 * std::abs(value)) << key << " " << row.fill;
    }
    // the friction of joint_properties is not that of the stage
    EXPECT_TRUE(is_still(table, "joint_properties.joint.friction_deg"));
    // a vertical crack leans one way only, for beyond 90 its sides change their names
    EXPECT_TRUE(row_of(table, "joints.crack.dip").derivative.one_side);
  }
}

// F = ((W cos ψ + T sin α) tan φ + c L)/(W sin ψ - T cos α): a bolt's force T at α to the plane is part of the load,
// which `factor` counts as active; the joint is L = 2/cos ψ long across the box of 2 x 2 m
struct HeldBlock {
  long double weight, dip, friction, cohesion, bolt, bolt_dip;  // N, rad, rad, Pa, N, rad below the horizontal
  long double factor() const {
    const long double a = dip - bolt_dip;
    return ((weight * std::cos(dip) + bolt * std::sin(a)) * std::tan(friction) + cohesion * 2 / std::cos(dip)) /
           (weight * std::sin(dip) - bolt * std::cos(a));
  }
};

TEST(BlocksDerivatives, BoltedBlockIsThatOfTheClosedForm) {
  const double x = 0.7 * std::cos(10 * degree), y = 0.7 * std::sin(10 * degree);
  const Overrides bolted{fmt::format("bolts.bolt.from=[{}, {}]", x, -y), fmt::format("bolts.bolt.to=[{}, {}]", -x, y),
                         fmt::format("density={}", 1e5 / (2 * 9.81))};
  const DerivativeTable table = derivatives_of("cases/support/slope.toml", bolted);
  // by weight, with the area of 2 m2; by dip, the bolt fixed in space; by yield
  expect_critical(table, 60,
                  {{"density", 0.11627606384202e-3 * 2 * 9.81},
                   {"joints.plane.dip", 0.99456966172619 + 0.0054303382738063},
                   {"bolts.bolt.yield", -0.58138031921011e-3}},
                  1e-9);
  // with cohesion, friction 35 degrees: differences of the closed form in steps of a millionth
  Overrides cohesive = bolted;
  const double length = 2 / std::cos(40 * degree);
  cohesive.push_back("joint_properties.rock.friction_deg=35");
  cohesive.push_back("stage.settle.bond=true");
  cohesive.push_back(fmt::format("joint_properties.rock.cohesion={}", 10e3 / length));
  const DerivativeTable with = derivatives_of("cases/support/slope.toml", cohesive);
  const HeldBlock block{1e5, 40 * degree, 35 * degree, 10e3 / length, 20e3, 10 * degree};
  EXPECT_NEAR(*with.base.value, static_cast<double>(block.factor()), 1e-12);
  const auto by = [&](long double HeldBlock::*member, long double step) {
    HeldBlock more = block, less = block;
    more.*member += step;
    less.*member -= step;
    return static_cast<double>((more.factor() - less.factor()) / (2 * step));
  };
  for (const auto& [key, value] : {std::pair("density", by(&HeldBlock::weight, 0.1L) * 2 * 9.81),
                                   {"joints.plane.dip", by(&HeldBlock::dip, 1e-6L) * degree},
                                   {"joint_properties.rock.friction_deg", by(&HeldBlock::friction, 1e-6L) * degree},
                                   {"joint_properties.rock.cohesion", by(&HeldBlock::cohesion, 0.01L)},
                                   {"bolts.bolt.yield", by(&HeldBlock::bolt, 0.1L)}})
    EXPECT_NEAR(*row_of(with, key).derivative.value, value, 1e-9 * std::abs(value)) << key;
}

// 100 kN on 40 degrees with a cohesive force of 20 kN
TEST(BlocksDerivatives, CohesiveBlockIsThatOfTheClosedForm) {
  const double length = 2 / std::cos(40 * degree);
  const std::string scene = fmt::format(R"(dimension = 2
gravity = [0, -9.81]
density = {}
domain = {{ box = {{ min = [-1, -1], max = [1, 1] }} }}
joints = [{{ name = "plane", dip = 40, dip_direction = 90, point = [0, 0] }}]
joint_properties = [{{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 30, cohesion = {}, bonds = "as_sliced" }}]
fix = [{{ below = ["plane"] }}]
)",
                                        1e5 / (2 * 9.81), 20e3 / length);
  const DerivativeTable table = blocks_derivatives(parse_scene(scene, "cohesive.toml"), {});
  EXPECT_NEAR(*table.base.value, 0.999204022864053, 1e-12);
  const double by_force = 1.5557238268604e-5;
  for (const auto& [key, value] :
       {std::pair("density", -3.1114476537208e-6 * 2 * 9.81),
        {"joint_properties.rock.cohesion", by_force * length},
        // the joint becomes longer as it dips more
        {"joints.plane.dip", -0.030860130854293 + by_force * 20e3 * std::tan(40 * degree) * degree},
        {"joint_properties.rock.friction_deg", 0.027733365417653}})
    EXPECT_NEAR(*row_of(table, key).derivative.value, value, 1e-9 * std::abs(value)) << key;
}

// at this direction of A the block leaves plane B: both sides, and no number between them
TEST(BlocksDerivatives, KinkHasBothSides) {
  const DerivativeTable table = derivatives_of(
      "cases/wedge/scene.toml", {"joints.A.dip_direction=158.9767322311491", "joint_properties.rock.friction_deg=50"});
  const double tangent = std::tan(50 * degree), factor = table.base.value.value();
  EXPECT_NEAR(std::atan(tangent / factor) / degree, 40, 1e-10);
  struct Sides {
    const char* key;
    double below, above;
  };
  for (const auto& [key, below, above] : {Sides{"joints.A.dip", 1, 0.8368240888},
                                          {"joints.A.dip_direction", 0.1450913697, 0},
                                          {"joints.B.dip", 0.1855567997, 0},
                                          {"joints.B.dip_direction", 0, -0.1450913697}}) {
    const DerivativeRow& row = row_of(table, key);
    EXPECT_TRUE(row.derivative.kink) << key;
    EXPECT_FALSE(row.derivative.value) << key;
    EXPECT_NEAR(of_critical(row.derivative.below.value.value(), factor, tangent), below, 1e-8) << key;
    EXPECT_NEAR(of_critical(row.derivative.above.value.value(), factor, tangent), above, 1e-8) << key;
    EXPECT_NE(row.remark.find("kink"), std::string::npos) << row.remark;
  }
}

// near the kink the derivative is that of the side of the scene
TEST(BlocksDerivatives, BesideAKinkItIsThatOfTheScene) {
  const DerivativeTable table = derivatives_of(
      "cases/wedge/scene.toml", {"joints.A.dip_direction=158.9767", "joint_properties.rock.friction_deg=50"});
  const DerivativeRow& row = row_of(table, "joints.A.dip_direction");
  ASSERT_TRUE(row.derivative.value);
  EXPECT_TRUE(row.derivative.one_side);
  EXPECT_NEAR(of_critical(*row.derivative.value, *table.base.value, std::tan(50 * degree)), 0.1450913697, 2e-6);
  EXPECT_NE(row.remark.find("from below; above: block 1 slides on A within 3."), std::string::npos) << row.remark;
}

// a wedge whose joint A dips to 0 or 360 degrees, and whose joint B is vertical
TEST(BlocksDerivatives, NeverLeavesTheRangesOfKeys) {
  for (const double turn : {230.0, -130.0}) {
    const DerivativeTable table =
        derivatives_of("cases/wedge/scene.toml",
                       {fmt::format("joints.A.dip_direction={}", 130 + turn), "joints.B.dip_direction=90",
                        "domain.planes.slope face.dip_direction=52", "joint_properties.rock.friction_deg=50"});
    expect_critical(table, 50, {{"joints.A.dip_direction", dry_wedges[0].by_direction_a}}, 1e-9);
  }
  const DerivativeTable upright =
      derivatives_of("cases/wedge/scene.toml", {"joints.B.dip=90", "joint_properties.rock.friction_deg=50"});
  const DerivativeRow& row = row_of(upright, "joints.B.dip");
  EXPECT_TRUE(row.derivative.one_side) << row.remark;
  EXPECT_FALSE(row.refused) << row.remark;
}

constexpr const char* flat_block = R"(dimension = 2
gravity = [0, -9]
density = 2000
domain = { box = { min = [-1, -1], max = [1, 1] } }
joints = [{ name = "bed", dip = 0, point = [0, 0] }]
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 30 }]
fix = [{ below = ["bed"] }]
)";

TEST(BlocksDerivatives, NoFactorHasNoDerivative) {
  const DerivativeTable table = blocks_derivatives(parse_scene(flat_block, "flat.toml"), {});
  EXPECT_FALSE(table.base.value);
  EXPECT_TRUE(table.rows.empty());
  EXPECT_NE(table.base.reason.find("no factor, so no derivative"), std::string::npos);
}

// An integer key, and a joint that dips 0 under a push of 20 kN to the right: F = W tan φ/P, W = 36 kN. It leans either
// way: F = (W cos ψ - P sin ψ) tan φ/(W sin ψ + P cos ψ), so dF/dψ = -(1 + (W/P)²) tan φ at 0.
TEST(BlocksDerivatives, FlatJointTurnsThroughZero) {
  const std::string pushed = std::string(flat_block) + R"(
stage = [{ name = "push", kind = "settle", force = [{ name = "push", above = ["bed"], force = [20000, 0] }] }]
)";
  const DerivativeTable table = blocks_derivatives(parse_scene(pushed, "flat.toml"), {});
  const double tangent = std::tan(30 * degree), ratio = 36.0 / 20;
  EXPECT_NEAR(*table.base.value, ratio * tangent, 1e-13);
  // down to the right: to 90 degrees, where the default direction points
  EXPECT_NEAR(*row_of(table, "joints.bed.dip").derivative.value, -(1 + ratio * ratio) * tangent * degree, 1e-11);
  EXPECT_FALSE(row_of(table, "joints.bed.dip").derivative.one_side);
  EXPECT_NEAR(*row_of(table, "density").derivative.value, ratio * tangent / 2000, 1e-13);
  EXPECT_NEAR(*row_of(table, "gravity, its size").derivative.value, ratio * tangent / 9, 1e-11);
  EXPECT_NEAR(*row_of(table, "stage.push.force.push.force, its size").derivative.value, -ratio * tangent / 20000,
              1e-15);
}

}  // namespace
}  // namespace voussoir::blocks_derivatives_test
