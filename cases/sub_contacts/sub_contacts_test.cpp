// Accuracy and cost of the number of points on a joint face: stiffness and strength of a square face against the
// distributed joint, and the time of a step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <limits>

#include "cases/case_tools.hpp"
#include "core/step.hpp"
#include "core/step/contacts.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/loads.hpp"
#include "core/step/neighbours.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {
namespace {

using verification::CaseReport;
using verification::Kind;

constexpr std::array numbers{1, 2, 4, 8, 16};  // of points along a face
constexpr double width = 1, arm = 0.25;        // m: of the face; of the centroid above it
constexpr double depth = 3e-6;                 // m: of the face in the plate
constexpr double small = 1e-7;  // rad, m: keeps the whole face closed, and every point below its strength
constexpr double small_of_whole =
    4e-6;                       // the same for an integrated face contact, whose response is linear over a larger range
constexpr double slide = 1e-2;  // rad: far beyond the strength of every point
constexpr double kn = 1e9, ks = 5e8, friction_deg = 40;  // as the scenes state them

// about the middle of the face
template <int Dim>
struct Answer {
  Vector<Dim> force;
  Spin<Dim> moment;
};

// A block of the scene, pressed into the plate; the response of its joint to small motions, one after the other.
template <int Dim>
struct Pressed {
  LoadedScene scene;
  Model<Dim> model;
  Settings settings;
  State<Dim> state;
  int block;

  explicit Pressed(const std::string& carried)
      : scene(load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / (Dim == 2 ? "strip.toml" : "square.toml"),
                         {carried})) {
    const auto& prepared = std::get<Prepared<Dim>>(scene.prepared);
    model = prepared.model;
    settings = prepared.settings;
    state = prepared.state;
    block = select(model, {.names = {"block"}, .above = {}, .below = {}, .inside = {}}).front();
    state.bodies.motions[block].displacement[Dim - 1] = -depth;
    answer();
  }

  Answer<Dim> answer() {
    find_neighbours(model, settings, state.bodies, state.contacts, state.counters);
    find_contacts(model, settings, 0, state.bodies, state.contacts, state.counters);
    apply_joint_laws(model, settings, state.schedule, joint_step(settings, state.time_step, state.relaxation),
                     state.bodies, state.contacts, state.ledger, state.counters);
    sum_loads(model, settings, state.schedule, state.bodies, state.contacts, state.supports, state.loads);
    const Load<Dim>& load = state.loads.total[block];
    const Vector<Dim> from_face = matrix(state.bodies.motions[block].rotation) * (arm * Vector<Dim>::Unit(Dim - 1));
    return {load.force, load.moment + moment(from_face, load.force)};
  }

  // the face's middle moves by `way` while the block rotates by `turn` about it, within a second
  Answer<Dim> go(const Vector<Dim>& way, const Spin<Dim>& turn) {
    Motion<Dim>& motion = state.bodies.motions[block];
    const Rotation<Dim> turned_to = turned(motion.rotation, turn);
    const Vector<Dim> lift = arm * Vector<Dim>::Unit(Dim - 1);
    const Vector<Dim> path = way + matrix(turned_to) * lift - matrix(motion.rotation) * lift;
    motion.rotation = turned_to;
    motion.displacement += path;
    motion.velocity = path;
    motion.angular_momentum = angular_momentum(model.bodies[block], motion.rotation, turn);
    state.time_step.length = 1;
    return answer();
  }
};

template <int Dim>
constexpr double face = Dim == 2 ? width : width* width;

// as a fraction of the distributed joint
struct Stiffness {
  double normal = 0, shear = 0, rocking = 0, spin = 1, spin_strength = 1;
};

template <int Dim>
Stiffness stiffness_of(const std::string& carried, double by) {
  Stiffness s;
  const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1), right = Vector<Dim>::Unit(0);
  const Vector<Dim> still = Vector<Dim>::Zero();
  const Spin<Dim> no_turn = Spin<Dim>::Zero();
  {
    Pressed<Dim> pressed(carried);
    const double before = pressed.answer().force.dot(up);
    s.normal = (pressed.go(-by * up, no_turn).force.dot(up) - before) / (kn * face<Dim> * by);
  }
  s.shear = -Pressed<Dim>(carried).go(by * right, no_turn).force.dot(right) / (ks * face<Dim> * by);
  {
    Spin<Dim> rock = no_turn;
    rock[Dim == 2 ? 0 : 1] = by;
    const double inertia = face<Dim> * width * width / 12;
    s.rocking = -Pressed<Dim>(carried).go(still, rock).moment[Dim == 2 ? 0 : 1] / (kn * inertia * by);
  }
  if constexpr (Dim == 3) {
    const double polar = std::pow(width, 4) / 6;
    s.spin = -Pressed<3>(carried).go(still, {0, 0, by}).moment[2] / (ks * polar * by);
    // the mean distance of a square's points from its middle
    const double mean = width * (std::sqrt(2) + std::asinh(1)) / 6;
    const double strength = std::tan(friction_deg * degree) * kn * depth * face<3> * mean;
    s.spin_strength = -Pressed<3>(carried).go(still, {0, 0, slide}).moment[2] / strength;
  }
  return s;
}

// of a contact in a step, ns of the processor: the fastest of some rounds, since anything else only adds to it
template <int Dim>
double step_nanoseconds(const std::string& carried) {
  constexpr int rounds = 20, steps = 100;
  Pressed<Dim> pressed(carried);
  Body<Dim>& body = pressed.model.bodies[pressed.block];
  body.free_translation.fill(false);  // it does not move
  body.free_rotation.fill(false);
  double least = std::numeric_limits<double>::infinity();
  for (int r = 0; r < rounds; ++r) {
    const std::clock_t began = std::clock();
    const long long evaluations = pressed.state.counters.contact_evaluations;
    for (int i = 0; i < steps; ++i)
      step(pressed.model, pressed.settings, pressed.state);
    const double seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
    least =
        std::min(least, 1e9 * seconds / static_cast<double>(pressed.state.counters.contact_evaluations - evaluations));
  }
  return least;
}

void judge(CaseReport& report, const std::string& what, double expected, double tolerance, const std::string& because,
           double found) {
  report.record({what, "1", Kind::exact, "closed form: distributed joint", expected, {tolerance, 0}, because}, found);
}

// the normal of a tilted contact is between the two faces', and its point is accurate to rounding over the tilt
constexpr double measured_to = 1e-5;

template <int Dim>
void measure(CaseReport& report, const std::string& file) {
  std::vector<std::vector<double>> columns(8);
  for (const int along : numbers) {
    const std::string carried = fmt::format("joint_properties.rock.sub_contacts={}", along);
    const Stiffness s = stiffness_of<Dim>(carried, small);
    const double time = step_nanoseconds<Dim>(carried);
    const std::string name = fmt::format(", {} points in {}-D", Dim == 2 ? along : along * along, Dim);
    judge(report, "normal stiffness" + name, 1, measured_to, "exact with one point", s.normal);
    judge(report, "shear stiffness" + name, 1, measured_to, "exact with one point", s.shear);
    if (along > 1)
      judge(report, "rocking stiffness" + name, 1, measured_to, "a point is its cell's centre of pressure", s.rocking);
    else
      report.report("rocking stiffness" + name, "1", s.rocking,
                    "of the distributed joint; the point is the centre of "
                    "the overlap, which moves more than the pressure");
    if (Dim == 3)
      judge(report, "spin stiffness" + name, 1 - 1.0 / (along * along), measured_to,
            "each cell lacks its own spin, which together is 1/n² of the face's", s.spin);
    if (Dim == 3) report.report("spin strength" + name, "1", s.spin_strength, "of the distributed joint");
    report.report_time("contact in a step" + name, "ns", time, "processor time, fastest of twenty rounds of this run");
    // for a logarithmic axis: rounding is drawn at 1e-8
    const auto error = [](double fraction) { return std::max(1e-8, std::abs(fraction - 1)); };
    const std::array row{static_cast<double>(along),
                         std::pow(along, Dim - 1),
                         error(s.normal),
                         error(s.shear),
                         error(s.rocking),
                         error(s.spin),
                         error(s.spin_strength),
                         time};
    for (std::size_t k = 0; k < row.size(); ++k)
      columns[k].push_back(row[k]);
  }
  write_csv("sub_contacts", file,
            {"along", "points", "normal", "shear", "rocking", "spin", "spin_strength", "nanoseconds"}, columns);
}

// the integrated face contact
template <int Dim>
double measure_whole(CaseReport& report) {
  const Stiffness s = stiffness_of<Dim>(whole_faces, small_of_whole);
  const std::string name = fmt::format(", whole face in {}-D", Dim);
  constexpr double tolerance = 1e-9;
  const std::string because =
      "the integrals are exact; their polygon is half the overlap within the block and rotates with it, and its edges "
      "pull, which changes rocking by some 13 times the square of the overlap over the width, 1e-10; positions are "
      "accurate to 1e-16 m of two micrometres";
  judge(report, "normal stiffness" + name, 1, tolerance, because, s.normal);
  judge(report, "shear stiffness" + name, 1, tolerance, because, s.shear);
  judge(report, "rocking stiffness" + name, 1, tolerance, because, s.rocking);
  if (Dim == 3) {
    judge(report, "spin stiffness" + name, 1, tolerance, because, s.spin);
    judge(report, "spin strength" + name, 1, tolerance, because, s.spin_strength);
  }
  const double time = step_nanoseconds<Dim>(whole_faces);
  report.report_time("contact in a step" + name, "ns", time, "processor time, fastest of twenty rounds of this run");
  return time;
}

TEST(SubContacts, AnIntegratedFaceIsTheDistributedJoint) {
  CaseReport report("sub_contacts", {"rocking stiffness, whole face in 2-D", "spin stiffness, whole face in 3-D"});
  const double strip = measure_whole<2>(report), square = measure_whole<3>(report);
  write_csv("sub_contacts", "whole.csv", {"along", "square", "strip"}, {{0.85, 19}, {square, square}, {strip, strip}});
}

TEST(SubContacts, AccuracyAgainstCost) {
  CaseReport report("sub_contacts", {"rocking stiffness, 2 points in 2-D", "spin stiffness, 16 points in 3-D"});
  measure<2>(report, "strip.csv");
  measure<3>(report, "square.csv");
}

}  // namespace
}  // namespace voussoir::cases
