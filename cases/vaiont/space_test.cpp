// Vaiont slide in space: the volume of rock between the planes of the slide and of the ground, in total and below the
// reservoir.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cases/case_tools.hpp"
#include "core/model/water_surfaces.hpp"
#include "reference/vaiont/slide_in_space.hpp"

namespace voussoir::cases::space_test {
namespace {

using verification::CaseReport;
using verification::Kind;

constexpr double grid = 2.5;  // m, cells of the reference

const std::string source = "grid between the planes, reference/vaiont";

Model<3> model_of(const std::string& scene, const std::vector<std::string>& overrides = {}) {
  return std::get<Prepared<3>>(load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / scene, overrides).prepared).model;
}

// m3, of the blocks that may move
double free_volume(const Model<3>& model) {
  double sum = 0;
  for (const Body<3>& body : model.bodies)
    if (!body.fixed) sum += volume(body);
  return sum;
}

// m3, of the blocks that may move, from the uplift of the water
double submerged_volume(const Model<3>& model) {
  const std::vector<Load<3>> loads = water_loads_at_reference(model);
  double lift = 0;
  for (std::size_t b = 0; b < loads.size(); ++b)
    if (!model.bodies[b].fixed) lift += loads[b].force[2];
  return lift / model.waters.front().unit_weight;
}

// by the grid, within the change by halving its cells
void judge_volume(CaseReport& report, const std::string& name, const reference::SlideInSpace& slide, double found) {
  const double expected = slide_volumes(slide, grid).all;
  const double apart = std::abs(expected - slide_volumes(slide, 2 * grid).all);
  report.record(
      {name, "m3", Kind::exact, source, expected, {apart, 0}, "the grid's error: the change by half its spacing"},
      found);
}

// as in the thesis: the position of its centroid decides whether a block is removed or kept
std::vector<std::string> block_by_block() {
  std::vector<std::string> settings;
  for (const char* strip : {"west 1 1", "west 1 2", "west 2", "west 3", "centre 1", "centre 2", "centre 3", "centre 4",
                            "centre 5", "east 1", "east 2", "east 3"})
    settings.push_back(fmt::format("excavations.{}.outline=false", strip));
  return settings;
}

// Cut along the outline, the slide has the volume between its planes. If it is cut into blocks, pieces with an
// inscribed radius below 10 m at the outline are removed.
TEST(VaiontInSpace, HasTheVolumeBetweenItsPlanes) {
  const std::string all = "free volume", flexible = "free volume, flexible east",
                    cut = "free volume, 80 m, blocks of any size", coarse = "pieces of blocks that go, 160 m",
                    fine = "pieces of blocks that go, 80 m", whole_blocks = "free volume, 80 m, blocks go whole";
  CaseReport report("vaiont", {all, flexible, cut, coarse, fine, whole_blocks});
  const double whole = free_volume(model_of("space.toml"));
  judge_volume(report, all, reference::vaiont_in_space(), whole);
  judge_volume(report, flexible, reference::vaiont_in_space(3400), free_volume(model_of("space.toml", {"fix=[]"})));
  report.record({cut,
                 "m3",
                 Kind::exact,
                 "conservation of volume: space.toml, the slide as one body",
                 whole,
                 {1e-9 * whole, 0},
                 "rounding"},
                free_volume(model_of("space_80.toml", {"slicing.smallest_inscribed_radius=0"})));
  for (const auto& [name, scene] : {std::pair(coarse, "space_fall_160.toml"), {fine, "space_80.toml"}})
    report.report(name, "1", 1 - free_volume(model_of(scene)) / whole, "as a fraction of the free volume");
  report.report(whole_blocks, "m3", free_volume(model_of("space_80.toml", block_by_block())),
                "as in the thesis, by the positions of their centroids");
}

TEST(VaiontInSpace, HasTheVolumesBelowTheReservoir) {
  const reference::SlideInSpace slide = reference::vaiont_in_space();
  for (const int level : {460, 600, 710}) {
    const std::string quantity = fmt::format("volume below {} m", level);
    CaseReport report("vaiont", {quantity});
    const double expected = slide_volumes(slide, grid, level).below;
    const double apart = std::abs(expected - slide_volumes(slide, 2 * grid, level).below);
    report.record(
        {quantity, "m3", Kind::exact, source, expected, {apart, 0}, "the grid's error: the change by half its spacing"},
        submerged_volume(model_of("space.toml", {fmt::format("water.reservoir.level={}", level)})));
  }
}

}  // namespace
}  // namespace voussoir::cases::space_test
