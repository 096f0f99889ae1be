#include "cases/tunnel/twin.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/LU>

namespace voussoir::cases {
namespace {

using namespace voussoir::reference::network;

// Common edges of blocks as cut are on one line, except for rounding.
constexpr double same_line = 1e-7;  // m

Point point(const Vector<2>& v) {
  return {v[0], v[1]};
}

// the blocks of bodies that exist and are rock; `number` of each body, -1: none
std::vector<Block> blocks_of(const Model<2>& model, std::vector<int>& number) {
  std::vector<Block> blocks;
  number.assign(model.bodies.size(), -1);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<2>& body = model.bodies[b];
    if (!body.present || body.parts.empty()) continue;
    Block block;
    for (const Polytope<2>& part : body.parts) {
      Polygon polygon;
      for (const int v : boundary_ring(part))
        polygon.push_back(point(body.reference + part.vertices[v]));
      block.parts.push_back(polygon);
    }
    if (body.fixed) block.held = {true, true, true};
    number[b] = static_cast<int>(blocks.size());
    blocks.push_back(block);
  }
  return blocks;
}

Freedoms motion_between(const Motion<2>& from, const Motion<2>& to) {
  const Vector<2> way = to.displacement - from.displacement;
  return {way[0], way[1], to.rotation.angle - from.rotation.angle};
}

// A stage removes the forces that it releases: the load that held the block falls.
void relieve_held(const StageEnd& before, const StageEnd& after, const std::vector<int>& number,
                  std::vector<Block>& blocks) {
  for (std::size_t i = 0; i < after.state.loads.relief.size(); ++i) {
    const ReliefLoad<2>& held = after.state.loads.relief[i];
    const double change = held.share - before.state.loads.relief[i].share;
    Freedoms& load = blocks[number[held.body]].load;
    load[0] += change * held.load.force[0];
    load[1] += change * held.load.force[1];
    load[2] += change * held.load.moment[0];
  }
}

// the bolts that have springs in the run, and the springs between the same two blocks
void add_bolts(const StageEnd& after, const std::vector<Face>& joints, const std::vector<int>& number, Twins& both) {
  const Model<2>& model = after.model;
  auto& bolts = both.network.bolts;
  int last = -1;
  std::size_t next = 0;  // of the network's along this bolt, not yet matched
  for (const BoltSpring<2>& spring : after.state.supports.bolt_springs) {
    if (spring.bolt != last) {
      last = spring.bolt;
      next = bolts.size();
      const voussoir::Bolt<2>& bolt = model.bolts[last];
      const BoltProperties& properties = model.bolt_properties[bolt.properties];
      for (const reference::network::Bolt& laid :
           bolts_across(joints, point(bolt.collar), point(bolt.toe), properties.stiffness, 1.2 * properties.diameter))
        bolts.push_back(laid);
    }
    const auto same = std::find_if(
        bolts.begin() + static_cast<std::ptrdiff_t>(next), bolts.end(),
        [&](const auto& laid) { return number[spring.body_a] == laid.first && number[spring.body_b] == laid.second; });
    const bool met = same != bolts.end();
    both.twin_of_spring.push_back(met ? static_cast<int>(same - bolts.begin()) : -1);
    if (met) next = static_cast<std::size_t>(same - bolts.begin()) + 1;
  }
}

void add_lining(const Model<2>& model, const voussoir::Lining& stated, const std::vector<Face>& wall,
                Network& network) {
  auto& lining = network.lining;
  lining.closed = stated.closed;
  lining.axial = stated.properties.axial();
  lining.bending = stated.properties.bending();
  for (const LiningNode& node : stated.nodes)
    lining.nodes.push_back({.at = point(node.place)});
  const JointProperties& interface = model.properties[stated.interface_properties];
  tie_to_wall(lining, wall, interface.normal_stiffness, interface.shear_stiffness, same_line);
}

void find_convergence(const Network& network, const Solution& solution, const std::vector<Face>& wall,
                      const Point& centre, Increment& increment) {
  for (int degrees = 0; degrees < 360; ++degrees)
    increment.convergence.push_back(
        convergence_at(network, solution, wall, centre, (degrees + 0.5) * std::numbers::pi / 180));
  increment.mean_convergence = mean_convergence(network, solution, wall, centre);
}

// the corners of a region, counter-clockwise
Polygon outline_of(HalfSpaces<2> region) {
  std::ranges::sort(region, {}, [](const HalfSpace<2>& face) { return std::atan2(face.normal[1], face.normal[0]); });
  Polygon outline;
  for (std::size_t i = 0; i < region.size(); ++i) {
    const HalfSpace<2>&one = region[i], &next = region[(i + 1) % region.size()];
    Matrix<2> normals;
    normals << one.normal.transpose(), next.normal.transpose();
    outline.push_back(point(normals.inverse() * Vector<2>(one.offset, next.offset)));
  }
  return outline;
}

Point middle_of(const Polygon& outline) {
  Point middle{};
  for (const Point& corner : outline)
    for (int k = 0; k < 2; ++k)
      middle[k] += corner[k] / static_cast<double>(outline.size());
  return middle;
}

}  // namespace

SupportedRun run_supported(const std::string& scene, const std::vector<std::string>& overrides) {
  SupportedRun kept;
  kept.run.scene = load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / scene, overrides);
  const auto& prepared = std::get<Prepared<2>>(kept.run.scene.prepared);
  Watcher<2> watcher;
  watcher.frame = [&](const Model<2>& model, const State<2>& state, double) { kept.ends.push_back({model, state}); };
  Progress<2> progress = initial_progress(prepared);
  simulate(prepared, progress, watcher);
  kept.run.results = std::move(progress.results);
  if (kept.run.results.outcome != Outcome::done) throw std::runtime_error(scene + ": " + kept.run.results.message);
  return kept;
}

Twins twins(const SupportedRun& run, int cells) {
  const StageEnd &before = run.before(), &after = run.after();
  const Model<2>& model = after.model;
  Twins both;
  Network& network = both.network;
  std::vector<int> number;
  network.blocks = blocks_of(model, number);
  relieve_held(before, after, number, network.blocks);
  const std::vector<Face> joints = faces(network.blocks, same_line);
  const JointProperties& joint = model.properties[model.joints.front().properties];
  network.springs = springs(joints, cells, joint.normal_stiffness, joint.shear_stiffness);
  const Polygon outline = outline_of(model.excavations.front().region);
  const std::vector<Face> around = wall(network.blocks, outline, same_line);
  add_bolts(after, joints, number, both);
  for (const LiningState& lined : after.state.supports.linings)
    add_lining(model, model.linings[lined.lining], around, network);

  const Solution solution = solve(network);
  Solution moved = solution;  // of the program: motion of its blocks
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (number[b] >= 0)
      moved.blocks[number[b]] = motion_between(before.state.bodies.motions[b], after.state.bodies.motions[b]);
  find_convergence(network, solution, around, middle_of(outline), both.linear);
  find_convergence(network, moved, around, middle_of(outline), both.program);
  for (const BoltForce& bolt : solution.bolts)
    both.linear.bolts.push_back(bolt.axial);
  for (const BoltSpring<2>& spring : after.state.supports.bolt_springs)
    both.program.bolts.push_back(spring.force);
  const std::size_t beams = solution.beams.size();
  for (std::size_t i = 0; i < beams; ++i) {
    const BeamForce &ahead = solution.beams[i], &behind = solution.beams[(i + beams - 1) % beams];
    both.linear.thrust.push_back((ahead.thrust + behind.thrust) / 2);
    both.linear.moment.push_back((ahead.start_moment + behind.end_moment) / 2);
  }
  for (const LiningRow& node : run.run.results.linings) {
    both.program.thrust.push_back(node.forces.thrust);
    both.program.moment.push_back(node.forces.moment);
  }
  return both;
}

}  // namespace voussoir::cases
