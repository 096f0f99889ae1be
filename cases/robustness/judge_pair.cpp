#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "cases/robustness/judges.hpp"
#include "core/contact/pair_geometry.hpp"
#include "core/model/state.hpp"
#include "core/step/contacts.hpp"
#include "core/testing/exact_referee.hpp"

namespace voussoir::atlas {
namespace {

using exact::Quad;
using exact::to_double;

// Newton's last decrement is below newton_tolerance = 1e-5 before the step, which squares it; a factor 10 for the
// constant
constexpr double newton_remainder = 1e-9;

// up to this many planes cddlib solves the program from scratch; beyond, the kernel's own basis is proven exactly
constexpr int most_planes_for_cddlib = 120;

// two gradients of a potential nearer to zero or to each other than this give no direction (core/contact/rounding.hpp)
constexpr double no_direction = 1e-6;

// input of the stages of one contact
struct Scene {
  Pair<3> pair;
  HalfSpaces<3> planes;
  int faces_a;
  double size, reach;
  ContactSettings settings;

  double rounding(std::size_t i, const Vector<3>& x) const {
    return std::abs(planes[i].offset) + x.cwiseAbs().maxCoeff();
  }
};

// correct or wrong by the error as a fraction of the promise
Judgement by_fraction(double fraction, const std::string& what) {
  if (fraction <= 1) return {Verdict::correct, "", fraction};
  return {Verdict::wrong, fmt::format("{}: {:.3g} of the promise", what, fraction), fraction};
}

exact::ProgramBounds exact_value(const exact::Planes& planes, const std::array<int, 4>& basis) {
  if (planes.size() > most_planes_for_cddlib) return exact::feasibility_bounds(planes, basis);
  const exact::Program program = exact::feasibility(planes);
  return {program.bounded, program.value, program.value};
}

// ---- decision -------------------------------------------------------------------------------------------------------

struct Decision {
  Judgement judgement;
  Contact<3> contact;
  Counters counters;
};

// through Model and State, as a step does it
Decision decide(const Meeting& meeting, const FeasibilityResult<3>& lp, const Scene& scene) {
  Model<3> model;
  model.bodies = {meeting.a, meeting.b};
  list_parts(model);
  model.properties = {{"joint", 1e9, 5e8, 0.5, false}};
  State<3> state = initial_state(model);
  state.bodies.motions[1].displacement = meeting.displacement_b;
  state.bodies.motions[1].rotation = meeting.turn;
  Contact<3> candidate;
  candidate.part_a = 0;
  candidate.part_b = 1;
  state.contacts.list = {candidate};
  find_contacts(model, Settings{}, 0, state.bodies, state.contacts, state.counters);
  Decision decision{{}, state.contacts.list[0], state.counters};

  // the same bodies exactly
  exact::Point offset;
  for (int k = 0; k < 3; ++k)
    offset[k] = exact::Rational(meeting.b.reference[k]) - exact::Rational(meeting.a.reference[k]) +
                exact::Rational(meeting.displacement_b[k]);
  const exact::ProgramBounds value = exact_value(exact::planes_of(scene.pair, offset), lp.basis);
  const double band = whole_chain * (scene.pair.a->radius + scene.pair.b->radius + scene.pair.offset.norm());
  const double low = value.low.get_d(), high = value.high.get_d();

  Judgement& j = decision.judgement;
  const ContactStatus status = decision.contact.status;
  if (status == ContactStatus::lp_not_converged) {
    j.verdict = Verdict::refused;
    return decision;
  }
  if (!value.proven) {
    j = wrong("the LP's basis proves no bound");
    return decision;
  }
  const double error = std::max(low - lp.value, lp.value - high);
  j = by_fraction(std::max(error, 0.0) / band, "the LP's value is off");
  if (j.verdict == Verdict::wrong) return decision;
  const bool touching = status > ContactStatus::undecided;  // or its stages failed
  if (high >= -band && low <= band)
    j.verdict = Verdict::warned;
  else if (touching != (high < 0))
    j = wrong(fmt::format("{} though s* = {:.3g}, band {:.3g}", touching ? "touching" : "separate", low, band));
  return decision;
}

// ---- the stages -----------------------------------------------------------------------------------------------------

Judgement judge_centre(const Scene& scene, const CentreResult<3>& found) {
  if (found.status != CentreStatus::converged) return {Verdict::refused, "", 0};
  const exact::Centre centre = exact::centre(scene.planes, found.point);
  if (!centre.interior) return wrong("the contact point is outside");
  // each slack carries the rounding of its plane: in the region's metric their squares add up
  double squares = 0;
  for (std::size_t i = 0; i < scene.planes.size(); ++i) {
    const double slack = -signed_distance<3>(scene.planes[i], found.point);
    squares += std::pow(scene.rounding(i, found.point) / slack, 2);
  }
  return by_fraction(to_double(centre.decrement) / (newton_remainder + one_stage * std::sqrt(squares)),
                     "the centre is off");
}

Judgement judge_normal(const Scene& scene, const Vector<3>& point, bool found, bool fallback, const Vector<3>& normal) {
  if (!found || fallback) return {Verdict::warned, "", 0};
  const double radius = scene.settings.potential_radius * scene.size;
  const exact::Normal expected = exact::contact_normal(scene.planes, scene.faces_a, point, radius);
  double loss_a = 0, loss_b = 0;  // what rounding adds to the gradients
  for (std::size_t i = 0; i < scene.planes.size(); ++i) {
    const double rounding = one_stage * (scene.rounding(i, point) + radius);
    if (-signed_distance<3>(scene.planes[i], point) < radius + rounding)
      (static_cast<int>(i) < scene.faces_a ? loss_a : loss_b) += rounding;
  }
  const double gradient_a = to_double(expected.gradient_a), gradient_b = to_double(expected.gradient_b);
  if (std::min(gradient_a, gradient_b) < 0.5 * no_direction * radius) return wrong("a normal without a gradient");
  const double allowed =
      (loss_a / gradient_a + loss_b / gradient_b + one_stage) / to_double(expected.difference) + one_stage;
  double error = 0;
  for (int k = 0; k < 3; ++k)
    error = std::max(error, std::abs(to_double(expected.normal[k] - Quad(normal[k]))));
  return by_fraction(error / allowed, fmt::format("the normal is off by {:.3g}", error));
}

// interval of the end of the search along the normal, given the rounding of slacks and slopes
struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = low;
};

Judgement judge_overlap(const Scene& scene, const Vector<3>& point, const Vector<3>& normal, bool found, double overlap,
                        int face_a, int face_b) {
  if (!found) return {Verdict::refused, "", 0};
  Interval ends[2];
  std::vector<Interval> each(scene.planes.size());
  for (std::size_t i = 0; i < scene.planes.size(); ++i) {
    const bool of_a = static_cast<int>(i) < scene.faces_a;
    Quad slope = 0, slack = scene.planes[i].offset;
    for (int k = 0; k < 3; ++k) {
      slope += Quad(scene.planes[i].normal[k]) * Quad(normal[k]);
      slack -= Quad(scene.planes[i].normal[k]) * Quad(point[k]);
    }
    const double s = to_double(of_a ? slope : -slope), distance = to_double(slack);
    const double rounding = one_stage * scene.rounding(i, point);
    if (s > -one_stage) each[i].low = (distance - rounding) / (s + one_stage);
    if (s > one_stage) each[i].high = (distance + rounding) / (s - one_stage);
    Interval& end = ends[of_a ? 0 : 1];
    end.low = std::min(end.low, each[i].low);
    end.high = std::min(end.high, each[i].high);
  }
  if (each[face_a].low > ends[0].high || each[face_b].low > ends[1].high) return wrong("another face ends the overlap");
  const double low = ends[0].low + ends[1].low, high = ends[0].high + ends[1].high;
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  return by_fraction(std::abs(overlap - middle) / half, "the overlap is off");
}

Judgement judge_area(const Scene& scene, const Vector<3>& point, const Vector<3>& normal, double area) {
  // a section grows with its planes, so planes moved out and in by the rounding bracket the result
  exact::Planes outer = exact::planes_of(scene.planes), inner = outer;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const exact::Rational rounding(one_stage * (scene.rounding(i, point) + scene.reach));
    outer[i].offset += rounding;
    inner[i].offset -= rounding;
  }
  const double high = to_double(exact::section_area(outer, point, normal)),
               low = to_double(exact::section_area(inner, point, normal));
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low) + one_stage * high;
  return by_fraction(std::abs(area - middle) / half,
                     fmt::format("area {:.3g} not in {:.3g} to {:.3g}", area, low, high));
}

Scene make_scene(const Meeting& meeting) {
  Scene scene;
  const Polytope<3>&a = meeting.a.parts[0], &b = meeting.b.parts[0];
  scene.pair = {&a, &b, Matrix<3>::Identity(), matrix(meeting.turn),
                (meeting.b.reference - meeting.a.reference) + meeting.displacement_b};
  // the frame of narrow_phase: the centre of the smaller part
  const Vector<3> origin =
      a.radius < b.radius ? a.centre : Vector<3>(scene.pair.offset + scene.pair.rotation * b.centre);
  assemble<3>(scene.pair, origin, scene.planes);
  scene.faces_a = static_cast<int>(a.faces.size());
  scene.size = std::min(a.inscribed_radius, b.inscribed_radius);
  scene.reach = 4 * std::min(a.radius, b.radius);
  return scene;
}

}  // namespace

Judgements judge_pair(const Meeting& meeting) {
  Judgements all;
  const Scene scene = make_scene(meeting);
  const std::array<int, 4> start = meeting.a.parts[0].basis;
  const FeasibilityResult<3> lp = solve_feasibility<3>(scene.planes, {&start, 1e300, 1e-15 * scene.size});
  const Decision decision = decide(meeting, lp, scene);
  of(all, Kernel::decision) = decision.judgement;
  const ContactStatus status = decision.contact.status;
  if (status <= ContactStatus::undecided || status == ContactStatus::lp_not_converged) return all;

  // stage by stage, each judged on its own input
  const CentreResult<3> centre =
      solve_analytic_centre<3>(scene.planes, {lp.point, scene.settings.newton_tolerance, scene.settings.newton_limit});
  of(all, Kernel::centre) = judge_centre(scene, centre);
  if (centre.status != CentreStatus::converged) {
    for (const Kernel k : {Kernel::normal, Kernel::overlap, Kernel::area})
      of(all, k).verdict = Verdict::refused;
    return all;
  }
  bool fallback = false;
  Vector<3> normal = Vector<3>::Zero();
  const bool found = contact_normal<3>(scene.planes, scene.faces_a, centre.point,
                                       scene.settings.potential_radius * scene.size, normal, fallback);
  of(all, Kernel::normal) = judge_normal(scene, centre.point, found, fallback, normal);
  if (decision.counters.deep_overlaps > 0 && of(all, Kernel::normal).verdict == Verdict::correct)
    of(all, Kernel::normal).verdict = Verdict::warned;
  if (status == ContactStatus::no_normal) {
    for (const Kernel k : {Kernel::normal, Kernel::overlap, Kernel::area})
      of(all, k).verdict = Verdict::refused;
    return all;
  }
  // a normal from the LP's multipliers replaces missing gradients
  if (!found) normal = decision.contact.geometry.normal;

  double overlap = 0;
  int face_a = -1, face_b = -1;
  const bool ended = overlap_along<3>(scene.planes, scene.faces_a, centre.point, normal, overlap, face_a, face_b);
  of(all, Kernel::overlap) = judge_overlap(scene, centre.point, normal, ended, overlap, face_a, face_b);
  of(all, Kernel::area) =
      judge_area(scene, centre.point, normal, section_area<3>(scene.planes, centre.point, normal, scene.reach));
  return all;
}

}  // namespace voussoir::atlas
