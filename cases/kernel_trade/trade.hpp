// The kernel's speed-accuracy trade: one setting at a time over the same seeded pairs, errors against long double.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cases/kernel_trade/small_kernel.hpp"
#include "core/contact/pair_geometry.hpp"
#include "core/testing/one_pair.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::trade {

// two touching parts, the same pair a step earlier, and the converged result in long double
struct TouchingPair {
  Polytope<3> a, b;
  Matrix<3> turn;
  Vector<3> offset;
  Contact<3> before;     // converged with the second part 1 % of the overlap (and rotated as much) away
  HalfSpaces<3> planes;  // in the first part's frame
  Vector<3> start;       // the LP's point in that frame
  double size;           // the smaller inscribed radius
  Answer<long double> exact;

  int faces_a() const { return static_cast<int>(a.faces.size()); }
};

// Places the second part on the first, both with their size and shape set. Face on face: two faces are rotated to meet,
// tilted by `tilt`, spun and moved sideways at random; otherwise both have any orientation. The largest ball in the
// overlap has `overlap` as its diameter.
void place(TouchingPair& pair, bool face_on_face, double tilt, double overlap, shapes::Random& random);

// regular and irregular solids; corners, edges and faces meet; overlaps of 1e-2, 1e-3 and 1e-4 of the size
std::vector<TouchingPair> make_pairs();

enum class Quantity { point, normal, overlap, area };
inline constexpr std::array quantity_names{"point", "normal", "overlap", "area"};
inline constexpr int quantities = 4;

// point: distance from the exact one in the overlap's own measure (Hessian of the barrier), 1 being about the overlap;
// normal: rad; overlap and area: relative
using Errors = std::array<double, quantities>;
Errors errors_of(const TouchingPair& pair, const Answer<long double>& answer);

enum class Family { cold, warm, lp_tolerance, centroid, chebyshev, plain_double, plain_float };
inline constexpr std::array family_names{
    "cold", "warm", "LP tolerance", "centroid", "Chebyshev", "plain kernel, double", "plain kernel, float"};

// one setting over all pairs
struct Measured {
  Family family;
  double tolerance;  // Newton's, or the LP's as a fraction of the size
  int pairs = 0, failed = 0;

  // planes looked at, per pair: all of them once for each LP, pivot and Newton iteration, for normal, overlap and area
  double visits = 0;
  double nanoseconds = 0;  // per pair, least of some runs; measured, never judged
  Errors worst{}, median{};
  bool on_front = false;

  double worst_of_all() const { return *std::max_element(worst.begin(), worst.end()); }
};

Measured measure_kernel(const std::vector<TouchingPair>& pairs, Family family, double newton_tolerance);
Measured measure_lp(const std::vector<TouchingPair>& pairs, double lp_tolerance);
template <class Real>
Measured measure_plain(const std::vector<TouchingPair>& pairs, Family family, double newton_tolerance);

// marks the settings than which no other is both cheaper and more accurate, among those that never failed
void mark_front(std::vector<Measured>& settings_tried);

// the cheapest setting of a family that reaches the error in all four quantities; null if none does
const Measured* cheapest(const std::vector<Measured>& settings_tried, Family family, double error);

}  // namespace voussoir::trade
