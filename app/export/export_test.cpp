// `voussoir export`: the text read back gives the blocks that `voussoir slice` writes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "app/testing/program.hpp"
#include "core/geometry/types.hpp"

namespace voussoir::export_test {
namespace {

using namespace program;

const std::string rock = R"(title = "wedges & a 'plate'"
dimension = 3
gravity = [0, 0, -9.81]
density = 2600
domain = { box = { min = [1000, 2000, 300], max = [1010, 2010, 310] } }
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e8
friction_deg = 35
cohesion = 1e4
[[joint_properties]]
name = "clay"
normal_stiffness = 2e8
shear_stiffness = 1e7
friction_deg = 20
[[joints]]
name = "A"
dip = 40
dip_direction = 130
point = [1005, 2005, 305]
properties = "rock"
[[joints]]
name = "B"
dip = 60
dip_direction = 220
point = [1004, 2005, 305]
properties = "rock"
[[joints]]
name = "C"
dip = 10
dip_direction = 20
point = [1005, 2004, 303]
properties = "clay"
[[fix]]
below = ["C"]
[[stage]]
name = "settle"
kind = "settle"
[[monitors]]
name = "m"
above = ["A", "B", "C"]
over = "mean"
quantities = ["displacement"]
)";

// a block as the text describes it
struct ReadBlock {
  double volume = 0;
  Vector<3> centroid = Vector<3>::Zero();
  std::vector<std::array<double, 4>> planes;  // outward unit normal, offset
  bool fixed = false;
};

// A small reader of `block create polyhedron`, with faces clockwise seen from outside, and of `block fix`.
std::vector<ReadBlock> read_three_dec(const std::string& text) {
  std::vector<ReadBlock> blocks;
  bool goes_on = false;
  for (std::string line : lines_of(text)) {
    if (line.starts_with(";")) continue;
    if (line.starts_with("block fix range")) {
      double low[3], high[3];
      EXPECT_EQ(std::sscanf(line.c_str(), "block fix range position-x %lf %lf position-y %lf %lf position-z %lf %lf",
                            &low[0], &high[0], &low[1], &high[1], &low[2], &high[2]),
                6)
          << line;
      for (ReadBlock& block : blocks)
        if ((block.centroid.array() > Vector<3>(low).array()).all() &&
            (block.centroid.array() < Vector<3>(high).array()).all())
          block.fixed = true;
    }
    if (line.starts_with("block create polyhedron")) blocks.emplace_back();
    const bool face = line.starts_with("  face ");
    EXPECT_EQ(face, goes_on) << "a face is on a line that the one before continues with &: " << line;
    goes_on = line.ends_with("&");
    if (!face) continue;
    std::istringstream words(line.substr(7));
    std::vector<Vector<3>> corners;
    for (std::string word; words >> word && word != "&";) {
      Vector<3> p;
      EXPECT_EQ(std::sscanf(word.c_str(), "%lf,%lf,%lf", &p[0], &p[1], &p[2]), 3) << word;
      corners.push_back(p);
    }
    EXPECT_GE(corners.size(), 3u) << line;
    if (corners.size() < 3) return blocks;
    ReadBlock& block = blocks.back();
    Vector<3> area = Vector<3>::Zero();
    // seen from a corner of the first face, so that large coordinates do not cancel; clockwise: the outside is minus
    static Vector<3> from;
    if (block.planes.empty()) from = corners[0], block.centroid.setZero();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const Vector<3> a = corners[0] - from, b = corners[k] - from, c = corners[k + 1] - from;
      const double six = -a.dot(b.cross(c));
      block.volume += six / 6;
      block.centroid += six / 24 * (a + b + c);
      area -= (b - a).cross(c - a);
    }
    const Vector<3> normal = area.normalized();
    block.planes.push_back({normal[0], normal[1], normal[2], normal.dot(corners[0])});
    if (!goes_on) block.centroid = from + block.centroid / block.volume;
  }
  return blocks;
}

// a block of a script for YADE: the lines block('name', material, [(x, y, z), …], fixed, 'blocked')
struct YadeBlock {
  std::vector<Vector<3>> vertices;
  bool fixed = false;
};
std::vector<YadeBlock> read_yade(const std::string& text) {
  std::vector<YadeBlock> blocks;
  for (const std::string& line : lines_of(text)) {
    if (!line.starts_with("block('")) continue;
    YadeBlock& block = blocks.emplace_back();
    for (std::size_t at = line.find('(', line.find(", [")); at != std::string::npos; at = line.find('(', at + 1)) {
      Vector<3>& v = block.vertices.emplace_back();
      EXPECT_EQ(std::sscanf(line.c_str() + at, "(%lf, %lf, %lf)", &v[0], &v[1], &v[2]), 3) << line;
    }
    block.fixed = line.find(", True, '") != std::string::npos;
  }
  return blocks;
}

// all vertices are behind all planes, and each plane has a face of them
void expect_vertices_of(const std::vector<Vector<3>>& vertices, const ReadBlock& block) {
  for (const std::array<double, 4>& plane : block.planes) {
    int on = 0;
    for (const Vector<3>& v : vertices) {
      const double beyond = Vector<3>(plane[0], plane[1], plane[2]).dot(v) - plane[3];
      EXPECT_LT(beyond, 1e-11);
      on += std::abs(beyond) < 1e-11;
    }
    EXPECT_GE(on, 3);
  }
}

std::vector<std::string> cells(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> all;
  for (std::string cell; std::getline(stream, cell, ',');)
    all.push_back(cell);
  return all;
}

// blocks.csv and block_planes.csv
std::vector<ReadBlock> read_sliced(const fs::path& folder) {
  std::vector<ReadBlock> blocks;
  const std::vector<std::string> rows = lines_of(read(folder / "blocks.csv"));
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const std::vector<std::string> row = cells(rows[k]);
    ReadBlock& block = blocks.emplace_back();
    block.volume = std::stod(row[2]);
    block.fixed = row[5] == "1";
    block.centroid = {std::stod(row[6]), std::stod(row[7]), std::stod(row[8])};
  }
  std::map<std::string, std::size_t> places;
  const std::vector<std::string> planes = lines_of(read(folder / "block_planes.csv"));
  std::map<std::string, std::size_t> columns;
  const std::vector<std::string> names = cells(planes[0]);
  for (std::size_t c = 0; c < names.size(); ++c)
    columns[names[c]] = c;
  for (std::size_t k = 1; k < planes.size(); ++k) {
    const std::vector<std::string> row = cells(planes[k]);
    const std::size_t b = places.try_emplace(row[columns["block"]], places.size()).first->second;
    const auto number = [&](const char* column) { return std::stod(row[columns[column]]); };
    blocks[b].planes.push_back({number("normal_x"), number("normal_y"), number("normal_z"), number("offset_m")});
  }
  return blocks;
}

// every plane of one list is in the other; coordinates of 2000 m are rounded to 2.3e-13 m
void expect_planes(const ReadBlock& found, const ReadBlock& expected) {
  ASSERT_EQ(found.planes.size(), expected.planes.size());
  for (const auto& p : expected.planes) {
    double nearest = 1;
    for (const auto& q : found.planes)
      nearest = std::min(nearest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) * 2000 + std::abs(p[3] - q[3]));
    EXPECT_LT(nearest, 1e-8) << "normals from corners round by 2e-13 over edges of half a metre and more";
  }
}

class Export : public Program {
 protected:
  std::string exported(const std::string& arguments) const {
    const Ended ended = run("export scene.toml --out out.txt --overwrite " + arguments);
    EXPECT_EQ(ended.code, 0) << ended.err;
    return read(folder_ / "out.txt");
  }
};

TEST_F(Export, ReadsBackAsTheBlocksThatWereCut) {
  write("scene.toml", rock);
  ASSERT_EQ(run("slice scene.toml --out sliced --planes").code, 0);
  const std::vector<ReadBlock> sliced = read_sliced(folder_ / "sliced");
  const std::string data = exported("--as 3dec");
  const std::vector<ReadBlock> found = read_three_dec(data);
  ASSERT_EQ(found.size(), sliced.size());
  ASSERT_EQ(found.size(), 8u);
  int fixed = 0;
  for (std::size_t b = 0; b < found.size(); ++b) {
    EXPECT_NEAR(found[b].volume, sliced[b].volume, 1e-9) << "100 m2 of faces times rounding";
    EXPECT_LT((found[b].centroid - sliced[b].centroid).norm(), 1e-9);
    EXPECT_EQ(found[b].fixed, sliced[b].fixed) << b;
    expect_planes(found[b], sliced[b]);
    fixed += found[b].fixed;
  }
  EXPECT_GT(fixed, 0);
  EXPECT_LT(fixed, 8);
  for (const char* part :
       {"; wedges & a 'plate'", "NOT run in 3DEC", "Units: m, kg, s, N, Pa", "- the stages (settle)", "- 1 monitors",
        "model gravity 0 0 -9.81", "block contact jmodel assign mohr", "stiffness-normal 1000000000 ", "friction 35",
        "cohesion 10000 ", "; joint C: dip 10 dip-direction 20 origin ", "friction 20", " range plane normal "})
    EXPECT_NE(data.find(part), std::string::npos) << part;
  EXPECT_EQ(data.find("range plane"), data.rfind("range plane")) << "only one joint has other properties than most";

  // 3DEC's joints dilate as ours of the constant law, YADE's do not
  const std::string dilation =
      " --set joint_properties.rock.dilation_law=constant --set joint_properties.rock.dilation_deg=8 --set "
      "joint_properties.rock.dilation_until_m=0.01";
  EXPECT_NE(exported("--as 3dec" + dilation).find("friction 35 dilation 8 dilation-zero 0.01 cohesion"),
            std::string::npos);
  expect_one_line(run("export scene.toml --as yade --set joints.C.properties=rock --set "
                      "joint_properties.rock.cohesion=0 --out y.py" +
                      dilation),
                  2, "joint_properties.rock.dilation_law");

  // YADE has one stiffness and friction for all
  expect_one_line(run("export scene.toml --as yade --out y.py"), 2, "2 joint_properties (rock, clay)");
  const std::string alike = "--as yade --set joints.C.properties=rock --set joint_properties.rock.cohesion=0";
  const std::string script = exported(alike);
  const std::vector<YadeBlock> there = read_yade(script);
  ASSERT_EQ(there.size(), sliced.size());
  for (std::size_t b = 0; b < there.size(); ++b) {
    EXPECT_EQ(there[b].fixed, sliced[b].fixed);
    expect_vertices_of(there[b].vertices, sliced[b]);
  }
  EXPECT_NE(script.find("were run in YADE 2023.02a; this one was not"), std::string::npos);
  if (std::system("command -v python3 >/dev/null 2>&1") == 0) {
    EXPECT_EQ(std::system(
                  fmt::format("python3 -c \"import ast; ast.parse(open('{}').read())\"", (folder_ / "out.txt").string())
                      .c_str()),
              0);
  }
}

// ---- words of 3DEC

using Keywords = std::map<std::string, std::vector<std::string>>;

std::vector<std::string> words_in(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;)
    words.push_back(word);
  return words;
}

// of every command, and of `range`
Keywords three_dec_keywords() {
  Keywords keywords;
  for (const std::string& line : lines_of(read(scenes / "three_dec_keywords.txt"))) {
    if (line.starts_with("#")) continue;
    const std::size_t first = line.find(" | "), second = line.find(" | ", first + 2);
    EXPECT_NE(second, std::string::npos) << line;
    keywords[line.substr(0, first)] = words_in(line.substr(first + 2, second - first - 2));
  }
  return keywords;
}

// numbers, and vectors of them
bool is_value(const std::string& word) {
  return word.find_first_not_of("0123456789.,eE+-") == std::string::npos &&
         word.find_first_of("0123456789") != std::string::npos;
}

// the first word of a data file that is in no list; empty if all are
std::string foreign_word(const std::string& data, const Keywords& keywords) {
  std::string command;
  for (std::string line : lines_of(data)) {
    if (line.starts_with(";")) continue;
    const bool goes_on = line.ends_with("&");
    command += " " + line.substr(0, line.size() - (goes_on ? 1 : 0));
    if (goes_on) continue;
    for (std::size_t open = command.find('\''); open != std::string::npos; open = command.find('\'', open))
      command.replace(open, command.find('\'', open + 1) - open + 1, "0");  // a name is a value
    std::vector<std::string> words = words_in(command);
    command.clear();
    std::string known;
    std::size_t behind = 0;
    std::string so_far;
    for (std::size_t k = 0; k < words.size(); ++k) {
      so_far += (k > 0 ? " " : "") + words[k];
      if (keywords.contains(so_far)) known = so_far, behind = k + 1;
    }
    if (known.empty()) return line;
    const std::vector<std::string>* allowed = &keywords.at(known);
    for (std::size_t k = behind; k < words.size(); ++k) {
      if (words[k] == "range")
        allowed = &keywords.at("range");
      else if (!is_value(words[k]) && std::find(allowed->begin(), allowed->end(), words[k]) == allowed->end())
        return words[k];
    }
  }
  return "";
}

TEST_F(Export, EveryWordIsOneOf3dec) {
  const Keywords keywords = three_dec_keywords();
  write("scene.toml", rock);
  const std::string data = exported("--as 3dec");
  EXPECT_EQ(foreign_word(data, keywords), "");
  // any word that is changed is found
  for (const std::string word : {" polyhedron ", " face ", " large-strain ", "gravity ", " density ", " fix ",
                                 " group ", " stiffness-normal ", " friction ", " range ", " position-y ", " plane ",
                                 " origin ", " distance ", " jmodel ", " default ", " material-table "}) {
    std::string changed = data;
    const std::size_t at = changed.rfind(word);  // comments come before
    ASSERT_NE(at, std::string::npos) << word;
    changed[at + 2] = 'q';
    EXPECT_NE(foreign_word(changed, keywords), "") << word;
  }
  // the stiffness of contacts that form later, without which large strain does not cycle: of the most common properties
  const std::size_t table = data.find("block contact material-table default jmodel mohr\n");
  ASSERT_NE(table, std::string::npos);
  EXPECT_NE(data.find("block contact material-table default property stiffness-normal 1000000000 stiffness-shear "
                      "100000000 friction 35\n",
                      table),
            std::string::npos)
      << data;
  EXPECT_LT(data.find("model large-strain on"), table);
  write("scene.toml", read(scenes / "two_cubes.toml"));
  const std::string cubes = exported("--as 3dec");
  EXPECT_EQ(foreign_word(cubes, keywords), "");
  EXPECT_NE(cubes.find("block contact material-table default property stiffness-normal "), std::string::npos);
}

TEST_F(Export, StatedBlocksKeepTheirNames) {
  write("scene.toml", read(scenes / "two_cubes.toml"));
  const std::string data = exported("--as 3dec");
  EXPECT_EQ(read_three_dec(data).size(), 2u);
  EXPECT_NE(data.find("block group '"), std::string::npos);
  EXPECT_EQ(read_yade(exported("--as yade")).size(), 2u);
}

TEST_F(Export, UnsupportedFeaturesAreRefusedInOneLine) {
  write("scene.toml", rock);
  struct Case {
    std::string more, arguments, says;
  };
  const std::string water = "[[water]]\nname = \"lake\"\nlevel = 305\n";
  const std::string bolt =
      "[[bolts]]\nname = \"roof\"\nfrom = [1005, 2005, 301]\nto = [1005, 2005, 309]\nstiffness = 1e8\n[[stage]]\nname "
      "= "
      "\"hold\"\nkind = \"settle\"\ninstall = [\"roof\"]\n";
  const std::string ball =
      "[[blocks]]\nname = \"ball\"\nshape = \"potential\"\nsphericity = 1\nsphere_radius = 1\ncentre = [1005, 2005, "
      "320]\n[[joint_properties]]\nname = \"default\"\nnormal_stiffness = 1e9\nshear_stiffness = 1e8\nfriction_deg = "
      "30\nconstant_stiffness = true\n";
  const std::string held =
      "[[joints]]\nname = \"D\"\ndip = 80\ndip_direction = 10\npoint = [1005, 2005, 305]\nkind = "
      "\"construction\"\nproperties = \"rock\"\n";
  for (const char* format : {"3dec", "yade"})
    for (const Case& c : std::vector<Case>{
             {water, "", "water.lake"},
             {bolt, "", "bolts.roof"},
             {ball, "", "blocks.ball.shape"},
             {held, "", "convex parts"},
             {"",
              "--set joint_properties.rock.friction_law=softening --set joint_properties.rock.softening_drop=0.1 --set "
              "joint_properties.rock.softening_slip_m=0.01",
              "joint_properties.rock.friction_law"},
             {"",
              "--set joint_properties.rock.dilation_law=falling --set joint_properties.rock.dilation_deg=8 --set "
              "joint_properties.rock.dilation_decay_m=0.01",
              "joint_properties.rock.dilation_law"},
             {"",
              "--set joint_properties.rock.friction_law=barton_bandis --set joint_properties.rock.jrc=10 --set "
              "joint_properties.rock.jcs=3e7",
              "has no Barton-Bandis model"},
         }) {
      write("scene.toml", rock + c.more);
      expect_one_line(run(fmt::format("export scene.toml --as {} --out x.txt --set joints.C.properties=rock --set "
                                      "joint_properties.rock.cohesion=0 {}",
                                      format, c.arguments)),
                      2, c.says);
      EXPECT_FALSE(fs::exists(folder_ / "x.txt"));
    }
  write("scene.toml", rock);
  expect_one_line(run("export scene.toml --as yade --set joints.C.properties=rock --out x.py"), 2,
                  "tension or cohesion");
  expect_one_line(run("export scene.toml --as udec --out x.txt"), 2, "--as");
  expect_one_line(run("export " + squares_ + "--as 3dec --out x.txt"), 2, "dimension = 2");
  expect_one_line(run("export scene.toml --as 3dec --out scene.toml --overwrite"), 2, "scene.toml");
  exported("--as 3dec");
  expect_one_line(run("export scene.toml --as 3dec --out out.txt"), 2, "--overwrite");
}

}  // namespace
}  // namespace voussoir::export_test
