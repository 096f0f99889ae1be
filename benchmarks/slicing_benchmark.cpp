// Cutting a cube by joints: regular sets, the scene of Boon (2013), Table 4.1 with and without culling, and the same
// blocks by an explicit face-edge-vertex structure and voro++; the section's program by our simplex method and GLPK's.
#include <benchmark/benchmark.h>
#ifdef VOUSSOIR_PEER_VORO
#include <voro++/voro++.hh>
#endif

#include <numbers>

#include "benchmarks/explicit_slicer.hpp"
#include "benchmarks/shapes.hpp"
#ifdef VOUSSOIR_PEER_GLPK
#include "core/solvers/glpk.hpp"
#endif
#include "core/slicing/slice.hpp"
#include "text/angle.hpp"

namespace voussoir::benchmarks {
namespace {

Polytope<3> cube(double half) {
  return shapes::block<3>(shapes::cube<3>(half));
}

// three nearly orthogonal sets of n joints: about (n+1)³ blocks of a cube of 1 m
std::vector<Cut<3>> three_sets(int n) {
  Random random(7);
  std::vector<Cut<3>> cuts;
  for (int set = 0; set < 3; ++set)
    for (int i = 0; i < n; ++i) {
      const Vector<3> normal = (Vector<3>::Unit(set) + 0.05 * shapes::direction<3>(random)).normalized();
      cuts.push_back({{normal, (i + 1.0) / (n + 1) - 0.5}, static_cast<int>(cuts.size())});
    }
  return cuts;
}

// Table 4.1: a box of 100 m, three sets of n joints, centres by a Poisson process; persistent, or squares of lognormal
// size with mean 5 m and deviation 1 m. Blocks of at least 0.4 m (diameter of the inscribed ball), aspect at most 8000.
std::vector<Cut<3>> table_4_1(int n, bool persistent) {
  constexpr double dip_direction[] = {122, 112, 9}, dip[] = {8, 80, 85};
  constexpr double mean = 5, deviation = 1;
  const double spread = std::sqrt(std::log1p(deviation * deviation / (mean * mean)));
  Random random(41);
  std::vector<Cut<3>> cuts;
  for (int i = 0; i < n; ++i)
    for (int set = 0; set < 3; ++set) {
      const Vector<3> normal = upward_normal_3d(dip[set] * degree, dip_direction[set] * degree);
      Vector<3> centre;
      for (int k = 0; k < 3; ++k)
        centre[k] = shapes::uniform(random, -50, 50);
      const double size = std::exp(std::log(mean) - spread * spread / 2 + spread * shapes::normal_vector<1>(random)[0]);
      Cut<3> cut{{normal, normal.dot(centre)}, static_cast<int>(cuts.size())};
      if (!persistent) cut.extent = rectangle_extent(normal, centre, size, size);
      cut.set = set;
      cuts.push_back(cut);
    }
  put_in_order(cuts, CuttingOrder::by_size);
  return cuts;
}

SlicingLimits table_4_1_limits() {
  SlicingLimits limits;
  limits.smallest_inscribed_radius = 0.2;
  limits.largest_aspect_ratio = 8000;
  return limits;
}

void cut_and_count(benchmark::State& state, double half, const std::vector<Cut<3>>& cuts, const SlicingLimits& limits) {
  const Polytope<3> domain = cube(half);
  std::size_t blocks = 0;
  SlicingCounters counters;
  long double volume = 0;
  for (auto _ : state) {
    counters = {};
    const std::vector<Polytope<3>> made = slice<3>(domain, cuts, limits, counters);
    state.PauseTiming();
    blocks = made.size();
    volume = 0;
    for (const Polytope<3>& block : made)
      volume += block.mass.volume;
    state.ResumeTiming();
  }
  state.counters["blocks"] = static_cast<double>(blocks);
  state.counters["programs"] = static_cast<double>(counters.lp_solves);
  state.counters["tests"] = static_cast<double>(counters.tests);
  state.counters["volume_error"] = static_cast<double>(volume / domain.mass.volume - 1);
  state.SetItemsProcessed(state.iterations() * static_cast<long long>(blocks));
}

void regular_sets(benchmark::State& state) {
  cut_and_count(state, 0.5, three_sets(static_cast<int>(state.range(0))), {});
}
BENCHMARK(regular_sets)->Arg(4)->Arg(8)->Arg(20)->Arg(46)->Unit(benchmark::kMillisecond);

void persistent_table_4_1(benchmark::State& state) {
  cut_and_count(state, 50, table_4_1(static_cast<int>(state.range(0)), true), table_4_1_limits());
}
BENCHMARK(persistent_table_4_1)->Arg(12)->Arg(26)->Arg(60)->Unit(benchmark::kMillisecond);

void non_persistent_table_4_1(benchmark::State& state) {
  SlicingLimits limits = table_4_1_limits();
  limits.culling = state.range(1) != 0;
  cut_and_count(state, 50, table_4_1(static_cast<int>(state.range(0)), false), limits);
}
BENCHMARK(non_persistent_table_4_1)
    ->ArgNames({"joints", "culling"})
    ->ArgsProduct({{300, 1000, 3000, 10000}, {1}})
    ->ArgsProduct({{300, 1000}, {0}})
    ->Unit(benchmark::kMillisecond);

// ten thousand parallel joints, and joints through one line: exact counts
void parallel_joints(benchmark::State& state) {
  Random random(1);
  HalfSpaces<3> planes;
  const int n = static_cast<int>(state.range(0));
  for (int i = 0; i < n; ++i)
    planes.push_back({Vector<3>(0.36, 0.48, 0.8), -0.9 + 1.8 * i / (n - 1)});
  shapes::shuffle(planes, random);
  std::vector<Cut<3>> cuts;
  for (const HalfSpace<3>& p : planes)
    cuts.push_back({p, static_cast<int>(cuts.size())});
  cut_and_count(state, 1, cuts, {});
}
BENCHMARK(parallel_joints)->Arg(10'000)->Unit(benchmark::kMillisecond);

void joints_through_a_line(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  std::vector<Cut<3>> cuts;
  for (int i = 0; i < n; ++i) {
    const double angle = 0.1 + std::numbers::pi * i / n;
    cuts.push_back({{Vector<3>(std::cos(angle), std::sin(angle), 0), 0}, i});
  }
  Random random(2);
  shapes::shuffle(cuts, random);
  cut_and_count(state, 1, cuts, {});
}
BENCHMARK(joints_through_a_line)->Arg(10'000)->Unit(benchmark::kMillisecond);

// ---- peers --------------------------------------------------------------------------------------------------------

void explicit_structure(benchmark::State& state) {
  HalfSpaces<3> planes;
  for (const Cut<3>& cut : three_sets(static_cast<int>(state.range(0))))
    planes.push_back(cut.plane);
  std::size_t blocks = 0;
  double volume = 0;
  for (auto _ : state) {
    volume = 0;
    const std::vector<ExplicitBlock> made = explicit_slice(explicit_box(0.5), planes);
    for (const ExplicitBlock& block : made)
      volume += explicit_volume(block);
    blocks = made.size();
  }
  state.counters["blocks"] = static_cast<double>(blocks);
  state.counters["volume_error"] = volume - 1;
  state.SetItemsProcessed(state.iterations() * static_cast<long long>(blocks));
}
BENCHMARK(explicit_structure)->Arg(4)->Arg(8)->Arg(20)->Arg(46)->Unit(benchmark::kMillisecond);

#ifdef VOUSSOIR_PEER_VORO
// Each block's cell cut from a box by the block's own faces, as if they were known: a lower bound for any slicing.
void voro_cells(benchmark::State& state) {
  SlicingCounters counters;
  const std::vector<Polytope<3>> blocks =
      slice<3>(cube(0.5), three_sets(static_cast<int>(state.range(0))), {}, counters);
  double volume = 0;
  for (auto _ : state) {
    volume = 0;
    voro::voronoicell cell;
    for (const Polytope<3>& block : blocks) {
      const Vector<3>& o =
          block.centre;  // its planes are given by twice their foot point, relative to a point inside the cell
      cell.init(-0.5 - o[0], 0.5 - o[0], -0.5 - o[1], 0.5 - o[1], -0.5 - o[2], 0.5 - o[2]);
      for (const HalfSpace<3>& face : block.faces) {
        const double distance = -signed_distance<3>(face, o);
        cell.plane(face.normal[0], face.normal[1], face.normal[2], 2 * distance);
      }
      volume += cell.volume();
    }
  }
  state.counters["blocks"] = static_cast<double>(blocks.size());
  state.counters["volume_error"] = volume - 1;
  state.SetItemsProcessed(state.iterations() * static_cast<long long>(blocks.size()));
}
BENCHMARK(voro_cells)->Arg(4)->Arg(8)->Arg(20)->Arg(46)->Unit(benchmark::kMillisecond);
#endif

// the program of Eq. 3.7 on sections through the centres of blocks
std::vector<HalfSpaces<2>> sections() {
  SlicingCounters counters;
  Random random(3);
  std::vector<HalfSpaces<2>> all;
  for (const Polytope<3>& block : slice<3>(cube(0.5), three_sets(4), {}, counters)) {
    const Vector<3> normal = shapes::direction<3>(random);
    const auto axes = plane_axes(normal.z() < 0 ? Vector<3>(-normal) : normal);
    HalfSpaces<2> section;
    for (const HalfSpace<3>& face : block.faces)
      section.push_back({axes.transpose() * face.normal, -signed_distance<3>(face, block.mass.centroid)});
    all.push_back(section);
  }
  return all;
}

template <FeasibilitySolver<2> solve>
void section_programs(benchmark::State& state) {
  const std::vector<HalfSpaces<2>> all = sections();
  for (auto _ : state)
    for (const HalfSpaces<2>& section : all)
      benchmark::DoNotOptimize(solve(section, {}).value);
  state.SetItemsProcessed(state.iterations() * static_cast<long long>(all.size()));
}
BENCHMARK(section_programs<solve_feasibility<2>>)->Name("section_programs/own");
#ifdef VOUSSOIR_PEER_GLPK
BENCHMARK(section_programs<solve_feasibility_glpk<2>>)->Name("section_programs/glpk");
#endif

}  // namespace
}  // namespace voussoir::benchmarks
