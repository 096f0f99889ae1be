#include "core/run/find_mechanism.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "core/geometry/plunge_trend.hpp"
#include "core/step/joint_forces.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// of the way of the corner that moved most: bodies that come so far move with it
constexpr double moving_way = 0.1;

// of the same: motions that differ by less are one, rotations by less are none, joints that slip or open by less do not
constexpr double same_motion = 0.1;

// of the normal forces on a cluster: joints of less carry nothing
constexpr double carrying_share = 0.01;

// sine of the angle between joints that are not parallel
constexpr double least_oblique = 0.02;

// of a cluster's size: a corner is on a face that is in contact if it is so near to its plane
constexpr double on_face = 0.02;

// Where a point of a rigid body goes: by + (turn - 1)(x - centre).
template <int Dim>
struct RigidMotion {
  Vector<Dim> centre = Vector<Dim>::Zero(), by = Vector<Dim>::Zero();  // m
  Matrix<Dim> turn = Matrix<Dim>::Identity();

  Vector<Dim> way(const Vector<Dim>& x) const {
    const Vector<Dim> arm = x - centre;
    return by + turn * arm - arm;
  }
  // of the point that is at x afterwards
  Vector<Dim> way_to(const Vector<Dim>& x) const {
    const Vector<Dim> arm = x - centre - by;
    return x - (centre + turn.transpose() * arm);
  }
};

Spin<2> turn_vector(const Rotation<2>& from, const Rotation<2>& to) {
  return Spin<2>(to.angle - from.angle);
}
Spin<3> turn_vector(const Rotation<3>& from, const Rotation<3>& to) {
  return rotation_vector(Rotation<3>{Quaternion((to.quaternion * from.quaternion.conjugate()).coeffs())});
}

template <int Dim>
struct BodyMotions {
  const Model<Dim>& model;
  const std::vector<Placement<Dim>>&from, &to;

  bool counts(int body) const {
    const Body<Dim>& of = model.bodies[body];
    return of.present && !of.fixed && !of.parts.empty();
  }
  Vector<Dim> place(int body) const { return model.bodies[body].reference + from[body].displacement; }
  Vector<Dim> place_after(int body) const { return model.bodies[body].reference + to[body].displacement; }
  RigidMotion<Dim> motion(int body) const {
    return {place(body), to[body].displacement - from[body].displacement,
            matrix(to[body].rotation) * matrix(from[body].rotation).transpose()};
  }
  template <class Act>
  void for_corners(int body, const Act& act) const {
    const Matrix<Dim> axes = matrix(from[body].rotation);
    for (const Polytope<Dim>& part : model.bodies[body].parts)
      for (const Vector<Dim>& vertex : part.vertices)
        act(Vector<Dim>(place(body) + axes * vertex));
  }
  double farthest_way(int body) const {
    const RigidMotion<Dim> rigid = motion(body);
    double farthest = 0;
    for_corners(body, [&](const Vector<Dim>& x) { farthest = std::max(farthest, rigid.way(x).norm()); });
    return farthest;
  }
};

// the motion of two bodies at a contact that they had before, or have afterwards
template <int Dim>
struct FaceMotion {
  int a = 0, b = 0, joint = no_joint;  // bodies
  Vector<Dim> place, normal;           // m, before; unit, from a to b
  double slip = 0, opening = 0;        // m
  double force = 0;                    // N, normal, afterwards
};

template <int Dim>
std::vector<FaceMotion<Dim>> face_motions(const BodyMotions<Dim>& motions, const ContactsState<Dim>& before,
                                          const ContactsState<Dim>& after) {
  const Model<Dim>& model = motions.model;
  std::map<std::pair<int, int>, FaceMotion<Dim>> faces;
  const auto add = [&](const Contact<Dim>& c, bool was) {
    FaceMotion<Dim> face{.a = model.parts[c.part_a].body, .b = model.parts[c.part_b].body, .joint = c.joint};
    const RigidMotion<Dim> of_a = motions.motion(face.a), of_b = motions.motion(face.b);
    const Vector<Dim> point = (was ? motions.place(face.a) : motions.place_after(face.a)) + c.geometry.point;
    const Vector<Dim> apart =
        was ? Vector<Dim>(of_b.way(point) - of_a.way(point)) : Vector<Dim>(of_b.way_to(point) - of_a.way_to(point));
    face.place = was ? point : Vector<Dim>(point - of_b.way_to(point));
    face.normal = c.geometry.normal;
    face.opening = apart.dot(face.normal);
    face.slip = (apart - face.opening * face.normal).norm();
    faces.emplace(std::pair(c.part_a, c.part_b), face);
  };
  for (const Contact<Dim>& c : before.list)
    if (c.touching()) add(c, true);
  for (const Contact<Dim>& c : after.list) {
    if (!c.touching()) continue;
    add(c, false);
    faces.at({c.part_a, c.part_b}).force = std::max(0.0, c.force.dot(c.geometry.normal));
  }
  std::vector<FaceMotion<Dim>> list;
  for (auto& [parts, face] : faces)
    list.push_back(face);
  return list;
}

template <int Dim>
struct ClusterGroup {
  std::vector<int> bodies;
  RigidMotion<Dim> motion;  // of its centroid, by the mean of its bodies
  Spin<Dim> turn = Spin<Dim>::Zero();
  double farthest = 0, turning = 0;  // m: largest way of a corner, and by its rotation alone
  double size = 0;                   // m: distance of the corner that is farthest from the centroid
  std::vector<FaceMotion<Dim>> faces{};
};

template <int Dim>
bool moves_alike(const BodyMotions<Dim>& motions, const RigidMotion<Dim>& motion, double way, int body) {
  const RigidMotion<Dim> own = motions.motion(body);
  double apart = 0;
  motions.for_corners(body,
                      [&](const Vector<Dim>& x) { apart = std::max(apart, (own.way(x) - motion.way(x)).norm()); });
  return apart <= same_motion * way;
}

// from the heaviest body, over bodies that are near each other
template <int Dim>
std::vector<ClusterGroup<Dim>> gather_clusters(const BodyMotions<Dim>& motions, std::vector<int> moving,
                                               const ContactsState<Dim>& before, const ContactsState<Dim>& after) {
  const Model<Dim>& model = motions.model;
  std::vector<char> waits(model.bodies.size(), false);
  for (const int body : moving)
    waits[body] = true;
  std::map<int, std::vector<int>> near;
  for (const ContactsState<Dim>* contacts : {&before, &after})
    for (const Contact<Dim>& c : contacts->list) {
      const int a = model.parts[c.part_a].body, b = model.parts[c.part_b].body;
      if (c.status == ContactStatus::apart || !waits[a] || !waits[b]) continue;
      near[a].push_back(b);
      near[b].push_back(a);
    }
  std::ranges::stable_sort(moving, std::ranges::greater{}, [&](int body) { return model.bodies[body].mass; });
  std::vector<ClusterGroup<Dim>> clusters;
  for (const int first : moving) {
    if (!waits[first]) continue;
    const RigidMotion<Dim> motion = motions.motion(first);
    const double way = motions.farthest_way(first);
    std::vector<int> found{first};
    waits[first] = false;
    for (std::size_t k = 0; k < found.size(); ++k)
      for (const int next : near[found[k]]) {
        if (!waits[next] || !moves_alike(motions, motion, way, next)) continue;
        waits[next] = false;
        found.push_back(next);
      }
    std::ranges::sort(found);
    clusters.push_back({.bodies = std::move(found)});
  }
  return clusters;
}

template <int Dim>
void fit_motion(const BodyMotions<Dim>& motions, ClusterGroup<Dim>& cluster) {
  double mass = 0;
  RigidMotion<Dim>& mean = cluster.motion;
  for (const int body : cluster.bodies) {
    const double m = motions.model.bodies[body].mass;
    mass += m;
    mean.centre += m * motions.place(body);
    mean.by += m * (motions.to[body].displacement - motions.from[body].displacement);
    cluster.turn += m * turn_vector(motions.from[body].rotation, motions.to[body].rotation);
  }
  mean.centre /= mass;
  mean.by /= mass;
  cluster.turn /= mass;
  mean.turn = matrix(turned(Rotation<Dim>{}, cluster.turn));
  for (const int body : cluster.bodies)
    motions.for_corners(body, [&](const Vector<Dim>& x) {
      cluster.farthest = std::max(cluster.farthest, mean.way(x).norm());
      cluster.turning = std::max(cluster.turning, (mean.way(x) - mean.by).norm());
      cluster.size = std::max(cluster.size, (x - mean.centre).norm());
    });
}

template <int Dim>
std::vector<double> numbers_of(const Vector<Dim>& v) {
  return {v.data(), v.data() + Dim};
}

template <int Dim>
void describe_joints(const Model<Dim>& model, const ClusterGroup<Dim>& cluster, MovingCluster& row) {
  std::map<int, MovingJoint> joints;
  double forces = 0;
  for (const FaceMotion<Dim>& face : cluster.faces) {
    MovingJoint& joint = joints[face.joint];
    if (face.joint != no_joint) joint.joint = model.joints[face.joint].name;
    joint.slip = std::max(joint.slip, face.slip);
    joint.opening = std::max(joint.opening, face.opening);
    joint.force += face.force;
    forces += face.force;
  }
  const double little = same_motion * cluster.farthest;
  for (auto& [number, joint] : joints) {
    joint.carries = joint.force > carrying_share * forces;
    joint.slips = joint.slip > little;
    joint.opens = joint.opening > little;
    row.joints.push_back(joint);
  }
  std::ranges::stable_sort(row.joints, std::ranges::greater{}, &MovingJoint::force);
}

// whether it slides on two joints that are not parallel
template <int Dim>
bool slides_along_line(const ClusterGroup<Dim>& cluster, const MovingCluster& row, const Model<Dim>& model) {
  if (Dim == 2) return false;
  std::map<std::string, Vector<Dim>> normals;
  for (const FaceMotion<Dim>& face : cluster.faces)
    if (face.joint != no_joint) normals.emplace(model.joints[face.joint].name, face.normal);
  std::vector<Vector<Dim>> slipping;
  for (const MovingJoint& joint : row.joints)
    if (joint.slips && joint.carries) {
      if (!normals.contains(joint.joint)) return false;
      slipping.push_back(normals.at(joint.joint));
    }
  if (slipping.size() != 2) return false;
  const double cosine = slipping[0].dot(slipping[1]);
  return 1 - cosine * cosine > least_oblique * least_oblique;
}

// The corner, of a face at which the cluster is carried, that its motion leaves nearest to its place; nothing if it
// moves as well.
template <int Dim>
std::optional<Vector<Dim>> pivot_of(const BodyMotions<Dim>& motions, const ClusterGroup<Dim>& cluster) {
  std::optional<Vector<Dim>> pivot;
  double least = same_motion * cluster.farthest;
  for (const FaceMotion<Dim>& face : cluster.faces) {
    if (!(face.force > 0)) continue;
    for (const int body : {face.a, face.b})
      motions.for_corners(body, [&](const Vector<Dim>& x) {
        const double way = cluster.motion.way(x).norm();
        if (way > least || std::abs((x - face.place).dot(face.normal)) > on_face * cluster.size ||
            (x - cluster.motion.centre).norm() > (1 + on_face) * cluster.size)
          return;
        least = way;
        pivot = x;
      });
  }
  return pivot;
}

Vector<2> point_of_axis(const ClusterGroup<2>& cluster) {
  const RigidMotion<2>& m = cluster.motion;
  const Matrix<2> change = m.turn - Matrix<2>::Identity();
  return m.centre - change.inverse() * m.by;
}
Vector<3> point_of_axis(const ClusterGroup<3>& cluster) {
  const double angle = cluster.turn.norm();
  return cluster.motion.centre + (cluster.turn / angle).cross(cluster.motion.by) / angle;
}

// the top stays behind the centroid
template <int Dim>
bool turns_back(const Model<Dim>& model, const ClusterGroup<Dim>& cluster) {
  const double g = model.gravity.norm();
  const Vector<Dim> up = g > 0 ? Vector<Dim>(-model.gravity / g) : Vector<Dim>(Vector<Dim>::Unit(Dim - 1));
  const Vector<Dim> level = cluster.motion.by - cluster.motion.by.dot(up) * up;
  return cross(cluster.turn, up).dot(level) < 0;
}

template <int Dim>
void describe_rotation(const BodyMotions<Dim>& motions, const ClusterGroup<Dim>& cluster, bool slips,
                       MovingCluster& row) {
  const Model<Dim>& model = motions.model;
  const std::optional<Vector<Dim>> pivot = pivot_of(motions, cluster);
  const Vector<Dim> about = pivot ? *pivot : point_of_axis(cluster);
  row.at_edge = pivot.has_value();
  row.about = numbers_of<Dim>(model.origin + about);
  if constexpr (Dim == 3) row.axis = numbers_of<Dim>(cluster.turn.normalized());
  if (pivot)
    row.motion = (cluster.motion.centre - about).dot(model.gravity) < 0 ? FailureMotion::topples : FailureMotion::turns;
  else if (!slips)
    row.motion = FailureMotion::turns;
  else
    row.motion = turns_back(model, cluster) ? FailureMotion::slumps : FailureMotion::slides_and_turns;
}

template <int Dim>
MovingCluster describe(const BodyMotions<Dim>& motions, const ClusterGroup<Dim>& cluster, double free_mass) {
  const Model<Dim>& model = motions.model;
  MovingCluster row;
  row.bodies = cluster.bodies;
  double mass = 0;
  for (const int body : cluster.bodies) {
    row.volume += volume(model.bodies[body]);
    mass += model.bodies[body].mass;
  }
  row.weight = mass * model.gravity.norm();
  row.free_share = mass / free_mass;
  row.displacement = cluster.motion.by.norm();
  row.farthest = cluster.farthest;
  std::tie(row.plunge, row.trend) = plunge_and_trend<Dim>(cluster.motion.by);
  row.turn = to_degrees(Dim == 2 ? cluster.turn[0] : cluster.turn.norm());
  describe_joints(model, cluster, row);
  row.along_line = slides_along_line(cluster, row, model);
  const bool slips =
      std::ranges::any_of(row.joints, [](const MovingJoint& joint) { return joint.carries && joint.slips; });
  if (cluster.turning > same_motion * cluster.farthest)
    describe_rotation(motions, cluster, slips, row);
  else if (slips)
    row.motion = FailureMotion::slides;
  else
    row.motion = cluster.motion.by.dot(model.gravity) >= std::cos(45 * degree) * row.displacement * model.gravity.norm()
                     ? FailureMotion::falls
                     : FailureMotion::lifts;
  return row;
}

}  // namespace

template <int Dim>
std::vector<int> moving_set(const Model<Dim>& model, const std::vector<Placement<Dim>>& from,
                            const std::vector<Placement<Dim>>& to) {
  const BodyMotions<Dim> motions{model, from, to};
  std::vector<double> ways(from.size(), 0);
  double farthest = 0;
  for (int b = 0; b < static_cast<int>(from.size()); ++b) {
    if (!motions.counts(b)) continue;
    ways[b] = motions.farthest_way(b);
    farthest = std::max(farthest, ways[b]);
  }
  std::vector<int> moving;
  for (int b = 0; b < static_cast<int>(from.size()); ++b)
    if (ways[b] > 0 && ways[b] >= moving_way * farthest) moving.push_back(b);
  return moving;
}

template <int Dim>
FailureMechanism find_mechanism(const Model<Dim>& model, const std::vector<Placement<Dim>>& from,
                                const ContactsState<Dim>& before, const std::vector<Placement<Dim>>& to,
                                const ContactsState<Dim>& after) {
  FailureMechanism mechanism;
  mechanism.dimension = Dim;
  const BodyMotions<Dim> motions{model, from, to};
  const std::vector<int> moving = moving_set(model, from, to);
  if (moving.empty()) return mechanism;
  double free_mass = 0;
  for (int b = 0; b < static_cast<int>(from.size()); ++b)
    if (motions.counts(b)) free_mass += model.bodies[b].mass;
  const std::vector<FaceMotion<Dim>> faces = face_motions(motions, before, after);
  std::vector<ClusterGroup<Dim>> clusters = gather_clusters(motions, moving, before, after);
  std::vector<int> cluster_of(from.size(), -1);
  for (std::size_t k = 0; k < clusters.size(); ++k)
    for (const int body : clusters[k].bodies)
      cluster_of[body] = static_cast<int>(k);
  for (const FaceMotion<Dim>& face : faces) {
    const int a = cluster_of[face.a], b = cluster_of[face.b];
    if (a == b) continue;
    if (a >= 0) clusters[a].faces.push_back(face);
    if (b >= 0) clusters[b].faces.push_back(face);
  }
  for (ClusterGroup<Dim>& cluster : clusters) {
    fit_motion(motions, cluster);
    mechanism.clusters.push_back(describe(motions, cluster, free_mass));
    mechanism.free_share += mechanism.clusters.back().free_share;
  }
  std::ranges::stable_sort(mechanism.clusters, std::ranges::greater{}, &MovingCluster::weight);
  return mechanism;
}

template <int Dim>
std::optional<BondsOfMotion> bonds_of_motion(long long broken_before, const State<Dim>& now) {
  const BondCount bonds = count_bonds(now.contacts, now.ledger.bonds);
  const BondsOfMotion motion{bonds.broken - broken_before, bonds.slipped, bonds.whole};
  if (motion.broken + motion.slipped + motion.whole == 0) return {};
  return motion;
}

template std::optional<BondsOfMotion> bonds_of_motion<2>(long long, const State<2>&);
template std::optional<BondsOfMotion> bonds_of_motion<3>(long long, const State<3>&);
template std::vector<int> moving_set<2>(const Model<2>&, const std::vector<Placement<2>>&,
                                        const std::vector<Placement<2>>&);
template std::vector<int> moving_set<3>(const Model<3>&, const std::vector<Placement<3>>&,
                                        const std::vector<Placement<3>>&);
template FailureMechanism find_mechanism<2>(const Model<2>&, const std::vector<Placement<2>>&, const ContactsState<2>&,
                                            const std::vector<Placement<2>>&, const ContactsState<2>&);
template FailureMechanism find_mechanism<3>(const Model<3>&, const std::vector<Placement<3>>&, const ContactsState<3>&,
                                            const std::vector<Placement<3>>&, const ContactsState<3>&);

}  // namespace voussoir
