// Every numerical choice, grouped by room: default, unit, range, what breaks when it is wrong; then the plain plans a
// scene may state. A row of scene/keys/ names the member that a scene's key sets, and takes its default from here.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace voussoir {

enum class LpSolver { own, glpk };

// where in the overlap a contact acts. chebyshev: at the point of the program min s (Eq. 3.27); central_path: at that
// of its logarithmic barrier (solvers/central_path.hpp), which does not jump
enum class ContactPoint { analytic_centre, centroid, chebyshev, central_path };
enum class OverlapSearch { closed_form, bracketing };

// Direction and depth of a contact. potential: from the rounded potentials at the point, measured along it, as
// published. multipliers: of the program min s, or of its barrier where the point is on the central path, the gradient
// g = Σ λ a over one part's planes, and -s/|g|, at 4|g|² of a constant stiffness k: where the contact acts at the
// program's or the barrier's own point, the force is that of the potential 2 k s²
enum class ContactNormal { potential, multipliers };

// What carries a joint of constant normal and shear stiffness per area: points, or the contact as a whole
// (contact/integrated_contact.hpp)
enum class ContactFace { point, integrated };

struct ContactSettings {
  LpSolver lp = LpSolver::own;
  ContactPoint point = ContactPoint::analytic_centre;
  ContactNormal normal = ContactNormal::potential;     // multipliers: with point = central_path
  OverlapSearch overlap = OverlapSearch::closed_form;  // of normal = potential
  ContactFace face = ContactFace::point;

  // two parts touch when they overlap by more than this times the smaller inscribed radius, and by more than rounding
  // hides (at most 64 ulp of the pair's size); far above that, contacts are found late
  double tolerance = 0;

  // radius r of the inner potential particle that rounds the normal at edges, times the smaller inscribed radius; must
  // exceed the largest overlap; large values tilt the normal of face contacts near an edge
  double potential_radius = 0.02;

  // weight µ of the central path's barrier, times the smaller inscribed radius: as a face rocks, its force walks over
  // it within an angle of some 2 µ over its width, and parts give way by some 10 to 30 µ before they resist. Smaller:
  // the force jumps from corner to corner within a step; larger: blocks lie deeper
  double smoothing = 3e-4;

  // Newton stops when its decrement before the step is below this; 1e-3 leaves 1e-6 of overlap and area, 1e-5 1e-9
  double newton_tolerance = 1e-5;
  int newton_limit = 200;

  // parts closer than this times the smallest inscribed radius are candidates; it changes the cost, never the result
  double skin = 0.1;
};

enum class Statics { adaptive, local, newton };

struct DampingSettings {
  // how a run that ends at rest gets there. adaptive: dynamic relaxation with scaled inertia, in which time, velocities
  // and dashpots mean nothing; local: the true motion under the damping below, the thesis' way, ten to a hundred times
  // slower for many blocks, and right where the way to rest is an event, like a fall. newton: Newton's method on the
  // joints' stiffness, which relaxation then confirms
  Statics statics = Statics::adaptive;

  // Cundall's non-viscous damping: each force component is lessened by this fraction when it drives the motion; 0..<1.
  // Reaches rest, but delays failure; 0 for dynamics, and in a scene's stages of kind run unless it is stated
  double local = 0.7;

  // newton: increments in which a ramp of gravity, or a fall of friction in a search, is put on; a joint that slips
  // within one slips along its chord. The cost goes with them
  int increments = 1;

  // ratio to critical of the dashpot in every contact's normal direction; 0..; lowers the stable time step
  double viscous_ratio = 0;
};

struct TimeSettings {
  // time step as a fraction of the limit 2/sqrt(lambda); one-sided contacts gain energy above 0.2 (0.1 without damping,
  // which is what a scene's stages of kind run take unless it is stated)
  static constexpr double most_damped = 0.2, most_undamped = 0.1;
  double fraction = most_damped;

  // s; replaces the estimate, for scenes whose step no contact determines
  std::optional<double> step;
};

struct EquilibriumSettings {
  // at rest when for every free body (|unbalanced force| + |momentum| ω) / mean force (integrate.hpp) stays below
  // during `window` steps, ω² being the body's largest stiffness over mass: at the end of a swing the force shows it,
  // in the middle the momentum does. Too loose and a slow slide passes as rest
  double unbalanced = 1e-6;
  int window = 10;
};

struct Settings {
  ContactSettings contact;
  DampingSettings damping;
  TimeSettings time;
  EquilibriumSettings equilibrium;
  int threads = 1;  // results do not depend on it
};

// ---- plans: what a scene asks for ---------------------------------------------------------------------------------

// The model's gravity times a factor: from one to the other within the time of the ramp; without ramp `to` at once, or
// no change where it is not given.
struct GravityPlan {
  double ramp = 0;                // s
  double from = 0;                // factor at which a ramp begins
  std::optional<double> to = {};  // where it ends; 1 if not given
};

// A water whose numbers change within a stage, linearly from what they are to what is stated (model.hpp, Water).
struct WaterPlan {
  int water = 0;
  std::vector<double> from, to;
  double ramp = 0;  // s
};

// run to equilibrium
struct SettlePlan {
  GravityPlan gravity{};
  double time_limit = 1e9;  // s
  long long step_limit = 1'000'000;
};

// run for a given time
struct RunPlan {
  double duration = 0;  // s
  GravityPlan gravity{};
};

enum class ReductionMethod { bisection, steps, rate, two_rates };

// what a reduction searches: a friction angle, or the factor by which tan φ and cohesion are divided
enum class Searched { friction, factor };

// from where to where the factor is raised, by bisection or in steps
struct FactorPlan {
  double from = 0, to = 0;  // start (stable) and end of the search
  double tolerance = 0;     // bisection: largest bracket at the end
  double step = 0;          // steps: increment
};

// lower the strength of joints until the model fails
struct ReducePlan {
  ReductionMethod method = ReductionMethod::bisection;
  Searched searched = Searched::friction;
  FactorPlan factor;                    // where that is searched
  std::vector<std::string> properties;  // joint properties to reduce; empty: all
  double from = 0, to = 0;              // rad: start (stable) and end of the search
  double tolerance = 0;                 // rad, bisection: largest bracket at the end
  double step = 0;                      // rad, steps: decrement
  double rate = 0;                      // rad/s, rate: speed of reduction; two_rates: the faster
  double slower_rate = 0;               // rad/s, two_rates: the slower
  double failure_displacement = 0;      // m: a body that has moved this far since the search began (rates:
                                        // since the fall began) has failed; 0: a tenth of the smallest inscribed radius
  double failure_fraction = 0;          // of the free mass that must have moved so far; 0: any body
  long long ramp_steps = 500;           // steps over which a trial lowers the friction; few: inertia breaks the path
  long long step_limit = 1'000'000;     // for one trial
};

// a choice of bodies: all that satisfy every condition given; sides refer to a joint's upward normal
struct Selector {
  bool all = false;
  std::vector<std::string> names;             // bodies or joints' sides by name
  std::vector<std::string> above, below;      // joints
  std::optional<std::vector<double>> inside;  // m: a point in the body
  std::vector<std::string> sides{};           // left, right, …: an outer face of the body lies in one of these sides
  std::vector<double> low{}, high{};          // m: corners of a box that holds its centroid; empty: anywhere
};

// a factor that varies with time: linear between the points of a table and constant beyond them, times a sine
struct TimeFactor {
  std::vector<double> times, factors;  // s, ascending, and as many factors; empty: 1
  double frequency = 0;                // Hz; 0: no sine
  double phase = 0;                    // rad: sin(2π frequency time + phase)
};

// A velocity forced upon bodies while the stage lasts, times a factor of the time since it began. Their other freedoms
// stay what they are: those of a fixed body are held.
struct MovePlan {
  Selector bodies;
  std::vector<double> velocity;                       // m/s, as many entries as dimensions
  std::array<bool, 3> translation{true, true, true};  // the axes along which it is forced
  std::vector<double> angular_velocity;               // rad/s, world axes, 2-D one entry; empty: rotation is not forced
  TimeFactor factor;
};

// stress of the rock's own weight, which begins at a surface
struct InSituPlan {
  double surface = 0;                 // m, its elevation
  double k0 = 1;                      // horizontal over vertical stress
  std::optional<double> k0_y;         // along y, in space; empty: k0
  std::optional<double> unit_weight;  // N/m³; once a scene is read it is stated
};

// A stress on the faces of bodies that no joint made, from the stage on; it replaces what the bodies bore before.
struct BoundaryPlan {
  Selector bodies;
  std::vector<double> stress;           // Pa, compression positive: 2-D xx, yy, xy; 3-D xx, yy, zz, yz, zx, xy
  std::optional<InSituPlan> in_situ{};  // and this
};

// A force on bodies, from the stage on, until a later stage states one of the same name. Its factor runs while the
// stage that states it lasts; afterwards the force stays as it ended.
struct ForcePlan {
  std::string name;
  Selector bodies;
  std::vector<double> force;     // N (2-D: N/m), on each body, as many entries as dimensions
  std::vector<double> point;     // m: where it acts, world coordinates at the start; empty: at each body's centroid
  bool turns_with_body = false;  // else it keeps its direction in space; its point always moves with the body
  TimeFactor factor;             // of the time since the stage began
  double last_factor = 1;        // when it ends
};

// a friction angle of joint properties by name
struct FrictionPlan {
  std::string properties;
  double friction = 0;  // rad
};

// How the forces by which excavated rock held the rest are let off: linearly from the share that still acts to this
// one, or not at all where no more acts.
struct LetOffPlan {
  double share = 0;     // of what acted before the excavation
  double duration = 0;  // s, from the begin of the stage on
};

// what changes in the model between two stages
struct Change {
  std::vector<Selector> fix, release, remove;
  std::vector<std::string> excavate{};  // Model::excavations that are taken out
  std::vector<MovePlan> move;           // within the stage only
  std::vector<BoundaryPlan> boundary;
  std::vector<ForcePlan> force{};
  std::optional<double> friction;           // rad: new friction angle of every joint
  std::vector<FrictionPlan> friction_of{};  // then that of some
  std::vector<std::string> install{};       // Model::bolt_properties and Model::linings that are put in
  bool bond = false;                        // closed joints with tensile strength or cohesion are bonded
  bool zero_slip = false;                   // every joint's plastic slip begins again at 0
};

struct StagePlan {
  std::string name;
  std::variant<SettlePlan, RunPlan, ReducePlan> plan;
  Change change;                           // applied before the stage begins
  std::vector<WaterPlan> water{};          // of kind settle or run
  std::optional<LetOffPlan> let_off{};     // likewise; without it what is excavated is gone at once
  std::optional<DampingSettings> damping;  // replaces the scene's within this stage
  std::optional<double> time_fraction;     // the same of TimeSettings::fraction
};

// what is in force within a stage
inline Settings settings_of(const StagePlan& stage, Settings scene) {
  scene.damping = stage.damping.value_or(scene.damping);
  scene.time.fraction = stage.time_fraction.value_or(scene.time.fraction);
  return scene;
}

struct OutputPlan {
  double history_interval = 0;  // s between rows of history.csv; 0: about 200 rows a stage
  double frame_interval = 0;    // s between ParaView frames; 0: at the end of each stage only
  bool frames = true;
  bool view = false;  // keep what the viewer shows (output/view.hpp)

  // whether somebody asks for frames
  bool any_frames() const { return frames || view; }
};

}  // namespace voussoir
