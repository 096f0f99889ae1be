// Tables: written files read back unchanged; malformed ones are reported with the place.
#include "core/exchange/tables.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/half_space.hpp"
#include "core/testing/expected_fault.hpp"
#include "core/testing/shapes.hpp"
#include "text/angle.hpp"

namespace voussoir::tables_test {
namespace {

TEST(JointTable, ReportsThePlaceOfAnError) {
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

// headers of field books, spreadsheets and other programs
TEST(JointTable, NamesTheColumnThatIsMeant) {
  const std::pair<const char*, const char*> meant[] = {{"Dip", "dip_deg"},
                                                       {"dip", "dip_deg"},
                                                       {"DIP_DEG", "dip_deg"},
                                                       {"ID", "name"},
                                                       {"Id", "name"},
                                                       {"Name", "name"},
                                                       {"DipDir", "dip_direction_deg"},
                                                       {"Dip_Direction", "dip_direction_deg"},
                                                       {"Azimuth", "dip_direction_deg"},
                                                       {"X", "x_m"},
                                                       {"Easting", "x_m"},
                                                       {"z", "z_m"},
                                                       {"Strike", "strike_deg"},
                                                       {"strike_dge", "strike_deg"},
                                                       {"Length", "length_m"},
                                                       {"lenght_m", "length_m"},
                                                       {"Set", "set"},
                                                       {"Nx", "normal_x"}};
  for (const auto& [stated, column] : meant) {
    const std::string table = fmt::format("{},b,c\n1,2,3\n", stated);
    expect_fault([&] { read_joint_table(table, 3); }, 1, 1,
                 fmt::format("no such column as '{}'; did you mean {}?", stated, column));
  }
  expect_fault([] { read_joint_table("colour,x_m,y_m,z_m\n", 3); }, 1, 1, "no such column as 'colour'; there are");
  expect_fault([] { read_joint_table("Strike,x_m,y_m\n", 2); }, 1, 1, "no such column as 'Strike'; there are");
  expect_fault([] { read_joint_table("sep=,\nname,x_m,y_m,z_m,dip_deg\n", 3); }, 1, 0, "remove this line");
  expect_fault(
      [] {
        read_joint_table(
            "Name,Strike,Dip,Dip_Dir,Cx,Cy,Cz,Nx,Ny,Nz,Sample_Radius,RMS,Gx,Gy,Gz,Length\n"
            "Plane,30,40,120,1,2,3,0,0,1,1,0.1,1,2,3,-1\n",
            3);
      },
      1, 0, "rename its columns Name, Dip, Dip_Dir, Cx, Cy, Cz");
}

// the plane through the strike's horizontal line that dips to the right of it
TEST(JointTable, StrikeIsReadByTheRightHandRule) {
  shapes::Random random(15);
  for (int i = 0; i < 200; ++i) {
    const double strike = i < 5 ? 90 * i : shapes::uniform(random, 0, 360), dip = shapes::uniform(random, 1, 89);
    std::vector<FileRemark> remarks;
    const std::vector<JointRow> rows =
        read_joint_table(fmt::format("strike_deg,dip_deg,x_m,y_m,z_m\n{},{},0,0,0\n", strike, dip), 3, &remarks);
    const Vector<3> along(std::sin(strike * degree), std::cos(strike * degree), 0);  // x east, y north
    const Vector<3> right(std::cos(strike * degree), -std::sin(strike * degree), 0);
    const Vector<3> down = std::cos(dip * degree) * right - std::sin(dip * degree) * Vector<3>::UnitZ();
    const Vector<3> normal = upward_normal_3d(*rows[0].dip_deg * degree, *rows[0].dip_direction_deg * degree);
    EXPECT_NEAR(normal.dot(along), 0, 1e-14);
    EXPECT_NEAR(normal.dot(down), 0, 1e-14);
    EXPECT_GE(*rows[0].dip_direction_deg, 0);
    EXPECT_LE(*rows[0].dip_direction_deg, 360);
    ASSERT_EQ(remarks.size(), 1u);
    EXPECT_NE(remarks[0].text.find("right-hand rule: dip direction = strike + 90 degrees"), std::string::npos);
  }
  const std::string head = "strike_deg,dip_deg,dip_direction_deg,x_m,y_m,z_m\n";
  expect_fault([&] { read_joint_table(head + "10,20,100,0,0,0\n", 3); }, 2, 1, "states dip_direction_deg too");
  expect_fault([&] { read_joint_table(head + "361,20,,0,0,0\n", 3); }, 2, 1, "must be from 0 to 360");
  EXPECT_EQ(*read_joint_table(head + ",20,100,0,0,0\n", 3)[0].dip_direction_deg, 100);
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

}  // namespace
}  // namespace voussoir::tables_test
