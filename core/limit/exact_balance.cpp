#include "core/limit/exact_balance.hpp"

#include <Eigen/Cholesky>
#include <limits>
#include <queue>

namespace voussoir {
namespace {

constexpr int digits_of_forces = 60;  // binary, of the lighter body's weight: those of corners outside the tree
constexpr int digits_of_closing = 120;
constexpr int most_digits = 900;  // loads of very different size need more
constexpr double little_less = 1 - 4 * std::numeric_limits<double>::epsilon();

template <int Dim>
double lighter_weight(const CornerAssembly<Dim>& assembly, const CornerFace<Dim>& face) {
  double least = std::numeric_limits<double>::infinity();
  for (const int b : {face.body_a, face.body_b})
    if (assembly.bodies[b].moves()) least = std::min(least, assembly.bodies[b].weight);
  return least;
}

template <int Dim>
bool smooth(const CornerFace<Dim>& face) {
  return !(face.friction > 0) && !(face.cohesion > 0);
}

// of corners p1, …: what their forces can resist, in two directions at least
double spread(const std::array<Vector<2>, 2>& p) {
  return (p[1] - p[0]).norm();
}

double spread(const std::array<Vector<3>, 3>& p) {
  return std::sqrt(0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm());
}

// Calls act(corners) for every choice of two ends, or of three corners.
template <class Act>
void for_choices(std::array<int, 2>, int, const Act& act) {
  act(std::array<int, 2>{0, 1});
}

template <class Act>
void for_choices(std::array<int, 3>, int count, const Act& act) {
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j)
      for (int k = j + 1; k < count; ++k)
        act(std::array<int, 3>{i, j, k});
}

Integer rounded_quotient(const Integer& a, const Integer& positive) {
  const Integer twice = 2 * a + positive, divisor = 2 * positive;
  return twice >= 0 ? Integer(twice / divisor) : Integer(-((divisor - 1 - twice) / divisor));
}

// greatest common divisor of a and b as a·x + b·y
struct CommonDivisor {
  Integer divisor, x, y;
};

CommonDivisor common_divisor(const Integer& a, const Integer& b) {
  CommonDivisor last{a, 1, 0}, next{b, 0, 1};
  while (!next.divisor.is_zero()) {
    const Integer times = last.divisor / next.divisor;
    last = {last.divisor - times * next.divisor, last.x - times * next.x, last.y - times * next.y};
    std::swap(last, next);
  }
  if (last.divisor < 0) last = {-last.divisor, -last.x, -last.y};
  return last;
}

// u with u·v = 1; only if the numbers of v have no common divisor
template <std::size_t Size>
std::optional<Numbers<Integer, Size>> inverse(const Numbers<Integer, Size>& v) {
  Numbers<Integer, Size> u{};
  u[0] = 1;
  Integer divisor = v[0];
  for (std::size_t k = 1; k < Size; ++k) {
    const CommonDivisor both = common_divisor(divisor, v[k]);
    for (std::size_t i = 0; i < k; ++i)
      u[i] *= both.x;
    u[k] = both.y;
    divisor = both.divisor;
  }
  if (divisor == -1) return Integer(-1) * u;
  if (divisor != 1) return std::nullopt;
  return u;
}

// The forces at the two ends of a face, or at three corners of one, with a given resultant: p2 - p1, … as integers.
template <int Dim>
struct Lattice;

template <>
struct Lattice<2> {
  Numbers<Integer, 2> along, across;  // cross(along, across) = 1

  static std::optional<Lattice> of(const std::array<Numbers<Integer, 2>, 1>& edges) {
    const auto u = inverse(edges[0]);
    if (!u) return std::nullopt;
    return Lattice{edges[0], {-(*u)[1], (*u)[0]}};
  }
  // the force at p2 with a moment about p1, near `wanted`
  std::array<Numbers<Integer, 2>, 1> close(const Numbers<Integer, 1>& of_moment,
                                           const std::array<Numbers<Integer, 2>, 1>& wanted) const {
    Numbers<Integer, 2> more = Integer(of_moment[0] - moment(along, wanted[0])[0]) * across;
    more = more - rounded_quotient(product(more, along), product(along, along)) * along;
    return {wanted[0] + more};
  }
};

template <>
struct Lattice<3> {
  Numbers<Integer, 3> second, third, normal, along_normal, along_third;  // normal·along_normal = 1, third·…: too

  static std::optional<Lattice> of(const std::array<Numbers<Integer, 3>, 2>& edges) {
    const Numbers<Integer, 3> normal = outer(edges[1], edges[0]);
    const auto of_normal = inverse(normal), of_third = inverse(edges[1]);
    if (!of_normal || !of_third) return std::nullopt;
    return Lattice{edges[0], edges[1], normal, *of_normal, *of_third};
  }
  // The forces at p2 and p3 with a moment about p1, near `wanted`. The moment along p3 - p1 is that of the force at p2
  // alone; the rest Q is perpendicular to third, and third × (Q × u) = Q for any u with u·third = 1.
  std::array<Numbers<Integer, 3>, 2> close(const Numbers<Integer, 3>& of_moment,
                                           const std::array<Numbers<Integer, 3>, 2>& wanted) const {
    Numbers<Integer, 3> more = Integer(product(of_moment, third) - product(wanted[0], normal)) * along_normal;
    const Integer s = product(second, second), t = product(third, third), st = product(second, third),
                  det = s * t - st * st, of_second = product(more, second), of_third = product(more, third);
    more = more - rounded_quotient(of_second * t - of_third * st, det) * second -
           rounded_quotient(of_third * s - of_second * st, det) * third;
    const Numbers<Integer, 3> at_second = wanted[0] + more;
    Numbers<Integer, 3> at_third = outer(of_moment - outer(second, at_second), along_third);
    at_third = at_third - rounded_quotient(product(at_third - wanted[1], third), t) * third;
    return {at_second, at_third};
  }
};

// an edge of the tree, from a held or reached body
template <int Dim>
struct TreeEdge {
  double quality = 0;  // the least slack of its corners, of the lighter body's weight, and how far they are apart
  int face = 0, body = 0;
  std::array<int, Dim> corners{};

  bool operator<(const TreeEdge& other) const {
    return quality != other.quality ? quality < other.quality : face > other.face;
  }
};

template <int Dim>
class Closing {
 public:
  Closing(CornerAssembly<Dim>& assembly, int grid, const CornerForces<Dim>& forces)
      : assembly_(assembly), grid_(grid), forces_(forces) {}

  std::optional<BalancedForces<Dim>> close(const Loads<Dim>& dead, const Loads<Dim>& live, double factor) {
    if (!plant() || !move_corners() || !find_unit(dead, live, factor)) return std::nullopt;
    round_forces();
    left_.assign(assembly_.bodies.size(), {});
    moments_.assign(assembly_.bodies.size(), {});
    const Dyadic of_live(factor);
    for (std::size_t b = 0; b < left_.size(); ++b) {
      if (!assembly_.bodies[b].moves()) continue;
      const auto force = exact_of<Dim>(dead[b].force) + of_live * exact_of<Dim>(live[b].force);
      const auto turn =
          exact_of<spin_freedoms<Dim>>(dead[b].moment) + of_live * exact_of<spin_freedoms<Dim>>(live[b].moment);
      for (int k = 0; k < Dim; ++k)
        left_[b][k] = force[k].in_units(found_.unit);
      for (int k = 0; k < spin_freedoms<Dim>; ++k)
        moments_[b][k] = turn[k].in_units(found_.unit + grid_);
    }
    for (std::size_t f = 0; f < assembly_.faces.size(); ++f)
      for (std::size_t k = 0; k < assembly_.faces[f].corners.size(); ++k)
        put(assembly_.faces[f], k, found_.at_corners[f][k]);
    for (std::size_t k = order_.size(); k-- > 0;)
      close_edge(order_[k], lattices_[k]);
    return std::move(found_);
  }

 private:
  using Force = Numbers<Integer, Dim>;
  static constexpr int others = Dim - 1;  // corners of an edge besides the first

  Force place(const Vector<Dim>& of) const {
    const auto numbers = exact_of<Dim>(of);
    Force place;
    for (int k = 0; k < Dim; ++k)
      place[k] = numbers[k].in_units(grid_);
    return place;
  }

  TreeEdge<Dim> edge_of(int f) const {
    const CornerFace<Dim>& face = assembly_.faces[f];
    TreeEdge<Dim> best{0, f, 0, {}};
    if (smooth(face)) return best;
    const double weight = lighter_weight(assembly_, face), tangent = std::tan(face.friction);
    double radius = std::numeric_limits<double>::infinity();
    for (const int b : {face.body_a, face.body_b})
      if (assembly_.bodies[b].moves()) radius = std::min(radius, assembly_.bodies[b].radius);
    const std::vector<double> cohesion = cohesion_at_corners(face);
    std::vector<double> slack;
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      const double normal = forces_[f][k].dot(face.normal);
      const double shear = (forces_[f][k] - normal * face.normal).norm();
      slack.push_back(std::min(normal, tangent * normal + cohesion[k] - shear) / weight);
    }
    for_choices(std::array<int, Dim>{}, static_cast<int>(slack.size()), [&](const std::array<int, Dim>& corners) {
      std::array<Vector<Dim>, Dim> places;
      double least = std::numeric_limits<double>::infinity();
      for (int k = 0; k < Dim; ++k) {
        places[k] = face.corners[corners[k]];
        least = std::min(least, slack[corners[k]]);
      }
      const double far = std::min(1.0, spread(places) / radius), quality = least * far * far;
      if (quality > best.quality) best = {quality, f, 0, corners};
    });
    return best;
  }

  // the tree of largest quality from all held bodies
  bool plant() {
    std::vector<std::vector<TreeEdge<Dim>>> leading(assembly_.bodies.size());
    for (std::size_t f = 0; f < assembly_.faces.size(); ++f) {
      TreeEdge<Dim> edge = edge_of(static_cast<int>(f));
      if (!(edge.quality > 0)) continue;
      const int a = assembly_.faces[f].body_a, b = assembly_.faces[f].body_b;
      edge.body = b;
      leading[a].push_back(edge);
      edge.body = a;
      leading[b].push_back(edge);
    }
    std::vector<int> depth(assembly_.bodies.size(), -1);
    std::priority_queue<TreeEdge<Dim>> open;
    const auto reach = [&](std::size_t body, int at) {
      depth[body] = at;
      for (const TreeEdge<Dim>& edge : leading[body])
        open.push(edge);
    };
    for (std::size_t b = 0; b < depth.size(); ++b)
      if (!assembly_.bodies[b].moves()) reach(b, 0);
    while (!open.empty()) {
      const TreeEdge<Dim> edge = open.top();
      open.pop();
      if (depth[edge.body] >= 0) continue;
      const CornerFace<Dim>& face = assembly_.faces[edge.face];
      order_.push_back(edge);
      reach(edge.body, 1 + depth[face.body_a == edge.body ? face.body_b : face.body_a]);
      found_.depth = std::max(found_.depth, depth[edge.body]);
    }
    return std::ranges::none_of(depth, [](int at) { return at < 0; });
  }

  std::optional<Lattice<Dim>> lattice_of(const TreeEdge<Dim>& edge) const {
    const std::vector<Vector<Dim>>& corners = assembly_.faces[edge.face].corners;
    std::array<Force, others> edges;
    for (int k = 0; k < others; ++k)
      edges[k] = place(corners[edge.corners[k + 1]]) - place(corners[edge.corners[0]]);
    return Lattice<Dim>::of(edges);
  }

  // by a unit of the grid at most, until the equations of every edge can be solved in integers
  bool move_corners() {
    constexpr int digits = Dim * others;
    for (const TreeEdge<Dim>& edge : order_) {
      std::vector<Vector<Dim>>& corners = assembly_.faces[edge.face].corners;
      const std::vector<Vector<Dim>> as_stated = corners;
      std::optional<Lattice<Dim>> found = lattice_of(edge);
      int choices = 1;
      for (int k = 0; k < digits; ++k)
        choices *= 3;
      for (int choice = 1; choice < choices && !found; ++choice) {
        corners = as_stated;
        for (int k = 0, rest = choice; k < digits; ++k, rest /= 3)
          corners[edge.corners[1 + k / Dim]][k % Dim] += std::ldexp(rest % 3 == 2 ? -1 : rest % 3, grid_);
        found = lattice_of(edge);
      }
      if (!found) return false;
      lattices_.push_back(*found);
    }
    return true;
  }

  int digits_of(const CornerFace<Dim>& face) const {
    return std::ilogb(lighter_weight(assembly_, face)) - digits_of_forces;
  }

  // of which all loads and forces are multiples
  bool find_unit(const Loads<Dim>& dead, const Loads<Dim>& live, double factor) {
    int unit = 0;
    const auto count = [&](const auto& numbers, int more) {
      for (const double number : numbers)
        if (number != 0) unit = std::min(unit, last_digit(number) + more);
    };
    const int of_factor = factor != 0 ? last_digit(factor) : 0;
    int least = std::numeric_limits<int>::max();
    for (const CornerFace<Dim>& face : assembly_.faces) {
      least = std::min(least, std::ilogb(lighter_weight(assembly_, face)) - digits_of_closing);
      if (smooth(face)) count(face.normal, digits_of(face));
    }
    unit = std::min(unit, least);
    for (std::size_t b = 0; b < dead.size(); ++b) {
      if (!assembly_.bodies[b].moves()) continue;
      count(dead[b].force, 0);
      count(dead[b].moment, -grid_);
      if (factor != 0) count(live[b].force, of_factor);
      if (factor != 0) count(live[b].moment, of_factor - grid_);
    }
    found_.unit = unit;
    return unit > -most_digits;
  }

  // those of smooth faces remain along their normals
  void round_forces() {
    for (std::size_t f = 0; f < assembly_.faces.size(); ++f) {
      const CornerFace<Dim>& face = assembly_.faces[f];
      const int digits = digits_of(face);
      const auto rounded = [&](double number) {
        return Dyadic(std::ldexp(std::round(std::ldexp(number, -digits)), digits));
      };
      found_.at_corners.emplace_back();
      for (const Vector<Dim>& force : forces_[f]) {
        Force on_b;
        const Dyadic normal = rounded(std::max(0.0, force.dot(face.normal)));
        for (int k = 0; k < Dim; ++k)
          on_b[k] = (smooth(face) ? normal * Dyadic(face.normal[k]) : rounded(force[k])).in_units(found_.unit);
        found_.at_corners.back().push_back(on_b);
      }
    }
  }

  // adds a force at a corner to what is left of the loads of both bodies
  void put(const CornerFace<Dim>& face, std::size_t corner, const Force& on_b) {
    for (const bool second : {false, true}) {
      const int body = second ? face.body_b : face.body_a;
      const Force force = second ? on_b : Integer(-1) * on_b;
      left_[body] = left_[body] + force;
      moments_[body] =
          moments_[body] + moment(place(face.corners[corner]) - place(assembly_.bodies[body].centroid), force);
    }
  }

  // The remainder of a body as forces at the edge's corners, near those of the least sum of squares; what is left at
  // freedoms that are held is theirs.
  void close_edge(const TreeEdge<Dim>& edge, const Lattice<Dim>& lattice) {
    const CornerBody<Dim>& body = assembly_.bodies[edge.body];
    const CornerFace<Dim>& face = assembly_.faces[edge.face];
    const Integer sign = face.body_b == edge.body ? -1 : 1;
    Force force = sign * left_[edge.body];
    Numbers<Integer, spin_freedoms<Dim>> turn = sign * moments_[edge.body];
    for (int k = 0; k < Dim; ++k)
      if (!body.free[k]) force[k] = 0;
    for (int k = 0; k < spin_freedoms<Dim>; ++k)
      if (!body.free[Dim + k]) turn[k] = 0;

    const std::array<Vector<Dim>, Dim> wanted = least_forces(edge, force, turn);
    std::array<Force, others> near_to;
    for (int k = 0; k < others; ++k)
      for (int i = 0; i < Dim; ++i)
        near_to[k][i] = static_cast<Integer>(std::round(wanted[k + 1][i]));
    const Force first = place(face.corners[edge.corners[0]]) - place(body.centroid);
    const std::array<Force, others> closing = lattice.close(turn - moment(first, force), near_to);
    const double weight = lighter_weight(assembly_, face);
    Force rest = force;
    const auto add = [&](int k, const Force& more) {
      const std::size_t corner = edge.corners[k];
      found_.at_corners[edge.face][corner] = found_.at_corners[edge.face][corner] + more;
      put(face, corner, more);
      for (const Integer& number : more)
        found_.change =
            std::max(found_.change, std::abs(std::ldexp(static_cast<double>(number), found_.unit)) / weight);
    };
    for (int k = 0; k < others; ++k) {
      add(k + 1, closing[k]);
      rest = rest - closing[k];
    }
    add(0, rest);
  }

  // in units, rounded
  std::array<Vector<Dim>, Dim> least_forces(const TreeEdge<Dim>& edge, const Force& force,
                                            const Numbers<Integer, spin_freedoms<Dim>>& turn) const {
    const CornerBody<Dim>& body = assembly_.bodies[edge.body];
    FixedMatrix<freedoms<Dim>, Dim * Dim> sums;
    for (int k = 0; k < Dim; ++k) {
      const Vector<Dim> arm = assembly_.faces[edge.face].corners[edge.corners[k]] - body.centroid;
      for (int i = 0; i < Dim; ++i) {
        const Vector<Dim> along = Vector<Dim>::Unit(i);
        sums.col(Dim * k + i) << along, voussoir::moment(arm, along) / body.radius;
      }
    }
    Vector<freedoms<Dim>> all;
    for (int k = 0; k < Dim; ++k)
      all[k] = static_cast<double>(force[k]);
    for (int k = 0; k < spin_freedoms<Dim>; ++k)
      all[Dim + k] = std::ldexp(static_cast<double>(turn[k]), grid_) / body.radius;
    const FixedMatrix<freedoms<Dim>, freedoms<Dim>> normal = sums * sums.transpose();
    const Vector<Dim* Dim> least = sums.transpose() * normal.ldlt().solve(all);
    std::array<Vector<Dim>, Dim> forces;
    for (int k = 0; k < Dim; ++k)
      forces[k] = least.template segment<Dim>(Dim * k);
    return forces;
  }

  CornerAssembly<Dim>& assembly_;
  int grid_;
  const CornerForces<Dim>& forces_;
  BalancedForces<Dim> found_;
  std::vector<TreeEdge<Dim>> order_;  // bodies nearer to held ones first
  std::vector<Lattice<Dim>> lattices_;
  std::vector<Force> left_;
  std::vector<Numbers<Integer, spin_freedoms<Dim>>> moments_;
};

}  // namespace

template <int Dim>
std::optional<BalancedForces<Dim>> balance_exactly(CornerAssembly<Dim>& assembly, int grid, const Loads<Dim>& dead,
                                                   const Loads<Dim>& live, double factor,
                                                   const CornerForces<Dim>& forces) {
  return Closing<Dim>(assembly, grid, forces).close(dead, live, factor);
}

template <int Dim>
std::vector<double> cohesion_at_corners(const CornerFace<Dim>& face) {
  std::vector<double> all(face.corners.size(), 0);
  if (!(face.cohesion > 0)) return all;
  const double whole = little_less * face.cohesion * face.area();
  const std::vector<double> shares = face.shares();
  for (std::size_t k = 0; k < all.size(); ++k)
    all[k] = whole * shares[k];
  return all;
}

template std::optional<BalancedForces<2>> balance_exactly(CornerAssembly<2>&, int, const Loads<2>&, const Loads<2>&,
                                                          double, const CornerForces<2>&);
template std::optional<BalancedForces<3>> balance_exactly(CornerAssembly<3>&, int, const Loads<3>&, const Loads<3>&,
                                                          double, const CornerForces<3>&);
template std::vector<double> cohesion_at_corners(const CornerFace<2>&);
template std::vector<double> cohesion_at_corners(const CornerFace<3>&);

}  // namespace voussoir
