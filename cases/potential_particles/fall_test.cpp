// The five regular shapes, rounded, fall into a box and come to rest: nothing gives way, and what becomes of the
// energy.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cases/model_picture.hpp"
#include "cases/potential_particles/trial.hpp"
#include "cases/recorded_run.hpp"
#include "core/testing/fall_scene.hpp"
#include "core/testing/fall_watch.hpp"

namespace voussoir::cases {
namespace {

using namespace shapes;
using verification::Bound;
using verification::CaseReport;
using verification::Kind;

constexpr double corner_radius = 0.2;  // of the smallest block's inscribed radius: 33 mm
constexpr double sphericity = 0.05;

// Stiff enough that an impact at 7 m/s goes in by less than a corner's radius: v sqrt(m/K) = 13 mm of a cube.
const std::vector<std::string> stiff{"joint_properties.rock.normal_stiffness=1e8",
                                     "joint_properties.rock.shear_stiffness=5e7"};

// the scene of the case free_fall, its blocks, plate and walls made particles
std::filesystem::path rounded_fall(const FallPlan& plan) {
  const std::string sharp = fall_scene(plan, "Rounded regular polyhedra fall into a box");
  const LoadedScene loaded = load_scene(write_scene("fall_sharp", sharp));
  const auto& scene = std::get<Prepared<3>>(loaded.prepared);
  const std::string particles =
      blocks_as_particles<3>(scene.model, scene.state, {corner_radius * smallest_size(scene.model), sphericity});
  const std::size_t begin = sharp.find("blocks = ["), end = sharp.find("[[joint_properties]]");
  return write_scene("fall", sharp.substr(0, begin) + particles + "\n" + sharp.substr(end));
}

struct Fall {
  LoadedScene loaded;
  FallFindings found;
  double deepest = 0;  // m, over all frames: the largest overlap
};

Fall let_fall(const FallPlan& plan, std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), stiff.begin(), stiff.end());
  Fall fall{load_scene(rounded_fall(plan), overrides), {}};
  fall.found =
      fall_until_rest(std::get<Prepared<3>>(fall.loaded.prepared), plan.side * plan.pitch, [&](const State<3>& state) {
        for (const Contact<3>& c : state.contacts)
          if (c.touching()) fall.deepest = std::max(fall.deepest, c.geometry.overlap);
      });
  return fall;
}

}  // namespace

TEST(ScratchLong, Fall) {
  FallPlan plan;
  plan.blocks = getenv("N") ? atoi(getenv("N")) : 20;
  plan.side = getenv("S") ? atoi(getenv("S")) : 3;
  std::vector<std::string> o;
  if (getenv("O")) {
    std::istringstream in(getenv("O"));
    std::string w;
    while (in >> w)
      o.push_back(w);
  }
  const Fall f = let_fall(plan, o);
  fmt::print(
      "before {} {} end {} {} kinetic {} time {} seconds {} evals {} deepest {} unconv {} deep {} undecided {} cold "
      "{}\n",
      f.found.before.motion, f.found.before.contacts, f.found.end.motion, f.found.end.contacts, f.found.kinetic,
      f.found.time, f.found.seconds, f.found.counters.contact_evaluations, f.deepest, f.found.counters.unconverged,
      f.found.counters.deep_overlaps, f.found.counters.undecided, f.found.counters.cold_starts);
}
}  // namespace voussoir::cases
