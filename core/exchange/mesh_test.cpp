// Surfaces: written files read back unchanged; malformed ones are reported with the place.
#include "core/exchange/mesh.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/base/floating_point_traps.hpp"
#include "core/geometry/half_space.hpp"
#include "core/slicing/block.hpp"
#include "core/testing/expected_fault.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::mesh_test {
namespace {

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

TEST(Mesh, ReadsUsualVariants) {
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

TEST(Mesh, RefusesSurfacesOfNoConvexSolid) {
  const auto fault = [](const std::string& obj, int line, const std::string& part) {
    expect_fault([&] { corners_of(obj); }, line, 0, part);
  };
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  fault(points + "f 1 3 2\nf 1 2 4\nf 1 4 3\n", 1, "at least 4");
  fault(points + "v 1 1 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 5\n", 9, "the surface is open");
  fault(points + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 4 3\n", 8, "one of them is turned over");
  fault(points + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 2 3 4\n", 9, "occurs twice");
  fault("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", 1, "bounds no volume");
  const std::string far = "v 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";
  fault(tetrahedron + far, 13, "another piece");
  // a box with a notch in its top: an L along y
  fault(
      "v 0 0 0\nv 2 0 0\nv 2 0 1\nv 1 0 1\nv 1 0 2\nv 0 0 2\nv 0 1 0\nv 2 1 0\nv 2 1 1\nv 1 1 1\nv 1 1 2\nv 0 1 2\n"
      "f 1 2 3 4 5 6\nf 12 11 10 9 8 7\nf 1 7 8 2\nf 2 8 9 3\nf 3 9 10 4\nf 4 10 11 5\nf 5 11 12 6\nf 6 12 7 1\n",
      13, "the block is not convex");
}

// a box of three edges, turned at random, about a point
Mesh turned_box(shapes::Random& random, const Vector<3>& edges, const Vector<3>& about) {
  const Vector<3> x = shapes::direction<3>(random), z = x.cross(shapes::direction<3>(random)).normalized();
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  Mesh mesh = mesh_of(shapes::cube<3>(1), Vector<3>::Zero());
  double extent = 0;
  for (Vector<3>& p : mesh.points)
    extent = std::max(extent, p.cwiseAbs().maxCoeff());
  for (Vector<3>& p : mesh.points)
    p = about + axes * (p / (2 * extent)).cwiseProduct(edges);
  return mesh;
}

std::string written(const Mesh& mesh, int decimals, bool trimmed) {
  std::string text = "o " + mesh.name + "\n";
  for (const Vector<3>& p : mesh.points) {
    text += "v";
    for (const double x : p) {
      std::string number = fmt::format("{:.{}f}", x, decimals);
      if (trimmed) number = number.substr(0, number.find_last_not_of('0') + 1);
      text += " " + number + (number.ends_with('.') ? "0" : "");
    }
    text += "\n";
  }
  for (const Facet& facet : mesh.facets) {
    text += "f";
    for (const int corner : facet.corners)
      text += fmt::format(" {}", corner + 1);
    text += "\n";
  }
  return text;
}

// whether the corners of every facet lie in a plane as they are written: by their volume in whole units
bool all_planes(const Mesh& mesh, int decimals) {
  const auto corner = [&](const Facet& facet, std::size_t k) {
    return Vector<3>((mesh.points[facet.corners[k]] * std::pow(10.0, decimals)).array().round());
  };
  return std::all_of(mesh.facets.begin(), mesh.facets.end(), [&](const Facet& facet) {
    const Vector<3> a = corner(facet, 1) - corner(facet, 0), b = corner(facet, 2) - corner(facet, 0),
                    c = corner(facet, 3) - corner(facet, 0);
    return a.dot(b.cross(c)) == 0;
  });
}

double hull_volume(const std::vector<Vector<3>>& corners) {
  return shapes::block<3>(hull_planes<3>(corners)).mass.volume;
}

// Boxes turned in space, with few decimals: their faces are no planes, and the hull is the box within that rounding.
TEST(Mesh, RoundedCornersMakeTheirConvexHull) {
  shapes::Random random(16);
  for (int i = 0; i < 300; ++i) {
    const int decimals = 3 + i % 3;
    const Vector<3> edges(shapes::uniform(random, 0.5, 2), shapes::uniform(random, 0.5, 2),
                          shapes::uniform(random, 0.5, 2));
    const Mesh mesh = turned_box(random, edges, (i % 4) * 10 * shapes::direction<3>(random));
    std::vector<FileRemark> remarks;
    std::vector<Vector<3>> corners;
    ASSERT_NO_THROW(corners = convex_corners(read_obj(written(mesh, decimals, i % 2)).front(), &remarks)) << i;
    EXPECT_EQ(corners.size(), 8u);
    const double unit = std::pow(10.0, -decimals),
                 area = 2 * (edges[0] * edges[1] + edges[1] * edges[2] + edges[2] * edges[0]);
    EXPECT_NEAR(hull_volume(corners), edges.prod(), area * unit);  // √3/2 of it, and twice that between hull and box
    for (const FileRemark& remark : remarks)
      EXPECT_NE(remark.text.find("its convex hull was taken"), std::string::npos) << remark.text;
    // with five decimals the rounding may be smaller than that of single precision
    if (decimals < 5) {
      EXPECT_EQ(remarks.empty(), all_planes(mesh, decimals)) << i;
    }
  }
  std::vector<FileRemark> remarks;
  EXPECT_EQ(convex_corners(read_obj("o c\nv 0.0000 0.0000 0.0000\nv 0.3469 0.6816 -0.6442\nv -0.4181 1.2846 -0.4182\n"
                                    "v -0.7650 0.6030 0.2260\nv 0.5425 0.4144 0.7307\nv 0.8895 1.0961 0.0865\n"
                                    "v 0.1244 1.6991 0.3125\nv -0.2225 1.0174 0.9567\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\n"
                                    "f 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
                               .front(),
                           &remarks)
                .size(),
            8u);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].text.find("stated to 0.0001 m: its convex hull was taken"), std::string::npos)
      << remarks[0].text;
}

// A point within the top of a box, up or down by a multiple of the file's rounding unit. Down by less than rounding it
// is no corner, by far more the block is not convex, with few digits and with many.
TEST(Mesh, ADentDeeperThanTheDigitsIsNotConvex) {
  const auto dented = [](double height, int decimals) {
    std::string text;
    for (const Vector<3>& p :
         {Vector<3>(0, 0, 0), Vector<3>(1, 0, 0), Vector<3>(1, 1, 0), Vector<3>(0, 1, 0), Vector<3>(0, 0, 1),
          Vector<3>(1, 0, 1), Vector<3>(1, 1, 1), Vector<3>(0, 1, 1), Vector<3>(0.5123456789, 0.4987654321, height)})
      text += fmt::format("v {1:.{0}f} {2:.{0}f} {3:.{0}f}\n", decimals, p[0], p[1], p[2]);
    return read_obj(text +
                    "f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\n")
        .front();
  };
  for (const int decimals : {3, 4, 5, 9}) {
    const double unit = std::pow(10.0, -decimals);
    std::vector<FileRemark> remarks;
    EXPECT_EQ(convex_corners(dented(1, decimals), &remarks).size(), 8u) << decimals;
    EXPECT_TRUE(remarks.empty()) << decimals;
    EXPECT_EQ(convex_corners(dented(1 - unit, decimals), &remarks).size(), 8u) << decimals;
    const double deep = std::max(1e-5, 20 * unit);
    expect_fault([&] { convex_corners(dented(1 - deep, decimals)); }, 12, 0, "the block is not convex");
    EXPECT_EQ(convex_corners(dented(1 + 10 * deep, decimals)).size(), 9u) << decimals;
  }
}

TEST(Obj, ReportsThePlaceOfAnError) {
  const auto fault = [](const std::string& obj, int line, int column, const std::string& part) {
    expect_fault([&] { read_obj(obj); }, line, column, part);
  };
  fault("", 1, 0, "contains no face");
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

TEST(Stl, ReportsThePlaceOfAnError) {
  const auto fault = [](const std::string& stl, int line, int column, const std::string& part) {
    expect_fault([&] { read_stl(stl); }, line, column, part);
  };
  fault("", 1, 0, "is no STL");
  fault("v 0 0 0\n", 1, 0, "is no STL");
  fault("solid a\n", 1, 0, "the file ends");
  fault("solid a\n  facett\n", 2, 3, "instead of 'facet'");
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

// in single precision, some faces of a convex block are not plane
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

// Far from the origin floats are far apart: from a spacing of a thousandth of its shortest edge on a block is reported,
// in binary files and in texts of as few digits, or refused, which is a report too.
TEST(Stl, ALossOfDigitsFarFromTheOriginIsReported) {
  shapes::Random random(17);
  for (int i = 0; i < 200; ++i) {
    const double edge = shapes::uniform(random, 0.3, 3);
    const Vector<3> about = shapes::power_of_ten(random, 0, 8) * shapes::direction<3>(random);
    const Mesh box = turned_box(random, Vector<3>::Constant(edge), about);
    double largest = 0;
    for (const Vector<3>& p : box.points)
      largest = std::max(largest, p.cwiseAbs().maxCoeff());
    int exponent = 0;
    std::frexp(largest, &exponent);
    const double spacing = std::ldexp(1.0, exponent - 24);  // of the 24 bits of a float
    std::vector<FileRemark> remarks;
    double volume = 0;
    try {
      volume = hull_volume(convex_corners(read_stl(binary_stl(box)).front(), &remarks));
    } catch (const FileFault& fault) {
      EXPECT_GT(spacing, 1e-4 * edge) << fault.what();
      continue;
    }
    const bool told = std::any_of(remarks.begin(), remarks.end(), [](const FileRemark& remark) {
      return remark.text.find("its shortest edge is") != std::string::npos;
    });
    if (spacing < 0.5e-3 * edge) {
      EXPECT_FALSE(told) << spacing / edge;
    }
    if (spacing > 2e-3 * edge) {
      EXPECT_TRUE(told) << spacing / edge;
    }
    if (!told) {
      EXPECT_NEAR(volume / std::pow(edge, 3), 1, 1e-2);
    }
  }
  // a text with the digits of floats
  for (const auto& [digits, is_told] : {std::pair{7, true}, {8, true}, {12, false}, {17, false}}) {
    Mesh box = mesh_of(shapes::cube<3>(1), Vector<3>(1234567, 0, 0));
    std::string text = "solid far\n";
    for (const Facet& facet : box.facets)
      for (std::size_t k = 1; k + 1 < facet.corners.size(); ++k) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const int corner : {facet.corners[0], facet.corners[k], facet.corners[k + 1]})
          text += fmt::format("vertex {:.{}e} {:e} {:e}\n", box.points[corner][0] + 0.1234567, digits - 1,
                              box.points[corner][1], box.points[corner][2]);
        text += "endloop\nendfacet\n";
      }
    std::vector<FileRemark> remarks;
    try {
      convex_corners(read_stl(text + "endsolid far\n").front(), &remarks);
      EXPECT_EQ(!remarks.empty(), is_told) << digits;
    } catch (const FileFault&) {
      EXPECT_TRUE(is_told) << digits;
    }
  }
}

}  // namespace
}  // namespace voussoir::mesh_test
