// Every numerical choice, grouped by room: default, unit, range, the effect of a wrong value; then the plans that a
// scene may state. A row of scene/keys/ names the member that a scene's key sets, and takes its default from here.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/ground_motion.hpp"

namespace voussoir {

// the point of the overlap at which a contact acts. chebyshev: at the point of the program min s (Eq. 3.27);
// central_path: at that of its logarithmic barrier (solvers/central_path.hpp), which does not jump
enum class ContactPoint { analytic_centre, centroid, chebyshev, central_path };
enum class OverlapSearch { closed_form, bracketing };

// Direction and depth of a contact. potential: from the rounded potentials at the point, measured along it, as
// published. multipliers: of the program min s, or of its barrier if the point is on the central path, the gradient
// g = Σ λ a over one part's planes, and -s/|g|, at 4|g|² of a constant stiffness k: if the contact acts at the
// program's or the barrier's own point, the force is that of the potential 2 k s²
enum class ContactNormal { potential, multipliers };

// How a joint of constant normal and shear stiffness per area transfers force: at points, or integrated over its face
// (contact/integrated_contact.hpp)
enum class ContactFace { point, integrated };

struct ContactSettings {
  ContactPoint point = ContactPoint::analytic_centre;
  ContactNormal normal = ContactNormal::potential;     // multipliers: with point = central_path
  OverlapSearch overlap = OverlapSearch::closed_form;  // of normal = potential
  ContactFace face = ContactFace::point;

  // two parts touch when they overlap by more than this times the smaller inscribed radius, and by more than the error
  // of rounding (at most 64 ulp of the pair's size); far above that, contacts are found late
  double tolerance = 0;

  // radius r of the inner potential particle that rounds the normal at edges, times the smaller inscribed radius; must
  // exceed the largest overlap; large values tilt the normal of face contacts near an edge
  double potential_radius = 0.02;

  // weight µ of the central path's barrier, times the smaller inscribed radius: as a face rocks, its force crosses it
  // within an angle of some 2 µ over its width, and parts approach by some 10 to 30 µ before they resist. Smaller: the
  // force jumps from corner to corner within a step; larger: blocks overlap more
  double smoothing = 3e-4;

  // Newton stops when its decrement before the step is below this; 1e-3 leaves 1e-6 of overlap and area, 1e-5 1e-9
  double newton_tolerance = 1e-5;
  int newton_limit = 200;

  // parts closer than this times the smallest inscribed radius are candidates; it changes the cost, never the result
  double skin = 0.1;
};

enum class Statics { adaptive, local, newton };

struct StaticsSettings {
  // method by which a run reaches equilibrium. adaptive: dynamic relaxation with scaled inertia, in which time,
  // velocities and dashpots have no meaning; local: the true motion under its damping, the thesis' method, ten
  // to a hundred times slower for many blocks, and right when the path to equilibrium is an event, like a fall. newton:
  // Newton-Raphson iteration on the joints' stiffness, whose result relaxation confirms
  Statics method = Statics::adaptive;

  // newton: increments in which a ramp of gravity, or a reduction of friction in a search, is applied; slip within one
  // is integrated in a single step. The cost grows with their number
  int increments = 1;

  // newton, in trials that the required strength judges: the reference state is updated when a body has slipped by this
  // many elastic displacements. Half of one errs by 0.002° in a wedge, one by 0.004°, two by 0.008°; a quarter costs 8
  // to 30 % more for 0.0013°
  double slip = 0.5;

  // newton: a step after which the residual has grown is refused, not shortened by its work. More steps, but slip keeps
  // to its path, and blocks that hold are not carried along with those that slide: for searches
  bool refuses_growth = false;
};

struct DampingSettings {
  // Cundall's non-viscous damping: each force component is lessened by this fraction when it drives the motion; 0..<1.
  // Reaches rest, but delays failure; 0 for dynamics, and in a scene's stages of kind run unless it is stated
  double local = 0.7;

  // ratio to critical of the dashpot in every contact's normal direction; 0..; lowers the stable time step
  double viscous_ratio = 0;

  // dashpots of implicit steps in proportion to the joints' stiffness, normal and shear: this ratio to critical of a
  // swing of that frequency, Hz, and in proportion to the frequency of others; 0..
  double joint_ratio = 0, joint_frequency = 1;
};

// of true motion: leapfrog, whose step follows the stiffest joint; or the implicit midpoint rule, whose step follows
// the motion
enum class Integration { explicit_steps, implicit_steps };

struct TimeSettings {
  // time step as a fraction of the limit 2/sqrt(lambda); one-sided contacts gain energy above 0.2 (0.1 without damping,
  // which a scene's stages of kind run take unless it is stated)
  static constexpr double most_damped = 0.2, most_undamped = 0.1;
  double fraction = most_damped;

  // s; replaces the estimate, for scenes whose step no contact determines
  std::optional<double> step;

  Integration integration = Integration::explicit_steps;
  double error = 0;  // m: of an implicit step; 0: 1e-5 of the median free block
  // s: at multiples of these of the run's time rows of the history and frames are due, and implicit steps of their own
  // length end; 0: none
  double row_interval = 0, frame_interval = 0;

  // each stage of implicit steps by their own error is run once more with half of it, to see what its displacements owe
  // to it
  bool half_error = false;
};

struct EquilibriumSettings {
  // in equilibrium when for every free body (|unbalanced force| + |momentum| ω) / mean force (integrate.hpp) stays
  // below during `window` steps, ω² being the body's largest stiffness over mass: at the end of a swing the force shows
  // it, in the middle the momentum does. Too loose and a slow slide passes as equilibrium
  double unbalanced = 1e-6;
  int window = 10;
};

struct Settings {
  ContactSettings contact;
  StaticsSettings statics;
  DampingSettings damping;
  TimeSettings time;
  EquilibriumSettings equilibrium;
  int threads = 1;  // results do not depend on it
};

// ---- plans stated in a scene ------------------------------------------------------------------------------------

// The model's gravity times a factor: from one to the other within the time of the ramp; without a ramp `to` applies
// immediately; no change if it is not given.
struct GravityPlan {
  double ramp = 0;                // s
  double from = 0;                // factor at which a ramp begins
  std::optional<double> to = {};  // final factor; 1 if not given
};

// A water whose parameters change within a stage, linearly from their present values to the stated ones (model.hpp,
// Water).
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

// the quantity that a reduction searches: a friction angle, or the factor by which tan φ and cohesion are divided
enum class Searched { friction, factor };

// when a trial has failed: by the strength that its own motion requires, or by displacement alone
enum class FailureCriterion { required_strength, displacement };

// the range in which the factor is raised, by bisection or in steps
struct FactorPlan {
  double from = 0, to = 0;  // start (stable) and end of the search
  double tolerance = 0;     // bisection: largest bracket at the end
  double step = 0;          // steps: increment
};

// lower the strength of joints until the model fails
struct ReducePlan {
  ReductionMethod method = ReductionMethod::bisection;
  Searched searched = Searched::friction;
  FactorPlan factor;                    // if that is searched
  std::vector<std::string> properties;  // joint properties to reduce; empty: all
  double from = 0, to = 0;              // rad: start (stable) and end of the search
  double tolerance = 0;                 // rad, bisection: largest bracket at the end
  double step = 0;                      // rad, steps: decrement
  double rate = 0;                      // rad/s, rate: speed of reduction; two_rates: the faster
  double slower_rate = 0;               // rad/s, two_rates: the slower
  double failure_displacement = 0;      // m: a body that has moved this far since the search began (rates:
                                        // since the fall began) has failed; 0: a tenth of the smallest inscribed radius
  FailureCriterion criterion = FailureCriterion::displacement;
  double failure_fraction = 0;       // of the free mass that must have moved so far; 0: any body
  long long ramp_steps = 500;        // steps over which a trial lowers the friction; too few: inertia disturbs the path
  long long step_limit = 1'000'000;  // for one trial
  long long follow_steps = 0;        // of the last failed trial, beyond its failure; 0: it is not followed
};

// a choice of bodies: all that satisfy every condition given; sides refer to a joint's upward normal
struct Selector {
  bool all = false;
  std::vector<std::string> names;             // bodies or joints' sides by name
  std::vector<std::string> above, below;      // joints
  std::optional<std::vector<double>> inside;  // m: a point in the body
  std::vector<std::string> sides{};           // left, right, …: an outer face of the body is in one of these sides
  std::vector<double> low{}, high{};          // m: corners of a box around its centroid; empty: anywhere
};

// a factor that varies with time: linear between the points of a table and constant beyond them, times a sine
struct TimeFactor {
  std::vector<double> times, factors;  // s, ascending, and as many factors; empty: 1
  double frequency = 0;                // Hz; 0: no sine
  double phase = 0;                    // rad: sin(2π frequency time + phase)
};

// A velocity forced upon bodies while the stage lasts, times a factor of the time since it began. Their other degrees
// of freedom do not change: those of a fixed body are held.
struct MovePlan {
  Selector bodies;
  std::vector<double> velocity;                       // m/s, as many entries as dimensions
  std::array<bool, 3> translation{true, true, true};  // the axes along which it is forced
  std::vector<double> angular_velocity;               // rad/s, world axes, 2-D one entry; empty: rotation is not forced
  TimeFactor factor;
  std::vector<RecordedMotion> records{};  // the sum of these motions instead; then the velocity is zero
};

// stress of the rock's own weight, which begins at a surface
struct InSituPlan {
  double surface = 0;                 // m, its elevation
  double k0 = 1;                      // horizontal over vertical stress
  std::optional<double> k0_y;         // along y, in space; empty: k0
  std::optional<double> unit_weight;  // N/m³; once a scene is read it is stated
};

// The rock beyond a side that waves leave; empty: as the blocks of that side make it.
struct MediumPlan {
  std::optional<double> normal_impedance, shear_impedance;  // Pa s/m: density times the speed of waves
  std::optional<double> normal_stiffness, shear_stiffness;  // Pa/m: of the joints along the side
};

// A side that waves leave, and one that may enter.
struct QuietPlan {
  MediumPlan medium{};
  std::vector<double> velocity{};         // m/s, of the entering motion; empty: none enters, but records
  double upgoing = 1;                     // the upgoing wave's share of it: half of the motion of an outcrop
  TimeFactor factor{};                    // of the time since the stage began
  std::vector<RecordedMotion> records{};  // the sum of these motions instead; then the velocity is zero
};

// On the faces of bodies that no joint made, from the stage on: a stress, which replaces the stress on these bodies
// before; or one of the two kinds of sides that waves leave.
struct BoundaryPlan {
  Selector bodies;
  std::vector<double> stress;           // Pa, compression positive: 2-D xx, yy, xy; 3-D xx, yy, zz, yz, zx, xy
  std::optional<InSituPlan> in_situ{};  // and this
  std::optional<QuietPlan> quiet{};
  std::optional<MediumPlan> free_field{};  // beyond it a column of rock moves as if the model were not there

  bool lets_waves_leave() const { return quiet || free_field; }
};

// A force on bodies, from the stage on, until a later stage states one of the same name. Its factor runs while the
// stage that states it lasts; afterwards the force stays as it ended.
struct ForcePlan {
  std::string name;
  Selector bodies;
  std::vector<double> force;     // N (2-D: N/m), on each body, as many entries as dimensions
  std::vector<double> point;     // m: point of action, world coordinates at the start; empty: at each body's centroid
  bool turns_with_body = false;  // else it keeps its direction in space; its point always moves with the body
  TimeFactor factor;             // of the time since the stage began
  double last_factor = 1;        // when it ends
};

// The friction of joint properties by name: an angle, which is Coulomb's also for joints of Barton and Bandis' law, or
// that of the scene, with its law.
struct FrictionPlan {
  std::string properties;
  double friction = 0;     // rad
  bool as_stated = false;  // instead
};

// The relief loads, by which excavated rock supported the remaining rock: they fall linearly from the share that still
// acts to this one, or stay constant if no more than this share acts.
struct ExcavationForcesPlan {
  double remaining = 0;  // as a fraction of the forces before the excavation
  double duration = 0;   // s, from the begin of the stage on
};

// changes of the model between two stages
struct Change {
  std::vector<Selector> fix, release, remove;
  std::vector<std::string> excavate{};  // Model::excavations that are removed
  std::vector<MovePlan> move;           // within the stage only
  std::vector<BoundaryPlan> boundary;
  std::vector<ForcePlan> force{};
  std::optional<double> friction;           // rad: new friction angle of every joint
  bool friction_as_stated = false;          // instead: every joint has the friction of the scene, and its law
  std::vector<FrictionPlan> friction_of{};  // then that of some
  std::vector<std::string> install{};       // Model::bolt_properties and Model::linings that are installed
  bool bond = false;                        // closed joints with tensile strength or cohesion are bonded
  bool zero_slip = false;                   // every joint's plastic slip is reset to 0
};

struct StagePlan {
  std::string name;
  std::variant<SettlePlan, RunPlan, ReducePlan> plan;
  Change change;                                            // applied before the stage begins
  std::vector<WaterPlan> water{};                           // of kind settle or run
  std::optional<ExcavationForcesPlan> excavation_forces{};  // likewise; without it they are removed at once
  std::optional<StaticsSettings> statics;                   // replaces the scene's within this stage
  std::optional<DampingSettings> damping;                   // likewise
  std::optional<TimeSettings> time;                         // likewise; of kind run
};

// the settings within a stage
inline Settings settings_of(const StagePlan& stage, Settings scene) {
  scene.statics = stage.statics.value_or(scene.statics);
  scene.damping = stage.damping.value_or(scene.damping);
  scene.time = stage.time.value_or(scene.time);
  // rest is sought by relaxation or Newton's method
  if (!std::holds_alternative<RunPlan>(stage.plan)) scene.time.integration = Integration::explicit_steps;
  return scene;
}

struct OutputPlan {
  double history_interval = 0;  // s between rows of history.csv; 0: about 200 rows a stage
  double frame_interval = 0;    // s between ParaView frames; 0: at the end of each stage only
  bool frames = true;
  bool view = false;  // keep the viewer's data (output/view.hpp)

  // whether frames are requested
  bool any_frames() const { return frames || view; }
};

}  // namespace voussoir
