#include "core/key_blocks/direction_cone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/surface.hpp"

namespace voussoir {
namespace {

constexpr double parallel = 1e-12;     // sine below which two normals are one line: their forces are not unique
constexpr double flat_triple = 1e-13;  // determinant below which three normals are in one plane
constexpr double rounding = 1e-15;     // of the load, in a component of the motion
constexpr double balanced = 1e-12;     // of the number of faces: normals whose sum is zero

double determinant(const Vector<3>& a, const Vector<3>& b, const Vector<3>& c) {
  return a.dot(b.cross(c));
}

template <int Dim>
bool is_loaded(const Projection<Dim>& projection, int face) {
  return std::find(projection.faces.begin(), projection.faces.begin() + projection.loaded, face) !=
         projection.faces.begin() + projection.loaded;
}

// the face that the motion closes most; -1: none beyond the tolerance
template <int Dim>
int most_closed(const std::vector<Vector<Dim>>& normals, const Projection<Dim>& projection, double scale) {
  int worst = -1;
  double least = -closing_tolerance * projection.motion.norm() - rounding * scale;
  for (int i = 0; i < static_cast<int>(normals.size()); ++i) {
    const double opening = normals[i].dot(projection.motion);
    if (opening < least && !is_loaded(projection, i)) {
      least = opening;
      worst = i;
    }
  }
  return worst;
}

// the faces whose forces are in balance, while one enters
template <int Dim>
struct ActiveSet {
  int count = 0;
  std::array<int, Dim> faces{};
  std::array<double, Dim> forces{};

  void remove(int place) {
    for (int k = place; k + 1 < count; ++k) {
      faces[k] = faces[k + 1];
      forces[k] = forces[k + 1];
    }
    --count;
  }
};

// The last face depends on the others: it takes over their forces until the first of them is zero, which leaves.
template <int Dim>
int first_unloaded(const std::vector<Vector<Dim>>& normals, const ActiveSet<Dim>& active) {
  std::array<double, Dim> shares{};
  balance<Dim>(normals, active.faces, active.count - 1, -normals[active.faces[active.count - 1]], shares);
  int leaves = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k + 1 < active.count; ++k)
    if (shares[k] > closing_tolerance && active.forces[k] / shares[k] < least) {
      least = active.forces[k] / shares[k];
      leaves = k;
    }
  if (leaves >= 0) return leaves;
  return static_cast<int>(std::min_element(active.forces.begin(), active.forces.begin() + active.count - 1) -
                          active.forces.begin());
}

// Moves the forces towards those that balance the load and removes faces that would pull on the path.
template <int Dim>
void settle_forces(const std::vector<Vector<Dim>>& normals, const Vector<Dim>& load, ActiveSet<Dim>& active) {
  while (active.count > 0) {
    std::array<double, Dim> wanted{};
    if (!balance<Dim>(normals, active.faces, active.count, load, wanted)) {
      active.remove(first_unloaded(normals, active));
      continue;
    }
    int pulls = -1;
    double share = 1;
    for (int k = 0; k < active.count; ++k)
      if (wanted[k] <= 0) {
        const double fall = active.forces[k] - wanted[k], until = fall > 0 ? active.forces[k] / fall : 0;
        if (pulls < 0 || until < share) {
          share = until;
          pulls = k;
        }
      }
    if (pulls < 0) {
      active.forces = wanted;
      return;
    }
    for (int k = 0; k < active.count; ++k)
      active.forces[k] += share * (wanted[k] - active.forces[k]);
    active.remove(pulls);
  }
}

// the part of the load that the loaded faces leave
template <int Dim>
Vector<Dim> remaining(const std::vector<Vector<Dim>>& normals, const Vector<Dim>& load, const ActiveSet<Dim>& active) {
  if (active.count == Dim) return Vector<Dim>::Zero();
  if constexpr (Dim == 3)
    if (active.count == 2) {  // along the line of the two faces, without the rounding of two large forces
      const Vector<3> line = normals[active.faces[0]].cross(normals[active.faces[1]]).normalized();
      return line.dot(load) * line;
    }
  Vector<Dim> motion = load;
  for (int k = 0; k < active.count; ++k)
    motion += active.forces[k] * normals[active.faces[k]];
  return motion;
}

// a direction perpendicular to all normals, if there is one
template <int Dim>
std::optional<Vector<Dim>> free_line(const std::vector<Vector<Dim>>& normals) {
  if (normals.empty()) return Vector<Dim>::Unit(0);
  if constexpr (Dim == 2) {
    const Vector<2> along = perpendicular(normals[0]);
    for (const Vector<2>& n : normals)
      if (std::abs(along.dot(n)) > closing_tolerance) return std::nullopt;
    return along;
  } else {
    std::optional<Vector<3>> line;
    for (const Vector<3>& n : normals) {
      const Vector<3> both = normals[0].cross(n);
      if (!line && both.norm() > closing_tolerance) line = both.normalized();
      if (line && std::abs(line->dot(n)) > closing_tolerance) return std::nullopt;
    }
    return line ? *line : perpendicular(normals[0]);
  }
}

}  // namespace

template <int Dim>
bool balance(const std::vector<Vector<Dim>>& normals, const std::array<int, Dim>& faces, int count,
             const Vector<Dim>& load, std::array<double, Dim>& forces) {
  const Vector<Dim>& a = normals[faces[0]];
  if (count == 1) {
    forces[0] = -a.dot(load);
    return true;
  }
  const Vector<Dim>& b = normals[faces[1]];
  if (count == 2) {
    const double cosine = a.dot(b), squared_sine = 1 - cosine * cosine;
    if (squared_sine < parallel * parallel) return false;
    const double on_a = -a.dot(load), on_b = -b.dot(load);
    forces[0] = (on_a - cosine * on_b) / squared_sine;
    forces[1] = (on_b - cosine * on_a) / squared_sine;
    return true;
  }
  if constexpr (Dim == 3) {
    const Vector<3>& c = normals[faces[2]];
    const double volume = determinant(a, b, c);
    if (std::abs(volume) < flat_triple) return false;
    forces = {-determinant(b, c, load) / volume, -determinant(c, a, load) / volume, -determinant(a, b, load) / volume};
  }
  return true;
}

template <int Dim>
Projection<Dim> project(const std::vector<Vector<Dim>>& normals, const Vector<Dim>& load) {
  Projection<Dim> projection;
  projection.motion = load;
  const double scale = load.norm();
  if (scale == 0) return projection;
  const int limit = 20 + 4 * static_cast<int>(normals.size());
  for (projection.steps = 0; projection.steps < limit; ++projection.steps) {
    const int entering = most_closed(normals, projection, scale);
    if (entering < 0) return projection;
    ActiveSet<Dim> active{projection.loaded, projection.faces, projection.forces};
    active.faces[active.count] = entering;
    active.forces[active.count++] = 0;
    settle_forces(normals, load, active);
    projection.loaded = active.count;
    projection.faces = active.faces;
    projection.forces = active.forces;
    projection.motion = remaining(normals, load, active);
    if (active.count == Dim || projection.motion.norm() <= closing_tolerance * scale) {
      projection.motion.setZero();
      return projection;
    }
  }
  projection.found = false;
  return projection;
}

template <int Dim>
Removability<Dim> find_removability(const std::vector<Vector<Dim>>& normals) {
  Removability<Dim> result;
  if (const std::optional<Vector<Dim>> line = free_line(normals)) {
    result.removable = true;
    result.direction = *line;
    return result;
  }
  // With g = Σ n_i and normals that span the space, K = {0} if and only if the projection of g onto K is 0: then
  // Σ (1 + N_i) n_i = 0, and no term of Σ (1 + N_i) n_i·v can be positive for a v of K.
  Vector<Dim> outwards = Vector<Dim>::Zero();
  for (const Vector<Dim>& n : normals)
    outwards += n;
  result.weights.assign(normals.size(), 1);
  if (outwards.norm() <= balanced * static_cast<double>(normals.size())) return result;
  const Projection<Dim> projection = project(normals, outwards);
  result.found = projection.found;
  if (projection.motion.norm() > 0) {
    result.removable = true;
    result.direction = projection.motion.normalized();
    result.weights.clear();
  } else {
    for (int k = 0; k < projection.loaded; ++k)
      result.weights[projection.faces[k]] += projection.forces[k];
  }
  return result;
}

template <int Dim>
std::optional<double> find_taper(const std::vector<Vector<Dim>>& normals) {
  HalfSpaces<Dim> planes;
  for (const Vector<Dim>& n : normals)
    planes.push_back({-n, 1});
  const Surface<Dim> surface = find_surface(planes, closing_tolerance);
  if (surface.status != SurfaceStatus::ok) return std::nullopt;
  double farthest = 0;
  for (const Vector<Dim>& corner : surface.vertices)
    farthest = std::max(farthest, corner.norm());
  return std::asin(std::min(1.0, 1 / farthest));
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                   \
  template Projection<Dim> project<Dim>(const std::vector<Vector<Dim>>&, const Vector<Dim>&);                       \
  template bool balance<Dim>(const std::vector<Vector<Dim>>&, const std::array<int, Dim>&, int, const Vector<Dim>&, \
                             std::array<double, Dim>&);                                                             \
  template Removability<Dim> find_removability<Dim>(const std::vector<Vector<Dim>>&);                               \
  template std::optional<double> find_taper<Dim>(const std::vector<Vector<Dim>>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
