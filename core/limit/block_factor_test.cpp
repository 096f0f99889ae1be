// The factor of a block that may turn: boxes on a floor, gravity leaning instead of it, against statics by hand.
#include "core/limit/block_factor.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/model/water_surfaces.hpp"
#include "core/scene/scene.hpp"
#include "text/angle.hpp"

namespace voussoir::block_factor_test {
namespace {

constexpr double friction = 35 * degree;

// a box on a floor, its first corner at the origin; gravity leans towards x
template <int Dim>
struct Box {
  Assembly<Dim> assembly;
  Block<Dim> block;

  Box(const Vector<Dim>& size, double lean, const std::string& bolts = "") {
    const auto list = [](const Vector<Dim>& v) {
      return Dim == 2 ? fmt::format("[{}, {}]", v[0], v[1]) : fmt::format("[{}, {}, {}]", v[0], v[1], v[Dim - 1]);
    };
    Vector<Dim> low = Vector<Dim>::Constant(-50), high = Vector<Dim>::Constant(50), gravity = Vector<Dim>::Zero();
    high[Dim - 1] = 0;
    gravity[0] = 10 * std::sin(lean);
    gravity[Dim - 1] = -10 * std::cos(lean);
    Model<Dim> model =
        prepare<Dim>(
            parse_scene(fmt::format("dimension = {}\ngravity = {}\ndensity = 1000\nblocks = [{{ name = \"floor\", box "
                                    "= {{ min = {}, max = {} }}, fixed = true }},\n{{ name = \"box\", box = {{ min = "
                                    "{}, max = {} }} }}]\njoint_properties = [{{ name = \"r\", normal_stiffness = 1e9, "
                                    "shear_stiffness = 1e8, friction_deg = 35 }}]\n{}\nstage = [{{ name = \"s\", kind "
                                    "= \"settle\"{} }}]\n",
                                    Dim, list(gravity), list(low), list(high), list(Vector<Dim>::Zero()), list(size),
                                    bolts, bolts.empty() ? "" : ", install = [\"b\"]"),
                        "box.toml"))
            .model;
    const std::vector<bool> installed(model.bolts.size(), true);
    const WaterValues water = initial_water(model);
    assembly = make_assembly(std::move(model), water, installed);
    gather<Dim>(assembly, std::array{1}, {}, block);
  }
  double factor() const { return factor_with_moments(assembly, block).value_or(-1); }
};

template <int Dim>
Vector<Dim> size_of(double length, double width, double height) {
  if constexpr (Dim == 2)
    return {length, height};
  else
    return {length, width, height};
}

template <int Dim>
void expect_statics() {
  const double slide = std::tan(friction) / std::tan(0.4);
  EXPECT_NEAR(Box<Dim>(size_of<Dim>(3, 2, 1), 0.4).factor(), slide, 1e-6) << "it slides";
  EXPECT_EQ(Box<Dim>(size_of<Dim>(1, 2, 3), 0.4).factor(), 0) << "it topples, whatever its friction";
  EXPECT_EQ(Box<Dim>(size_of<Dim>(3, 2, 1), 0).factor(), std::numeric_limits<double>::infinity());
  // a bolt straight into the floor: more pressure, and the box of before no longer topples but slides
  const Box<Dim> bolted(size_of<Dim>(3, 2, 1), 0.4,
                        std::string("bolts = [{ name = \"b\", from = ") +
                            (Dim == 2 ? "[1.5, 0.5], to = [1.5, -1]" : "[1.5, 1, 0.5], to = [1.5, 1, -1]") +
                            ", stiffness = 1e8, yield = 9e3 }]");
  const double weight = 10e3 * (Dim == 2 ? 3 : 6), normal = weight * std::cos(0.4) + 9e3;
  EXPECT_NEAR(bolted.factor(), std::tan(friction) * normal / (weight * std::sin(0.4)), 1e-6);
}

TEST(BlockFactor, OfBoxesThatSlideAndTopple) {
  expect_statics<2>();
  expect_statics<3>();
}

// A lath of 10 m, pushed sideways at its foot, e from its middle. Its weight rests on both ends alike, of which the
// nearer carries (1/2 + e/L) P: F = µ W / (P (1 + 2 e/L)). Pure sliding would have µ W / P.
TEST(BlockFactor, OfALathThatTurnsOnTheFloor) {
  Box<3> lath({10, 1e-3, 0.1}, 0);
  const double weight = 10e3 * 10 * 1e-3 * 0.1, push = 0.3 * weight, aside = 2;
  const Vector<3> force(0, push, 0), lever(aside, 0, -0.05);
  lath.block.stated.force += force;
  lath.block.stated.moment += moment(lever, force);
  EXPECT_NEAR(lath.factor(), std::tan(friction) / (0.3 * (1 + 2 * aside / 10)), 1e-4);
}

}  // namespace
}  // namespace voussoir::block_factor_test
