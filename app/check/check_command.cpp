#include "app/check/check_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/base/arguments.hpp"
#include "app/base/run_scene.hpp"
#include "app/base/shown_unit.hpp"
#include "app/check/assess.hpp"
#include "app/check/check_blocks.hpp"
#include "app/check/check_line.hpp"
#include "app/check/check_records.hpp"
#include "app/check/check_rough_joints.hpp"
#include "app/check/check_stages.hpp"
#include "app/check/check_support.hpp"
#include "core/contact/integrable.hpp"
#include "core/model/water_surfaces.hpp"
#include "core/run/bonds_as_sliced.hpp"
#include "core/scene/judge_values.hpp"
#include "core/scene/scene.hpp"
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

// the volume of blocks below water, and the part of their weight that buoyancy carries, if the scene has water
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
      print_line(label, fmt::format("{}: {} {}", water.name, quantity_text(water.values.front(), "Pa"), on));
    } else {
      std::vector<WaterStretch<Dim>> surface;
      list_stretches<Dim>(water.values, surface);
      double below = 0, whole = 0;
      for (const Body<Dim>& body : model.bodies) {
        if (body.fixed) continue;
        below += submerged<Dim>(body.parts, body.radius, {.centroid = body.reference}, surface).volume;
        whole += volume(body);
      }
      print_line(label, fmt::format("{}: {} {}; {:.6g} {} of the free blocks are below it, {:.4g} %", water.name,
                                    quantity_text(water.unit_weight, "N/m³"), on, below, Dim == 3 ? "m³" : "m²",
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
    print_line("", fmt::format("before the first stage its uplift on the free blocks is {}, {:.4g} % of their weight",
                               quantity_text(lift, Dim == 2 ? "N/m" : "N"), 100 * lift / weight));
  print_line("", "hydrostatic (no flow, drag or added mass); contact forces are effective");
}

std::string law_of_cohesion(const JointProperties& p) {
  if (p.cohesion_law == CohesionLaw::plastic) return "plastic: slip leaves it";
  if (p.cohesion_law == CohesionLaw::brittle) return "brittle: the first slip takes it";
  return fmt::format("softens to {} within {:g} m of slip", quantity_text(p.residual_cohesion, "Pa"), p.cohesion_slip);
}

// the laws that a plain joint does not have, one after the other
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
  if (p.states_barton_bandis())
    for (const std::string& line : rough_joint_text(p))
      laws.push_back(line);
  add(p.laws.normal == StiffnessLaw::hyperbolic,
      fmt::runtime("normal stiffness hyperbolic up to a closure of {:g} m, of which {:g} is not recovered"),
      p.maximum_closure, p.irrecoverable_fraction);
  add(p.laws.dilation == DilationLaw::constant,
      fmt::runtime("dilates at {:g} deg up to {:g} m of slip; no strength is added to friction at a normal stress"),
      to_degrees(p.dilation), p.dilation_until);
  add(p.laws.dilation == DilationLaw::falling,
      fmt::runtime(
          "dilates at {:g} deg, falling within {:g} m of slip; no strength is added to friction at a normal stress"),
      to_degrees(p.dilation), p.dilation_decay);
  const char* const where = p.bonds == BondsMade::as_sliced ? "from the first stage on" : "if bonded";
  add(p.tension > 0, fmt::runtime("tension {} {}"), quantity_text(p.tension, "Pa"), where);
  add(p.cohesion > 0, fmt::runtime("cohesion {} {}, {}"), quantity_text(p.cohesion, "Pa"), where, law_of_cohesion(p));
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
                           used[k] ? "" : "; no face that may touch another has them"));
    for (const std::string& law : laws_text(p))
      print_line("", "  " + law);
    if (p.states_barton_bandis())
      if (const std::string angles = rough_joint_angles(model, static_cast<int>(k)); !angles.empty())
        print_line("", "  " + angles);
    if (is_integrated(contact, p)) {
      print_line("", p.sub_contacts == 1
                         ? "  integrated face contact"
                         : fmt::format("  integrated face contact (sub_contacts = {} is not used)", p.sub_contacts));
      continue;
    }
    if (contact.face == ContactFace::integrated)
      print_line(
          "", fmt::format("  not integrated: {}", p.constant_stiffness ? "constant_stiffness is independent of the area"
                                                  : p.laws.bond        ? "it can be bonded"
                                                  : p.states_barton_bandis() ? "its friction varies over the face"
                                                  : p.dilates()              ? "its rise varies over the face"
                                                                : "its laws depend on the history at each point"));
    print_line("", p.sub_contacts == 1 ? "  one contact point per face"
                                       : fmt::format("  {} contact points per face",
                                                     Dim == 2 ? fmt::format("{}", p.sub_contacts)
                                                              : fmt::format("{0} x {0}", p.sub_contacts)));
  }
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
        : monitor.over != Aggregate::one
            ? fmt::format("{} blocks, {}", monitor.group.size(), monitor.over == Aggregate::sum ? "sum" : "mean")
            : fmt::format("block {}", monitor.subject);
    print_line(label, fmt::format("{}: {} of {}", monitor.name, monitor.followed.word, subject));
    label = "";
  }
}

// features that the scene does not use
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
  if (none_changes([](const Change& c) { return c.bond; }) && !has_bonds_as_sliced(model)) list.push_back("bonds");
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
                                                                  : "analytic centre";
  const char* normal = contact.normal == ContactNormal::multipliers    ? "normal and overlap by multipliers"
                       : contact.overlap == OverlapSearch::closed_form ? "overlap by closed form"
                                                                       : "overlap by bracketing";
  return fmt::format("contact point {}, {}", point, normal);
}

// joints whose laws Newton's method does not support, if it is asked for
template <int Dim>
void print_left_to_relaxation(const Prepared<Dim>& prepared) {
  if (!asks_for_newton(prepared.settings.statics, prepared.stages)) return;
  std::vector<std::string> left;
  for (const JointProperties& p : prepared.model.properties)
    if (!newton_follows(p))
      left.push_back(p.name + (p.follows_barton_bandis() && p.mobilises() ? " softens beyond its peak"
                               : p.dilates()                              ? " dilates"
                                                                          : " softens"));
  if (!left.empty()) print_line("", fmt::format("relaxation replaces Newton's method: {}", fmt::join(left, ", ")));
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
  print_line("statics", statics_text(settings.statics));
  print_line("damping", damping_text(settings.damping));
  print_line("solvers", solvers_text(settings.contact));
  print_stages(prepared.stages, prepared.model.waters);
  print_records(prepared);
  print_set_aside(prepared);
  print_left_to_relaxation(prepared);
  print_support(prepared);
  print_monitors(prepared);
  print_line("not active", inactive(prepared));
}

void print_derived(const Forecast& forecast) {
  fmt::print("derived\n");
  print_line("contacts",
             fmt::format("{} pairs near each other, {} of them touch", forecast.candidates, forecast.touching));
  if (forecast.candidates > 0)
    print_line("", fmt::format("most, {}, of block {}; at most {:.0f} pairs are allowed; a run takes about {:.0f} MB",
                               forecast.most_candidates, forecast.crowded, forecast.candidates_allowed,
                               1e-6 * forecast.memory));
  if (const auto& bonds = forecast.bonds)
    print_line(
        "bonds",
        fmt::format("at the start {} closed joints are in compression and can be bonded, {} when first in compression",
                    bonds->made, bonds->due));
  if (forecast.overlap > 0)
    print_line("overlap", fmt::format("about {:.2g} m under a block's own weight, {:.1g} of its inscribed radius",
                                      forecast.overlap, forecast.overlap_fraction));
  if (std::isfinite(forecast.step_limit))
    print_line("time step", fmt::format("stable below {:.3g} s", forecast.step_limit));
  for (const StageForecast& stage : forecast.stages) {
    const std::string step = stage.time_step > 0 ? fmt::format("steps of {:.3g} s", stage.time_step)
                                                 : "no contact and no time.step_s: no time step yet";
    const std::string count =
        stage.steps > 0 ? fmt::format(", {} {:.1g} of them", text_of(stage.kind), stage.steps) : "";
    print_line("", fmt::format("{}: {}{}", stage.name, step, count));
    if (stage.load_step > 0 && stage.steps > 0)
      print_line("", fmt::format("{}: {:.1g} evaluations of each contact; implicit steps, {}, of at most {:.3g} s by "
                                 "the load: about {:.1g}",
                                 stage.name, stage.steps,
                                 stage.implicit ? "which it takes" : "time = { integration = \"implicit\" }",
                                 stage.load_step, stage.implicit_evaluations()));
    if (!stage.damping.empty()) print_line("", fmt::format("{}: {}", stage.name, stage.damping));
  }
}

struct CheckArguments {
  SceneArguments scene;
  bool hash = false;  // only the input hash, which needs no blocks
};

ExitCode check_command(const CheckArguments& arguments) {
  const auto& [path, overrides] = arguments.scene;
  if (arguments.hash) {
    fmt::print("{}\n", input_hash(read_scene(path, overrides)));
    return ExitCode::done;
  }
  const LoadedScene scene = load_scene(path, overrides);
  fmt::print("{} ({}-D)\n", scene.title.empty() ? path.filename().string() : scene.title, scene.dimension);
  std::visit([&](const auto& prepared) { print_active(*scene.stated, prepared); }, scene.prepared);
  const auto print_list = [](const char* label, const std::vector<std::string>& lines) {
    for (std::size_t k = 0; k < lines.size(); ++k)
      print_line(k == 0 ? label : "", lines[k]);
  };
  print_list("by preset", scene.stated->from_preset);
  print_list("by level", scene.stated->from_level);
  print_list("renamed", scene.stated->renamed);
  print_line("input hash", scene.hash);
  const Assessment assessment = assess(scene);
  print_derived(assessment.forecast);
  for (const std::string& warning : assessment.warnings)
    fmt::print("warning: {}\n", warning);
  fmt::print("{}\n", assessment.warnings.empty() ? "no warnings" : "the scene can run; see the warnings");
  return ExitCode::done;
}

}  // namespace

void add_check(CLI::App& program, Action& action) {
  const auto [command, arguments] =
      add_command(program, action, "check",
                  "report the features a scene uses, a forecast of the run, and likely mistakes", check_command);
  add_scene(command, arguments.scene);
  command->add_flag("--hash", arguments.hash, "print only the input hash of the scene, which its results.json has too");
}

}  // namespace voussoir
