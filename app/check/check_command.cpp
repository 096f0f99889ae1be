#include "app/check/check_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/base/arguments.hpp"
#include "app/base/run_scene.hpp"
#include "app/check/check_blocks.hpp"
#include "app/check/check_support.hpp"
#include "app/check/plausibility.hpp"
#include "core/contact/integrable.hpp"
#include "core/model/water_surfaces.hpp"
#include "core/scene/plausibility.hpp"
#include "core/scene/stage_excavations.hpp"
#include "core/step/relaxation.hpp"
#include "core/step/static_solver.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// of blocks and of joints: tables and joint sets make thousands
constexpr std::size_t most_shown = 30;

template <int Dim>
std::string vector_text(const Vector<Dim>& v) {
  std::string text;
  for (int k = 0; k < Dim; ++k)
    text += fmt::format("{}{:g}", k ? ", " : "", v[k] + 0.0);
  return "(" + text + ")";
}

std::string orientation(const Vector<2>& normal) {
  return fmt::format("dip {:g} to the {}", to_degrees(std::acos(std::min(1.0, normal[1]))),
                     normal[0] < 0 ? "left" : "right");
}

std::string orientation(const Vector<3>& normal) {
  const double direction = to_degrees(std::atan2(normal[0], normal[1]));
  return fmt::format("dip/dip direction {:.4g}/{:.4g}", to_degrees(std::acos(std::min(1.0, normal[2]))),
                     direction < 0 ? direction + 360 : direction);
}

template <int Dim>
void print_blocks(const Model<Dim>& model) {
  int fixed = 0, restrained = 0, parts = 0;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0, whole = 0, mass = 0;
  for (const Body<Dim>& body : model.bodies) {
    fixed += body.fixed;
    const auto held = [](bool free) { return !free; };
    restrained += !body.fixed && (std::any_of(body.free_translation.begin(), body.free_translation.end(), held) ||
                                  std::any_of(body.free_rotation.begin(), body.free_rotation.end(), held));
    parts += static_cast<int>(body.parts.size());
    smallest = std::min(smallest, body.size);
    largest = std::max(largest, body.size);
    whole += volume(body);
    if (!body.fixed) mass += body.mass;
  }
  const int count = static_cast<int>(model.bodies.size());
  print_line("blocks", fmt::format("{}: {} free{}, {} fixed", count, count - fixed,
                                   restrained ? fmt::format(" ({} of them restrained)", restrained) : "", fixed));
  if (parts != count) print_line("", fmt::format("of {} convex parts", parts));
  print_line("",
             fmt::format("inscribed radius {:.4g} to {:.4g} m; {} {:.6g} {}; free mass {:.6g} {}", smallest, largest,
                         Dim == 3 ? "volume" : "area", whole, Dim == 3 ? "m³" : "m²", mass, Dim == 3 ? "kg" : "kg/m"));
  std::string names;
  std::size_t named = 0;
  for (const Body<Dim>& body : model.bodies)
    if (!body.name.empty() && named++ < most_shown) names += (names.empty() ? "" : ", ") + body.name;
  if (named > most_shown) names += fmt::format(" and {} more", named - most_shown);
  if (!names.empty()) print_line("", "named: " + names);
}

template <int Dim>
void print_joints(const Model<Dim>& model) {
  const char* label = "joints";
  for (std::size_t j = 0; j < std::min(model.joints.size(), most_shown); ++j) {
    int faces = 0;
    for (const Body<Dim>& body : model.bodies)
      for (const Polytope<Dim>& part : body.parts)
        faces += static_cast<int>(std::count(part.joints.begin(), part.joints.end(), static_cast<int>(j)));
    const Joint<Dim>& joint = model.joints[j];
    print_line(label, fmt::format("{}: {}, {} faces, properties {}", joint.name, orientation(joint.plane.normal), faces,
                                  model.properties[joint.properties].name));
    label = "";
  }
  if (model.joints.size() > most_shown) print_line("", fmt::format("and {} more", model.joints.size() - most_shown));
}

// what of the blocks lies in water, and how much of their weight it carries, where the scene has them
template <int Dim>
void print_water(const Prepared<Dim>& prepared) {
  const Model<Dim>& model = prepared.model;
  if (model.waters.empty()) return;
  const char* label = "water";
  for (std::size_t w = 0; w < model.waters.size(); ++w) {
    const Water& water = model.waters[w];
    const auto joints = std::count(model.water_of_joint.begin(), model.water_of_joint.end() - 1, static_cast<int>(w));
    const bool outside = model.water_of_joint.back() == static_cast<int>(w);
    const std::string on = model.water_by_volume
                               ? "on all faces"
                               : fmt::format("on the faces of {} joints{}", joints, outside ? " and outside" : "");
    if (water.uniform) {
      print_line(label, fmt::format("{}: {:g} Pa {}", water.name, water.values.front(), on));
    } else {
      std::vector<WaterStretch<Dim>> surface;
      list_stretches<Dim>(water.values, surface);
      double below = 0, whole = 0;
      for (const Body<Dim>& body : model.bodies) {
        if (body.fixed) continue;
        below += submerged<Dim>(body.parts, body.radius, {.centroid = body.reference}, surface).volume;
        whole += volume(body);
      }
      print_line(label, fmt::format("{}: {:g} N/m³ {}; {:.6g} {} of the free blocks lie below it, {:.4g} %", water.name,
                                    water.unit_weight, on, below, Dim == 3 ? "m³" : "m²",
                                    whole > 0 ? 100 * below / whole : 0));
    }
    label = "";
  }
  double lift = 0, weight = 0;
  const std::vector<Load<Dim>> loads = water_loads_at_reference(model);
  for (std::size_t b = 0; b < loads.size(); ++b) {
    if (model.bodies[b].fixed) continue;
    lift += loads[b].force[Dim - 1];
    weight -= model.bodies[b].mass * model.gravity[Dim - 1];
  }
  if (std::abs(lift) < 16 * std::numeric_limits<double>::epsilon() * weight) lift = 0;
  if (weight > 0)
    print_line(
        "", fmt::format("before the first stage it lifts the free blocks by {:.6g} N{}, {:.4g} % of their weight", lift,
                        Dim == 2 ? "/m" : "", 100 * lift / weight));
  print_line("", "it stands still (no flow, drag or added mass); contact forces are effective");
}

// the laws that a plain joint has not, one after the other
std::vector<std::string> laws_text(const JointProperties& p) {
  std::vector<std::string> laws;
  const auto add = [&](bool has, auto... arguments) {
    if (has) laws.push_back(fmt::format(arguments...));
  };
  add(p.laws.normal == StiffnessLaw::linear, fmt::runtime("normal stiffness + {:g}/m times the normal stress"),
      p.normal_growth);
  add(p.laws.normal == StiffnessLaw::power, fmt::runtime("normal stiffness times (normal stress / 1 Pa)^{:g}"),
      p.normal_exponent);
  add(p.laws.shear == StiffnessLaw::linear, fmt::runtime("shear stiffness + {:g}/m times the normal stress"),
      p.shear_growth);
  add(p.laws.shear == StiffnessLaw::power, fmt::runtime("shear stiffness times (normal stress / 1 Pa)^{:g}"),
      p.shear_exponent);
  add(p.laws.friction == FrictionLaw::hardening,
      fmt::runtime("friction hardens within {:g} m of slip (normal stress / 1 Pa)^{:g}"), p.hardening_slip,
      p.hardening_exponent);
  add(p.laws.friction == FrictionLaw::softening,
      fmt::runtime("friction coefficient softens by {:g} within {:g} m of slip"), p.softening_drop, p.softening_slip);
  add(p.tension > 0, fmt::runtime("tension {:g} Pa where bonded"), p.tension);
  add(p.cohesion > 0, fmt::runtime("cohesion {:g} Pa where bonded"), p.cohesion);
  return laws;
}

template <int Dim>
void print_properties(const Model<Dim>& model, const ContactSettings& contact) {
  const std::vector<bool> used = properties_of_faces(model);
  for (std::size_t k = 0; k < model.properties.size(); ++k) {
    const JointProperties& p = model.properties[k];
    print_line(k == 0 ? "properties" : "",
               fmt::format("{}: normal {:g}, shear {:g} {}, friction {:g} deg{}", p.name, p.normal_stiffness,
                           p.shear_stiffness, p.constant_stiffness ? "N/m" : "Pa/m", to_degrees(p.friction),
                           used[k] ? "" : "; of no face that may meet another"));
    for (const std::string& law : laws_text(p))
      print_line("", "  " + law);
    if (is_integrated(contact, p)) {
      print_line("", p.sub_contacts == 1
                         ? "  each contact as a whole, integrated"
                         : fmt::format("  each contact as a whole, integrated (sub_contacts = {} is not used)",
                                       p.sub_contacts));
      continue;
    }
    if (contact.face == ContactFace::integrated)
      print_line("", fmt::format("  not integrated: {}", p.constant_stiffness ? "constant_stiffness knows no area"
                                                         : p.laws.bond        ? "it can be bonded"
                                                                              : "its laws differ from point to point"));
    print_line("", p.sub_contacts == 1
                       ? "  one point a face"
                       : fmt::format("  {} points a face", Dim == 2 ? fmt::format("{}", p.sub_contacts)
                                                                    : fmt::format("{0} x {0}", p.sub_contacts)));
  }
}

std::string damping_text(const DampingSettings& damping, bool seeks_rest = true) {
  std::string text;
  if (damping.local > 0) text = fmt::format("local {:g}", damping.local);
  if (damping.viscous_ratio > 0) text += fmt::format("{}viscous {:g}", text.empty() ? "" : ", ", damping.viscous_ratio);
  std::string rest;
  if (relaxes(seeks_rest, damping))
    rest =
        damping.statics == Statics::newton
            ? fmt::format("; to rest by Newton's method in {} increments, confirmed by relaxation", damping.increments)
            : "; to rest by relaxation";
  return (text.empty() ? "none" : text) + rest;
}

struct PlanText {
  std::string operator()(const SettlePlan& plan) const { return "settle until at rest" + gravity(plan.gravity); }
  std::string operator()(const RunPlan& plan) const {
    return fmt::format("run for {:g} s", plan.duration) + gravity(plan.gravity);
  }
  std::string operator()(const ReducePlan& plan) const {
    std::string of = "all joint properties";
    if (!plan.properties.empty()) of = fmt::format("{}", fmt::join(plan.properties, ", "));
    std::string failure = plan.failure_displacement > 0 ? fmt::format("{:g} m", plan.failure_displacement)
                                                        : std::string("a tenth of the smallest inscribed radius");
    if (plan.failure_fraction > 0) failure += fmt::format(", by {:g} of the free mass", plan.failure_fraction);
    if (plan.searched == Searched::factor)
      return fmt::format("divide tan φ and cohesion of {} by {:g} to {:g} {}; failed after {}", of, plan.factor.from,
                         plan.factor.to, how(plan.method, plan.factor), failure);
    return fmt::format("reduce the friction of {} from {:g} to {:g} deg {}; failed after {}", of, to_degrees(plan.from),
                       to_degrees(plan.to), how(plan), failure);
  }
  static std::string how(ReductionMethod method, const FactorPlan& plan) {
    if (method == ReductionMethod::steps) return fmt::format("in steps of {:g}", plan.step);
    return fmt::format("by bisection to {:g}", plan.tolerance);
  }
  static std::string gravity(const GravityPlan& plan) {
    if (plan.ramp > 0 && !plan.to && plan.from == 0) return fmt::format(", gravity put on within {:g} s", plan.ramp);
    if (plan.ramp > 0)
      return fmt::format(", gravity taken from {:g} to {:g} times itself within {:g} s", plan.from, plan.to.value_or(1),
                         plan.ramp);
    return plan.to ? fmt::format(", under {:g} times the gravity", *plan.to) : "";
  }
  static std::string how(const ReducePlan& plan) {
    switch (plan.method) {
      case ReductionMethod::bisection:
        return fmt::format("by bisection to {:g} deg", to_degrees(plan.tolerance));
      case ReductionMethod::steps:
        return fmt::format("in steps of {:g} deg", to_degrees(plan.step));
      case ReductionMethod::rate:
        return fmt::format("at {:g} deg/s", to_degrees(plan.rate));
      case ReductionMethod::two_rates:
        return fmt::format("at {:g} and {:g} deg/s, extrapolated", to_degrees(plan.rate), to_degrees(plan.slower_rate));
    }
    return "";
  }
};

std::string numbers_text(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers)
    texts.push_back(fmt::format("{:g}", number + 0.0));
  return fmt::format("({})", fmt::join(texts, ", "));
}

std::string factor_text(const TimeFactor& factor) {
  std::string text;
  if (factor.frequency > 0)
    text += fmt::format(", times a sine of {:g} Hz from {:g} deg on", factor.frequency, to_degrees(factor.phase));
  if (!factor.times.empty())
    text += fmt::format(", times {} at {} s", numbers_text(factor.factors), numbers_text(factor.times));
  return text;
}

std::string move_text(const MovePlan& move) {
  std::string text;
  if (!move.velocity.empty()) {
    std::string axes;
    for (std::size_t k = 0; k < move.velocity.size(); ++k)
      if (move.translation[k]) axes += "xyz"[k];
    text = fmt::format("at {} m/s along {}", numbers_text(move.velocity), axes);
  }
  if (!move.angular_velocity.empty())
    text += fmt::format("{}turning at {} rad/s", text.empty() ? "" : ", ", numbers_text(move.angular_velocity));
  return text + factor_text(move.factor);
}

// what happens to the model before the stage, and what is forced upon it within
std::string change_text(const Change& change) {
  std::string text;
  for (const MovePlan& move : change.move)
    text += "; moves blocks " + move_text(move);
  for (const BoundaryPlan& plan : change.boundary) {
    text +=
        fmt::format("; stress {} = {} Pa on outer faces of blocks",
                    plan.stress.size() == 3 ? "(xx, yy, xy)" : "(xx, yy, zz, yz, zx, xy)", numbers_text(plan.stress));
    if (plan.in_situ)
      text += fmt::format(" and that of {:g} N/m³ below {:g} m, horizontally {:g}{} times as much",
                          plan.in_situ->unit_weight.value(), plan.in_situ->surface, plan.in_situ->k0,
                          plan.in_situ->k0_y ? fmt::format(", along y {:g}", *plan.in_situ->k0_y) : "");
  }
  for (const ForcePlan& plan : change.force) {
    text += fmt::format("; force '{}' = {} {} on blocks", plan.name, numbers_text(plan.force),
                        plan.force.size() == 2 ? "N/m" : "N");
    if (!plan.point.empty()) text += fmt::format(" at {} m", numbers_text(plan.point));
    if (plan.turns_with_body) text += ", turning with them";
    text += factor_text(plan.factor);
  }
  if (change.bond) text += "; bonds closed joints that have tension or cohesion";
  if (!change.fix.empty()) text += "; fixes blocks";
  if (!change.release.empty()) text += "; releases blocks";
  if (!change.remove.empty()) text += "; removes blocks";
  if (!change.excavate.empty()) text += fmt::format("; excavates '{}'", fmt::join(change.excavate, "', '"));
  if (!change.install.empty()) text += fmt::format("; installs '{}'", fmt::join(change.install, "', '"));
  if (change.friction) text += fmt::format("; friction {:g} deg", to_degrees(*change.friction));
  for (const FrictionPlan& plan : change.friction_of)
    text += fmt::format("; friction of {} {:g} deg", plan.properties, to_degrees(plan.friction));
  if (change.zero_slip) text += "; plastic slip set to zero";
  return text;
}

void print_stages(const std::vector<StagePlan>& stages, const std::vector<Water>& waters) {
  ActingShare acting;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const StagePlan& stage = stages[k];
    std::string text = fmt::format("{} {}: {}", k + 1, stage.name, std::visit(PlanText{}, stage.plan));
    text += change_text(stage.change);
    for (const WaterPlan& water : stage.water)
      text += fmt::format("; water '{}' changes within {:g} s", waters[water.water].name, water.ramp);
    if (stage.let_off)
      text += fmt::format("; lets off to a share of {:g} within {:g} s", stage.let_off->share, stage.let_off->duration);
    const bool seeks_rest = !std::holds_alternative<RunPlan>(stage.plan);
    if (stage.damping) text += "; damping " + damping_text(*stage.damping, seeks_rest);
    print_line(k == 0 ? "stages" : "", text);
    acting.follow(stage);
  }
  if (acting.share > 0)
    print_line("", fmt::format("let_off: a share of {:g} still acts after the last stage, since stage {}", acting.share,
                               acting.stage));
}

template <int Dim>
void print_monitors(const Prepared<Dim>& prepared) {
  const char* label = "monitors";
  for (const Monitor& monitor : prepared.monitors) {
    const Quantity quantity = monitor.followed.quantity;
    const bool of_joint = quantity == Quantity::contact_force || quantity == Quantity::whole_bonds;
    const std::string subject =
        of_joint                           ? "joint " + prepared.model.joints[monitor.subject].name
        : quantity == Quantity::level      ? "water " + prepared.model.waters[monitor.subject].name
        : quantity == Quantity::bolt_force ? "bolts " + prepared.model.bolt_properties[monitor.subject].name
        : quantity == Quantity::lining_force
            ? "lining " + prepared.model.linings[monitor.subject].properties.name +
                  (monitor.node < 0 ? "" : fmt::format(" at node {}", monitor.node + 1))
        : quantity == Quantity::convergence ? fmt::format("{} points of a wall", monitor.wall.size())
        : monitor.over != Over::one
            ? fmt::format("{} blocks, {}", monitor.group.size(), monitor.over == Over::sum ? "sum" : "mean")
            : fmt::format("block {}", monitor.subject);
    print_line(label, fmt::format("{}: {} of {}", monitor.name, monitor.followed.word, subject));
    label = "";
  }
}

// what a reader might look for in vain
template <int Dim>
std::string inactive(const Prepared<Dim>& prepared) {
  std::vector<std::string> list;
  const Model<Dim>& model = prepared.model;
  const auto uses = [&](auto test) {
    return test(prepared.settings.damping) || std::any_of(prepared.stages.begin(), prepared.stages.end(),
                                                          [&](const auto& s) { return s.damping && test(*s.damping); });
  };
  if (model.gravity.norm() == 0) list.push_back("gravity");
  if (!uses([](const DampingSettings& d) { return d.local > 0; })) list.push_back("local damping");
  if (!uses([](const DampingSettings& d) { return d.viscous_ratio > 0; })) list.push_back("viscous damping");
  if (model.joints.empty()) list.push_back("joints");
  const auto none_changes = [&](auto test) {
    return std::none_of(prepared.stages.begin(), prepared.stages.end(),
                        [&](const StagePlan& s) { return test(s.change); });
  };
  const auto none_has = [&](auto test) { return std::none_of(model.properties.begin(), model.properties.end(), test); };
  if (none_has([](const JointProperties& p) { return !p.laws.is_plain(); })) list.push_back("joint laws and strengths");
  if (none_has([](const JointProperties& p) { return p.sub_contacts > 1; })) list.push_back("sub-contacts");
  if (none_changes([](const Change& c) { return c.bond; })) list.push_back("bonds");
  if (none_changes([](const Change& c) { return !c.move.empty(); })) list.push_back("prescribed motion");
  if (none_changes([](const Change& c) { return !c.boundary.empty(); })) list.push_back("boundary stress");
  if (none_changes([](const Change& c) { return !c.force.empty(); })) list.push_back("applied forces");
  if (model.waters.empty()) list.push_back("water");
  if (prepared.monitors.empty()) list.push_back("monitors");
  if (!prepared.output.frames) list.push_back("ParaView frames");
  if (std::none_of(prepared.stages.begin(), prepared.stages.end(),
                   [](const StagePlan& s) { return std::holds_alternative<ReducePlan>(s.plan); }))
    list.push_back("strength reduction");
  const bool moving = std::any_of(prepared.state.bodies.motions.begin(), prepared.state.bodies.motions.end(),
                                  [](const auto& m) { return m.velocity.norm() > 0 || m.angular_momentum.norm() > 0; });
  if (!moving) list.push_back("initial velocities");
  return fmt::format("{}", fmt::join(list, ", "));
}

std::string solvers_text(const ContactSettings& contact) {
  const char* point = contact.point == ContactPoint::central_path ? "on the central path"
                      : contact.point == ContactPoint::chebyshev  ? "Chebyshev"
                      : contact.point == ContactPoint::centroid   ? "centroid"
                      : contact.centre == CentreSolver::own       ? "analytic centre (own)"
                      : contact.centre == CentreSolver::ipopt     ? "analytic centre (Ipopt)"
                                                                  : "analytic centre (Ipopt, thesis' scaling)";
  const char* normal = contact.normal == ContactNormal::multipliers    ? "normal and overlap by multipliers"
                       : contact.overlap == OverlapSearch::closed_form ? "overlap by closed form"
                                                                       : "overlap by bracketing";
  return fmt::format("linear program {}, contact point {}, {}", contact.lp == LpSolver::own ? "own" : "GLPK", point,
                     normal);
}

// joints whose laws Newton's method does not follow, where it is asked for
template <int Dim>
void print_left_to_relaxation(const Prepared<Dim>& prepared) {
  if (!asks_for_newton(prepared.settings.damping, prepared.stages)) return;
  std::vector<std::string> names;
  for (const JointProperties& p : prepared.model.properties)
    if (!newton_follows(p)) names.push_back(p.name);
  if (!names.empty())
    print_line("", fmt::format("Newton's method leaves all to relaxation: {} softens", fmt::join(names, ", ")));
}

template <int Dim>
void print_active(const Scene& stated, const Prepared<Dim>& prepared) {
  const Settings& settings = prepared.settings;
  print_blocks(prepared.model);
  print_worst_blocks(prepared.model);
  print_particles(prepared.model);
  print_joints(prepared.model);
  print_missing_joints(stated, prepared.model);
  if (const std::string endless = endless_joints(stated, prepared.model.bodies.size()); !endless.empty())
    print_line("", endless);
  print_properties(prepared.model, prepared.settings.contact);
  print_line("gravity", vector_text<Dim>(prepared.model.gravity) + " m/s²");
  print_water(prepared);
  print_line("damping", damping_text(settings.damping));
  print_line("solvers", solvers_text(settings.contact));
  print_stages(prepared.stages, prepared.model.waters);
  print_left_to_relaxation(prepared);
  print_support(prepared);
  print_monitors(prepared);
  print_line("not active", inactive(prepared));
}

void print_derived(const Plausibility& plausibility) {
  fmt::print("derived\n");
  print_line("contacts",
             fmt::format("{} pairs near each other, {} of them touch", plausibility.candidates, plausibility.touching));
  if (plausibility.candidates > 0)
    print_line("", fmt::format("most, {}, of block {}; {:.0f} pairs in all are allowed; a run takes about {:.0f} MB",
                               plausibility.most_candidates, plausibility.crowded, plausibility.candidates_allowed,
                               1e-6 * plausibility.memory));
  if (const auto& bonds = plausibility.bonds)
    print_line("bonds", fmt::format("at the start {} closed joints press and can be bonded, {} when they first press",
                                    bonds->made, bonds->due));
  if (plausibility.overlap > 0)
    print_line("overlap", fmt::format("about {:.2g} m under a block's own weight, {:.1g} of its inscribed radius",
                                      plausibility.overlap, plausibility.overlap_fraction));
  if (std::isfinite(plausibility.step_limit))
    print_line("time step", fmt::format("stable below {:.3g} s", plausibility.step_limit));
  for (const StageForecast& stage : plausibility.stages) {
    const std::string step = stage.time_step > 0 ? fmt::format("steps of {:.3g} s", stage.time_step)
                                                 : "no contact and no time.step_s: no time step yet";
    const std::string count =
        stage.steps > 0 ? fmt::format(", {} {:.1g} of them", text_of(stage.reckoning), stage.steps) : "";
    print_line("", fmt::format("{}: {}{}", stage.name, step, count));
  }
}

ExitCode check_command(const SceneArguments& arguments) {
  const LoadedScene scene = load_scene(arguments.scene, arguments.overrides);
  fmt::print("{} ({}-D)\n", scene.title.empty() ? arguments.scene.filename().string() : scene.title, scene.dimension);
  std::visit([&](const auto& prepared) { print_active(*scene.stated, prepared); }, scene.prepared);
  for (std::size_t k = 0; k < scene.from_level.size(); ++k)
    print_line(k == 0 ? "by level" : "", scene.from_level[k]);
  const Plausibility plausibility = assess(scene);
  print_derived(plausibility);
  for (const std::string& warning : plausibility.warnings)
    fmt::print("warning: {}\n", warning);
  fmt::print("{}\n", plausibility.warnings.empty() ? "no warnings" : "the scene can run; see the warnings");
  return ExitCode::done;
}

}  // namespace

void add_check(CLI::App& program, Action& action) {
  const auto [command, arguments] =
      add_command(program, action, "check", "say what a scene activates and what looks wrong", check_command);
  add_scene(command, arguments);
}

}  // namespace voussoir
