#include "core/contact/face_sensitivity.hpp"

#include <array>
#include <cmath>

namespace voussoir {
namespace {

template <int Dim>
using ByMotion = FixedMatrix<1, freedoms<Dim>>;

// ∫ (x - centre)(x - centre)ᵀ dA
Matrix<2> second_moment(const FaceIntegral<2>& f, const PressedPolygon&) {
  const Vector<2> along(-f.normal[1], f.normal[0]);
  return f.polar * along * along.transpose();
}
Matrix<3> second_moment(const FaceIntegral<3>&, const PressedPolygon& polygon) {
  Matrix<2> sum = Matrix<2>::Zero();
  const auto& c = polygon.corners;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Vector<2>&v = c[k], &w = c[(k + 1) % c.size()];
    const Vector<2> both = v + w;
    sum += (v[0] * w[1] - v[1] * w[0]) / 24 * (v * v.transpose() + w * w.transpose() + both * both.transpose());
  }
  return polygon.axes * sum * polygon.axes.transpose();
}

// places of an edge with the weights of Simpson's rule, which is exact for a product of three linear functions
template <int Dim>
struct PlaceOnEdge {
  Vector<Dim> x;
  double overlap, weight;
};
std::array<PlaceOnEdge<2>, 1> places_of(const FaceEdge<2>& e) {
  return {{{e.from, e.overlap_from, 1}}};
}
std::array<PlaceOnEdge<3>, 3> places_of(const FaceEdge<3>& e) {
  const double sixth = (e.to - e.from).norm() / 6;
  return {{{e.from, e.overlap_from, sixth},
           {0.5 * (e.from + e.to), 0.5 * (e.overlap_from + e.overlap_to), 4 * sixth},
           {e.to, e.overlap_to, sixth}}};
}

template <int Dim>
double sine_between(const Vector<Dim>& side, const Vector<Dim>& normal) {
  return (side - side.dot(normal) * normal).norm();
}

}  // namespace

template <int Dim>
FaceSensitivity<Dim> find_face_sensitivity(const HalfSpaces<Dim>& planes, int faces_a, const HalfSpace<Dim>& a,
                                           const HalfSpace<Dim>& b, const Vector<Dim>& centroid,
                                           const FaceIntegral<Dim>& f, const PressedPolygon& polygon,
                                           std::span<const FaceEdge<Dim>> edges) {
  constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;
  using Motion = FixedMatrix<Dim, F>;
  const Vector<Dim>& n = f.normal;
  const double c = 0.5 * (a.normal - b.normal).norm(), gradient = (a.normal + b.normal).norm() / c;

  // motion of the second body's point at x along a direction
  const auto along = [&](const Vector<Dim>& direction, const Vector<Dim>& x) {
    ByMotion<Dim> row;
    row.template head<Dim>() = direction.transpose();
    row.template tail<S>() = moment(Vector<Dim>(x - centroid), direction).transpose();
    return row;
  };
  const auto beta = [&](const Vector<Dim>& x) { return along(b.normal, x); };

  // how b, n, c and the slope of β turn
  Motion b_turns = Motion::Zero(), n_turns = Motion::Zero();
  FixedMatrix<S, F> crossing = FixedMatrix<S, F>::Zero();  // b × a
  for (int k = 0; k < S; ++k) {
    const Vector<Dim> turned = cross(Spin<Dim>(Spin<Dim>::Unit(k)), b.normal);
    b_turns.col(Dim + k) = turned;
    n_turns.col(Dim + k) = (n.dot(turned) * n - turned) / (2 * c);
    crossing.col(Dim + k) = moment(turned, a.normal);
  }
  const ByMotion<Dim> c_changes = -0.5 * n.transpose() * b_turns;

  FaceSensitivity<Dim> s;
  const double volume = f.volume, area = f.area;
  const Matrix<Dim> second = second_moment(f, polygon);
  s.volume = (area * beta(f.centre) - volume * c_changes) / c;
  s.square = 2 / c * (volume * beta(f.pressure) - f.square * c_changes);
  s.area.setZero();
  s.polar.setZero();
  // of ∫ u x dA and of ∫ x dA; a place follows along n by -β/2c
  Motion pressed = (f.centre * (area * beta(f.centre)) - second * b_turns - f.pressure * (volume * c_changes)) / c -
                   n * (0.5 * volume / c * beta(f.pressure));
  Motion covered = -n * (0.5 * area / c * beta(f.centre));
  Motion edge_force = Motion::Zero();
  FixedMatrix<S, F> edge_moment = FixedMatrix<S, F>::Zero();

  // of the mean of an edge's overlaps at its ends: there is none where the overlap ends
  const auto mean_change = [&](std::size_t edge) {
    ByMotion<Dim> sum = ByMotion<Dim>::Zero();
    if constexpr (Dim == 2) return ByMotion<Dim>(beta(edges[edge].from) / c);
    if (edges[(edge + edges.size() - 1) % edges.size()].plane != no_plane) sum += beta(edges[edge].from);
    if (edges[(edge + 1) % edges.size()].plane != no_plane) sum += beta(edges[edge].to);
    return ByMotion<Dim>(0.5 / c * sum);
  };

  for (std::size_t k = 0; k < edges.size(); ++k) {
    const FaceEdge<Dim>& e = edges[k];
    const bool presses = e.plane != no_plane;
    const Vector<Dim> side = presses ? planes[e.plane].normal : Vector<Dim>(Vector<Dim>::Zero());
    const double sine = presses ? sine_between<Dim>(side, n) : gradient;
    if (!(sine > 0)) continue;
    const auto outwards = [&](int plane, const Vector<Dim>& normal, double angle, const Vector<Dim>& x) {
      ByMotion<Dim> way = 0.5 / c * normal.dot(n) * beta(x);
      if (plane >= faces_a) way += along(normal, x);
      return ByMotion<Dim>(way / angle);
    };
    double square = 0;  // ∫ u² ds over the sine
    Vector<Dim> lever = Vector<Dim>::Zero();
    for (const PlaceOnEdge<Dim>& at : places_of(e)) {
      const ByMotion<Dim> b_moves = beta(at.x);
      const ByMotion<Dim> way =
          at.weight * (presses ? outwards(e.plane, side, sine, at.x) : ByMotion<Dim>(b_moves / (c * sine)));
      s.area += way;
      s.polar += (at.x - f.centre).squaredNorm() * way;
      covered += at.x * way;
      s.volume += at.overlap * way;
      pressed += at.overlap * at.x * way;
      if (!presses) continue;
      const ByMotion<Dim> pulls = 2 * at.weight * at.overlap / (sine * c) * b_moves;
      edge_force += e.pull * pulls;
      edge_moment += moment(at.x, e.pull) * pulls;
      const double part = at.weight * at.overlap * at.overlap / sine;
      square += part;
      lever += part * at.x;
    }
    if (e.twin == no_plane) continue;
    const Vector<Dim> middle = 0.5 * (e.from + e.to), twin = planes[e.twin].normal;
    const ByMotion<Dim> share = e.twin_per_behind * (outwards(e.twin, twin, sine_between<Dim>(twin, n), middle) -
                                                     outwards(e.plane, side, sine, middle)) +
                                e.twin_per_overlap * mean_change(k);
    edge_force += square * e.twin_pulls * share;
    edge_moment += moment(lever, e.twin_pulls) * share;
  }

  s.force = n * s.volume + volume * n_turns - edge_force;
  s.pressure = (pressed - f.pressure * s.volume) / volume;
  s.centre = (covered - f.centre * s.area) / area;
  s.moment = -edge_moment - 0.25 / (c * c) * (moment(b.normal, a.normal) * s.square + f.square * crossing);
  for (int k = 0; k < F; ++k)
    s.moment.col(k) +=
        moment(Vector<Dim>(pressed.col(k)), n) + moment(Vector<Dim>(volume * f.pressure), Vector<Dim>(n_turns.col(k)));
  s.gradient = -(b_turns - n * (n.transpose() * b_turns)) / c;
  return s;
}

template FaceSensitivity<2> find_face_sensitivity<2>(const HalfSpaces<2>&, int, const HalfSpace<2>&,
                                                     const HalfSpace<2>&, const Vector<2>&, const FaceIntegral<2>&,
                                                     const PressedPolygon&, std::span<const FaceEdge<2>>);
template FaceSensitivity<3> find_face_sensitivity<3>(const HalfSpaces<3>&, int, const HalfSpace<3>&,
                                                     const HalfSpace<3>&, const Vector<3>&, const FaceIntegral<3>&,
                                                     const PressedPolygon&, std::span<const FaceEdge<3>>);

}  // namespace voussoir
