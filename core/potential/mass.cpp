#include "core/potential/mass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/potential/support.hpp"
#include "core/potential/surface.hpp"

namespace voussoir {
namespace {

// Gauss's rule of three points on -1..1
const std::array<double, 3> gauss_points{-std::sqrt(0.6), 0, std::sqrt(0.6)};
constexpr std::array<double, 3> gauss_weights{5.0 / 9, 8.0 / 9, 5.0 / 9};

constexpr int first_cells = 4;  // in each direction

// Integrals in units of the half extents, from the centre: volume, first moments, second moments' lower triangle.
template <int Dim>
using Integrals = FixedMatrix<1 + Dim + Dim*(Dim + 1) / 2, 1>;

template <int Dim>
struct MeasuredShape {
  PlacedPotential<Dim> potential;
  Vector<Dim> half;  // extents
};

// a piece of the face at which coordinate `axis` is `side`: middle and half width in the others
template <int Dim>
struct SurfaceCell {
  int axis, side;
  FixedMatrix<Dim - 1, 1> middle;
  double half;
  Integrals<Dim> kept = Integrals<Dim>::Zero();  // by its parts
  double error = 0;
};

template <int Dim>
void add_ray(const MeasuredShape<Dim>& body, const Vector<Dim>& through, double weight, Integrals<Dim>& sums) {
  const double reach = distance_to_surface<Dim>(body.potential, body.potential.centre, body.half.cwiseProduct(through));
  const double volume = weight * std::pow(reach, Dim) / Dim;
  const double first = volume * reach * Dim / (Dim + 1), second = first * reach * (Dim + 1) / (Dim + 2);
  int entry = 0;
  sums[entry++] += volume;
  for (int k = 0; k < Dim; ++k)
    sums[entry++] += first * through[k];
  for (int k = 0; k < Dim; ++k)
    for (int l = 0; l <= k; ++l)
      sums[entry++] += second * through[k] * through[l];
}

template <int Dim>
Integrals<Dim> by_gauss(const MeasuredShape<Dim>& body, const SurfaceCell<Dim>& cell) {
  Integrals<Dim> sums = Integrals<Dim>::Zero();
  Vector<Dim> through;
  through[cell.axis] = cell.side;
  const int first = (cell.axis + 1) % Dim, second = (cell.axis + 2) % Dim;
  for (int i = 0; i < 3; ++i) {
    through[first] = cell.middle[0] + cell.half * gauss_points[i];
    const double weight = cell.half * gauss_weights[i];
    if constexpr (Dim == 2) {
      add_ray<Dim>(body, through, weight, sums);
    } else {
      for (int j = 0; j < 3; ++j) {
        through[second] = cell.middle[1] + cell.half * gauss_points[j];
        add_ray<Dim>(body, through, weight * cell.half * gauss_weights[j], sums);
      }
    }
  }
  return sums;
}

template <int Dim>
std::vector<SurfaceCell<Dim>> parts_of(const SurfaceCell<Dim>& cell) {
  std::vector<SurfaceCell<Dim>> parts;
  for (int signs = 0; signs < 1 << (Dim - 1); ++signs) {
    SurfaceCell<Dim> part{cell.axis, cell.side, cell.middle, cell.half / 2};
    for (int k = 0; k < Dim - 1; ++k)
      part.middle[k] += signs >> k & 1 ? part.half : -part.half;
    parts.push_back(part);
  }
  return parts;
}

// The surface over a cell lies between its chords, from corner to corner, and the plane that touches it over the
// middle.
template <int Dim>
struct Enclosure {
  bool tight = false;   // the plane meets the rays of all corners
  bool smooth = false;  // every plane counts on all of the piece or on none of it: the distance is analytic
  double width = 0;     // between the two, as a volume, times the farthest corner's distance² if that is more
};

// volume between the centre and a plane through these distances along the rays of the corners
template <int Dim>
double pyramid(const std::array<double, 1 << (Dim - 1)>& reach, double half) {
  if constexpr (Dim == 2)
    return half * reach[0] * reach[1];
  else
    return 4 * half * half / 6 * reach[0] * reach[3] * (reach[1] + reach[2]);
}

template <int Dim>
Enclosure<Dim> enclose(const MeasuredShape<Dim>& body, const SurfaceCell<Dim>& cell) {
  constexpr int corners = 1 << (Dim - 1);
  const PlacedPotential<Dim>& potential = body.potential;
  const auto ray = [&](const FixedMatrix<Dim - 1, 1>& across) {
    Vector<Dim> through;
    through[cell.axis] = cell.side;
    for (int k = 0; k < Dim - 1; ++k)
      through[(cell.axis + 1 + k) % Dim] = across[k];
    return body.half.cwiseProduct(through).eval();
  };
  const Vector<Dim> middle = ray(cell.middle);
  const Vector<Dim> touched = distance_to_surface<Dim>(potential, potential.centre, middle) * middle;
  const Vector<Dim> normal = derivatives<Dim>(potential, potential.centre + touched).gradient;

  Enclosure<Dim> result;
  std::array<double, corners> inner, outer;
  std::array<Vector<Dim>, 2 * corners> points;
  double farthest = 1;
  for (int i = 0; i < corners; ++i) {
    FixedMatrix<Dim - 1, 1> across = cell.middle;
    for (int k = 0; k < Dim - 1; ++k)
      across[k] += i >> k & 1 ? cell.half : -cell.half;
    const Vector<Dim> direction = ray(across);
    if (!(normal.dot(direction) > 0)) return result;
    inner[i] = distance_to_surface<Dim>(potential, potential.centre, direction);
    outer[i] = std::max(normal.dot(touched) / normal.dot(direction), inner[i]);
    points[2 * i] = potential.centre + inner[i] * direction;
    points[2 * i + 1] = potential.centre + outer[i] * direction;
    farthest = std::max(farthest, outer[i] * outer[i] * (1 + across.squaredNorm()));
  }
  result.tight = true;
  result.width = farthest * (pyramid<Dim>(outer, cell.half) - pyramid<Dim>(inner, cell.half));
  result.smooth = std::all_of(potential.planes.begin(), potential.planes.end(), [&](const HalfSpace<Dim>& plane) {
    const auto counts = [&](const Vector<Dim>& point) { return signed_distance<Dim>(plane, point) > 0; };
    return std::all_of(points.begin(), points.end(), counts) || std::none_of(points.begin(), points.end(), counts);
  });
  return result;
}

template <int Dim>
void measure(const MeasuredShape<Dim>& body, SurfaceCell<Dim>& cell) {
  cell.kept.setZero();
  for (const SurfaceCell<Dim>& part : parts_of<Dim>(cell))
    cell.kept += by_gauss<Dim>(body, part);
  const Enclosure<Dim> enclosure = enclose<Dim>(body, cell);
  if (!enclosure.tight)
    cell.error = 1 << Dim;  // all that the body may contain: to be divided
  else
    cell.error =
        (cell.kept - by_gauss<Dim>(body, cell)).cwiseAbs().maxCoeff() + (enclosure.smooth ? 0 : enclosure.width);
}

template <int Dim>
std::vector<SurfaceCell<Dim>> whole_surface() {
  std::vector<SurfaceCell<Dim>> cells;
  const double half = 1.0 / first_cells;
  for (int axis = 0; axis < Dim; ++axis)
    for (const int side : {-1, 1})
      for (int i = 0; i < first_cells; ++i)
        for (int j = 0; j < (Dim == 3 ? first_cells : 1); ++j) {
          SurfaceCell<Dim> cell{axis, side, {}, half};
          cell.middle[0] = -1 + (2 * i + 1) * half;
          if constexpr (Dim == 3) cell.middle[1] = -1 + (2 * j + 1) * half;
          cells.push_back(cell);
        }
  return cells;
}

template <int Dim>
MassProperties<Dim> in_metres(const MeasuredShape<Dim>& body, const Integrals<Dim>& sums) {
  const double unit = body.half.prod();
  const Vector<Dim>& c = body.potential.centre;
  MassProperties<Dim> mass;
  mass.volume = unit * sums[0];
  const Vector<Dim> first = unit * body.half.cwiseProduct(sums.template segment<Dim>(1));
  mass.centroid = c + first / mass.volume;
  int entry = 1 + Dim;
  for (int k = 0; k < Dim; ++k)
    for (int l = 0; l <= k; ++l)
      mass.second_moment(k, l) = mass.second_moment(l, k) = unit * body.half[k] * body.half[l] * sums[entry++] +
                                                            c[k] * first[l] + c[l] * first[k] +
                                                            mass.volume * c[k] * c[l];
  return mass;
}

}  // namespace

template <int Dim>
PotentialMass<Dim> integrate(const PotentialShape<Dim>& shape, double tolerance, long long cell_limit) {
  MeasuredShape<Dim> body{placed<Dim>(shape), {}};
  RayScratch scratch;
  const PotentialBox<Dim> box = bounding_box<Dim>(body.potential, scratch);
  body.half = (body.potential.centre - box.low).cwiseMax(box.high - body.potential.centre);

  std::vector<SurfaceCell<Dim>> cells = whole_surface<Dim>();
  double error = 0, volume = 0;
  for (SurfaceCell<Dim>& cell : cells) {
    measure<Dim>(body, cell);
    error += cell.error;
    volume += cell.kept[0];
  }

  // the worst cell first; of equal ones, the first in the heap, which is the same in every run
  const auto better = [](const SurfaceCell<Dim>& a, const SurfaceCell<Dim>& b) { return a.error < b.error; };
  std::make_heap(cells.begin(), cells.end(), better);
  while (error > tolerance * volume && static_cast<long long>(cells.size()) < cell_limit) {
    std::pop_heap(cells.begin(), cells.end(), better);
    const SurfaceCell<Dim> worst = cells.back();
    cells.pop_back();
    error -= worst.error;
    for (SurfaceCell<Dim>& part : parts_of<Dim>(worst)) {
      measure<Dim>(body, part);
      error += part.error;
      cells.push_back(part);
      std::push_heap(cells.begin(), cells.end(), better);
    }
  }

  // small ones first, so that nothing is lost in the sum
  std::sort_heap(cells.begin(), cells.end(), better);
  Integrals<Dim> sums = Integrals<Dim>::Zero();
  PotentialMass<Dim> result;
  for (const SurfaceCell<Dim>& cell : cells) {
    sums += cell.kept;
    result.error += cell.error;
  }
  result.error /= sums[0];
  result.cells = static_cast<long long>(cells.size());
  result.mass = in_metres<Dim>(body, sums);
  return result;
}

template PotentialMass<2> integrate<2>(const PotentialShape<2>&, double, long long);
template PotentialMass<3> integrate<3>(const PotentialShape<3>&, double, long long);

}  // namespace voussoir
