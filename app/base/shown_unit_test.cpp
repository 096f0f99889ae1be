// Units of printed tables.
#include "app/base/shown_unit.hpp"

#include <gtest/gtest.h>

namespace voussoir::shown_unit_test {
namespace {

TEST(ShownUnit, ForcesStressesAndMomentsAreInThousands) {
  EXPECT_EQ(quantity_text(24077.3, "N"), "24.0773 kN");
  EXPECT_EQ(quantity_text(-59721.8, "N/m"), "-59.7218 kN/m");
  EXPECT_EQ(quantity_text(5e4, "Pa"), "50 kPa");
  EXPECT_EQ(quantity_text(9810, "N/m³"), "9.81 kN/m³");
  EXPECT_EQ(quantity_text(2.5e8, "N m²"), "250000 kN m²");
  EXPECT_EQ(quantity_text(-15202.9, "Nm"), "-15.2029 kN m");
}

TEST(ShownUnit, OtherUnitsAreThoseOfFiles) {
  EXPECT_EQ(quantity_text(1.0674, "1"), "1.0674");
  EXPECT_EQ(quantity_text(20, "deg"), "20 deg");
  EXPECT_EQ(quantity_text(1500, "m"), "1500 m");
  EXPECT_EQ(quantity_text(4000, "Nodes"), "4000 Nodes");  // begins with N and is no force
}

}  // namespace
}  // namespace voussoir::shown_unit_test
