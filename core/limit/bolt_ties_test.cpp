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
  EXPECT_NE(message("kind = \"grouted\", axial_stiffness = 1e8, bond_stiffness = 1e8, yield = 15e3").find("grouted"),
            std::string::npos);
}

}  // namespace
}  // namespace voussoir::bolt_ties_test
