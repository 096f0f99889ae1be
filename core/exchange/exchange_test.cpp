// Tables and surfaces: what is written comes back, what is malformed is reported with its place.
#include <gtest/gtest.h>

#include <cstring>

#include "core/exchange/mesh.hpp"
#include "core/exchange/tables.hpp"
#include "core/floating_point_traps.hpp"
#include "core/testing/shapes.hpp"
#include "text/file_fault.hpp"

namespace voussoir {
namespace {

template <class Read>
void expect_fault(const Read& read, int line, int column, const std::string& part) {
  SCOPED_TRACE(part);
  try {
    read();
    ADD_FAILURE() << "read without a complaint";
  } catch (const FileFault& fault) {
    EXPECT_EQ(fault.line, line) << fault.what();
    EXPECT_EQ(fault.column, column) << fault.what();
    EXPECT_NE(std::string(fault.what()).find(part), std::string::npos) << fault.what();
  }
}

// ---- tables

TEST(JointTable, TellsWhereItIsMalformed) {
  const std::string head = "name,dip_deg,dip_direction_deg,x_m,y_m,z_m,shape,length_m,width_m\n";
  const auto fault = [&](const std::string& row, int column, const std::string& part) {
    expect_fault([&] { read_joint_table(head + row, 3); }, 2, column, part);
  };
  fault("A,4o,90,0,0,0,,,\n", 3, "dip_deg = '4o'");
  fault("A,40,90,0,nan,0,,,\n", 11, "finite decimal number");
  fault("A,40,90,0,inf,0,,,\n", 11, "finite decimal number");
  fault("A,40,90,0,0x10,0,,,\n", 11, "finite decimal number");
  fault("A,40,90,0,1e999,0,,,\n", 11, "finite decimal number");
  fault("A,40,90,0,1 2,0,,,\n", 11, "finite decimal number");
  fault("A,40,90,0,,0,,,\n", 11, "the cell is empty");
  fault("A,,90,0,0,0,,,\n", 3, "needs an orientation");
  fault("A,40,90,0,0,0,round,1,1\n", 15, "must be infinite, ellipse, rectangle or polygon");
  fault("A,40,90,0,0,0,ellipse,0,1\n", 23, "greater than 0");
  fault("A,40,90,0,0,0,ellipse,1,\n", 25, "the cell is empty");
  fault("A,40,90,0,0,0,,1,\n", 16, "an infinite joint has no extent");
  expect_fault([] { read_joint_table("name,x_m,y_m\n", 3); }, 1, 0, "lacks the column z_m");
  expect_fault([] { read_joint_table("x_m,y_m,z_m,dipp\n", 3); }, 1, 13, "no such column as 'dipp'");
  expect_fault([] { read_joint_table("x_m,y_m,z_m\n1,2,3\n", 3); }, 1, 0, "needs an orientation");
  expect_fault([] { read_joint_table("x_m,y_m,normal_x,normal_y\n1,2,3,4\n", 2); }, 2, 5, "length 1 (here 5)");
}

TEST(JointTable, ReturnsJointsExactly) {
  shapes::Random random(5);
  std::vector<JointRow> rows;
  for (int i = 0; i < 200; ++i) {
    JointRow row;
    row.name = "joint, \"no\" " + std::to_string(i);
    row.set = i % 2 ? "A" : "";
    row.dip_deg = shapes::uniform(random, 0, 90);
    row.dip_direction_deg = shapes::uniform(random, 0, 360);
    const Vector<3> normal = shapes::direction<3>(random);
    row.normal = {normal[0], normal[1], normal[2]};
    for (int k = 0; k < 3; ++k)
      row.point.push_back(shapes::power_of_ten(random, -6, 6) * (k == 1 ? -1 : 1));
    if (i % 7 == 0) {
      row.shape = OutlineForm::polygon;
      for (int corner = 0; corner < 3 + i % 3; ++corner)
        row.corners.push_back({shapes::uniform(random, -1, 1), shapes::uniform(random, -9, 9), 1e6 / (corner + 3)});
    } else if (i % 3) {
      row.shape = i % 3 == 1 ? OutlineForm::ellipse : OutlineForm::rectangle;
      row.extents = {shapes::uniform(random, 1, 9), shapes::uniform(random, 1, 9)};
    }
    rows.push_back(row);
  }
  const std::string text = joint_table(rows, 3);
  const std::vector<JointRow> back = read_joint_table(text, 3);
  ASSERT_EQ(back.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(back[i].name, rows[i].name);
    EXPECT_EQ(back[i].dip_deg, rows[i].dip_deg);
    EXPECT_EQ(back[i].normal, rows[i].normal);
    EXPECT_EQ(back[i].point, rows[i].point);
    EXPECT_EQ(back[i].shape, rows[i].shape);
    EXPECT_EQ(back[i].extents, rows[i].extents);
    EXPECT_EQ(back[i].corners, rows[i].corners);
  }
  EXPECT_EQ(joint_table(back, 3), text);
}

TEST(PlaneTable, ReturnsPlanesExactly) {
  shapes::Random random(6);
  std::vector<PlaneRow> rows;
  for (int i = 0; i < 200; ++i) {
    const Vector<3> normal = shapes::direction<3>(random);
    rows.push_back({0,
                    "block-" + std::to_string(i / 7),
                    i % 2,
                    i % 3 ? "J" : "",
                    {normal[0], normal[1], normal[2]},
                    shapes::uniform(random, -1e6, 1e6)});
  }
  const std::vector<PlaneRow> back = read_plane_table(plane_table(rows, 3), 3);
  ASSERT_EQ(back.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(back[i].block, rows[i].block);
    EXPECT_EQ(back[i].part, rows[i].part);
    EXPECT_EQ(back[i].joint, rows[i].joint);
    EXPECT_EQ(back[i].normal, rows[i].normal);
    EXPECT_EQ(back[i].offset, rows[i].offset);
  }
  const std::string head = "block,part,normal_x,normal_y,offset_m\n";
  expect_fault([&] { read_plane_table(head + ",0,1,0,1\n", 2); }, 2, 1, "must name the block");
  expect_fault([&] { read_plane_table(head + "a,0.5,1,0,1\n", 2); }, 2, 3, "whole number");
  expect_fault([&] { read_plane_table(head + "a,-1,1,0,1\n", 2); }, 2, 3, "whole number");
  expect_fault([&] { read_plane_table(head + "a,0,1,0,\n", 2); }, 2, 9, "the cell is empty");
}

// ---- surfaces

Mesh mesh_of(const HalfSpaces<3>& planes, const Vector<3>& place) {
  const Polytope<3> part = make_block<3>(planes, std::vector<int>(planes.size(), no_joint)).part;
  Mesh mesh{"block", 0, {}, {}};
  for (const Vector<3>& v : part.vertices)
    mesh.points.push_back(v + place);
  for (const std::vector<int>& loop : part.loops)
    mesh.facets.push_back({loop, 0});
  return mesh;
}

bool holds(const std::vector<Vector<3>>& points, const Vector<3>& p) {
  return std::find(points.begin(), points.end(), p) != points.end();
}

// every corner comes back to the last bit, and no other point
TEST(Mesh, KeepsItsCornersThroughStlAndObj) {
  shapes::Random random(7);
  for (int i = 0; i < 40; ++i) {
    const Vector<3> place = 1000 * shapes::direction<3>(random);
    const Mesh mesh = mesh_of(shapes::random_planes<3>(random, 3 + i, 2), place);
    for (const std::vector<Mesh>& back : {read_stl(stl_text({mesh, mesh})), read_obj(obj_text({mesh, mesh}))}) {
      ASSERT_EQ(back.size(), 2u);
      EXPECT_EQ(back[1].name, "block");
      const std::vector<Vector<3>> corners = convex_corners(back[1]);
      EXPECT_EQ(corners.size(), mesh.points.size());
      for (const Vector<3>& p : mesh.points)
        EXPECT_TRUE(holds(corners, p));
    }
  }
}

const std::string tetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::vector<Vector<3>> corners_of(const std::string& obj) {
  return convex_corners(read_obj(obj).front());
}

TEST(Mesh, TakesWhatPeopleWrite) {
  EXPECT_EQ(corners_of(tetrahedron).size(), 4u);
  // all facets inside out, indices from the end, normals and textures, materials
  EXPECT_EQ(corners_of("mtllib a.mtl\nvn 0 0 1\nv 0 0 0 # corner\nv 1 0 0\nv 0 1 0\nv 0 0 1 1.0\nusemtl rock\ns off\n"
                       "f 1//1 2//1 3//1\nf -4/1 -1/2/3 -3\nf 1 3 4\nf 2 4 3\n")
                .size(),
            4u);
  // a face divided about a point in its middle, and an edge in its own: neither is a corner
  EXPECT_EQ(corners_of("v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nv 0.5 0.5 0\nv 1 0 0\n"
                       "f 1 3 5\nf 3 2 5\nf 2 6 5\nf 6 1 5\nf 1 6 4\nf 6 2 4\nf 1 4 3\nf 2 3 4\n")
                .size(),
            4u);
}

TEST(Mesh, RefusesWhatIsNoConvexSolid) {
  const auto fault = [](const std::string& obj, int line, const std::string& part) {
    expect_fault([&] { corners_of(obj); }, line, 0, part);
  };
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  fault(points + "f 1 3 2\nf 1 2 4\nf 1 4 3\n", 1, "at least 4");
  fault(points + "v 1 1 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 5\n", 9, "the surface is open");
  fault(points + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 4 3\n", 8, "one of them is turned over");
  fault(points + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 2 3 4\n", 9, "stands twice");
  fault("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", 1, "bounds no volume");
  const std::string far = "v 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";
  fault(tetrahedron + far, 13, "another piece");
  // a box with a notch in its top: an L along y
  fault(
      "v 0 0 0\nv 2 0 0\nv 2 0 1\nv 1 0 1\nv 1 0 2\nv 0 0 2\nv 0 1 0\nv 2 1 0\nv 2 1 1\nv 1 1 1\nv 1 1 2\nv 0 1 2\n"
      "f 1 2 3 4 5 6\nf 12 11 10 9 8 7\nf 1 7 8 2\nf 2 8 9 3\nf 3 9 10 4\nf 4 10 11 5\nf 5 11 12 6\nf 6 12 7 1\n",
      13, "the block is not convex");
}

TEST(Obj, TellsWhereItIsMalformed) {
  const auto fault = [](const std::string& obj, int line, int column, const std::string& part) {
    expect_fault([&] { read_obj(obj); }, line, column, part);
  };
  fault("", 1, 0, "holds no face");
  fault("v 0 0\n", 1, 1, "three coordinates");
  fault("v 0 0 x\n", 1, 7, "z = 'x'");
  fault("v 0 0 1e13\n", 1, 7, "exceeds 1e12");
  fault("v 0 0 0\nf 1 2 3\n", 2, 5, "none of the 1 vertices");
  fault("v 0 0 0\nf 0 1 1\n", 2, 3, "counted from 1");
  fault("v 0 0 0\nf 1 -2 1\n", 2, 5, "none of the 1 vertices");
  fault("v 0 0 0\nf 1 1\n", 2, 1, "at least three corners");
  fault("v 0 0 0\nf 1 1 1\n", 2, 0, "the same point");
  fault("curv 0 1\n", 1, 1, "no statement 'curv'");
  fault("v 0 0 99999999999999999999999999999999999999999999999999\n", 1, 7, "exceeds 1e12");
  fault("f 99999999999999999999999999 1 1\n", 1, 3, "none of the 0 vertices");
}

TEST(Stl, TellsWhereItIsMalformed) {
  const auto fault = [](const std::string& stl, int line, int column, const std::string& part) {
    expect_fault([&] { read_stl(stl); }, line, column, part);
  };
  fault("", 1, 0, "is no STL");
  fault("v 0 0 0\n", 1, 0, "is no STL");
  fault("solid a\n", 1, 0, "the file ends");
  fault("solid a\n  facett\n", 2, 3, "where 'facet' must stand");
  fault("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", 4, 1, "three coordinates");
  fault("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 nan 0\n", 5, 10, "y = 'nan'");
  fault("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n", 2, 0,
        "the same point");
  EXPECT_EQ(read_stl("solid a\nendsolid a\n").size(), 1u);
}

std::string binary_stl(const Mesh& mesh) {
  std::string bytes(80, ' ');
  const auto add = [&](const auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  std::uint32_t count = 0;
  for (const Facet& facet : mesh.facets)
    count += static_cast<std::uint32_t>(facet.corners.size()) - 2;
  add(count);
  for (const Facet& facet : mesh.facets)
    for (std::size_t k = 1; k + 1 < facet.corners.size(); ++k) {
      bytes.append(12, '\0');
      for (const int corner : {facet.corners[0], facet.corners[k], facet.corners[k + 1]})
        for (int c = 0; c < 3; ++c)
          add(static_cast<float>(mesh.points[corner][c]));
      bytes.append(2, '\0');
    }
  return bytes;
}

// single precision, which some faces of a convex block then are not plane in
TEST(Stl, ReadsBinaryFiles) {
  shapes::Random random(8);
  for (int i = 0; i < 20; ++i) {
    const Mesh mesh = mesh_of(shapes::random_planes<3>(random, 5, 2), Vector<3>(3, -4, 5));
    const std::vector<Vector<3>> corners = convex_corners(read_stl(binary_stl(mesh)).front());
    for (const Vector<3>& p : mesh.points)
      EXPECT_TRUE(holds(corners, p.cast<float>().cast<double>()));
  }
  std::string bytes = binary_stl(mesh_of(shapes::cube<3>(1), Vector<3>::Zero()));
  expect_fault([&] { read_stl(bytes.substr(0, bytes.size() - 1)); }, 1, 0, "is it cut off?");
  std::memset(bytes.data() + 84 + 12, 0xff, 4);
  const WithoutTraps comparing_nan;
  expect_fault([&] { read_stl(bytes); }, 0, 0, "facet 1: a coordinate is not finite");
}

}  // namespace
}  // namespace voussoir
