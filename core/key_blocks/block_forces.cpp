#include "core/key_blocks/block_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/model/water_surfaces.hpp"

namespace voussoir {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr int halvings = 60;                // of a bracket: to the rounding of its numbers
constexpr double largest_force = 1000;      // of the load
constexpr double first_force = 1.0 / 1024;  // of the load, from which a force is doubled
constexpr int trends = 24;
constexpr int improvements = 50;
constexpr double settled_factor = 1e-13;  // relative fall of a factor that ends its improvement

template <int Dim>
double factor_under(const Block<Dim>& block, const Vector<Dim>& load, const Vector<Dim>& gravity) {
  return judge(block, load, gravity, false).factor().value_or(unlimited);
}

// g - F v/|v|: the change of (resistance - F driving force) with a force
template <int Dim>
Vector<Dim> gradient(const Block<Dim>& block, const Verdict<Dim>& verdict, double factor) {
  Vector<Dim> change = -factor * verdict.direction();
  for (int axis = 0; axis < Dim && verdict.loaded > 0; ++axis) {
    std::array<double, Dim> forces{};
    balance<Dim>(block.normals, verdict.faces, verdict.loaded, Vector<Dim>::Unit(axis), forces);
    for (int k = 0; k < verdict.loaded; ++k)
      change[axis] += forces[k] * block.faces[verdict.faces[k]].friction_slope(verdict.forces[k]);
  }
  return change;
}

template <int Dim>
bool same_faces(const Verdict<Dim>& a, const Verdict<Dim>& b) {
  if (a.kind != b.kind || a.loaded != b.loaded) return false;
  auto first = a.faces, second = b.faces;
  std::sort(first.begin(), first.begin() + a.loaded);
  std::sort(second.begin(), second.begin() + b.loaded);
  return std::equal(first.begin(), first.begin() + a.loaded, second.begin());
}

// the bound between two numbers at which a condition begins to hold
template <class Holds>
double bisect(double without, double with, const Holds& holds) {
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (without + with);
    (holds(middle) ? with : without) = middle;
  }
  return with;
}

template <int Dim>
std::optional<double> size_along(const Block<Dim>& block, const Vector<Dim>& load, double factor,
                                 const Vector<Dim>& direction, const Vector<Dim>& gravity) {
  const auto enough = [&](double size) { return factor_under<Dim>(block, load + size * direction, gravity) >= factor; };
  if (enough(0)) return 0.0;
  const double scale = load.norm();
  for (double size = first_force * scale; size <= largest_force * scale; size *= 2)
    if (enough(size)) return bisect(size > first_force * scale ? size / 2 : 0, size, enough);
  return std::nullopt;
}

Vector<2> along_trend(double angle, const Vector<2>&) {
  return {std::sin(angle) < 0 ? -1.0 : 1.0, 0};
}
Vector<3> along_trend(double angle, const Vector<3>&) {
  return {std::sin(angle), std::cos(angle), 0};
}

// the numbers of a horizontal surface: in space h, 0, 0, in the plane x and h of its points
template <int Dim>
bool is_level(const Water& water, const std::vector<double>& numbers) {
  if (water.uniform) return false;
  if (Dim == 3) return numbers[1] == 0 && numbers[2] == 0;
  for (std::size_t k = 3; k < numbers.size(); k += 2)
    if (numbers[k] != numbers[1]) return false;
  return true;
}

template <int Dim>
void set_level(double level, std::vector<double>& numbers) {
  for (std::size_t k = Dim == 3 ? 0 : 1; k < numbers.size(); k += Dim == 3 ? numbers.size() : 2)
    numbers[k] = level;
}

// of all corners, ascending, each once
template <int Dim>
std::vector<double> heights_of(const Model<Dim>& model, const std::vector<int>& bodies) {
  std::vector<double> heights;
  for (const int b : bodies)
    for (const Polytope<Dim>& part : model.bodies[b].parts)
      for (const Vector<Dim>& corner : part.vertices)
        heights.push_back(model.bodies[b].reference[Dim - 1] + corner[Dim - 1]);
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  return heights;
}

}  // namespace

template <int Dim>
std::optional<RequiredForce<Dim>> least_force(const Block<Dim>& block, const BoltedVerdict<Dim>& bolted, double factor,
                                              const Vector<Dim>& gravity) {
  const Verdict<Dim>& verdict = bolted.verdict;
  if (!moves(verdict.kind) || !bolted.factor) return std::nullopt;
  if (*bolted.factor >= factor) return RequiredForce<Dim>{};
  if (verdict.kind != BlockKind::slides)
    return RequiredForce<Dim>{Vector<Dim>((*bolted.factor - factor) * verdict.motion)};
  const Vector<Dim> change = gradient(block, verdict, factor);
  const double needed = factor * verdict.driving() - verdict.friction - verdict.cohesion;
  const Vector<Dim> direction = change.normalized(), force = needed / change.norm() * direction;
  const bool rough = std::ranges::any_of(block.faces, [](const RockFace<Dim>& face) { return face.rough; });
  const Verdict<Dim> after = judge(block, Vector<Dim>(bolted.load + force), gravity, false);
  if (!rough && same_faces(verdict, after)) return RequiredForce<Dim>{force};
  const std::optional<double> size = size_along<Dim>(block, bolted.load, factor, direction, gravity);
  if (!size) return std::nullopt;
  return RequiredForce<Dim>{Vector<Dim>(*size * direction), false};
}

template <int Dim>
std::optional<double> force_along(const Block<Dim>& block, const BoltedVerdict<Dim>& bolted, double factor,
                                  const Vector<Dim>& direction, const Vector<Dim>& gravity) {
  const Verdict<Dim>& verdict = bolted.verdict;
  if (!moves(verdict.kind) || !bolted.factor) return std::nullopt;
  if (*bolted.factor >= factor) return 0.0;
  if (verdict.kind == BlockKind::slides) return size_along<Dim>(block, bolted.load, factor, direction, gravity);
  const double against = -direction.dot(verdict.direction());
  if (!(against > closing_tolerance)) return std::nullopt;
  return (factor - *bolted.factor) * verdict.driving() / against;
}

template <int Dim>
WorstDirection<Dim> worst_direction(const Block<Dim>& block, const Vector<Dim>& load, double size,
                                    const Vector<Dim>& gravity) {
  WorstDirection<Dim> worst;
  double least = unlimited;
  const auto attempt = [&](const Vector<Dim>& direction) {
    const double factor = factor_under<Dim>(block, load + size * direction, gravity);
    if (!(factor < least)) return false;
    const bool falls = least == unlimited || factor < least * (1 - settled_factor);
    least = factor;
    worst.direction = direction;
    return falls;
  };
  for (int k = 0; k < trends; ++k)
    attempt(along_trend(2 * std::numbers::pi * (k + 0.5) / trends, load));
  for (int k = 0; k < improvements && least < unlimited; ++k) {
    const Verdict<Dim> verdict = judge(block, Vector<Dim>(load + size * worst.direction), gravity, false);
    Vector<Dim> downhill = -gradient(block, verdict, least);
    downhill[Dim - 1] = 0;
    if (!(downhill.norm() > 0) || !attempt(downhill.normalized())) break;
  }
  if (least < unlimited) worst.factor = least;
  return worst;
}

template <int Dim>
std::optional<double> critical_coefficient(const Block<Dim>& block, const Vector<Dim>& load,
                                           const Vector<Dim>& direction, const Vector<Dim>& gravity, double most) {
  const auto fails = [&](double k) {
    const double size = k * block.weight;
    const double factor = direction.norm() > 0
                              ? factor_under<Dim>(block, load + size * direction, gravity)
                              : worst_direction<Dim>(block, load, size, gravity).factor.value_or(unlimited);
    return factor < 1;
  };
  if (fails(0)) return 0.0;
  for (double k = most / 64; k <= most; k *= 2)
    if (fails(k)) return bisect(0.0, k, fails);
  return std::nullopt;
}

template <int Dim>
std::optional<double> critical_water(const Block<Dim>& block, const Vector<Dim>& load_without_water,
                                     const Vector<Dim>& gravity, double most) {
  const auto fails = [&](double share) {
    return factor_under<Dim>(block, load_without_water + share * block.water.force, gravity) < 1;
  };
  if (!(block.water.force.norm() > 0) || fails(0)) return std::nullopt;
  for (double share = 1.0 / 8; share <= most; share *= 2)
    if (fails(share)) return bisect(0.0, share, fails);
  return std::nullopt;
}

template <int Dim>
std::optional<double> critical_level(const Assembly<Dim>& assembly, const Block<Dim>& block,
                                     const Vector<Dim>& load_without_water, double most) {
  const Model<Dim>& model = assembly.model;
  if (model.waters.size() != 1 || !is_level<Dim>(model.waters[0], assembly.water_values[0])) return std::nullopt;
  WaterValues values = assembly.water_values;
  WaterSurfaces<Dim> surfaces;
  const auto fails = [&](double level) {
    set_level<Dim>(level, values[0]);
    find_surfaces(model, values, 1, surfaces);
    Vector<Dim> load = load_without_water;
    for (const int b : block.bodies)
      load += water_load<Dim>(model, surfaces, b, {.centroid = model.bodies[b].reference}).force;
    return factor_under<Dim>(block, load, model.gravity) < 1;
  };
  const std::vector<double> heights = heights_of(model, block.bodies);
  const double lowest = heights.front(), highest = heights.back();
  if (fails(lowest)) return std::nullopt;
  double stands = lowest;
  const auto found = [&](double level) {
    if (fails(level)) return true;
    stands = level;
    return false;
  };
  const auto elevation = [&](double level) { return bisect(stands, level, fails) + model.origin[Dim - 1]; };
  for (std::size_t k = 0; k + 1 < heights.size(); ++k)
    for (int quarter = 1; quarter <= 4; ++quarter) {
      const double level = heights[k] + 0.25 * quarter * (heights[k + 1] - heights[k]);
      if (found(level)) return elevation(level);
    }
  for (double times = 1; times <= most; times *= 2) {
    const double level = highest + times * (highest - lowest);
    if (found(level)) return elevation(level);
  }
  return std::nullopt;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                     \
  template std::optional<RequiredForce<Dim>> least_force<Dim>(const Block<Dim>&, const BoltedVerdict<Dim>&, double,   \
                                                              const Vector<Dim>&);                                    \
  template std::optional<double> force_along<Dim>(const Block<Dim>&, const BoltedVerdict<Dim>&, double,               \
                                                  const Vector<Dim>&, const Vector<Dim>&);                            \
  template WorstDirection<Dim> worst_direction<Dim>(const Block<Dim>&, const Vector<Dim>&, double,                    \
                                                    const Vector<Dim>&);                                              \
  template std::optional<double> critical_coefficient<Dim>(const Block<Dim>&, const Vector<Dim>&, const Vector<Dim>&, \
                                                           const Vector<Dim>&, double);                               \
  template std::optional<double> critical_water<Dim>(const Block<Dim>&, const Vector<Dim>&, const Vector<Dim>&,       \
                                                     double);                                                         \
  template std::optional<double> critical_level<Dim>(const Assembly<Dim>&, const Block<Dim>&, const Vector<Dim>&,     \
                                                     double);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
