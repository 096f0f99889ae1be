// Time and work against the number of blocks for the joint sets of Table 4.1, persistent and finite, with and without
// culling; the volume of the blocks, their overlaps, their number; and one assembly in space.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <tuple>

#include "cases/case_tools.hpp"
#include "cases/picture.hpp"
#include "core/scene/bodies.hpp"
#include "core/scene/draw_joint_sets.hpp"
#include "core/scene/scene.hpp"
#include "core/slicing/clump.hpp"
#include "core/solvers/feasibility.hpp"
#include "reference/slicing/arrangement.hpp"

namespace voussoir::cases::growth_test {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;

constexpr double half_box = 50;      // m, of Table 4.1
constexpr int ellipse_sides = 16;    // none of these joints is one
constexpr double conserved = 1e-12;  // of the volume: one term per block, each within some ulp of it

// some ulp of coordinates of 50 m: the possible distance of faces of one plane, seen from two blocks
constexpr double shared_plane = 1e-13;  // m

struct Pattern {
  Polytope<3> domain;
  std::vector<Cut<3>> cuts;
};

// the joints of a scene as cuts, drawn at this intensity (1/m)
Pattern pattern_of(const std::string& file, double intensity) {
  const Scene scene = read_scene(
      std::filesystem::path(VOUSSOIR_CASE_DIR) / file,
      {fmt::format("joint_sets.A.intensity={}", intensity), fmt::format("joint_sets.B.intensity={}", intensity),
       fmt::format("joint_sets.C.intensity={}", intensity)});
  const Vector<3> origin = find_origin<3>(scene);
  Pattern pattern{make_domain<3>(scene, origin), {}};
  int set_number = 0;
  for (const DrawnSet<3>& set : draw_joint_sets<3>(scene, pattern.domain, origin)) {
    for (const DrawnJoint<3>& joint : set.joints) {
      Cut<3> cut{plane_of(joint, origin), static_cast<int>(pattern.cuts.size())};
      cut.extent = extent_of(joint.normal, outline_from(joint, origin), ellipse_sides);
      cut.set = set_number;
      pattern.cuts.push_back(std::move(cut));
    }
    ++set_number;
  }
  put_in_order(pattern.cuts, CuttingOrder::by_size);
  return pattern;
}

SlicingLimits table_limits() {
  SlicingLimits limits;
  limits.smallest_inscribed_radius = 0.2;
  limits.largest_aspect_ratio = 8000;
  return limits;
}

struct Cutting {
  std::vector<Polytope<3>> blocks;
  SlicingCounters counters;
  double seconds = 0;

  double programs() const { return static_cast<double>(counters.lp_solves); }
};

Cutting cut(const Pattern& pattern, const SlicingLimits& limits) {
  Cutting done;
  const auto start = std::chrono::steady_clock::now();
  done.blocks = slice<3>(pattern.domain, pattern.cuts, limits, done.counters);
  done.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return done;
}

double total_volume(const std::vector<Polytope<3>>& blocks) {
  double sum = 0;
  for (const Polytope<3>& block : blocks)
    sum += block.mass.volume;
  return sum;
}

// memory of the blocks on the heap and off it, per block
double bytes_per_block(const std::vector<Polytope<3>>& blocks) {
  std::size_t bytes = 0;
  for (const Polytope<3>& block : blocks) {
    bytes += sizeof block + block.faces.capacity() * sizeof block.faces[0] + block.joints.capacity() * sizeof(int) +
             block.vertices.capacity() * sizeof block.vertices[0] + block.loops.capacity() * sizeof block.loops[0];
    for (const std::vector<int>& loop : block.loops)
      bytes += loop.capacity() * sizeof(int);
  }
  return static_cast<double>(bytes) / static_cast<double>(blocks.size());
}

// Pairs of blocks whose half-spaces have a ball in common. The blocks are sorted along x.
long long overlapping_pairs(const std::vector<Polytope<3>>& blocks) {
  struct Span {
    Vector<3> low, high;
    std::size_t block;
  };
  std::vector<Span> spans;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    Span span{blocks[i].vertices.front(), blocks[i].vertices.front(), i};
    for (const Vector<3>& v : blocks[i].vertices) {
      span.low = span.low.cwiseMin(v);
      span.high = span.high.cwiseMax(v);
    }
    spans.push_back(span);
  }
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.low[0] < b.low[0]; });
  long long overlapping = 0;
  for (std::size_t i = 0; i < spans.size(); ++i)
    for (std::size_t j = i + 1; j < spans.size() && spans[j].low[0] < spans[i].high[0]; ++j) {
      if ((spans[i].low.array() > spans[j].high.array()).any() || (spans[j].low.array() > spans[i].high.array()).any())
        continue;
      HalfSpaces<3> both = blocks[spans[i].block].faces;
      const HalfSpaces<3>& other = blocks[spans[j].block].faces;
      both.insert(both.end(), other.begin(), other.end());
      overlapping += solve_feasibility<3>(both, {.stop_above = 0}).value < -shared_plane;
    }
  return overlapping;
}

// power of the number of programs in that of blocks, between the first run and the last
double exponent(const std::vector<Cutting>& runs) {
  return std::log(runs.back().programs() / runs.front().programs()) /
         std::log(static_cast<double>(runs.back().blocks.size()) / static_cast<double>(runs.front().blocks.size()));
}

struct Growth {
  std::string name, file;
  std::vector<double> intensities;  // 1/m
  std::size_t culled_too;           // so many of them also without culling
  std::size_t overlaps_of;          // the one whose pairs are searched: a linear program for each pair of neighbours
};

void study(CaseReport& report, const Growth& growth) {
  std::vector<Cutting> runs;
  std::vector<std::vector<double>> columns(8);
  double worst_volume = 0, memory = 0, programs_saved = 0, seconds_saved = 0;
  for (std::size_t k = 0; k < growth.intensities.size(); ++k) {
    const Pattern pattern = pattern_of(growth.file, growth.intensities[k]);
    Cutting run = cut(pattern, table_limits());
    worst_volume = std::max(worst_volume, std::abs(total_volume(run.blocks) / pattern.domain.mass.volume - 1));
    memory = std::max(memory, bytes_per_block(run.blocks));
    Cutting without;
    if (k < growth.culled_too) {
      SlicingLimits limits = table_limits();
      limits.culling = false;
      without = cut(pattern, limits);
      ASSERT_EQ(without.blocks.size(), run.blocks.size());
      for (std::size_t b = 0; b < run.blocks.size(); ++b)
        ASSERT_EQ(without.blocks[b].mass.centroid, run.blocks[b].mass.centroid);
      programs_saved = without.programs() / run.programs();
      seconds_saved = without.seconds / run.seconds;
    }
    const double row[] = {growth.intensities[k],
                          static_cast<double>(pattern.cuts.size()),
                          static_cast<double>(run.blocks.size()),
                          run.seconds,
                          run.programs(),
                          without.seconds,
                          without.programs(),
                          static_cast<double>(run.counters.tests)};
    for (std::size_t c = 0; c < columns.size(); ++c)
      columns[c].push_back(row[c]);
    runs.push_back(std::move(run));
  }
  write_csv(
      "slicing", "growth_" + growth.name + ".csv",
      {"intensity_1/m", "joints", "blocks", "seconds", "programs", "seconds_without", "programs_without", "tests"},
      columns);

  const std::string of = growth.name + ": ";
  report.record({.quantity = of + "volume, largest relative error",
                 .unit = "1",
                 .source = "geometry: the box",
                 .tolerance = {.absolute = conserved},
                 .because = "rounding of as many volumes as there are blocks"},
                worst_volume);
  report.record({.quantity = of + "overlapping neighbours",
                 .unit = "1",
                 .source = "conservation of volume: blocks tile the box",
                 .tolerance = {.absolute = 0.5},
                 .because = "a count"},
                static_cast<double>(overlapping_pairs(runs[growth.overlaps_of].blocks)));
  report.record({.quantity = of + "memory of a block",
                 .unit = "B",
                 .kind = Kind::limit,
                 .source = "demanded: 5e5 blocks fit into 1 GB",
                 .expected = 2000,
                 .tolerance = {.relative = 1e-9, .bound = Bound::at_most},
                 .because = "a size in bytes"},
                memory);
  report.record({.quantity = of + "power of the linear programs in the number of blocks",
                 .unit = "1",
                 .kind = Kind::limit,
                 .source = "Boon (2013), Fig. 4.4: linear",
                 .expected = 1,
                 .tolerance = {.absolute = 0.1, .bound = Bound::at_most},
                 .because = "a logarithm beside a linear growth is smaller over these sizes"},
                exponent(runs));
  if (growth.culled_too > 0) {
    report.report(of + "linear programs without culling over those with it", "1", programs_saved,
                  fmt::format("at {} blocks", columns[2][growth.culled_too - 1]));
    report.report_time(of + "time without culling over time with it", "1", seconds_saved,
                       fmt::format("at {} blocks; on this machine", columns[2][growth.culled_too - 1]));
  }
  report.report(of + "blocks", "1", columns[2].back(), "the largest of these runs");
  report.report_time(of + "time", "s", columns[3].back(), "one thread, vertices and mass included; on this machine");
}

TEST(SlicingGrowth, ProgramsGrowAsTheNumberOfBlocks) {
  CaseReport report("slicing");
  study(report, {"persistent", "table_4_1_persistent.toml", {0.07, 0.1, 0.15, 0.2}, 3, 1});
  study(report, {"finite", "table_4_1.toml", {0.005, 0.01, 0.016, 0.03}, 2, 1});
}

// to more than a hundred thousand blocks, of which no two overlap, and without culling at twenty thousand
TEST(SlicingGrowthLong, ToAHundredThousandBlocks) {
  CaseReport report("slicing");
  study(report, {"persistent", "table_4_1_persistent.toml", {0.1, 0.2, 0.26, 0.4, 0.55}, 3, 4});
  study(report, {"finite", "table_4_1.toml", {0.005, 0.015, 0.042, 0.09, 0.15}, 3, 4});
}

TEST(SlicingGrowth, PersistentSetsMakeTheCountedNumberOfBlocks) {
  CaseReport report("slicing");
  const Pattern pattern = pattern_of("table_4_1_persistent.toml", 0.15);
  std::vector<reference::Plane3> planes;
  for (const Cut<3>& c : pattern.cuts)
    planes.push_back({{c.plane.normal[0], c.plane.normal[1], c.plane.normal[2]}, c.plane.offset});
  const reference::Box<3> box{{-half_box, -half_box, -half_box}, {half_box, half_box, half_box}};
  report.record({.quantity = "persistent: blocks without a least size",
                 .unit = "1",
                 .source = "Buck (1943): 1 + planes + lines + points within the box",
                 .expected = static_cast<double>(reference::pieces(planes, box)),
                 .tolerance = {.absolute = 0.5},
                 .because = "a count"},
                static_cast<double>(cut(pattern, {}).blocks.size()));
}

// ---- the assembly of Fig. 4.5

// of a block: brown if it is small
std::uint32_t colour(double share_of_largest) {
  const double large = std::cbrt(share_of_largest);
  std::uint32_t rgb = 0;
  for (const auto& [small_tone, large_tone] : {std::pair(214, 255), std::pair(132, 246), std::pair(70, 222)})
    rgb = rgb << 8 | static_cast<std::uint32_t>((1 - large) * small_tone + large * large_tone);
  return rgb;
}

// The assembly without the blocks of one corner.
void draw_assembly(const std::vector<Polytope<3>>& blocks, const std::vector<SharedFace>& shared) {
  std::vector<bool> kept;
  double largest = 0;
  for (const Polytope<3>& block : blocks) {
    const Vector<3>& c = block.mass.centroid;
    kept.push_back(!(c[0] > 0 && c[1] < 0 && c[2] > 0));
    largest = std::max(largest, block.mass.volume);
  }
  // faces exposed by a removed neighbour: joint and side of a block
  std::set<std::tuple<std::size_t, int, bool>> bare;
  for (const SharedFace& face : shared) {
    if (kept[face.below] && !kept[face.above]) bare.insert({face.below, face.joint, true});
    if (kept[face.above] && !kept[face.below]) bare.insert({face.above, face.joint, false});
  }
  const View view(-45, 32);
  std::vector<PictureFace> faces;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (std::size_t f = 0; kept[b] && f < blocks[b].faces.size(); ++f) {
      const Vector<3>& normal = blocks[b].faces[f].normal;
      const int joint = blocks[b].joints[f];
      const bool open = joint == no_joint || bare.contains({b, joint, normal[2] > 0});
      if (!open || normal.dot(view.eye) <= 0) continue;
      std::vector<Vector<3>> corners;
      for (const int v : blocks[b].loops[f])
        corners.push_back(blocks[b].vertices[v]);
      faces.push_back(shaded_face(view, corners, normal, colour(blocks[b].mass.volume / largest)));
    }
  write_objects("slicing", "assembly.gp", std::move(faces));
}

TEST(SlicingGrowth, AnAssemblyInSpaceFillsItsBoxAndItsFacesMatch) {
  CaseReport report("slicing");
  const Pattern pattern = pattern_of("assembly.toml", 0.22);
  const Cutting done = cut(pattern, table_limits());
  const std::vector<SharedFace> shared = shared_faces<3>(done.blocks, pattern.cuts);
  report.report("assembly: blocks", "1", static_cast<double>(done.blocks.size()), "finite joints in a box of 24 m");
  report.record({.quantity = "assembly: volume",
                 .unit = "m³",
                 .source = "geometry: the box",
                 .expected = pattern.domain.mass.volume,
                 .tolerance = {.relative = conserved},
                 .because = "rounding of as many volumes as there are blocks"},
                total_volume(done.blocks));
  double faces = 0, common = 0;
  for (const Polytope<3>& block : done.blocks)
    for (std::size_t f = 0; f < block.faces.size(); ++f)
      if (block.joints[f] != no_joint) faces += face_area(block, static_cast<int>(f));
  for (const SharedFace& face : shared)
    common += face.area;
  report.record({.quantity = "assembly: area of joints that two blocks share",
                 .unit = "m²",
                 .source = "geometry: half the area of all faces of joints: each is seen from both sides",
                 .expected = faces / 2,
                 .tolerance = {.relative = 1e-9},
                 .because = "areas clipped at a joint's other faces, of which slivers below 1e-9 are not counted"},
                common);
  draw_assembly(done.blocks, shared);
}

}  // namespace
}  // namespace voussoir::cases::growth_test
