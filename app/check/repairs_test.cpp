// Repairs that name the mistake in a scene or in one of its tables.
#include "app/testing/checked_scene.hpp"

namespace voussoir::repairs_test {
namespace {

using namespace program;

class Repair : public CheckedScene {
 protected:
  void refused_table(const std::string& table, const std::string& part) const {
    write("a.csv", table);
    refused(
        "dimension = 3\ndensity = 2000\njoints_file = \"a.csv\"\ndomain = { box = { min = [0, 0, 0], max = [1, 1, 1] "
        "} }\n" +
            rock_properties + settle_stage,
        part);
  }
};

std::string utf_16(const std::string& text) {
  std::string wide = "\xFF\xFE";
  for (const char character : text)
    wide += {character, '\0'};
  return wide;
}

TEST_F(Repair, OfTablesNamesTheMistake) {
  const std::string header = "dip_deg,dip_direction_deg,x_m,y_m,z_m\n", row = "30,90,0,0,0\n";
  refused_table("# joints of the east wall\n" + header + row, "a.csv:1: a comment");
  refused_table(header + "# the first\n" + row, "a.csv:2: a comment");
  refused_table(row + row, "a.csv:1: the header is missing");
  refused_table("dip_deg;dip_direction_deg;x_m;y_m;z_m\n30;90;0;0;0\n",
                "a.csv:1:8: columns are separated by semicolons");
  refused_table("dip_deg\tdip_direction_deg\tx_m\ty_m\tz_m\n", "columns are separated by tabs");
  refused_table(header + "30,5,90,0,0,0\n", "write 3.5, not 3,5");
  refused_table(header + "\"30,5\",90,0,0,0\n", "write the decimals with a point");
  refused_table(utf_16(header + row), "is written in UTF-16; save it as UTF-8");
  refused_table(utf_16(header + row).substr(2), "is written in UTF-16");
  refused_table(header + "30,90,0,0\n", "has 4 cells, but the header has 5; leave a cell empty but keep its comma");
}

TEST_F(Repair, OfScenesNamesTheMistake) {
  refused("dimension = 2\ndensity = 2,5\n", "scene.toml:2: not valid TOML");
  refused("dimension = 2\ndensity = 2,5\n", "decimals are written with a point: 2.5, not 2,5");
  refused("dimension = 3\ngravity = [0, 0, -9,81]\n", "gravity = [0, 0, -9.81]; decimals are written with a point");
  refused("dimension = 3\n// gravity\n", "a comment begins with #, not with //");
  refused("dimension = 3;\n", "a line ends without a semicolon");
  refused(utf_16("dimension = 3\n"), "is written in UTF-16; save it as UTF-8");
}

TEST_F(Repair, OfAFolderWithoutPermissionNamesTheFolder) {
  if (::geteuid() == 0) GTEST_SKIP() << "root enters every folder";
  fs::create_directories(folder_ / "closed");
  write("closed/scene.toml",
        head_in_plane + rock_properties + box("ground", -5, -20, 20) + "fixed = true\n" + settle_stage);
  fs::permissions(folder_ / "closed", fs::perms::none);
  expect_one_line(run("check closed/scene.toml"), 2, "those of the folders above it");
  fs::permissions(folder_ / "closed", fs::perms::owner_all);
}

}  // namespace
}  // namespace voussoir::repairs_test
