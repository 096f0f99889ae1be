// Drawings of blocks for CAD, read back.
#include "core/output/blocks_dxf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/output/paraview.hpp"
#include "core/slicing/block.hpp"
#include "core/testing/dxf_drawing.hpp"

namespace voussoir::blocks_dxf_test {
namespace {

using test::DxfEntity;

constexpr double inner = 2;  // m, inscribed radius

// prisms, or polygons in the plane, of so many sides, far from the origin
template <int Dim>
Model<Dim> polygons_of(const std::vector<int>& sides) {
  Model<Dim> model;
  model.origin = Vector<Dim>::Constant(1000.1);
  for (std::size_t b = 0; b < sides.size(); ++b) {
    HalfSpaces<Dim> planes;
    for (int k = 0; k < sides[b]; ++k) {
      Vector<Dim> normal = Vector<Dim>::Zero();
      normal[0] = std::cos(2 * std::numbers::pi * k / sides[b]);
      normal[1] = std::sin(2 * std::numbers::pi * k / sides[b]);
      planes.push_back({normal, inner + 10 * static_cast<double>(b) * normal[0]});
    }
    if constexpr (Dim == 3)
      for (const double sign : {1.0, -1.0})
        planes.push_back({sign * Vector<3>::Unit(2), 0.5});
    const BlockResult<Dim> block = make_block<Dim>(planes, std::vector<int>(planes.size(), no_joint));
    EXPECT_EQ(block.status, BlockStatus::ok);
    model.bodies.push_back(make_body<Dim>({block.part}, 2000));
  }
  list_parts(model);
  return model;
}

double area_of(int sides) {
  return sides * inner * inner * std::tan(std::numbers::pi / sides);
}

template <int Dim>
std::vector<DxfEntity> drawn(const Model<Dim>& model, const std::set<int>& key = {}) {
  return test::read_drawing(blocks_dxf(model, block_faces(model, initial_state(model), 0), key));
}

TEST(Dxf, FacesBoundTheVolumesOfTheirLayers) {
  Model<3> model = polygons_of<3>({3, 4, 5, 6, 9});
  model.bodies[3].fixed = true;
  const std::vector<DxfEntity> entities = drawn(model, {0, 4});
  const double rounding = 1e-9;  // of corners 1000 m from the origin, 1e-13 m, over faces of 100 m²
  EXPECT_NEAR(volume_on(entities, "KEY_BLOCKS"), area_of(3) + area_of(9), rounding);
  EXPECT_NEAR(volume_on(entities, "BLOCKS"), area_of(4) + area_of(5), rounding);
  EXPECT_NEAR(volume_on(entities, "FIXED_BLOCKS"), area_of(6), rounding);
}

// 3DFACEs have three or four corners: edges within a face of more are not seen
TEST(Dxf, EdgesWithinAFaceAreInvisible) {
  for (const int sides : {3, 4, 5, 6, 7, 12}) {
    const double side = 2 * inner * std::tan(std::numbers::pi / sides);
    double seen = 0;
    for (const DxfEntity& face : drawn(polygons_of<3>({sides})))
      for (std::size_t k = 0; k < 4; ++k)
        if ((face.flags >> k & 1) == 0) seen += (face.points.at(k) - face.points.at((k + 1) % 4)).norm();
    EXPECT_NEAR(seen, 2 * sides * (2 * side + 1), 1e-9) << sides << " sides; each edge belongs to two faces";
  }
}

TEST(Dxf, BlocksInThePlaneAreClosedOutlines) {
  const std::vector<DxfEntity> entities = drawn(polygons_of<2>({3, 7}), {1});
  ASSERT_EQ(entities.size(), 2u);
  for (const DxfEntity& outline : entities)
    EXPECT_EQ(outline.flags, 1) << "closed";
  EXPECT_NEAR(area_on(entities, "BLOCKS"), area_of(3), 1e-9);
  EXPECT_NEAR(area_on(entities, "KEY_BLOCKS"), area_of(7), 1e-9);
}

TEST(Dxf, BoltsAreLinesFromCollarToToe) {
  Model<3> model = polygons_of<3>({4});
  model.bolts.push_back({0, 1, {0.25, 0, 0}, {0.25, 0, 3}});
  const DxfEntity line = drawn(model).back();
  EXPECT_EQ(line.kind, "LINE");
  EXPECT_EQ(line.layer, "BOLTS");
  EXPECT_EQ(line.points,
            (std::vector<Vector<3>>{model.origin + model.bolts[0].collar, model.origin + model.bolts[0].toe}));
}

// m² of the closed lines of a layer, in any plane
double section_on(const std::vector<DxfEntity>& entities, const std::string& layer) {
  double area = 0;
  for (const std::vector<Vector<3>>& outline : points_on(entities, "POLYLINE", layer)) {
    Vector<3> twice = Vector<3>::Zero();
    for (std::size_t k = 0; k < outline.size(); ++k)
      twice += outline[k].cross(outline[(k + 1) % outline.size()]);
    area += twice.norm() / 2;
  }
  return area;
}

std::vector<DxfEntity> section_of_prisms(const Model<3>& model, const SectionPlane& plane) {
  return test::read_drawing(section_dxf(model, cut_blocks(model, plane), {2}));
}

// across the prisms their polygons, oblique these over the cosine, along them a width times the length of 1 m
TEST(Dxf, SectionsHaveTheAreasOfClosedForms) {
  Model<3> model = polygons_of<3>({4, 6, 9});
  model.bodies[1].fixed = true;
  const Vector<3> centre = model.origin + Vector<3>(10, 0, 0);
  const std::vector<DxfEntity> level = section_of_prisms(model, {centre, {0, 0, 1}});
  ASSERT_EQ(level.size(), 3u);
  for (const DxfEntity& outline : level)
    EXPECT_EQ(outline.flags, 1 + 8) << "closed, in space";
  // counter-clockwise from above; corners 1000 m from the origin are rounded to 1e-13 m
  EXPECT_NEAR(area_on(level, "BLOCKS"), area_of(4), 1e-9);
  EXPECT_NEAR(area_on(level, "FIXED_BLOCKS"), area_of(6), 1e-9);
  EXPECT_NEAR(area_on(level, "KEY_BLOCKS"), area_of(9), 1e-9);

  // it rises by 0.02 m over the radius of the hexagon and stays within its ends
  const Vector<3> oblique = Vector<3>(-0.01, 0, 1).normalized();
  EXPECT_NEAR(section_on(section_of_prisms(model, {centre, oblique}), "FIXED_BLOCKS"), area_of(6) / oblique[2], 1e-9);

  // through the centre of each: a square of 4 m, a hexagon between two sides of 2 / cos 30 degrees
  const std::vector<DxfEntity> upright = section_of_prisms(model, {centre, {0, 1, 0}});
  EXPECT_NEAR(section_on(upright, "BLOCKS"), 2 * inner, 1e-9);
  EXPECT_NEAR(section_on(upright, "FIXED_BLOCKS"), 2 * inner, 1e-9);
  // through opposite corners of the hexagon, whose sides close in: it is cut 1e-9 of its radius, 3e-9 m, beside them
  const std::vector<DxfEntity> across = section_of_prisms(model, {centre, {1, 0, 0}});
  EXPECT_NEAR(section_on(across, "FIXED_BLOCKS"), 2 * inner / std::cos(std::numbers::pi / 6), 4e-9);
  EXPECT_EQ(across.size(), 1u) << "the others are 10 m away";
  for (const DxfEntity& outline : across)
    for (const Vector<3>& corner : outline.points)
      EXPECT_NEAR(corner[0], centre[0], 1e-12);
}

// a plane in which faces meet: the blocks on the side of its normal; a corner that touches it is no section
TEST(Dxf, ASectionAlongFacesCutsTheBlocksOfOneSide) {
  Model<3> model = polygons_of<3>({4});
  Body<3> above = model.bodies[0];
  above.reference[2] += 1;
  model.bodies.push_back(above);
  list_parts(model);
  const Vector<3> top = model.origin + Vector<3>(0, 0, 0.5);
  for (const double sign : {1.0, -1.0}) {
    const std::vector<SectionPolygon> polygons = cut_blocks(model, {top, sign * Vector<3>::Unit(2)});
    ASSERT_EQ(polygons.size(), 1u);
    EXPECT_EQ(polygons[0].body, sign > 0 ? 1 : 0);
  }
  EXPECT_TRUE(cut_blocks(model, {top + Vector<3>(0, 0, 1), Vector<3>::Unit(2)}).empty()) << "the top has no rock above";
  const Vector<3> corner = model.origin + Vector<3>(inner, inner, 0);
  EXPECT_TRUE(cut_blocks(model, {corner, Vector<3>(-1, -1, 0).normalized()}).empty());
}

}  // namespace
}  // namespace voussoir::blocks_dxf_test
