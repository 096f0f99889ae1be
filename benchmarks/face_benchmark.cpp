// The cost of an integrated face contact compared with one point with area: two hundred blocks on a plate, on a face or
// a corner, sticking or sliding. One call finds all contacts and their joints' forces. With `--count <way> <calls>` it
// only executes the calls, for price_of_faces.sh, which counts instructions.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <map>
#include <string>

#include "core/step/joint_forces.hpp"
#include "core/step/neighbours.hpp"
#include "core/testing/models.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr int along = 15, blocks = along * along - 25;
constexpr double depth = 1e-3, speed = 1e-2;  // of blocks 1 m wide; m/s

struct Scene {
  Model<3> model;
  Settings settings;
  State<3> state;
};

Scene scene_of(bool corner, bool slides, ContactFace face) {
  shapes::Random random(5);
  std::vector<Body<3>> bodies{shapes::body_of<3>(shapes::box<3>({-1, -1, -1}, {2.0 * along, 2.0 * along, 0}), true)};
  for (int i = 0; i < blocks; ++i) {
    const Matrix<3> turn =
        matrix(corner ? shapes::orientation<3>(random) : turned(Rotation<3>{}, {0, 0, shapes::uniform(random, 0, 1)}));
    HalfSpaces<3> planes = shapes::placed<3>(shapes::cube<3>(0.5), turn, Vector<3>::Zero());
    double lowest = 0;
    for (const Vector<3>& v : shapes::block<3>(planes).vertices)
      lowest = std::min(lowest, v[2]);
    bodies.push_back(shapes::body_of<3>(
        shapes::placed<3>(planes, Matrix<3>::Identity(), {2.0 * (i % along), 2.0 * (i / along), -lowest - depth})));
  }
  Scene s;
  s.model = shapes::model_of<3>(bodies, (slides ? 1 : 80) * degree);
  s.settings.contact.face = face;
  s.state = initial_state(s.model);
  s.state.time_step.length = 1e-4;
  for (std::size_t b = 1; b < s.model.bodies.size(); ++b)
    s.state.bodies.motions[b].velocity = slides ? Vector<3>(speed, 0.3 * speed, 0) : Vector<3>(1e-9, 0, 0);
  find_neighbours(s.model, s.settings, s.state.bodies, s.state.contacts, s.state.counters);
  for (int i = 0; i < 50; ++i)
    find_joint_forces(s.model, s.settings, s.state.schedule,
                      joint_step(s.settings, s.state.time_step, s.state.relaxation), s.state.bodies, s.state.contacts,
                      s.state.ledger, s.state.counters);
  return s;
}

std::map<std::string, Scene (*)()> ways() {
  return {{"face/point", [] { return scene_of(false, false, ContactFace::point); }},
          {"face/whole", [] { return scene_of(false, false, ContactFace::integrated); }},
          {"face_slides/point", [] { return scene_of(false, true, ContactFace::point); }},
          {"face_slides/whole", [] { return scene_of(false, true, ContactFace::integrated); }},
          {"corner/point", [] { return scene_of(true, false, ContactFace::point); }},
          {"corner/whole", [] { return scene_of(true, false, ContactFace::integrated); }},
          {"corner_slides/point", [] { return scene_of(true, true, ContactFace::point); }},
          {"corner_slides/whole", [] { return scene_of(true, true, ContactFace::integrated); }}};
}

void run(Scene (*make)(), benchmark::State& bench) {
  Scene s = make();
  for (auto _ : bench)
    find_joint_forces(s.model, s.settings, s.state.schedule,
                      joint_step(s.settings, s.state.time_step, s.state.relaxation), s.state.bodies, s.state.contacts,
                      s.state.ledger, s.state.counters);
  int touching = 0;
  for (const Contact<3>& c : s.state.contacts.list)
    touching += c.touching();
  bench.counters["contacts"] = touching;
  bench.counters["ns_per_contact"] =
      benchmark::Counter(touching, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace
}  // namespace voussoir

int main(int argument_count, char** arguments) {
  using namespace voussoir;
  const auto all = ways();
  if (argument_count == 4 && std::string(arguments[1]) == "--count") {
    if (!all.contains(arguments[2])) return 2;
    Scene s = all.at(arguments[2])();
    for (int i = 0; i < std::atoi(arguments[3]); ++i)
      find_joint_forces(s.model, s.settings, s.state.schedule,
                        joint_step(s.settings, s.state.time_step, s.state.relaxation), s.state.bodies, s.state.contacts,
                        s.state.ledger, s.state.counters);
    return 0;
  }
  for (const auto& [way, make] : all)
    benchmark::RegisterBenchmark(way.c_str(), [make = make](benchmark::State& s) { run(make, s); });
  benchmark::Initialize(&argument_count, arguments);
  benchmark::RunSpecifiedBenchmarks();
}
