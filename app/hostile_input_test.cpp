// Scenes that ask for too much, and invalid files: refused in one line, exit code 2, with little memory and time.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "app/testing/program.hpp"

namespace voussoir::hostile_input_test {
namespace {

using namespace program;

// kilobytes of memory and seconds of processor time; a program that needs more is killed, as its exit code shows.
// Sanitizers reserve terabytes.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
const std::string limits = "ulimit -t 60 && ";
#else
const std::string limits = "ulimit -t 5 && ulimit -v 500000 && ";
#endif

class Hostile : public Program {
 protected:
  Ended check(const std::string& scene, const std::string& more = "") const {
    return run("check '" + scene + "' " + more, limits);
  }
  void refused(const std::string& scene, const std::string& part) const {
    SCOPED_TRACE(scene);
    expect_one_line(check(scene), 2, part);
  }
  void refused_text(const std::string& text, const std::string& part) const {
    write("scene.toml", text);
    refused("scene.toml", part);
  }
  // texts of up to 15 MB, divided by `share`
  void sizes_are_refused(int share) const;
  void tables_and_meshes_are_refused(int share) const;
};

using HostileLong = Hostile;

std::string repeated(const std::string& text, int count) {
  std::string all;
  all.reserve(text.size() * count);
  for (int i = 0; i < count; ++i)
    all += text;
  return all;
}

void Hostile::sizes_are_refused(int share) const {
  write("sparse.toml", "");
  fs::resize_file(folder_ / "sparse.toml", std::uintmax_t{10} << 30);
  refused("sparse.toml", "larger than 16 MB");
  fs::remove(folder_ / "sparse.toml");

  refused_text("a = " + repeated("[", 100'000), "depth");
  refused_text("a = " + repeated("{a=", 100'000), "depth");
  refused_text("a" + repeated(".a", 100'000) + " = 1", "100 dots");
  refused_text("[a" + repeated(".a", 100'000) + "]", "100 dots");
  refused_text(repeated("[", 1'000'000), "scene.toml:1");
  refused_text("density = " + repeated("1", 1'000'000), "too long");
  refused_text("density = 0." + repeated("1", 1'000'000), "length");
  refused_text("density = 1e" + repeated("1", 1'000'000), "scene.toml:1");
  refused_text("dimension = 3\ntitle = \"" + repeated("a", 10'000'000 / share) + "\"", "at most 1000 characters");
  refused_text("dimension = 3\n" + repeated("a", 10'000'000 / share) + " = 1", "no such key");
  refused_text("a = [" + repeated("1,", 7'000'000 / share) + "]", "more than a million values");
  refused_text(repeated("[[fix]]\n", 1'500'000), "more than a million values");
  refused_text("dimension = 3\n" + repeated("[[fix]]\n", 400'000), "fix.1.below is missing");
  refused_text(repeated("\n", 15'000'000 / share), "dimension is missing");
  refused_text("dimension = 3\n[[blocks]]\nname = \"a\"\nvertices = [" + repeated("[0,0,0],", 201) + "]",
               "at most 200 points");
  refused_text("dimension = 3\n[[blocks]]\nname = \"a\"\nplanes = [" + repeated("{},", 201) + "]",
               "at most 200 planes");
  refused_text("dimension = 3\n" + repeated("[[joints]]\n", 10'001), "at most 10000 joints");
}

TEST_F(Hostile, SizesAreRefusedBeforeTheyAreAllocated) {
  sizes_are_refused(5);
}

TEST_F(HostileLong, SizesAreRefusedBeforeTheyAreAllocated) {
  sizes_are_refused(1);
}

TEST_F(Hostile, OnlyRegularFilesAreScenes) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.toml").c_str(), 0600), 0);
  refused("pipe.toml", "not a file");
  refused("/dev/zero", "not a file");
  refused("/dev/stdin", "not a file");
  refused(".", "not a file");
  fs::create_symlink("circle.toml", folder_ / "circle.toml");
  refused("circle.toml", "no such file");
}

TEST_F(Hostile, ABaseIsARegularFileInTheScenesFolder) {
  const std::string good = read(scenes / "two_cubes.toml");
  write("good.toml", good);
  fs::create_directories(folder_ / "below");
  write("below/good.toml", good);
  fs::create_directories(folder_.string() + "_outside");
  std::ofstream(folder_.string() + "_outside/good.toml") << good;
  ASSERT_EQ(::mkfifo((folder_ / "pipe.toml").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", folder_ / "device.toml");
  fs::create_symlink(folder_.string() + "_outside/good.toml", folder_ / "leaves.toml");
  fs::create_symlink(folder_.string() + "_outside", folder_ / "away");
  fs::create_symlink("good.toml", folder_ / "stays.toml");
  fs::create_symlink("self.toml", folder_ / "self.toml");

  for (const char* base : {"good.toml", "below/good.toml", "./good.toml", "stays.toml"}) {
    write("scene.toml", std::string("base = \"") + base + "\"\n");
    EXPECT_EQ(check("scene.toml").code, 0) << base;
  }
  const std::pair<std::string, std::string> bad[] = {{"../" + folder_.filename().string() + "/good.toml", "without .."},
                                                     {"below/../good.toml", "without .."},
                                                     {(folder_ / "good.toml").string(), "leading /"},
                                                     {"none.toml", "no such file"},
                                                     {"below", "no such file"},
                                                     {"pipe.toml", "no such file"},
                                                     {"device.toml", "no such file"},
                                                     {"self.toml", "no such file"},
                                                     {"good.toml\\u0000", "no such file"},
                                                     {"leaves.toml", "leads out of the scene's own folder"},
                                                     {"away/good.toml", "leads out of the scene's own folder"},
                                                     {"scene.toml", "leads back to the scene itself"},
                                                     {"", "no such file"}};
  for (const auto& [base, part] : bad)
    refused_text("base = \"" + base + "\"\n", part);
  expect_one_line(check("good.toml", "--set base=below/good.toml"), 2, "cannot be set");
  fs::remove_all(folder_.string() + "_outside");
}

TEST_F(Hostile, BasesChainSixteenDeepAndEndInNoCircle) {
  write("0.toml", read(scenes / "two_cubes.toml"));
  for (int i = 1; i <= 17; ++i)
    write(fmt::format("{}.toml", i), fmt::format("base = \"{}.toml\"\n", i - 1));
  EXPECT_EQ(check("16.toml").code, 0);
  refused("17.toml", "more than 16 bases");
  write("a.toml", "base = \"b.toml\"\n");
  write("b.toml", "base = \"a.toml\"\n");
  refused("a.toml", "leads back to the scene itself");
}

// files of joints and blocks that a scene names
void Hostile::tables_and_meshes_are_refused(int share) const {
  const std::string stage =
      "joint_properties = [{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]\n"
      "stage = [{ name = \"s\", kind = \"settle\" }]\n";
  const auto refused_file = [&](const std::string& key, const std::string& name, const std::string& content,
                                const std::string& part) {
    write(name, content);
    refused_text("dimension = 3\ndensity = 1\n" + key + " = \"" + name + "\"\n" + stage, part);
  };
  const std::string joints = "dip_deg,dip_direction_deg,x_m,y_m,z_m\n";
  const std::string planes = "block,normal_x,normal_y,normal_z,offset_m\n";
  refused_file("joints_file", "a.csv", "", "a.csv:1: is empty");
  refused_file("joints_file", "a.csv", std::string(1'000'000 / share, '\0'), "a.csv:1:1: a control character");
  refused_file("joints_file", "a.csv", std::string(15'000'000 / share, ','), "a.csv:1:201: more than 200 columns");
  refused_file("joints_file", "a.csv", std::string(15'000'000 / share, '"'), "a.csv:1:");
  refused_file("joints_file", "a.csv", repeated("\n", 15'000'000 / share), "a.csv:1: is empty");
  refused_file("joints_file", "a.csv", joints + repeated("1,2,3,4,5\n", 1'000'000 / share),
               "a.csv:10002: more than 10000 rows");
  refused_file("joints_file", "a.csv", joints + "1,2,3,4," + repeated("1", 10'000'000 / share) + "\n",
               "a.csv:2:9: z_m = '1111");
  refused_file("joints_file", "a.csv", joints + "1,2,3,4\n", "a.csv:2: has 4 cells");
  refused_file("joints_file", "a.csv", joints + "1e400,2,3,4,5\n", "a.csv:2:1: dip_deg = '1e400'");
  refused_file("blocks_file", "b.csv", planes + repeated("a,1,0,0,1\n", 1'000'000 / share),
               "b.csv:100002: more than 100000 rows");
  refused_file("blocks_file", "b.csv", planes + repeated("a,1,0,0,1\n", 300), "at most 200 planes");
  refused_file("blocks_file", "b.csv", planes + "a,1,0,0,1\n", "b.csv:2: blocks.a.planes");
  refused_file("blocks_file", "b.csv", planes + "a,0,0,0,1\n", "b.csv:2: blocks.a.planes.1.normal");
  refused_file("blocks_file", "b.obj", repeated("v 0 0 0\n", 1'500'000 / share), "b.obj:1: contains no face");
  refused_file("blocks_file", "b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + repeated("f 1 2 3\n", 1'500'000 / share),
               "b.obj:5004: more than 5000 facets");
  refused_file("blocks_file", "b.obj", "f" + repeated(" 1", 7'000'000 / share), "b.obj:1:2001: more than 1000 words");
  refused_file("blocks_file", "b.obj", "f -9223372036854775808 1 1\n", "b.obj:1:3: corner");
  refused_file("blocks_file", "b.stl", "solid" + repeated(" a", 7'000'000 / share),
               "b.stl:1:2005: more than 1000 words");
  refused_file("blocks_file", "b.stl", std::string(80, ' ') + "\xff\xff\xff\xff" + std::string(50, 'x'), "is no STL");
  refused_file("blocks_file", "b.stl", std::string(80, '\0') + std::string("\1\0\0\0", 4) + std::string(50, '\xff'),
               "facet 1: a coordinate is not finite");
  ASSERT_EQ(::mkfifo((folder_ / "pipe.csv").c_str(), 0600), 0);
  refused_text("dimension = 3\njoints_file = \"pipe.csv\"\n", "no such file");
  fs::create_symlink("/dev/zero", folder_ / "device.csv");
  refused_text("dimension = 3\nblocks_file = \"device.csv\"\n", "no such file");
  refused_text("dimension = 3\njoints_file = 7\n", "name of a file in quotes");
  write("sparse.csv", "");
  fs::resize_file(folder_ / "sparse.csv", std::uintmax_t{10} << 30);
  refused_text("dimension = 3\njoints_file = \"sparse.csv\"\n", "larger than 16 MB");
}

TEST_F(Hostile, TablesAndMeshesAreRefusedWithTheirPlace) {
  tables_and_meshes_are_refused(5);
}

TEST_F(HostileLong, TablesAndMeshesAreRefusedWithTheirPlace) {
  tables_and_meshes_are_refused(1);
}

TEST_F(Hostile, JointSetsOfTooManyJointsAreRefusedBeforeTheyAreDrawn) {
  const std::string scene =
      "dimension = 3\ndensity = 1\ndomain = { box = { min = [0, 0, 0], max = [1, 1, 1] } }\n"
      "joint_properties = [{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]\n"
      "stage = [{ name = \"s\", kind = \"settle\" }]\n[[joint_sets]]\nname = \"A\"\ndip = 0\n";
  refused_text(scene + "spacing = 1e-12\n", "more than 1e+06");
  refused_text(scene + "intensity = 1e12\n", "more than 1e+06");
  // a distribution whose large joints may be centred anywhere
  refused_text(scene + "intensity = 1\nsize = \"lognormal\"\nsize_mean = 1e-6\nsize_deviation = 1e12\n",
               "more than 1e+06");
}

}  // namespace
}  // namespace voussoir::hostile_input_test
