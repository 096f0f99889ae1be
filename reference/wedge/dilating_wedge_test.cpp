#include "reference/wedge/dilating_wedge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace voussoir::reference::dilating_wedge_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

DilatingWedge of_planes(const Wedge& planes, double dilation, double tan_friction = 1) {
  return {planes, 0.8, 1.3, {[=](double) { return tan_friction; }, [=](double) { return dilation; }}};
}

// A symmetric wedge, whose line plunges by ε and whose planes are at the angle a to the vertical plane through it:
// tan φ = sin a tan ε/(cos δ + tan ε cos a sin δ), sin δ = tan ψ cot a. Its planes here: ε = 38, a = 45 degrees.
TEST(DilatingWedge, ASymmetricOneHasItsClosedForm) {
  Wedge planes;
  planes.a.dip = planes.b.dip = 56.137086019 * degree;
  planes.a.dip_direction = 31.619006537 * degree;
  planes.b.dip_direction = 148.380993463 * degree;
  const double dilation[] = {0, 5, 10, 15, 20, 25},
               critical[] = {28.918559285, 27.875089091, 27.053642647, 26.429676685, 26.004154246, 25.811147987};
  for (int k = 0; k < 6; ++k)
    EXPECT_NEAR(std::atan(1 / solve_dilating_wedge(of_planes(planes, dilation[k] * degree)).factor_of_safety) / degree,
                critical[k], 2e-9);
}

TEST(DilatingWedge, WithoutDilationItIsTheRigidWedge) {
  Wedge planes;
  planes.a = {48 * degree, 125 * degree, 35 * degree};
  planes.b = {55 * degree, 230 * degree, 35 * degree};
  planes.weight = 1e6;
  const WedgeSolution rigid = solve_wedge(planes);
  const DilatingSolution found = solve_dilating_wedge(of_planes(planes, 0, std::tan(35 * degree)));
  EXPECT_NEAR(found.factor_of_safety, rigid.factor_of_safety, 1e-12);
  EXPECT_NEAR(0.8 * found.stress_a, rigid.normal_force_a, 1e-6);
  EXPECT_NEAR(1.3 * found.stress_b, rigid.normal_force_b, 1e-6);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(found.direction[k], rigid.sliding_direction[k], 1e-12);
}

TEST(DilatingWedge, RefusesOneThatLeavesAPlane) {
  Wedge planes;
  planes.a = {30 * degree, 90 * degree};
  planes.b = {80 * degree, 95 * degree};
  EXPECT_THROW(solve_dilating_wedge(of_planes(planes, 0)), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::dilating_wedge_test
