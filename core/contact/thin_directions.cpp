#include "core/contact/thin_directions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voussoir {
namespace {

// directions with a larger cosine between them are equivalent
constexpr double alike = 0.7;

template <int Dim>
double width(const TurnedPart<Dim>& turned, const Vector<Dim>& direction) {
  const Vector<Dim> seen = turned.axes.transpose() * direction;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vector<Dim>& v : turned.part->vertices) {
    low = std::min(low, v.dot(seen));
    high = std::max(high, v.dot(seen));
  }
  return high - low;
}

template <int Dim>
double width(std::span<const TurnedPart<Dim>> parts, const Vector<Dim>& direction) {
  double sum = 0;
  for (const TurnedPart<Dim>& part : parts)
    sum += width(part, direction);
  return sum;
}

// the normal of a part's face across which the part itself is thinnest
template <int Dim>
Vector<Dim> thinnest(const TurnedPart<Dim>& turned) {
  Vector<Dim> best = Vector<Dim>::Unit(0);
  double least = std::numeric_limits<double>::infinity();
  for (const HalfSpace<Dim>& face : turned.part->faces) {
    const Vector<Dim> normal = turned.axes * face.normal;
    if (const double wide = width(turned, normal); wide < least) {
      least = wide;
      best = normal;
    }
  }
  return best;
}

}  // namespace

template <int Dim>
std::vector<Vector<Dim>> thin_directions(std::span<const TurnedPart<Dim>> parts) {
  double bound = std::numeric_limits<double>::infinity();
  for (int k = 0; k < Dim; ++k)
    bound = std::min(bound, 0.5 * width<Dim>(parts, Vector<Dim>::Unit(k)));

  struct Candidate {
    double width;
    Vector<Dim> direction;
  };
  std::vector<Candidate> candidates;
  for (const TurnedPart<Dim>& part : parts) {
    const Vector<Dim> direction = thinnest(part);
    const double wide = width<Dim>(parts, direction);
    if (wide < bound) candidates.push_back({wide, direction});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.width < b.width; });

  std::vector<Vector<Dim>> chosen;
  for (const Candidate& c : candidates) {
    const bool known = std::any_of(chosen.begin(), chosen.end(),
                                   [&](const Vector<Dim>& d) { return std::abs(d.dot(c.direction)) > alike; });
    if (!known && chosen.size() + 1 < Dim) chosen.push_back(c.direction);
  }
  return chosen;
}

template std::vector<Vector<2>> thin_directions<2>(std::span<const TurnedPart<2>>);
template std::vector<Vector<3>> thin_directions<3>(std::span<const TurnedPart<3>>);

}  // namespace voussoir
