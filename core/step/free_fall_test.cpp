// Bodies without an equilibrium, before the first step and after they have left.
#include "core/step/free_fall.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <vector>

#include "core/run/run.hpp"
#include "core/step.hpp"
#include "core/testing/models.hpp"

namespace voussoir::free_fall_test {
namespace {

using Engine = std::mt19937_64;
using shapes::box;

template <int Dim>
Matrix<Dim> random_axes(Engine& engine) {
  shapes::Random random(engine());
  return matrix(shapes::orientation<Dim>(random));
}

template <int Dim>
using Cell = std::array<int, Dim>;

// Unit cubes in cells of a lattice, under gravity along one of its axes, all rotated together.
template <int Dim>
struct Lattice {
  std::vector<Cell<Dim>> cells;
  std::vector<bool> fixed;
  int axis = 0, sign = -1;  // of gravity

  explicit Lattice(Engine& engine) {
    const auto whole = [&](int low, int high) { return std::uniform_int_distribution<>(low, high)(engine); };
    axis = whole(0, Dim - 1);
    sign = whole(0, 1) ? 1 : -1;
    std::map<Cell<Dim>, bool> chosen;
    const int count = whole(1, 8);
    while (static_cast<int>(chosen.size()) < count) {
      Cell<Dim> cell;
      for (int& k : cell)
        k = whole(0, 4) * (whole(0, 2) ? 1 : 10);
      chosen[cell] = whole(0, 3) == 0;
    }
    for (const auto& [cell, is_fixed] : chosen) {
      cells.push_back(cell);
      fixed.push_back(is_fixed);
    }
  }

  // the numbers of the chains of cells that are no farther apart than this along any axis: 1 for those that touch;
  // boxes aligned with the axes around rotated cubes may meet up to 3
  std::vector<int> chains(int reach) const {
    std::vector<int> chain(cells.size());
    for (std::size_t i = 0; i < chain.size(); ++i)
      chain[i] = static_cast<int>(i);
    const auto neighbours = [&](std::size_t i, std::size_t j) {
      int apart = 0;
      for (int k = 0; k < Dim; ++k)
        apart = std::max(apart, std::abs(cells[i][k] - cells[j][k]));
      return apart <= reach;
    };
    for (std::size_t round = 0; round < cells.size(); ++round)
      for (std::size_t i = 0; i < cells.size(); ++i)
        for (std::size_t j = 0; j < cells.size(); ++j)
          if (neighbours(i, j)) chain[i] = chain[j] = std::min(chain[i], chain[j]);
    return chain;
  }
  bool is_tied(const std::vector<int>& chain, int number) const {
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (chain[i] == number && fixed[i]) return true;
    return false;
  }
  // least sideways distance of another chain's cube that is not higher, in cells
  int nearest_below(const std::vector<int>& chain, int number) const {
    int nearest = 1000;
    for (std::size_t i = 0; i < cells.size(); ++i)
      for (std::size_t j = 0; j < cells.size(); ++j) {
        if (chain[i] != number || chain[j] == number || sign * (cells[j][axis] - cells[i][axis]) < 0) continue;
        int aside = 0;
        for (int k = 0; k < Dim; ++k)
          if (k != axis) aside = std::max(aside, std::abs(cells[j][k] - cells[i][k]));
        nearest = std::min(nearest, aside);
      }
    return nearest;
  }

  // whether a fixed cube is vertically below one of a chain
  bool held_below(const std::vector<int>& chain, int number) const {
    for (std::size_t i = 0; i < cells.size(); ++i)
      for (std::size_t j = 0; j < cells.size(); ++j) {
        Cell<Dim> way;
        for (int k = 0; k < Dim; ++k)
          way[k] = cells[j][k] - cells[i][k];
        const bool straight = std::ranges::count(way, 0) == Dim - 1 && sign * way[axis] > 0;
        if (chain[i] == number && fixed[j] && straight) return true;
      }
    return false;
  }

  Model<Dim> model(const Matrix<Dim>& turn) const {
    std::vector<Body<Dim>> bodies;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      Vector<Dim> low;
      for (int k = 0; k < Dim; ++k)
        low[k] = cells[i][k];
      bodies.push_back(
          shapes::body_of<Dim>(shapes::placed<Dim>(box<Dim>(low, low + Vector<Dim>::Ones()), turn, Vector<Dim>::Zero()),
                               fixed[i], std::to_string(i).c_str()));
    }
    Model<Dim> made = shapes::model_of<Dim>(std::move(bodies));
    made.gravity = turn * Vector<Dim>(sign * 9.81 * Vector<Dim>::Unit(axis));
    return made;
  }
};

template <int Dim>
void expect_named_when_it_can_only_fall(Engine& engine, std::array<int, 3>& seen) {
  const Lattice<Dim> lattice(engine);
  const Matrix<Dim> turn = random_axes<Dim>(engine);
  const Model<Dim> model = lattice.model(turn);
  State<Dim> state = initial_state(model);
  find_forces(model, {}, state);
  const int named = tied_to_nothing(model, state);

  const std::vector<int> touching = lattice.chains(1), near = lattice.chains(3);
  bool must = false;
  for (const int number : near)
    must |= !lattice.is_tied(near, number) && lattice.nearest_below(near, number) > 4;
  EXPECT_TRUE(!must || named >= 0);
  ++seen[must ? 0 : named < 0 ? 1 : 2];
  if (named < 0) return;
  const int cell = std::stoi(model.bodies[named].name);
  EXPECT_FALSE(lattice.is_tied(touching, touching[cell]));
  EXPECT_FALSE(lattice.held_below(touching, touching[cell]));
}

// Random cubes, in 2-D and 3-D, under gravity in any direction: cubes that are connected, or have another vertically
// below, are never named; a cube far from all others always is.
TEST(FreeFall, BeforeTheFirstStepIsThatOfUnconnectedBodies) {
  Engine engine(463);
  std::array<int, 3> seen{};
  for (int k = 0; k < 300; ++k) {
    expect_named_when_it_can_only_fall<2>(engine, seen);
    expect_named_when_it_can_only_fall<3>(engine, seen);
  }
  EXPECT_GT(seen[0], 50);
  EXPECT_GT(seen[1], 20);
}

TEST(FreeFall, BoltsAndOtherLoadsMayHoldUnconnectedBodies) {
  Model<2> model = shapes::model_of<2>({shapes::body_of<2>(box<2>({0, 0}, {1, 1}), false, "hung"),
                                        shapes::body_of<2>(box<2>({0, 3}, {1, 4}), true, "roof")});
  State<2> state = initial_state(model);
  find_forces(model, {}, state);
  const int hung = shapes::index_of(model, "hung"), roof = shapes::index_of(model, "roof");
  EXPECT_EQ(tied_to_nothing(model, state), hung);

  State<2> bolted = state;
  BoltSpring<2> spring;
  spring.body_a = roof;
  spring.body_b = hung;
  bolted.supports.bolt_springs.push_back(spring);
  EXPECT_EQ(tied_to_nothing(model, bolted), -1);
  bolted.supports.bolt_springs.front().broken = true;
  EXPECT_EQ(tied_to_nothing(model, bolted), hung);

  State<2> loaded = state;
  loaded.loads.by_source[Source::applied_forces].resize(2);
  loaded.loads.by_source[Source::applied_forces][hung].force = {0, 1e4};
  EXPECT_EQ(tied_to_nothing(model, loaded), -1);

  Model<2> restrained = model;
  restrained.bodies[hung].free_translation[1] = false;
  EXPECT_EQ(tied_to_nothing(restrained, state), -1);
  Model<2> weightless = model;
  weightless.gravity.setZero();
  EXPECT_EQ(tied_to_nothing(weightless, state), -1);
}

// A block far away in any direction without contact force: a contact without force is as good as none.
TEST(FreeFall, IsFoundInAnyDirection) {
  Engine engine(16);
  Model<3> model = shapes::block_on_plate<3>(0, 0.5);
  const int block = shapes::index_of(model, "block");
  for (int k = 0; k < 50; ++k) {
    State<3> state = initial_state(model);
    state.bodies.motions[block].displacement = 1.6e12 * random_axes<3>(engine).col(0);
    state.bodies.motions[block].velocity = random_axes<3>(engine).col(0);
    EXPECT_EQ(falling_free(model, state), block);
    state.contacts.list.resize(1);
    state.contacts.list[0].part_b = 1;
    state.contacts.list[0].status = ContactStatus::touching;
    state.contacts.loads.resize(1);
    state.contacts.loads[0].second = 1;
    EXPECT_EQ(falling_free(model, state), block);
    state.contacts.loads[0].force = {0, 0, 1};
    EXPECT_EQ(falling_free(model, state), -1) << "a force acts between them";
  }
}

}  // namespace
}  // namespace voussoir::free_fall_test
