#pragma once

namespace voussoir::reference {

struct PlanePoint {
  double x = 0, y = 0;
};

// The greatest value of the parabola through three points with ascending or descending x: its distance from the middle
// one, and its y. The middle point itself if the parabola has no maximum.
struct ParabolaTop {
  double aside = 0, y = 0;
};
inline ParabolaTop parabola_top(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  // Newton's form: b + first (x - x_b) + second (x - x_b)²
  const double left = (b.y - a.y) / (b.x - a.x), right = (c.y - b.y) / (c.x - b.x);
  const double second = (right - left) / (c.x - a.x), first = left + second * (b.x - a.x);
  const double aside = second < 0 ? -0.5 * first / second : 0;
  return {aside, b.y + 0.5 * first * aside};
}

}  // namespace voussoir::reference
