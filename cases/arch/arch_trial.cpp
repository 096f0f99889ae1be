#include "cases/arch/arch_trial.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/recorded_run.hpp"

namespace voussoir::cases {

std::vector<std::string> on_joints(double stiffness) {
  return {"joint_properties.dry.normal_stiffness=" + text(stiffness),
          "joint_properties.dry.shear_stiffness=" + text(stiffness)};
}

Trial attempt(const std::string& scene, const std::vector<std::string>& overrides, double drop) {
  RecordedRun<2> run = record<2>(scene, overrides, Demand::no_failure, [&](const Prepared<2>&, const State<2>& state) {
    return std::any_of(state.bodies.motions.begin(), state.bodies.motions.end(),
                       [&](const Motion<2>& motion) { return motion.displacement[1] < -drop; });
  });
  Trial trial;
  trial.cost = cost(run.run);
  trial.stands = run.ended && run.run.results.outcome == Outcome::done;
  trial.comes_down = !run.ended;
  trial.state = std::move(run.end);
  trial.scene = std::move(run.run.scene);
  return trial;
}

double Trial::drop(const std::string& block, const Vector<2>& point) const {
  const std::vector<Body<2>>& bodies = model().bodies;
  const auto body = std::find_if(bodies.begin(), bodies.end(), [&](const Body<2>& b) { return b.name == block; });
  if (body == bodies.end()) throw std::out_of_range("no block " + block);
  const Motion<2>& motion = state.bodies.motions[body - bodies.begin()];
  const Vector<2> arm = point - model().origin - body->reference;
  return -(motion.displacement + matrix(motion.rotation) * arm - arm)[1];
}

std::vector<Joint> joints_of(const Trial& trial, const ArchShape& shape) {
  const Model<2>& model = trial.model();
  const State<2>& state = trial.state;
  std::vector<Joint> joints;
  for (std::size_t i = 0; i < state.contacts.list.size(); ++i) {
    const Contact<2>& c = state.contacts.list[i];
    if (!c.touching()) continue;
    const int a = model.parts[c.part_a].body, b = model.parts[c.part_b].body;
    double turning = 0;  // N m about the contact's point
    for (const SubContact<2>& sub : subs_of(state.contacts, i))
      if (sub.area > 0) turning += moment(sub.point - c.geometry.point, sub.force)[0];
    const Vector<2> along = perpendicular(c.geometry.normal);
    const Vector<2> crossing = c.geometry.point + turning / moment(along, c.force)[0] * along;
    const Motion<2>&of_a = state.bodies.motions[a], &of_b = state.bodies.motions[b];

    // initial position of that point of the first body: joints are at multiples of a sector from the springing
    const Vector<2> before = model.origin + model.bodies[a].reference + matrix(of_a.rotation).transpose() * crossing;
    const double half = 0.5 * std::numbers::pi, sector = 2 * half / shape.voussoirs;
    Joint joint;
    joint.angle = sector * std::round((std::atan2(before[0], before[1]) + half) / sector) - half;
    joint.outwards = before[0] * std::sin(joint.angle) + before[1] * std::cos(joint.angle) - shape.radius;
    joint.turn = std::abs(of_a.rotation.angle - of_b.rotation.angle);
    joint.point = model.origin + model.bodies[a].reference + of_a.displacement + crossing;
    joint.force = c.force;
    joints.push_back(joint);
  }
  std::sort(joints.begin(), joints.end(), [](const Joint& a, const Joint& b) { return a.angle < b.angle; });
  return joints;
}

std::vector<Joint> hinges_of(const std::vector<Joint>& joints) {
  double most = 0;
  for (const Joint& joint : joints)
    most = std::max(most, joint.turn);
  std::vector<Joint> hinges;
  for (const Joint& joint : joints)
    if (joint.turn > 0.1 * most) hinges.push_back(joint);
  return hinges;
}

void draw_blocks(const std::string& file, const Trial& trial) {
  std::ofstream out(verification::case_output("arch") / file);
  out << "x_m,y_m\n";
  const Model<2>& model = trial.model();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Polytope<2>& part = model.bodies[b].parts.front();
    if (model.bodies[b].fixed) continue;
    for (const int vertex : closed_ring(part)) {
      const Motion<2>& motion = trial.state.bodies.motions[b];
      const Vector<2> p = model.origin + model.bodies[b].reference + motion.displacement +
                          matrix(motion.rotation) * part.vertices[vertex];
      out << p[0] << ',' << p[1] << '\n';
    }
    out << '\n';
  }
}

void draw_forces(const std::string& file, const Trial& trial) {
  std::vector<std::vector<double>> columns(4);
  const Model<2>& model = trial.model();
  const State<2>& state = trial.state;
  for (std::size_t i = 0; i < state.contacts.list.size(); ++i) {
    const int a = model.parts[state.contacts.list[i].part_a].body;
    for (const SubContact<2>& sub : subs_of(state.contacts, i)) {
      if (!(sub.area > 0)) continue;
      const Vector<2> p = model.origin + model.bodies[a].reference + state.bodies.motions[a].displacement + sub.point;
      columns[0].push_back(p[0]);
      columns[1].push_back(p[1]);
      columns[2].push_back(sub.force[0]);
      columns[3].push_back(sub.force[1]);
    }
  }
  write_csv("arch", file, {"x_m", "y_m", "force_x_N", "force_y_N"}, columns);
}

void draw_points(const std::string& file, const std::vector<Joint>& joints) {
  std::vector<std::vector<double>> columns(2);
  for (const Joint& joint : joints) {
    columns[0].push_back(joint.point[0]);
    columns[1].push_back(joint.point[1]);
  }
  write_csv("arch", file, {"x_m", "y_m"}, columns);
}

}  // namespace voussoir::cases
