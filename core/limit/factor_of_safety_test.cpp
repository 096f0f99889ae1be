// The factor of safety by limit analysis against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "core/limit/limit.hpp"
#include "core/model/water_surfaces.hpp"
#include "core/testing/limit_models.hpp"
#include "text/angle.hpp"

namespace voussoir::factor_of_safety_test {
namespace {

using limit_models::block_on_plate;

constexpr double bracket = 1.01e-6 * degree;  // of find_critical_friction, as the header states it
constexpr double rounding = 1e-9;             // of a small program's sums

// A block 2 wide and 0.1 high on its plane: (c L + W cos dip tan φ)/(W sin dip), of the named properties.
TEST(FactorOfSafety, OfABlockOnAnInclineIsItsStrengthOverItsWeight) {
  for (const double dip : {20.0, 40.0})
    for (const double cohesion : {0.0, 500.0}) {
      Model<2> model = block_on_plate(2, 0.1, dip * degree);
      model.properties.front().cohesion = cohesion;
      const double weight = 2 * 0.1 * 2000 * 10, s = std::sin(dip * degree), c = std::cos(dip * degree);
      const double exact = (2 * cohesion + weight * c * std::tan(30 * degree)) / (weight * s);
      const CriticalStrength<2> found = limit_models::factor_of_safety(model, {}, true);
      ASSERT_EQ(found.status, LimitStatus::found);
      EXPECT_LE(found.stands, found.collapses);
      EXPECT_NEAR(found.stands, exact, 1e-7 * exact) << dip << " " << cohesion;
      EXPECT_NEAR(found.collapses, exact, 1e-7 * exact);
      EXPECT_LT(found.evidence.gap, rounding);
      EXPECT_EQ(limit_models::assembly_of(model).faces.front().cohesion, 0) << "without bonds";
    }
}

TEST(FactorOfSafety, IsThatOfTheNamedPropertiesAndOfFurtherLoads) {
  Model<2> model = block_on_plate(2, 0.1, 20 * degree);
  model.properties.push_back(model.properties.front());
  model.properties.back().name = "unused";
  EXPECT_THROW(limit_models::factor_of_safety(model, {"roc"}), std::out_of_range);
  EXPECT_EQ(limit_models::factor_of_safety(model, {"unused"}).status, LimitStatus::carries_any);
  const double ratio = std::tan(30 * degree) / std::tan(20 * degree);
  EXPECT_NEAR(limit_models::factor_of_safety(model, {"rock"}).stands, ratio, 2e-7);
  // half the weight lifted: normal force and driving force are halved
  const CornerAssembly<2> assembly = limit_models::assembly_of(model);
  const std::vector<bool> all = faces_of(assembly, {});
  const auto loads_with = [&](const Vector<2>& lift) {
    Loads<2> loads = loads_of_acceleration(model, model.gravity);
    for (std::size_t b = 0; b < loads.size(); ++b)
      loads[b].force += model.bodies[b].mass * lift;
    return loads;
  };
  EXPECT_NEAR(find_factor_of_safety(assembly, loads_with(-0.5 * model.gravity), all).stands, ratio, 2e-7);
  // lifted only perpendicular to the plane
  const Vector<2> normal = matrix(Rotation<2>{20 * degree}) * Vector<2>(0, 1);
  const Loads<2> lifted = loads_with(-0.5 * model.gravity.dot(normal) * normal);
  EXPECT_NEAR(find_factor_of_safety(assembly, lifted, all).stands, 0.5 * ratio, 2e-7);
  const double critical = std::atan(2 * std::tan(20 * degree));
  EXPECT_NEAR(find_critical_friction(assembly, lifted, all).stands, critical, bracket);
}

// 1 m of water behind a block of 1 m x 1 m and 20 kN, with the first, the last or a middle point of its table at the
// block's face: the same thrust of 5 kN.
TEST(CriticalFriction, IncludesWaterWithAKinkAtAFace) {
  Model<2> model = limit_models::model_of(
      {{"floor", limit_models::box(-2, -1, 3, 0), true}, {"block", limit_models::box(0, 0, 1, 1)}});
  for (Body<2>& body : model.bodies)
    body.free_rotation.fill(false);
  const double x = 1 - model.origin[0], z = 1 - model.origin[1];
  for (const std::vector<double>& numbers :
       {std::vector<double>{x - 1, z - 1, x, z}, {x, z, x + 1, z - 1}, {x - 1, z - 1, x, z, x + 2, z + 3}, {x, z}}) {
    for (Body<2>& body : model.bodies)
      for (std::size_t f = 0; f < body.parts.front().faces.size(); ++f)
        body.parts.front().joints[f] = body.parts.front().faces[f].normal[0] > 0.5 && !body.fixed ? 0 : no_joint;
    model.joints = {{"crack", {Vector<2>::UnitX(), x}, 0}};
    assign_waters(model, {{"w", 10'000, false, numbers}}, {0, -1});
    const CornerAssembly<2> assembly = limit_models::assembly_of(model);
    Loads<2> loads = loads_of_acceleration(model, model.gravity);
    const Loads<2> water = water_loads_at_reference<2>(model);
    for (std::size_t b = 0; b < loads.size(); ++b)
      loads[b] += water[b];
    const CriticalStrength<2> found = find_critical_friction(assembly, loads, faces_of(assembly, {}));
    ASSERT_EQ(found.status, LimitStatus::found);
    EXPECT_NEAR(found.stands, std::atan(0.25), bracket);
  }
}

}  // namespace
}  // namespace voussoir::factor_of_safety_test
