// A scene made ready to run: blocks cut, properties assigned, selectors resolved.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

enum class Quantity {
  displacement,
  velocity,
  rotation,
  angular_velocity,
  load,
  contact_force,
  whole_bonds,
  level,
  bolt_force,
  convergence,
  lining_force
};

// a quantity that a monitor may follow in history.csv
struct Monitored {
  std::string_view word;
  Quantity quantity;

  bool operator==(const Monitored&) const = default;
};

// every such quantity: of a body, the loads of each source among them; of a joint the resultant over its contacts and
// its bonds; of a water its level; of bolts and linings their forces; of an opening the inward displacement of its wall
inline std::vector<Monitored> monitored_quantities() {
  std::vector<Monitored> all{{"displacement", Quantity::displacement},
                             {"velocity", Quantity::velocity},
                             {"rotation", Quantity::rotation},
                             {"angular_velocity", Quantity::angular_velocity}};
  for (const SourceRow& row : source_table)
    if (!row.monitored.empty() && row.monitored != all.back().word) all.push_back({row.monitored, Quantity::load});
  all.push_back({"contact_force", Quantity::contact_force});
  all.push_back({"whole_bonds", Quantity::whole_bonds});
  all.push_back({"level", Quantity::level});
  all.push_back({"bolt_force", Quantity::bolt_force});
  all.push_back({"convergence", Quantity::convergence});
  all.push_back({"lining_force", Quantity::lining_force});
  return all;
}

// how a monitor combines several bodies
enum class Aggregate { one, sum, mean };

// those that can be counted from the end of a stage
inline bool counts_from_stage(Quantity quantity) {
  return quantity == Quantity::displacement || quantity == Quantity::rotation || quantity == Quantity::convergence;
}

// a point of an opening's wall, in model coordinates of the reference configuration, m; as many
// coordinates as the scene has dimensions
struct WallPoint {
  std::array<double, 3> point{};
  std::array<double, 3> inwards{};  // unit, towards the opening's centre
  std::array<double, 3> rock{};     // a point inside the part of a body whose face the wall is: it identifies the body
};

// a monitor whose subject was found
struct Monitor {
  std::string name;
  Monitored followed{"displacement", Quantity::displacement};
  int subject = 0;   // body, or joint for contact_force and whole_bonds, or water for level, or Model::bolt_properties,
                     // or Model::linings
  int points = 0;    // of a level: the number of points of its table; 0: a pressure
  Aggregate over{};  // of bodies
  std::vector<int> group{};       // if it is over several: the bodies, ascending
  int since = -1;                 // the stage, from 0, from whose end motion is counted; -1: from the start
  std::vector<WallPoint> wall{};  // of convergence
  int node = -1;                  // of a lining, that is followed; -1: the largest of all
};

// the sets of the model's joints, for display: no result depends on them
struct JointSets {
  std::vector<int> of_joint{};  // by Model::joints: place in `names`; -1: of none
  std::vector<std::string> names{};

  // -1 also for faces that no joint of the scene made
  int set_of(int joint) const { return joint >= 0 && joint < static_cast<int>(of_joint.size()) ? of_joint[joint] : -1; }
};

template <int Dim>
struct Prepared {
  std::string title;
  std::string accuracy_level;  // that the scene names; empty: none
  Model<Dim> model;
  State<Dim> state;  // initial velocities set
  Settings settings;
  std::vector<StagePlan> stages;
  std::optional<int> last_stage{};  // place of the last one to be run; none: all are
  std::vector<Monitor> monitors;
  OutputPlan output;
  JointSets joint_sets{};
};

}  // namespace voussoir
