// Plain data and constants of the contact kernel that do not depend on the instruction set.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "core/contact/contact.hpp"
#include "core/geometry/half_space.hpp"

namespace voussoir {

inline constexpr int planes_per_quad = 4;  // strided partial sums; parts are padded to whole quads

// a slack's rounding as a share of the coordinates it was computed from, see assemble_planes: the products and sums of
// two rotated vectors lose at most 13 half-ulps
inline constexpr double slack_rounding = 4 * std::numeric_limits<double>::epsilon();

// gradients that differ by less give no direction
inline constexpr double parallel_gradients = 1e-6;

// below this decrement² a full Newton step cannot leave the region (it stays inside the Dikin ellipsoid)
inline constexpr double full_step_decrement2 = 1.0 / 16;

// a pivot that keeps less of its diagonal has lost the digits Newton needs: the frame does not fit
inline constexpr double smallest_pivot = 1e-12;

// sine² between axis and tangent below which they span no frame
inline constexpr double smallest_binormal2 = 1e-4;

// a corner beyond a plane of the section by more is not a corner; rounding is 1e-16 in these scaled planes
inline constexpr double corner_tolerance = 1e-13;

// an entering plane takes a multiplier only by more than rounding, as a share of the terms
inline constexpr double exchange_rounding = 1024 * std::numeric_limits<double>::epsilon();

// pivots are 2 to 9; more means rounding turns in circles
inline constexpr int most_exchanges = 60;

// the LP may stop when its point is inside by this share of the best it could still find
inline constexpr double well_inside = 0.2;

// primal-dual steps stop short of the boundary
inline constexpr double near_boundary = 0.95;
inline constexpr int most_approaches = 60;

// corners the search for a section keeps; more go the general way
inline constexpr int most_corners = 64;

// a plane as the parts store it: normal, offset and, in 2-D, what alignment adds
template <int Dim>
inline constexpr int row_length = sizeof(HalfSpace<Dim>) / sizeof(double);

// harmless in every stage: never violated, never near, no weight
inline constexpr double far_away = 1e30;
template <int Dim>
inline constexpr double padding_row[4] = {0, 0, Dim == 2 ? far_away : 0, Dim == 3 ? far_away : 0};

template <int Width>
struct Sources {
  const double* rows[Width];
  int count[Width];
  int least_count;
};

template <int Dim>
struct Arrays {
  double* normal[Dim];  // contact frame
  double* scaled[Dim];  // normal / slack; later the section's planes
  double* slack;
  double* multiplier;
  double* inverse;  // of the slack
};

// the section's planes in cyclic order, numbered as the padded planes are
struct SectionList {
  int size = 0;
  bool found_anew = false;                                                 // not the list that came in
  std::array<int, std::tuple_size_v<decltype(Proof<3>::section)>> planes;  // the first `size` of them
};

// grows, never shrinks: the step allocates nothing
struct Workspace {
  std::vector<double> numbers;

  template <int Dim>
  Arrays<Dim> arrays(int count) {
    const std::size_t needed = static_cast<std::size_t>(count) * (2 * Dim + 3);
    if (numbers.size() < needed) numbers.resize(needed);
    Arrays<Dim> a;
    double* next = numbers.data();
    for (int k = 0; k < Dim; ++k, next += count)
      a.normal[k] = next;
    for (int k = 0; k < Dim; ++k, next += count)
      a.scaled[k] = next;
    a.slack = next;
    a.multiplier = next + count;
    a.inverse = next + 2 * count;
    return a;
  }
};

}  // namespace voussoir
