// The robustness atlas: no kernel gives a wrong result unreported, from thick to thin, near to far, few faces to many.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/case_tools.hpp"
#include "cases/robustness/judges.hpp"
#include "cases/robustness/sweep.hpp"

namespace voussoir::cases::robustness_test {
namespace {

using namespace atlas;
using verification::CaseReport;
using verification::Kind;

constexpr std::array because{
    "every block is refused by name or is within 64 roundings of its planes (volume, centroid, inertia, vertices), "
    "and "
    "within 1e-9 of the volume if a plane was dropped",
    "a joint cuts if its section contains a circle of 1e-10 of the inscribed radius; both pieces as blocks",
    "touching or separate as exact arithmetic says, unless the program's value is within 64 roundings of the "
    "coordinates from zero; the value itself within the same 64",
    "Newton's remaining step is 1e-9 of the region, the slacks' rounding comes on top",
    "the gradients of the potentials carry 16 roundings of the slacks",
    "the ends of the search along the normal carry 16 roundings of slack and slope",
    "the section is between those of planes moved in and out by 16 roundings",
};

std::vector<double> depths(std::initializer_list<double> sizes) {
  std::vector<double> list{0};
  for (const double d : sizes)
    list.insert(list.end(), {d, -d});
  std::sort(list.begin(), list.end());
  return list;
}

std::vector<double> decades(int from, int to, int step) {
  std::vector<double> list;
  for (int k = from; step > 0 ? k <= to : k >= to; k += step)
    list.push_back(std::pow(10.0, k));
  return list;
}

Grid grid(int step, std::vector<double> faces, std::initializer_list<double> sizes, int instances) {
  Grid g;
  g.values = {decades(0, -12, -step), decades(0, -12, -step), decades(0, 9, step == 2 ? 3 : 1),
              decades(0, 12, step),   decades(0, 12, step),   std::move(faces)};
  g.values[static_cast<int>(Axis::angle)][0] = std::numbers::pi / 2;
  g.depths = depths(sizes);
  g.instances = instances;
  return g;
}

// place in the figure: decades, but faces one row each
void write_map(const Grid& g, const Atlas& atlas) {
  std::vector<std::string> header{"axis", "x", "y", "half_height", "value", "depth"};
  header.insert(header.end(), kernel_names.begin(), kernel_names.end());
  std::vector<std::vector<double>> columns(header.size());
  for (const Cell& cell : atlas.cells) {
    const std::vector<double>& values = g.values[static_cast<int>(cell.place.axis)];
    const bool by_row = cell.place.axis == Axis::faces;
    const double row = static_cast<double>(std::find(values.begin(), values.end(), cell.place.value) - values.begin());
    const double step = by_row ? 1 : std::abs(std::log10(values.back() / values[values.size() - 2]));
    const double column =
        static_cast<double>(std::find(g.depths.begin(), g.depths.end(), cell.place.depth) - g.depths.begin());
    std::vector<double> line{static_cast<double>(cell.place.axis),
                             column,
                             by_row ? row : step * row,
                             0.5 * step,
                             cell.place.value,
                             cell.place.depth};
    for (const Verdict v : cell.worst)
      line.push_back(static_cast<double>(v));
    for (std::size_t k = 0; k < line.size(); ++k)
      columns[k].push_back(line[k]);
  }
  write_csv("robustness", "atlas.csv", header, columns);
}

void check(CaseReport& report, const Atlas& atlas) {
  for (int k = 0; k < kernels; ++k) {
    const Tally& t = atlas.tallies[k];
    for (const std::string& reason : t.reasons)
      ADD_FAILURE() << kernel_names[k] << ": " << reason;
    report.record({fmt::format("wrong answers, {}", kernel_names[k]),
                   "1",
                   Kind::exact,
                   "exact arithmetic (cddlib, GMP) and 113 bits",
                   0,
                   {0.5, 0},
                   because[k]},
                  static_cast<double>(t.wrong));
    report.report(fmt::format("answers, {}", kernel_names[k]), "1", static_cast<double>(t.answers()),
                  fmt::format("{} correct, {} warned, {} refused", t.correct, t.warned, t.refused));
    report.report(fmt::format("largest fraction of the promised error, {}", kernel_names[k]), "1", t.worst_fraction,
                  "1 is the promise itself");
  }
}

TEST(Robustness, NoWrongResultIsUnreported) {
  CaseReport report("robustness", {"wrong answers, block", "wrong answers, decision"});
  const Grid g = grid(2, {4, 6, 12, 24, 40}, {0.3, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14}, 2);
  const Atlas atlas = sweep(g);
  write_map(g, atlas);
  check(report, atlas);
  // both sides of every decision were tested, and most had a result
  for (const Tally& t : atlas.tallies)
    EXPECT_GT(t.correct, t.refused);
}

// errors of the first maps, reduced: the mass of one block, density chosen so that it is about 1 kg
TEST(Robustness, FoundErrorsStayCorrected) {
  CaseReport report("robustness");
  const std::vector<std::pair<std::string, double>> found{{"coplanar", 1 - 5e-10 / 8}, {"needle", 1}};
  for (const auto& [name, expected] : found) {
    const SceneRun scene = cases::run("found/" + name + ".toml");
    const Model<3>& model = std::get<Prepared<3>>(scene.scene.prepared).model;
    report.record({"mass, " + name,
                   "kg",
                   Kind::exact,
                   "closed form",
                   expected,
                   {3e-8, 0},
                   "64 roundings (7e-15) over the needle's half thickness 5e-7, in two directions"},
                  model.bodies.front().mass);
  }
}

TEST(RobustnessLong, DenseMap) {
  CaseReport report("robustness");
  const Grid g =
      grid(1, {4, 6, 12, 24, 40, 100, 400},
           {0.3, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15}, 4);
  const Atlas atlas = sweep(g);
  write_map(g, atlas);
  check(report, atlas);

  // exact solids of thousands of faces take seconds each: a few cells
  Grid many;
  many.values[static_cast<int>(Axis::faces)] = {1000, 4000};
  many.depths = {-1e-3, 1e-3};
  for (const Tally& t : sweep(many).tallies)
    EXPECT_EQ(t.wrong, 0) << (t.reasons.empty() ? "" : t.reasons.front());
}

}  // namespace
}  // namespace voussoir::cases::robustness_test
