// Eight lively models for comparing builds: blocks slide, turn, part and meet again, so that one different rounding
// anywhere soon shows in every digit.
#pragma once

#include "core/model/water_surfaces.hpp"
#include "core/slicing/slice.hpp"
#include "core/testing/models.hpp"

namespace voussoir::probe {

template <int Dim>
struct Scene {
  const char* name;
  Model<Dim> model;
  Settings settings;
  State<Dim> state;
};

// a random velocity for every free body; numbers come from the generator alone, since a compiler may evaluate a
// constant sine differently from the C library
template <int Dim>
void set_in_motion(Scene<Dim>& scene, double speed, shapes::Random& random) {
  scene.state = initial_state(scene.model);
  for (std::size_t b = 0; b < scene.model.bodies.size(); ++b) {
    const Body<Dim>& body = scene.model.bodies[b];
    if (body.fixed) continue;
    Motion<Dim>& motion = scene.state.bodies.motions[b];
    for (int k = 0; k < Dim; ++k)
      motion.velocity[k] = shapes::uniform(random, -speed, speed);
    for (int k = 0; k < spin_freedoms<Dim>; ++k)
      motion.angular_momentum[k] = body.inertia[k] * shapes::uniform(random, -speed, speed);
  }
}

// some sixty blocks that random joints cut out of a cube of 2 m, on a slope of 32 degrees; local damping
inline Scene<3> collapse() {
  shapes::Random random(11);
  std::vector<Cut<3>> cuts;
  for (int set = 0; set < 3; ++set) {
    const Vector<3> normal = (Vector<3>::Unit(set) + 0.3 * shapes::direction<3>(random)).normalized();
    for (const double offset : {-0.6, 0.0, 0.5})
      cuts.push_back({{normal, offset + shapes::uniform(random, -0.05, 0.05)}, 0});
  }
  SlicingCounters counters;
  std::vector<Body<3>> bodies{shapes::body_of<3>(shapes::box<3>({-6, -6, -2}, {6, 6, -1}), true)};
  for (const Polytope<3>& part : slice<3>(shapes::block<3>(shapes::cube<3>(1)), cuts, {0.06}, counters))
    bodies.push_back(make_body<3>({part}, shapes::density));

  Scene<3> scene{.name = "collapse", .model = shapes::model_of<3>(bodies), .settings = {}, .state = {}};
  scene.model.gravity = {5, 1, -8};
  scene.model.properties = {{"joint", 1e7, 5e6, 0.35, false}};
  scene.settings.damping.local = 0.1;
  set_in_motion(scene, 0.5, random);
  return scene;
}

// a wall of forty blocks in running bond, shaken; a dashpot in every contact
inline Scene<2> wall() {
  shapes::Random random(12);
  std::vector<Body<2>> bodies{shapes::body_of<2>(shapes::box<2>({-6, -1}, {6, 0}), true)};
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 5; ++column) {
      const double x = column - 2.5 + 0.5 * (row % 2), y = 0.5 * row;
      bodies.push_back(shapes::body_of<2>(shapes::box<2>({x, y}, {x + 1, y + 0.5})));
    }

  Scene<2> scene{.name = "wall", .model = shapes::model_of<2>(bodies), .settings = {}, .state = {}};
  scene.model.properties = {{"joint", 1e7, 5e6, 0.5, false}};
  scene.settings.damping = {.local = 0, .viscous_ratio = 0.1};
  set_in_motion(scene, 1.0, random);
  return scene;
}

// regular solids and an L-shaped body of two parts thrown together above a floor: edges and corners meet; no damping
inline Scene<3> tumble() {
  shapes::Random random(13);
  std::vector<Body<3>> bodies{shapes::body_of<3>(shapes::box<3>({-6, -6, -2}, {6, 6, -1}), true)};
  const std::vector<shapes::Platonic> solids = shapes::platonic_solids(0.3);
  for (int place = 0; place < 18; ++place) {
    const Vector<3> centre = 0.85 * Vector<3>(place % 3 - 1, place / 3 % 3 - 1, place / 9 - 0.5);
    const Matrix<3> turn = matrix(shapes::orientation<3>(random));
    if (place == 4)
      bodies.push_back(make_body<3>({shapes::block<3>(shapes::box<3>({-0.4, -0.2, -0.6}, {0.4, 0.2, -0.2})),
                                     shapes::block<3>(shapes::box<3>({-0.4, -0.2, -0.2}, {0.0, 0.2, 0.2}))},
                                    shapes::density));
    else
      bodies.push_back(shapes::body_of<3>(shapes::placed<3>(solids[place % solids.size()].planes, turn, centre)));
  }

  Scene<3> scene{.name = "tumble", .model = shapes::model_of<3>(bodies), .settings = {}, .state = {}};
  scene.model.properties = {{"joint", 1e7, 5e6, 0.4, false}};
  scene.settings.damping.local = 0;
  scene.settings.time.fraction = 0.1;
  set_in_motion(scene, 2.0, random);
  return scene;
}

// the same by contacts on the central path
inline Scene<3> smooth_tumble() {
  Scene<3> scene = tumble();
  scene.name = "smooth_tumble";
  scene.model.properties[0].constant_stiffness = true;
  scene.settings.contact.point = ContactPoint::central_path;
  scene.settings.contact.normal = ContactNormal::multipliers;
  return scene;
}

// both with integrated face contacts: from faces over edges to corners and back
template <int Dim>
Scene<Dim> integrated_in(Scene<Dim> scene, const char* name) {
  scene.name = name;
  scene.settings.contact.face = ContactFace::integrated;
  return scene;
}

template <int Dim>
void flood(Scene<Dim>& scene, const std::vector<double>& numbers, const std::vector<int>& water_of_joint) {
  assign_waters(scene.model, {{"water", 9810, false, numbers}}, water_of_joint);
  scene.state.schedule.water = scene.state.schedule.last_water = initial_water(scene.model);
}

// solids thrown together half under a tilted surface of water, which has a potential
inline Scene<3> flooded_tumble() {
  Scene<3> scene = tumble();
  scene.name = "flooded_tumble";
  flood(scene, {0.1, 0.2, -0.1}, {0, 0});
  return scene;
}

// the wall with water outside its blocks, face by face
inline Scene<2> flooded_wall() {
  Scene<2> scene = wall();
  scene.name = "flooded_wall";
  flood(scene, {-2, 3, 1, 1, 2, 1.5}, {-1, 0});
  return scene;
}

}  // namespace voussoir::probe
