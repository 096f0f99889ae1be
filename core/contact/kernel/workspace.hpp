// Plain data and constants of the contact kernel that do not depend on the instruction set.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/contact/contact.hpp"
#include "core/contact/rounding.hpp"
#include "core/geometry/half_space.hpp"

namespace voussoir {

inline constexpr int planes_per_quad = 4;  // strided partial sums; parts are padded to whole quads
constexpr int quads_of(int planes) {
  return (planes + planes_per_quad - 1) / planes_per_quad;
}

// slots from `first` up to `last`: those of a part that hold planes
struct Slots {
  int first, last;
};

// below this decrement² a full Newton step cannot leave the region (it stays inside the Dikin ellipsoid)
inline constexpr double full_step_decrement2 = 1.0 / 16;

// a pivot that keeps less of its diagonal has lost the digits that Newton needs: the frame does not fit
inline constexpr double smallest_pivot = 1e-12;

// sine² between axis and tangent below which they span no frame
inline constexpr double smallest_binormal2 = 1e-4;

// a corner beyond a plane of the section by more is not a corner; rounding is 1e-16 in these scaled planes
inline constexpr double corner_tolerance = 1e-13;

// an entering plane takes a multiplier only by more than rounding, as a fraction of the terms
inline constexpr double exchange_rounding = 1024 * std::numeric_limits<double>::epsilon();

// pivots are 2 to 9; more means that rounding makes them cycle
inline constexpr int most_exchanges = 60;

// the LP may stop when its point is inside by this fraction of the best that it could still find
inline constexpr double well_inside = 0.2;

// The line between centroids is tried for a decision if the square of its length is at most this times that of the
// inscribed radii's sum: longer ones seldom pass through the overlap. Planes that are so nearly parallel to it do not
// bound its part inside.
inline constexpr double most_distant = 1.07, nearly_parallel = 1e-6;

// primal-dual steps stop short of the boundary
inline constexpr double near_boundary = 0.95;
inline constexpr int most_approaches = 60;

// corners that the search for a section keeps; sections with more go to the general method
inline constexpr int most_corners = 64;

// a plane as the parts store it: normal, offset and, in 2-D, the padding of alignment
template <int Dim>
inline constexpr int row_length = sizeof(HalfSpace<Dim>) / sizeof(double);

// Harmless in every computation: never violated, never near, no weight. A power of two, so that a product with it and a
// quotient by it are exact.
inline constexpr double far_away = 0x1p100;

// m: No slack counts as less when it is inverted, so that failed pairs overflow nowhere: the sixth power of the inverse
// is a number. Valid slacks are far larger: rounding alone is, for blocks of a nanometre.
inline constexpr double least_inverted = 0x1p-122;
template <int Dim>
inline constexpr double padding_row[4] = {0, 0, Dim == 2 ? far_away : 0, Dim == 3 ? far_away : 0};

template <int Width>
struct Sources {
  const double* rows[Width];
  int count[Width];
  int least_count;
};

// The fields of each plane: their places in its slot. They are side by side, each as wide as the slot.
template <int Dim>
struct Fields {
  static constexpr int slack_at = 0, inverse_at = 1,  // of the slack
      normal_at = 2,                                  // Dim of them, contact frame
      scaled_at = normal_at + Dim,                    // Dim of them: normal / slack, or the section's planes
      multiplier_at = scaled_at + Dim, fields = multiplier_at + 1;
};

// the section's planes in cyclic order, numbered as the padded planes are
struct SectionList {
  static constexpr int most = std::tuple_size_v<decltype(Proof<3>::section)>;
  int size = 0;
  bool found_again = false;    // not the given list
  std::array<int, 16> planes;  // `size` of them, then the first again and again
};
static_assert(SectionList::most < std::tuple_size_v<decltype(SectionList::planes)>);

// grows, never shrinks: the step allocates no memory
struct Workspace {
  std::vector<double> numbers;

  // room for so many, aligned to a cache line
  double* room(std::size_t count) {
    constexpr std::size_t line = 64;
    if (numbers.size() < count + line / sizeof(double)) numbers.resize(count + line / sizeof(double));
    const std::size_t beyond = reinterpret_cast<std::uintptr_t>(numbers.data()) % line;
    return numbers.data() + (beyond == 0 ? 0 : (line - beyond) / sizeof(double));
  }
};

}  // namespace voussoir
