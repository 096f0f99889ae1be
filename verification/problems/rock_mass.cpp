// The sliced rock mass, from the scene of a case.
#include <fmt/format.h>

#include "core/scene/scene.hpp"
#include "verification/problems/common.hpp"
#include "verification/problems/problems.hpp"
#include "verification/problems/solid.hpp"

namespace voussoir::problems {
namespace {

constexpr const char* scene_file = VOUSSOIR_SOURCE_DIR "/cases/slicing/rock_mass.toml";

Solid solid_of(const Model<3>& model, std::size_t b, const std::string& name) {
  const Body<3>& body = model.bodies[b];
  const Polytope<3>& part = body.parts.front();
  std::vector<Point> vertices;
  for (const Vector<3>& v : part.vertices)
    vertices.push_back(model.origin + body.reference + v);
  Solid made = solid(name, body.mass / part.mass.volume, vertices, part.loops);
  made.fixed = body.fixed;
  return made;
}

}  // namespace

Problem rock_mass() {
  const Prepared<3> prepared = prepare<3>(read_scene(scene_file));
  const Model<3>& model = prepared.model;
  Problem p;
  p.name = "rock_mass";
  p.title = "Rock mass of 327 blocks between fixed walls";
  int number = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    p.blocks.push_back(
        solid_of(model, b, model.bodies[b].fixed ? model.bodies[b].name : fmt::format("block_{}", ++number)));
  p.joints = {one_joint(35, {1e9, 0.5e9}, {})};
  p.gravity = grown({0, 0, -standard_gravity});
  p.duration = 4;
  p.output = 0.1;
  const std::string sum = " of the contact forces on floor and walls, mean from 3 s to 4 s";
  p.asked = {{"weight on floor and walls", "N", "sum" + sum + ", down"},
             {"thrust on the walls, eastward", "N", "sum" + sum + ", towards +x"},
             {"thrust on the walls, northward", "N", "sum" + sum + ", towards +y"},
             {"blocks that left their place", "1", "number of free blocks more than 50 mm from their place at 4 s"}};
  const std::string because =
      "equilibrium of the whole mass; what is left of its motion: 1e-3 of g in the mean of all blocks";
  const std::string counted = "a count";
  constexpr double weight = 2040480;  // N, for the tolerance of the horizontal forces alone
  const std::string which = ", 327 blocks by Newton's method";
  const auto reference = [&](const std::string& row, double absolute, double relative) {
    return Reference{"slicing", row + which, {}, absolute, relative, because};
  };
  const Reference vertical = reference("settling: weight on floor and walls", 0, 1e-3);
  const Reference east = reference("settling: thrust on the walls, eastward", 1e-3 * weight, 0);
  const Reference north = reference("settling: thrust on the walls, northward", 1e-3 * weight, 0);
  const Reference moved{"key_blocks", "blocks removed, F < 1, rock mass", {}, 0.5, 0, counted};
  p.references = {{p.asked[0].quantity, vertical, vertical},
                  {p.asked[1].quantity, east, east},
                  {p.asked[2].quantity, north, north},
                  {p.asked[3].quantity, moved, moved}};
  p.dimensions = {
      {{0, 0, 4.3}, {5, 0, 4.3}, "5 m"}, {{5.3, 0, 4}, {5.3, 4, 4}, "4 m"}, {{-0.3, 0, 0}, {-0.3, 0, 4}, "4 m"}};
  p.words.model =
      "A box of 5 x 4 x 4 m of rock, cut by three nearly orthogonal joint sets into 327 convex blocks, between a floor "
      "and "
      "four walls that are fixed; the top is free. Block theory proves that no block can move: all are enclosed, "
      "tapered "
      "or stable under their weight.";
  p.words.measured =
      "Forces on the fixed blocks once the mass is at rest, and which free blocks are more than 50 mm from their "
      "place.";
  p.words.protocol =
      "Gravity grows from nothing to 9.81 m/s2 within 1 s and is held until 4 s. Damping of the code's own choice.";
  p.words.two_answers =
      "One answer each. State the seconds: this problem compares cost. A code without contact forces writes `cannot "
      "state` for them and answers the last row.";
  p.words.tolerance = "Forces: " + because + ". Blocks: " + counted + ".";
  return p;
}

std::vector<Problem> all_problems() {
  return {sliding_cube(), incline(), toppling_block(), wedge(),        free_rotation(),
          rocking(),      arch(),    bonded_beam(),    bolted_block(), rock_mass()};
}

}  // namespace voussoir::problems
