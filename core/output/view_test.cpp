// Data of a run for the viewer: its records, and files that were truncated or started again. The numbers are compared
// with the state by the test that reads them back from a page (viewer/test/view_test.mjs).
#include "core/output/view.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/output/output_error.hpp"
#include "core/slicing/block.hpp"

namespace voussoir::view_test {
namespace {

namespace fs = std::filesystem;

struct ViewTest : testing::Test {
  fs::path folder = fs::temp_directory_path() / fs::path("voussoir_view_" + std::to_string(::getpid()));
  fs::path file = folder / view_file;
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  std::string bytes() const {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
};

constexpr int all = std::numeric_limits<int>::max();

// three unit cubes in a row, the first and the second touching
Prepared<3> cubes() {
  Prepared<3> scene;
  Model<3>& model = scene.model;
  model.joints.push_back({"A", {Vector<3>::Unit(0), 0.5}, 0});
  model.properties.push_back({"rock", 1e9, 1e8, 0.5, false});
  for (int b = 0; b < 3; ++b) {
    HalfSpaces<3> planes;
    for (int k = 0; k < 3; ++k)
      for (const double sign : {1.0, -1.0})
        planes.push_back({sign * Vector<3>::Unit(k), 0.5 + (k == 0 ? sign * b : 0)});
    const BlockResult<3> block = make_block<3>(planes, std::vector<int>(6, no_joint));
    model.bodies.push_back(make_body<3>({block.part}, 2000));
  }
  list_parts(model);
  scene.state = initial_state(model);
  Contact<3> contact;
  contact.part_a = 0, contact.part_b = 1;
  contact.status = ContactStatus::touching;
  contact.geometry.normal = Vector<3>::Unit(0);
  contact.force = 3 * Vector<3>::Unit(0);
  scene.state.contacts.list = {contact};
  return scene;
}

std::vector<std::uint32_t> tags(const std::string& bytes) {
  std::vector<std::uint32_t> found;
  for (std::size_t at = 8; at + 8 <= bytes.size();) {
    std::uint32_t head[2];
    std::memcpy(head, bytes.data() + at, sizeof head);
    found.push_back(head[0]);
    at += head[1];
  }
  return found;
}

constexpr std::uint32_t head = 1, shape = 2, frame = 3, again = 4, verdicts = 5;

TEST_F(ViewTest, ShapesAreWrittenOnceAndABodyDividedByAnExcavationGetsANewOne) {
  Prepared<3> scene = cubes();
  ViewSeries series = begin_view(file, scene);
  add_view_frame(series, scene.model, scene.state, {});
  scene.model.bodies[2].present = false;  // excavated
  scene.model.bodies[1].mass *= 0.5;      // lost a part
  add_view_frame(series, scene.model, scene.state, {});
  add_view_frame(series, scene.model, scene.state, {});
  EXPECT_EQ(tags(bytes()), (std::vector<std::uint32_t>{head, shape, shape, shape, frame, frame, shape, frame, frame}));
  EXPECT_EQ(series.frames, 4);
  EXPECT_EQ(series.pairs.size(), 1u) << "the same two faces";
}

TEST_F(ViewTest, AnIncompleteRecordOfAKilledProgramIsIgnored) {
  const Prepared<3> scene = cubes();
  ViewSeries series = begin_view(file, scene);
  const std::size_t first = bytes().size();
  add_view_frame(series, scene.model, scene.state, {});
  const std::string whole = bytes();
  EXPECT_EQ(view_extent(whole, all).bytes, whole.size());
  EXPECT_EQ(view_extent(whole, all).frames, 2);
  EXPECT_EQ(view_extent(whole, 1).bytes, first);
  for (std::size_t n = 0; n < whole.size(); ++n) {
    const ViewExtent cut = view_extent(std::string_view(whole).substr(0, n), all);
    ASSERT_LE(cut.bytes, n);
    ASSERT_EQ(cut.frames, n < first ? 0 : 1) << n;
  }
  EXPECT_EQ(view_extent("anything else", all).bytes, 0u);
  std::string damaged = whole;
  damaged[first + 5] = '\x7f';  // a record longer than the file
  EXPECT_EQ(view_extent(damaged, all).bytes, first);
}

TEST_F(ViewTest, AContinuedRunKeepsTheFramesOfItsCheckpointAndWritesAllShapesAgain) {
  const Prepared<3> scene = cubes();
  ViewSeries series = begin_view(file, scene);
  for (int k = 0; k < 3; ++k)
    add_view_frame(series, scene.model, scene.state, {});
  ViewSeries continued = continue_view(file, scene, 2);
  EXPECT_EQ(continued.frames, 2);
  add_view_frame(continued, scene.model, scene.state, {});
  EXPECT_EQ(tags(bytes()),
            (std::vector<std::uint32_t>{head, shape, shape, shape, frame, frame, again, shape, shape, shape, frame}));
  EXPECT_EQ(view_extent(bytes(), all).frames, 3);

  // with fewer frames than in the checkpoint, or none: starts here
  EXPECT_EQ(continue_view(file, scene, 9).frames, 0);
  EXPECT_EQ(tags(bytes()), (std::vector<std::uint32_t>{head}));
  fs::remove(file);
  EXPECT_EQ(continue_view(file, scene, 2).frames, 0);
  EXPECT_TRUE(fs::exists(file));
}

TEST_F(ViewTest, VerdictsAreARecordOfTheirOwn) {
  const ViewSeries series = begin_view(file, cubes());
  const std::string without = bytes();
  add_view_verdicts(series, "as sliced",
                    {{ViewVerdict::Kind::fixed, {}, "fixed"}, {ViewVerdict::Kind::judged, 1.25, "slides: \xc3\xa9"}});
  const std::string whole = bytes();
  EXPECT_EQ(whole.substr(0, without.size()), without);
  EXPECT_EQ(tags(whole), (std::vector<std::uint32_t>{head, shape, shape, shape, frame, verdicts}));
  EXPECT_EQ(view_extent(whole, all).bytes, whole.size());
  double factor = 0;  // after the head of the record, two texts with their lengths, the number of bodies, two kinds
  std::memcpy(&factor, whole.data() + without.size() + 8 + 4 + 12 + 4 + 4 + 8 + 4 + 8 + 4, sizeof factor);
  EXPECT_EQ(factor, 1.25);
}

TEST_F(ViewTest, NumbersThatAreNotFiniteAreWrittenAsZero) {
  Prepared<3> scene = cubes();
  ViewSeries series = begin_view(file, scene);
  add_view_frame(series, scene.model, scene.state, {});
  const std::string at_rest = bytes();
  scene.state.bodies.motions[1].displacement[0] = std::numeric_limits<double>::quiet_NaN();
  scene.state.bodies.motions[1].displacement[1] = 1e300;
  ViewSeries second = begin_view(file, cubes());
  add_view_frame(second, scene.model, scene.state, {});
  EXPECT_EQ(bytes(), at_rest);
}

TEST_F(ViewTest, AFileThatCannotBeWrittenIsNamed) {
  const Prepared<3> scene = cubes();
  EXPECT_THROW(begin_view(folder / "nowhere" / view_file, scene), OutputError);
  ViewSeries series = begin_view(file, scene);
  fs::remove(file);
  EXPECT_THROW(add_view_frame(series, scene.model, scene.state, {}), OutputError);
}

}  // namespace
}  // namespace voussoir::view_test
