// A scene made ready to run: blocks cut, properties assigned, selectors resolved.
#pragma once

#include <string>
#include <vector>

#include "core/model.hpp"
#include "core/settings.hpp"
#include "core/state.hpp"

namespace voussoir {

// a monitor whose subject was found
struct Monitor {
  std::string name;
  Quantity quantity = Quantity::displacement;
  int subject = 0;  // body, or joint for contact_force
};

template <int Dim>
struct Prepared {
  std::string title;
  std::string accuracy_level;  // that the scene names; empty: none
  Model<Dim> model;
  State<Dim> state;  // initial velocities set
  Settings settings;
  std::vector<StagePlan> stages;
  std::vector<Monitor> monitors;
  OutputPlan output;
};

}  // namespace voussoir
