// Rigid-block limit analysis against closed forms, and the proofs that come with its answers.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/limit/limit.hpp"
#include "core/limit/mechanism.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {
namespace {

constexpr double degree = std::numbers::pi / 180;

TEST(Scratch, Slump) {
  const Scene scene = read_scene(std::filesystem::path(VOUSSOIR_SOURCE_DIR) / "cases/slump/scene.toml");
  const Model<2> model = prepare<2>(scene).model;
  const auto faces = find_interfaces(model);
  int free = 0;
  for (const auto& b : model.bodies)
    free += !b.fixed;
  std::printf("%d free, %zu interfaces\n", free, faces.size());
  const CriticalFriction c = find_critical_friction(model, faces);
  std::printf("status %d %.9f %.9f missing %g gap %g oob %g inadm %g programs %d\n", int(c.status),
              c.collapses / degree, c.stands / degree, c.missing, c.evidence.gap, c.evidence.out_of_balance,
              c.evidence.inadmissible, c.evidence.programs);
  const Mechanism m = describe_mechanism(model, c.state.velocities);
  for (const auto& b : m.moving) {
    auto x = model.origin + model.bodies[b.body].reference;
    std::printf("%d at %.2f %.2f speed %g turning %g share %g centre %g %g\n", b.body, x[0], x[1], b.speed, b.turning,
                b.rotation_share, b.centre ? (*b.centre)[0] : NAN, b.centre ? (*b.centre)[1] : NAN);
  }
}

}  // namespace
}  // namespace voussoir
