// Bolts in limit analysis: a bolted block on a plane, in plane and space, against statics by hand.
#include "core/limit/bolt_ties.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/bad_input.hpp"
#include "core/limit/limit.hpp"
#include "core/limit/without_dilation.hpp"
#include "core/scene/scene.hpp"

namespace voussoir::bolt_ties_test {
namespace {

constexpr double weight = 80e3, slope = 0.7, yield = 15e3, lean = 0.5, friction = 0.6;  // N, rad, N, rad, tan φ

// A block of 80 kN, 4 m wide and 1 m high, on a floor; gravity leans by the slope towards x. The bolt goes through the
// middle of its foot, its toe in the floor leaning away from x.
std::string block_on_floor(int dimension, const std::string& keys) {
  const double x = std::sin(lean), z = std::cos(lean), down = -10 * std::cos(slope), along = 10 * std::sin(slope);
  const auto place = [&](double u, double w) {
    return dimension == 2 ? fmt::format("[{}, {}]", u, w) : fmt::format("[{}, 0.25, {}]", u, w);
  };
  const std::string box = dimension == 2
                              ? "{ name = \"floor\", box = { min = [-9, -3], max = [9, 0] }, fixed = true },\n"
                                "{ name = \"block\", box = { min = [-2, 0], max = [2, 1] } }"
                              : "{ name = \"floor\", box = { min = [-9, -3, -3], max = [9, 3, 0] }, fixed = true },\n"
                                "{ name = \"block\", box = { min = [-2, 0, 0], max = [2, 0.5, 1] } }";
  return fmt::format(
      "dimension = {}\ngravity = {}\ndensity = {}\nblocks = [{}]\njoint_properties = [{{ name = \"rock\", "
      "normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = {} }}]\nbolts = [{{ name = \"b\", from = {}, to = "
      "{}, {} }}]\nstage = [{{ name = \"s\", kind = \"settle\", install = [\"b\"] }}]\n",
      dimension, dimension == 2 ? fmt::format("[{}, {}]", along, down) : fmt::format("[{}, 0, {}]", along, down),
      dimension == 2 ? 2000 : 4000, box, std::atan(friction) * 180 / std::numbers::pi, place(0.5 * x, 0.5 * z),
      place(-2 * x, -2 * z), keys);
}

template <int Dim>
struct Bolted {
  Model<Dim> model;
  CornerAssembly<Dim> assembly;
  Loads<Dim> gravity;

  explicit Bolted(const std::string& keys)
      : model(prepare<Dim>(parse_scene(block_on_floor(Dim, keys), "scene.toml")).model),
        assembly(corner_assembly(model, model.gravity.norm())),
        gravity(loads_of_acceleration(model, model.gravity)) {
    assembly.ties = ties_of(model);
  }
  std::vector<bool> all() const { return std::vector<bool>(assembly.faces.size(), true); }
};

template <int Dim>
void expect_statics() {
  const double normal = weight * std::cos(slope), shear = weight * std::sin(slope);
  const Bolted<Dim> tied("stiffness = 1e8, yield = 15e3");
  ASSERT_EQ(tied.assembly.ties.size(), 1u);
  EXPECT_EQ(tied.assembly.ties[0].least, -yield);
  const CriticalStrength<Dim> critical = find_critical_friction(tied.assembly, tied.gravity, tied.all());
  const double pressed = normal + yield * std::cos(lean), driven = shear - yield * std::sin(lean);
  EXPECT_EQ(critical.status, LimitStatus::found);
  EXPECT_NEAR(critical.stands, std::atan(driven / pressed), 5e-8);
  ASSERT_EQ(critical.state.tensions.size(), 1u);
  EXPECT_NEAR(critical.state.tensions[0], yield, 1e-4 * yield);

  const CriticalStrength<Dim> factor = find_factor_of_safety(tied.assembly, tied.gravity, tied.all());
  EXPECT_NEAR(factor.stands, friction * pressed / driven, 1e-6);

  // gravity alone is multiplied, the bolt is not
  const LoadFactor<Dim> load = find_load_factor(tied.assembly, Loads<Dim>(tied.gravity.size()), tied.gravity);
  EXPECT_NEAR(load.factor, yield * (std::sin(lean) + friction * std::cos(lean)) / (shear - friction * normal), 1e-6);

  // a dowel resists the slip by itself, as far as the lean lets it
  const Bolted<Dim> dowel("stiffness = 1e8, yield = 15e3, dowel_stiffness = 1e8, dowel_strength = 8e3");
  const double held = driven - 8e3 * std::cos(lean), lifted = pressed - 8e3 * std::sin(lean);
  EXPECT_NEAR(find_critical_friction(dowel.assembly, dowel.gravity, dowel.all()).stands, std::atan(held / lifted),
              5e-8);

  // pushed the other way by a fifth of that, less steeply than the bolt leans: a cable hangs loose, a bar pushes back
  Loads<Dim> back = tied.gravity;
  for (Load<Dim>& of_body : back)
    of_body.force[0] *= -0.2;
  const Bolted<Dim> cable("stiffness = 1e8, yield = 15e3, tension_only = true");
  EXPECT_EQ(cable.assembly.ties[0].least, 0);
  EXPECT_NEAR(find_critical_friction(tied.assembly, back, tied.all()).stands,
              std::atan((0.2 * shear - yield * std::sin(lean)) / (normal - yield * std::cos(lean))), 5e-8);
  EXPECT_NEAR(find_critical_friction(cable.assembly, back, cable.all()).stands, std::atan(0.2 * shear / normal), 5e-8);
}

TEST(BoltTies, HoldABlockUpToTheirYield) {
  expect_statics<2>();
  expect_statics<3>();
}

// sliding on one plane needs no dilation: the least and the largest factor are the one with it
TEST(BoltTies, AreTheSameWithoutDilation) {
  const Bolted<3> tied("stiffness = 1e8, yield = 15e3");
  const Loads<3> none(tied.gravity.size());
  const FactorWithoutDilation<3> found = find_factor_without_dilation(tied.assembly, none, tied.gravity, {});
  const double factor = find_load_factor(tied.assembly, none, tied.gravity).factor;
  EXPECT_NEAR(found.least.factor, factor, 1e-4 * factor);
  EXPECT_NEAR(found.largest.factor, factor, 1e-4 * factor);
}

TEST(BoltTies, RefuseWhatHasNoBound) {
  const auto message = [](const std::string& keys) {
    try {
      Bolted<2> refused(keys);
    } catch (const BadInput& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(message("stiffness = 1e8").find("bolts 'b' state no yield"), std::string::npos);
  EXPECT_NE(message("kind = \"grouted\", axial_stiffness = 1e8, bond_stiffness = 1e8").find("or bond_strength"),
            std::string::npos);
}

TEST(BoltTies, RefuseAGroutedBarAcrossSeveralJoints) {
  const auto model = prepare<2>(parse_scene(R"(dimension = 2
gravity = [0, -10]
density = 2000
blocks = [
  { name = "floor", box = { min = [-1, -3], max = [1, 0] }, fixed = true },
  { name = "lower", box = { min = [-1, 0], max = [1, 1] } },
  { name = "upper", box = { min = [-1, 1], max = [1, 2] } },
]
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 30 }]
bolts = [{ name = "b", from = [0, 2], to = [0, -2], kind = "grouted", axial_stiffness = 1e8, bond_stiffness = 1e8, yield = 15e3 }]
stage = [{ name = "s", kind = "settle", install = ["b"] }]
)",
                                            "scene.toml"))
                         .model;
  EXPECT_THROW(ties_of(model), BadInput);
}

// 0.5 m of the bar in the block, 2 m in the floor
TEST(BoltTies, AGroutedBarPullsNoMoreThanItsBond) {
  const std::string bar = "kind = \"grouted\", axial_stiffness = 1e8, bond_stiffness = 1e8, ";
  const auto bounds = [&](const std::string& keys) {
    const CornerTie<2> tie = Bolted<2>(bar + keys).assembly.ties.at(0);
    return std::pair(tie.least, tie.most);
  };
  const auto near = [](std::pair<double, double> found, double least, double most) {
    EXPECT_NEAR(found.first, least, 1e-6);
    EXPECT_NEAR(found.second, most, 1e-6);
  };
  near(bounds("yield = 15e3"), -15e3, 15e3);                      // the bond never slips
  near(bounds("yield = 15e3, bond_strength = 10e3"), -5e3, 5e3);  // out of the block
  near(bounds("bond_strength = 10e3, free_length = 0.2"), -3e3, 3e3);
  const std::string plate = ", plate = \"spring\", plate_stiffness = 1e8";
  near(bounds("yield = 15e3, bond_strength = 10e3" + plate), -5e3, 15e3);
  near(bounds("yield = 15e3, bond_strength = 4e3" + plate), -2e3, 8e3);  // out of the floor
  near(bounds("bond_strength = 4e3, plate = \"tied\""), -8e3, 8e3);

  const Bolted<2> tied(bar + "yield = 15e3, bond_strength = 10e3");
  const double normal = weight * std::cos(slope), shear = weight * std::sin(slope);
  EXPECT_NEAR(find_critical_friction(tied.assembly, tied.gravity, tied.all()).stands,
              std::atan((shear - 5e3 * std::sin(lean)) / (normal + 5e3 * std::cos(lean))), 5e-8);
}

}  // namespace
}  // namespace voussoir::bolt_ties_test
