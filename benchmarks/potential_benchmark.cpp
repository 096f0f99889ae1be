// Contacts of potential particles: our solver cold and warm, Ipopt on the same program, and for the polyhedra of the
// same planes the half-space kernel, cold and pair by pair, and libccd's GJK+EPA; µs of processor time per pair, by
// polyhedron type and radius, all on the same pairs in one run. The particles' planes are at a distance r inside the
// polyhedra's, so that their faces coincide. Corners recede with r: the pairs of the contact benchmark are moved along
// their line of centres until the rounded bodies overlap by 1e-4 of the size, as the polyhedra did; the polyhedra then
// overlap by that plus the recession of the corners.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>

#include "benchmarks/peers/peers.hpp"
#include "core/potential/contact.hpp"
#include "core/potential/valid_shape.hpp"
#ifdef VOUSSOIR_PEER_IPOPT
#include "core/potential/ipopt.hpp"
#endif

namespace voussoir::benchmarks {
namespace {

constexpr int rounds = 5;                 // of which the median counts
constexpr std::size_t outside_pairs = 4;  // Ipopt's
constexpr double sphericity = 0.01;
constexpr double overlap = 1e-4;                                   // of the size
constexpr std::array<double, 4> radii = {1e-5, 1e-3, 1e-2, 1e-1};  // of the size; the first a tenth of the overlaps
constexpr int bisections = 50;
constexpr double first_part = 0.01;  // of the overlap

double processor_us() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

double median_us(
    std::size_t pairs, const std::function<void()>& resolve, const std::function<void()>& restore = [] {}) {
  std::vector<double> times;
  for (int i = 0; i < rounds; ++i) {
    restore();
    const double begin = processor_us();
    resolve();
    times.push_back((processor_us() - begin) / static_cast<double>(pairs));
  }
  std::nth_element(times.begin(), times.begin() + rounds / 2, times.end());
  return times[rounds / 2];
}

PotentialShape<3> rounded(const Polytope<3>& part, double corner_radius) {
  PotentialShape<3> shape{part.faces, corner_radius, sphericity};
  for (HalfSpace<3>& plane : shape.planes)
    plane.offset -= corner_radius;
  shape.sphere_radius = enclosing_radius<3>(shape.planes, corner_radius, Vector<3>::Zero());
  return shape;
}

// along the line of centres until the two just touch, and then against the normal by the overlap
void push_together(PotentialPair<3>& pair, double depth) {
  PotentialWorkspace<3> workspace;
  const Vector<3> along = pair.offset.normalized();
  double near = 0, far = pair.a->sphere_radius + pair.b->sphere_radius;
  for (int k = 0; k < bisections; ++k) {
    const double middle = (near + far) / 2;
    pair.offset = middle * along;
    const bool touch = resolve<3>(pair, PotentialQuery::decision, workspace).status == PotentialStatus::touching;
    (touch ? near : far) = middle;
  }
  pair.offset = (near - first_part * depth) * along;  // where the normal is not affected by rounding
  pair.offset -= (1 - first_part) * depth * resolve<3>(pair, PotentialQuery::overlap, workspace).normal;
}

struct Pairs {
  std::vector<PotentialShape<3>> shapes;
  std::vector<PotentialPair<3>> now, before;
  Workload sharp;  // the same poses
};

Pairs rounded_pairs(Shape type, double radius) {
  Pairs pairs;
  pairs.sharp = workload(type, PairState::touch);
  const std::vector<Polytope<3>>& parts = *pairs.sharp.parts;
  const double unit = unit_of(type);
  for (const Polytope<3>& part : parts)
    pairs.shapes.push_back(rounded(part, radius * unit));
  for (std::size_t i = 0; i < pairs.sharp.pairs.size(); ++i) {
    Pair<3>& now = pairs.sharp.pairs[i];
    const Pair<3>& before = pairs.sharp.previous[0][i];
    const PotentialShape<3>*a = &pairs.shapes[now.a - parts.data()], *b = &pairs.shapes[now.b - parts.data()];
    PotentialPair<3> placed{a, b, now.rotation, now.offset};
    push_together(placed, overlap * unit);
    pairs.now.push_back(placed);
    pairs.before.push_back({a, b, before.rotation, before.offset + (placed.offset - now.offset)});
    now.offset = placed.offset;
  }
  return pairs;
}

// of the polyhedra, by the method for the overlap
void print_sharp(const std::vector<Method>& methods, const char* name, const Workload& work) {
  for (const Method& method : methods) {
    if (method.name != name || method.stage != "overlap") continue;
    const std::shared_ptr<Prepared> prepared = method.prepare(work);
    const std::size_t pairs = work.pairs.size();
    fmt::print(",{:.2f}", median_us(
                              pairs, [&] { prepared->resolve(0, pairs); }, [&] { prepared->restore(0, pairs); }));
  }
}

void print_row(Shape shape, double radius) {
  const Pairs pairs = rounded_pairs(shape, radius);
  const Workload& work = pairs.sharp;
  PotentialWorkspace<3> workspace;
  std::vector<PotentialStart<3>> starts;
  int touching = 0, failed = 0;
  long long cold_iterations = 0, warm_iterations = 0;
  for (std::size_t i = 0; i < pairs.now.size(); ++i) {
    const PotentialContact<3> before = resolve<3>(pairs.before[i], PotentialQuery::least, workspace);
    starts.push_back({before.point, before.ratio});
    const PotentialContact<3> cold = resolve<3>(pairs.now[i], PotentialQuery::overlap, workspace);
    touching += cold.status == PotentialStatus::touching;
    failed += cold.status == PotentialStatus::no_answer;
    cold_iterations += cold.iterations;
    warm_iterations += resolve<3>(pairs.now[i], PotentialQuery::overlap, workspace, starts[i]).iterations;
  }

  const double cold_us = median_us(pairs.now.size(), [&] {
    for (const PotentialPair<3>& pair : pairs.now)
      resolve<3>(pair, PotentialQuery::overlap, workspace);
  });
  const double warm_us = median_us(pairs.now.size(), [&] {
    for (std::size_t i = 0; i < pairs.now.size(); ++i)
      resolve<3>(pairs.now[i], PotentialQuery::overlap, workspace, starts[i]);
  });
  const double count = static_cast<double>(pairs.now.size());
  fmt::print("{},{:g},{:.1f},{:.2f},{:.2f},{:.1f},{:.1f},{},{}", name_of(shape), radius, mean_planes(work), cold_us,
             warm_us, static_cast<double>(cold_iterations) / count, static_cast<double>(warm_iterations) / count,
             touching, failed);
#ifdef VOUSSOIR_PEER_IPOPT
  fmt::print(",{:.0f}", median_us(outside_pairs, [&] {
               for (std::size_t i = 0; i < outside_pairs; ++i)
                 solve_cone_program<3>(pairs.now[i], ConeReading::linked);
             }));
#endif
  print_sharp(own_methods(), single_cold, work);
#ifdef VOUSSOIR_PEER_CCD
  print_sharp(ccd_methods(), ccd_epa, work);
#endif
  fmt::print("\n");
  std::fflush(stdout);  // a row takes a minute on a busy machine
}

}  // namespace
}  // namespace voussoir::benchmarks

int main() {
  using namespace voussoir::benchmarks;
  fmt::print("shape,radius,planes,cold_us,warm_us,cold_iterations,warm_iterations,touching,failed");
#ifdef VOUSSOIR_PEER_IPOPT
  fmt::print(",ipopt_us");
#endif
  fmt::print(",half_space_us");
#ifdef VOUSSOIR_PEER_CCD
  fmt::print(",ccd_epa_us");
#endif
  fmt::print("\n");
  for (const double radius : radii)
    for (int shape = 0; shape < shape_count; ++shape)
      print_row(static_cast<Shape>(shape), radius);
}
