// A block pressed into a plate and tilted, without motion and weight, and the response of its joint; springs under it
// in closed form.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/step/contacts.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/loads.hpp"
#include "core/step/neighbours.hpp"
#include "core/testing/models.hpp"

namespace voussoir::pressed {

// the block of block_on_plate: 1 x 1 in plan, centroid 0.25 above its base
inline constexpr double width = 1, height = 0.25;

template <int Dim>
struct Block {
  Model<Dim> model;
  Settings settings;
  State<Dim> state;
  int block, plate;

  explicit Block(double friction = 40 * degree) : model(shapes::block_on_plate<Dim>(0, friction)) {
    model.gravity.setZero();
    block = shapes::index_of(model, "block");
    plate = shapes::index_of(model, "plate");
    state = initial_state(model);
  }

  // by `depth` under the middle of its base, turned about it by `angle`
  void press(double depth, double angle) {
    Motion<Dim>& motion = state.bodies.motions[block];
    motion.displacement[0] = (Dim == 2 ? -1 : 1) * height * std::sin(angle);
    motion.displacement[Dim - 1] = -depth + height * (std::cos(angle) - 1);
    if constexpr (Dim == 2)
      motion.rotation.angle = angle;
    else
      motion.rotation.quaternion = Eigen::AngleAxisd(angle, Vector<3>::UnitY());
    answer();
  }

  void answer() {
    find_neighbours(model, settings, state.bodies, state.contacts, state.counters);
    find_contacts(model, settings, 0, state.bodies, state.contacts, state.counters);
    apply_joint_laws(model, settings, state.schedule, joint_step(settings, state.time_step, state.relaxation),
                     state.bodies, state.contacts, state.ledger, state.counters);
    sum_loads(model, settings, state.schedule, state.bodies, state.contacts, state.supports, state.loads);
  }

  Vector<Dim> load() const { return state.loads.total[block].force; }
  Spin<Dim> moment_of_base() const {  // about the middle of the base
    const Load<Dim>& load = state.loads.total[block];
    const Vector<Dim> arm = matrix(state.bodies.motions[block].rotation) * (height * Vector<Dim>::Unit(Dim - 1));
    return load.moment + voussoir::moment(arm, load.force);
  }
};

// springs of stiffness k per area under a base tilted by `angle`: their force where they are pressed
struct Springs {
  double force = 0, moment = 0;
  Springs(double stiffness, double depth, double angle) {
    // overlap depth + angle·x over -1/2 < x < 1/2; where it is negative there is no force
    const double low = std::max(-0.5 * width, -depth / angle), high = 0.5 * width;
    const auto power = [&](int n) { return (std::pow(high, n + 1) - std::pow(low, n + 1)) / (n + 1); };
    force = stiffness * (depth * power(0) + angle * power(1));
    moment = stiffness * (depth * power(1) + angle * power(2));
  }
};

}  // namespace voussoir::pressed
