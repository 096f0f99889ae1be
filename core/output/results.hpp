// Results of a simulation, without files: values with units, the history of the monitors, counters, why it ended.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/model/state.hpp"
#include "core/output/failure_mechanism.hpp"

namespace voussoir {

// done: every stage reached its goal; incomplete: a goal was not reached (no equilibrium, no bracket);
// failed: a numerical failure (a contact without a solution, a non-finite force)
enum class Outcome { done, incomplete, failed };

// change of a value as one input was varied, in its unit
struct BudgetLine {
  std::string varied, change;  // "stiffness", "4 times"
  double shift = 0;            // the value then, minus the value
  double left = 0;             // the error estimated from it: extrapolated if an order is known
  double part = 0;             // of the error bar, half width: its square is added to the square of the bar
  bool sensitivity = false;    // the scene states that it was measured: reported, but not an error
};

// How the result of a search follows from its trials: the middle of a bracket whose trials failed by displacement, or
// by the strength that their motion requires; this strength at no displacement; the fit through the stable trials.
inline constexpr const char *found_by_displacement = "displacement", *found_by_bracket = "bracket",
                            *found_by_strength = "required strength", *found_by_fit = "stable fit";

struct Value {
  double value = 0;
  std::string unit;                    // "deg", "m", "1" …
  std::optional<double> error_bar;     // same unit: half width of the error from the sources that it `covers`
  std::string rule;                    // how it was determined; may be empty
  std::string covers = "bracket";      // only the search's; "criterion": the extrapolation of the required strength, or
                                       // the fit; "stiffness", "budget": these, and the lines of `budget`
  std::optional<double> bracket = {};  // half of the search's
  std::vector<BudgetLine> budget = {};  // by size
  std::string divides = {};   // of a factor of safety: the strengths that it divides, and those that it does not
  std::string found_by = {};  // of a search that brackets
  std::optional<double> bracket_middle = {};
  std::optional<double> criterion = {};      // part of the error bar: of the extrapolation, or the fit
  bool turned = false;                       // bodies of the last failed trial turned
  std::vector<std::string> not_varied = {};  // by the budget: parts of the error that the bar does not cover

  // whether the middle of its bracket is the result, so that half of the bracket is part of the bar
  bool is_middle() const { return error_bar && found_by != found_by_strength && found_by != found_by_fit; }
};

// The strengths that a factor of safety divides, as a sentence: tan φ and, if it is included, cohesion of joint
// properties by name; none: of all.
std::string divided_by_factor(const std::vector<std::string>& properties, bool cohesion = true);

// What the displacements of a stage of implicit steps owe to their error: against the same with half of it.
struct HalfErrorResult {
  int body = -1;            // that has moved most over the stage
  std::string name = {};    // of the body; may be empty
  double displacement = 0;  // m: its
  double change = 0;        // m: the largest of any free body's
};

struct StageResult {
  std::string name, kind;  // kind: settle, run, reduce
  std::string ended;       // why it stopped, e.g. "equilibrium", "end time", "bracket closed"
  bool relaxed = false;    // ended by relaxation: its time and velocities are fictitious (ends_relaxed)
  long long steps = 0;
  double time = 0;           // s simulated within the stage
  double time_step = 0;      // s at its end; the longest of implicit steps
  double shortest_step = 0;  // s: of implicit steps; 0: there was none
  // the equilibrium measure of the state at its end, which after a search is the last stable one; infinite if there is
  // no contact force as a reference, negative if equilibrium was not sought
  double unbalanced = 0;
  // of a stage that settles or runs: its motion, if it has found no equilibrium or has ended away from its begin
  FailureMechanism mechanism = {};
  std::optional<HalfErrorResult> half_error = {};  // if the scene asks for it
};

// Bonds of a joint, or of a set of joints.
struct BondsOfJoint {
  std::string joint;                           // its name or its set's; empty: of faces that no joint made
  long long whole = 0, slipped = 0, made = 0;  // without those that were removed with their blocks
  double area_share = 0;                       // area of those not lost over that of all
};

struct WholeBonds {
  long long whole = 0, slipped = 0, made = 0;
  std::vector<BondsOfJoint> by_joint{};
};

// the end of a trial of a search: a row of search.csv (core/output/search_csv.hpp)
struct TrialRow {
  int stage = 1, trial = 1;
  double level = 0;
  std::string unit;                                  // of the level: "deg" of a friction angle, "1" of a factor
  std::string outcome;                               // stable, failed, undecided, broken
  int body = -1;                                     // that has moved most since the search began; -1: none has
  std::string name = {};                             // of the body; may be empty
  double displacement = 0;                           // m, its
  std::optional<double> elastic_displacements = {};  // the same over the elastic displacement of the bodies that move
  std::optional<double> required = {};               // level that its motion required at its end, if it failed
  std::optional<double> bolts_turned = {};           // deg: largest of a bolt since its installation; no bolt: nothing
  std::optional<double> bolts_use = {};              // largest force of a bolt over its capacity, if any has one
  std::optional<double> water_lost = {};  // fraction of the water's force on that body when the search began; may be
                                          // negative
  FailureMechanism mechanism = {};        // of a trial that failed: its motion since the last stable state
};

// The last failed trial of a search, followed beyond its failure.
struct FollowedTrial {
  bool rests = false;       // it has come to equilibrium again
  double displacement = 0;  // m, of the body that moved most since the search began
  long long steps = 0;
  std::string ended;  // why it was followed no further
};

// What block theory says of the blocks that a search found to move (core/key_blocks).
struct BlockTheory {
  std::string kind;                // "slides", "stable", …
  std::optional<double> critical;  // factor or friction angle, in the unit of the search's level
  // of a factor with cohesion, which `critical` counts as plastic: friction only; if slip takes it at once
  std::optional<double> friction_only{}, brittle{};
  std::vector<std::string> joints;           // that carry
  double required = 0;                       // factor of safety of the force below
  std::optional<double> force{};             // N: the least that gives it
  double force_plunge = 0, force_trend = 0;  // deg
  // of a search for a factor: the block that by itself has the lowest, if that is below the search's by more than its
  // bar
  int lower_block = -1;
  double lower = 0;
  bool differs = false;                // from the search's value by more than its error bar
  std::vector<std::string> reasons{};  // that it knows, as clauses
};

// The bonds and supports that held the blocks when a stage was last in equilibrium: at the end of a settle stage, or in
// a search's last stable trial. Each row is empty if the scene has nothing of the kind.
struct StableState {
  std::string stage, kind;
  std::optional<double> level;  // of a search, in its unit
  std::string unit;
  std::optional<WholeBonds> bonds{};
  // of a search that seeks equilibrium
  std::optional<TrialRow> trial{}, failed{};  // the last stable trial, the last that failed
  std::optional<double> taken_out{};          // by an extrapolation to no displacement, in the unit of the level
  std::string bracket_because{};  // of a result that is the middle of the bracket, though the scene asks for
                                  // the required strength: the reason, as a clause
  std::optional<FollowedTrial> followed{};
  std::optional<BlockTheory> block_theory{};  // found when the run is complete
};

// a body that a stage has moved by more than a tenth of its inscribed radius while settling (core/run/settled.hpp)
struct MovedBody {
  std::string stage;
  int body = 0;
  std::string name;             // of the body; may be empty
  double distance = 0;          // m
  double inscribed_radius = 0;  // m
  int against = -1;             // the nearest of the bodies that it was in contact with and that stayed; -1: none
  std::vector<double> place{};  // m, world coordinates: its centroid at the end
  bool left_all = false;        // it has lost contact with all that it touched, and no bolt holds it
};

// column names carry their unit: time_s, wedge_displacement_x_m, friction_rock_deg …
struct History {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};

// a spring of a bolt at the end of a stage, or the plate of a grouted one (core/output/bolt_output.hpp)
struct BoltRow {
  int stage = 1;
  std::string bolts;
  int bolt = 1, joint = 1;
  double x = 0, y = 0, z = 0;  // m, world coordinates
  int body_a = 0, body_b = 0;
  double force = 0, shear = 0;        // N, of one bolt
  double extension = 0, plastic = 0;  // m
  std::optional<double> use;          // of yield
  bool broken = false;
  std::optional<double> slip{};  // m, of a grouted bolt's bond
};

// a node of a lining at the end of a stage (core/output/lining_output.hpp)
struct LiningRow {
  int stage = 1;
  std::string lining;
  int node = 1;
  double x = 0, y = 0;                    // m, world coordinates, present position
  double ux = 0, uy = 0;                  // m, since it was installed
  SectionForces forces;                   // means of its beams'
  std::optional<double> smoothed_moment;  // N m
  double pressure = 0, shear = 0;         // Pa, of the rock on the outline that it represents
  int rock = -1;                          // the block opposite; -1: none
  std::optional<double> use;              // utilisation of its strength
};

struct Results {
  Outcome outcome = Outcome::done;
  std::string message;                                // one line: why it is incomplete or failed
  std::vector<std::pair<std::string, Value>> values;  // in the order found; names unique
  std::vector<StageResult> stages;
  std::vector<StableState> at_last_stable_state;  // by stage, those with something to report
  History history;
  std::vector<TrialRow> trials;    // of searches, in the order of their trials
  std::vector<BoltRow> bolts;      // by stage, then by bolt
  std::vector<LiningRow> linings;  // by stage, then by lining and node
  Counters counters;
  std::optional<BondCount> bonds;     // if some are to be made
  std::vector<std::string> cohesion;  // then, of each joint properties with cohesion, its law in words
  std::vector<MovedBody> moved;       // by stage, the farthest first
  double forces_remaining = 0;        // largest fraction of excavation forces that still acts at the end
  EnergyBalance energy;
  std::string state_hash;             // of the last state (core/model/state_hash.hpp)
  std::vector<std::string> warnings;  // one line each: doubtful results of the run
  double seconds = 0;                 // wall clock
  long long budget_evaluations = 0;   // contact evaluations of the budget's runs

  const Value* find(const std::string& name) const {
    for (const auto& [key, value] : values)
      if (key == name) return &value;
    return nullptr;
  }
};

}  // namespace voussoir
