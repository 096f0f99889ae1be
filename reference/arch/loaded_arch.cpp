#include "reference/arch/loaded_arch.hpp"

#include <array>
#include <limits>
#include <numbers>

#include "reference/arch/equilibria.hpp"

namespace voussoir::reference {
namespace {

using std::numbers::pi;

// --- rigid voussoirs

Plane direction(const LoadedArch& loaded, int joint) {
  const double angle = joint * pi / loaded.arch.voussoirs - 0.5 * pi;
  return {std::sin(angle), std::cos(angle)};
}

Plane place_of(const LoadedArch& loaded, const Hinge& hinge) {
  const double half = 0.5 * loaded.thickness;
  return (loaded.arch.radius + (hinge.outside ? half : -half)) * direction(loaded, hinge.joint);
}

// vertical forces to the left of each joint: the weights, their moment about the centre, and whether the load is there
struct Left {
  double weight = 0, moment = 0;
  bool loaded = false;
};

std::vector<Left> left_of_joints(const LoadedArch& loaded) {
  const Voussoir voussoir = voussoir_of(loaded.arch, loaded.thickness);
  const int under = loaded_point(loaded).voussoir;
  std::vector<Left> left(1);
  for (int k = 0; k < loaded.arch.voussoirs; ++k) {
    const double angle = (k + 0.5) * pi / loaded.arch.voussoirs - 0.5 * pi;
    left.push_back({left.back().weight + voussoir.weight,
                    left.back().moment + voussoir.weight * voussoir.centroid * std::sin(angle), k >= under});
  }
  return left;
}

// the load that turns the arch about these hinges; infinite if they make no mechanism that the load drives
double load_on(const LoadedArch& loaded, const std::vector<Left>& left, const std::array<Hinge, 4>& hinges) {
  std::array<Plane, 4> at;
  for (int i = 0; i < 4; ++i)
    at[i] = place_of(loaded, hinges[i]);
  // the chain of the three bodies, each turning at a rate, must close
  const Plane a = at[1] - at[0], b = at[2] - at[1], c = at[3] - at[2];
  const std::array<double, 3> rate{cross(b, c), cross(c, a), cross(a, b)};
  constexpr double none = std::numeric_limits<double>::infinity();

  // work of a unit load and of the weights, body by body; a body's first hinge rises by the motion of the bodies before
  // it
  double of_load = 0, of_weights = 0, rises = 0;
  for (int i = 0; i < 3; ++i) {
    const Left &from = left[hinges[i].joint], &to = left[hinges[i + 1].joint];
    const double weight = to.weight - from.weight, moment = to.moment - from.moment;
    of_weights -= weight * rises + rate[i] * (moment - weight * at[i].x());
    if (to.loaded && !from.loaded) of_load -= rises + rate[i] * (loaded.x - at[i].x());
    rises += rate[i] * (at[i + 1].x() - at[i].x());
  }
  if (of_load == 0) return none;
  const double sense = of_load > 0 ? 1 : -1;
  for (int i = 0; i < 4; ++i) {
    // turning counter-clockwise against the body before it opens a joint that is hinged outside
    const double opens = sense * ((i < 3 ? rate[i] : 0) - (i > 0 ? rate[i - 1] : 0));
    if (!(hinges[i].outside ? opens > 0 : opens < 0)) return none;
  }
  return -of_weights / of_load;
}

// the force of the left abutment, and where the line through three of the hinges crosses each joint
void add_thrust_line(const LoadedArch& loaded, const std::vector<Left>& left, RigidLoad& found) {
  Eigen::Matrix3d moments;  // of horizontal and vertical force at the centre and of a moment, about each hinge
  Eigen::Vector3d of_loads;
  const auto vertical = [&](int joint) { return left[joint].weight + (left[joint].loaded ? found.load : 0); };
  const auto moment = [&](int joint) { return left[joint].moment + (left[joint].loaded ? found.load * loaded.x : 0); };
  for (int i = 0; i < 3; ++i) {
    const int joint = found.hinges[i].joint;
    const Plane p = place_of(loaded, found.hinges[i]);
    moments.row(i) << p.y(), -p.x(), 1;
    of_loads[i] = moment(joint) - vertical(joint) * p.x();
  }
  const Eigen::Vector3d given = moments.fullPivLu().solve(of_loads);
  found.thrust = given[0];
  found.margin = std::numeric_limits<double>::infinity();
  for (int joint = 0; joint <= loaded.arch.voussoirs; ++joint) {
    const Plane force(given[0], given[1] - vertical(joint));
    const double radius = (given[2] - moment(joint)) / cross(direction(loaded, joint), force);
    found.radius.push_back(radius);
    found.margin = std::min(found.margin, 0.5 * loaded.thickness - std::abs(radius - loaded.arch.radius));
  }
}

// --- elastic joints

// The whole arch. Unknowns: thrust, upward force at the right springing and load over the weight, crossing at the right
// springing over the radius.
struct Whole {
  LoadedArch loaded;
  ArchJoints joints;
  double weight = 0;
  LoadedPoint under;

  double load(const Shot& s) const { return s.from[3] * weight; }
  double drop(const Shot& s) const { return -s.march.loaded.way_of({under.point.x, under.point.y}).y(); }

  std::optional<Shot> shoot(const Eigen::VectorXd& x) const {
    const Arch& arch = loaded.arch;
    const FootForce foot{weight * Plane(-x[0], x[1]), x[2] * arch.radius};
    const PointLoad point{under.voussoir, {under.point.x, under.point.y}, x[3] * weight};
    const std::optional<March> marched = march(arch, joints, loaded.thickness, foot, arch.voussoirs, point);
    return marched ? std::optional(Shot{x, *marched}) : std::nullopt;
  }

  // the left abutment must stay in its place, and the fourth condition vanish
  template <class Condition>
  std::optional<Shot> find(const Eigen::VectorXd& from, const Condition& condition) const {
    return solve(
        loaded.arch, from, [&](const Eigen::VectorXd& x) { return shoot(x); },
        [&](const Shot& s) -> Eigen::VectorXd {
          const Moved& abutment = s.march.beyond;
          return Eigen::Vector4d(abutment.turn, abutment.place.x() / loaded.arch.radius,
                                 abutment.place.y() / loaded.arch.radius, condition(s));
        });
  }

  std::optional<Shot> with_load(double wanted, const Eigen::VectorXd& from) const {
    return find(from, [&](const Shot& s) { return (load(s) - wanted) / weight; });
  }

  std::optional<Shot> with_drop(double wanted, const Eigen::VectorXd& from) const {
    return find(from, [&](const Shot& s) { return (drop(s) - wanted) / loaded.arch.radius; });
  }

  ElasticLoad described(const Shot& s) const {
    return {load(s), drop(s), s.from[0] * weight, {s.march.joints.rbegin(), s.march.joints.rend()}};
  }
};

// equilibria, and how far the loaded point has dropped under the load alone
struct Path {
  std::vector<Shot> shots;
  double without = 0;  // m: its drop under the arch's own weight
};

// until `ends` is true of the last and of the greatest load so far
template <class End>
Path path_of(const Whole& whole, const End& ends) {
  constexpr double begin = 0.02;  // of the capacity of rigid voussoirs
  const double rigid = greatest_rigid_load(whole.loaded).load, radius = whole.loaded.arch.radius;
  const ElasticArch alone = elastic_arch(whole.loaded.arch, whole.joints, whole.loaded.thickness);
  const Eigen::Vector4d guess(alone.thrust / whole.weight, 0.5, alone.joints.front().crossing / radius, 0);
  const std::optional<Shot> unloaded = whole.with_load(0, guess), first = whole.with_load(begin * rigid, guess);
  if (!unloaded || !first) throw std::runtime_error("loaded arch: without a load it has no equilibrium");
  double most = 0;
  Path path{{}, whole.drop(*unloaded)};
  path.shots = follow(
      *first, [&](const Shot& s) { return whole.drop(s) - path.without; },
      [&](double drop, const Eigen::VectorXd& near) { return whole.with_drop(path.without + drop, near); },
      [&](const Shot& last) {
        most = std::max(most, whole.load(last));
        return ends(whole.load(last), most);
      });
  return path;
}

Whole whole_of(const LoadedArch& loaded, const ArchJoints& joints) {
  return {loaded, joints, loaded.arch.voussoirs * voussoir_of(loaded.arch, loaded.thickness).weight,
          loaded_point(loaded)};
}

}  // namespace

LoadedPoint loaded_point(const LoadedArch& loaded) {
  for (int k = 0; k < loaded.arch.voussoirs; ++k) {
    const std::vector<Corner> c = voussoir_corners(loaded.arch, loaded.thickness, k);
    const Corner &left = c[3], &right = c[2];
    if (loaded.x < left.x || loaded.x > right.x) continue;
    const double share = (loaded.x - left.x) / (right.x - left.x);
    return {k, {loaded.x, left.y + share * (right.y - left.y)}};
  }
  throw std::invalid_argument("loaded arch: the load is outside the arch");
}

RigidLoad greatest_rigid_load(const LoadedArch& loaded) {
  const std::vector<Left> left = left_of_joints(loaded);
  const int last = loaded.arch.voussoirs;
  RigidLoad found;
  found.load = std::numeric_limits<double>::infinity();
  std::array<Hinge, 4> hinges;
  for (int ends = 0; ends < 16; ++ends)
    for (int a = 0; a <= last; ++a)
      for (int b = a + 1; b <= last; ++b)
        for (int c = b + 1; c <= last; ++c)
          for (int d = c + 1; d <= last; ++d) {
            hinges = {{{a, (ends & 1) > 0}, {b, (ends & 2) > 0}, {c, (ends & 4) > 0}, {d, (ends & 8) > 0}}};
            const double load = load_on(loaded, left, hinges);
            if (load >= found.load) continue;
            found.load = load;
            found.hinges.assign(hinges.begin(), hinges.end());
          }
  if (!(found.load > 0) || found.hinges.empty())
    throw std::invalid_argument("loaded arch: it has no equilibrium without a load, or supports any load");
  add_thrust_line(loaded, left, found);
  return found;
}

std::vector<ElasticLoad> elastic_load_path(const LoadedArch& loaded, const ArchJoints& joints, double beyond) {
  const Whole whole = whole_of(loaded, joints);
  std::vector<ElasticLoad> path;
  for (const Shot& s : path_of(whole, [&](double load, double most) { return load < (1 - beyond) * most; }).shots)
    path.push_back(whole.described(s));
  return path;
}

ElasticLoad elastic_load(const LoadedArch& loaded, const ArchJoints& joints, double load) {
  const Whole whole = whole_of(loaded, joints);
  const Path path = path_of(whole, [&](double last, double most) { return last >= load || last < most; });
  const std::size_t before = path.shots.size() > 1 ? path.shots.size() - 2 : 0;
  const std::optional<Shot> found = whole.with_load(load, path.shots[before].from);
  if (whole.load(path.shots.back()) < load || !found)
    throw std::runtime_error("loaded arch: it does not support so large a load");
  return whole.described(*found);
}

ElasticLoad greatest_elastic_load(const LoadedArch& loaded, const ArchJoints& joints) {
  const Whole whole = whole_of(loaded, joints);
  const Path path = path_of(whole, [](double load, double most) { return load < 0.999 * most; });
  return whole.described(greatest_along(
      path.shots, [&](const Shot& s) { return whole.load(s); },
      [&](const Shot& s) { return whole.drop(s) - path.without; },
      [&](double drop, const Eigen::VectorXd& near) { return whole.with_drop(path.without + drop, near); }));
}

}  // namespace voussoir::reference
