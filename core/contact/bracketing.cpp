#include "core/contact/bracketing.hpp"

#include <limits>
#include <span>

namespace voussoir {
namespace {

// a part that continues beyond 2^64 times its slack is open: coordinates resolve no more than 2^53 of them
constexpr int doublings = 64;

// g(t) of Eq. 3.37 and the plane that has it
struct Depth {
  double value = -std::numeric_limits<double>::infinity();
  int face = -1;
};

template <int Dim>
Depth depth_at(std::span<const HalfSpace<Dim>> part, const Vector<Dim>& point, const Vector<Dim>& direction, double t) {
  Depth deepest;
  for (int i = 0; i < static_cast<int>(part.size()); ++i) {
    const double value = signed_distance(part[i], point) + t * part[i].normal.dot(direction);
    if (value > deepest.value) deepest = {value, i};
  }
  return deepest;
}

// distance from the point to the end of the part
template <int Dim>
bool find_end(std::span<const HalfSpace<Dim>> part, const Vector<Dim>& point, const Vector<Dim>& direction,
              double& distance, int& face) {
  // normals are unit, so the part cannot end nearer than its slack at the point: doubled until it is passed
  const double slack = -depth_at<Dim>(part, point, direction, 0).value;
  if (!(slack > 0)) return false;
  double inside = 0, outside = slack;
  for (int k = 0; depth_at<Dim>(part, point, direction, outside).value <= 0; ++k, outside *= 2) {
    if (k == doublings) return false;
    inside = outside;
  }
  while (true) {
    const double middle = inside + (outside - inside) / 2;
    if (middle <= inside || middle >= outside) break;
    (depth_at<Dim>(part, point, direction, middle).value > 0 ? outside : inside) = middle;
  }
  distance = outside;
  face = depth_at<Dim>(part, point, direction, outside).face;
  return true;
}

}  // namespace

template <int Dim>
bool overlap_by_bracketing(const HalfSpaces<Dim>& planes, int faces_a, const Vector<Dim>& point,
                           const Vector<Dim>& normal, double& overlap, int& face_a, int& face_b) {
  const std::span<const HalfSpace<Dim>> all(planes);
  double ahead = 0, behind = 0;
  face_a = face_b = -1;
  if (!find_end<Dim>(all.first(faces_a), point, normal, ahead, face_a)) return false;
  if (!find_end<Dim>(all.subspan(faces_a), point, -normal, behind, face_b)) return false;
  face_b += faces_a;
  overlap = ahead + behind;
  return true;
}

template bool overlap_by_bracketing<2>(const HalfSpaces<2>&, int, const Vector<2>&, const Vector<2>&, double&, int&,
                                       int&);
template bool overlap_by_bracketing<3>(const HalfSpaces<3>&, int, const Vector<3>&, const Vector<3>&, double&, int&,
                                       int&);

}  // namespace voussoir
