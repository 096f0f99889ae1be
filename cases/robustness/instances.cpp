#include "cases/robustness/instances.hpp"

#include <cmath>
#include <numbers>

namespace voussoir::atlas {
namespace {

// five random planes in a cube, about one across
HalfSpaces<3> ordinary(Random& random) {
  return shapes::random_planes<3>(random, 5, 0.5);
}

// planes of the solid squeezed along z
HalfSpaces<3> squeezed(HalfSpaces<3> planes, double factor) {
  for (HalfSpace<3>& p : planes) {
    p.normal[2] /= factor;
    const double length = p.normal.norm();
    p.normal /= length;
    p.offset /= length;
  }
  return planes;
}

// a slab or a squeezed random solid, or every third time a needle
HalfSpaces<3> thin(double thinness, Random& random) {
  const int kind = shapes::integer(random, 0, 3);
  if (kind == 0) return squeezed(ordinary(random), thinness);
  if (kind == 1) return shapes::box<3>({-0.5 * thinness, -0.5 * thinness, -0.5}, {0.5 * thinness, 0.5 * thinness, 0.5});
  return squeezed(shapes::cube<3>(0.5), thinness);
}

// a cube with one more face, hinged on its top and rotated by the angle: a thin wedge is cut off
HalfSpaces<3> with_turned_face(double angle, Random& random) {
  HalfSpaces<3> planes = shapes::cube<3>(0.5);
  const double hinge = shapes::uniform(random, -0.4, 0.4);
  const Vector<3> normal(std::sin(angle), 0, std::cos(angle));
  planes.push_back({normal, normal.dot(Vector<3>(hinge, 0, 0.5))});
  return planes;
}

// a wedge whose two large faces meet at the angle, closed by a box
HalfSpaces<3> wedge(double angle) {
  HalfSpaces<3> planes = shapes::box<3>({0, -0.5, 0}, {1, 0.5, 1});
  planes.push_back({{-std::sin(angle), 0, std::cos(angle)}, 0});
  return planes;
}

// an ordinary solid with one corner cut off at a small distance
HalfSpaces<3> with_small_face(double ratio, Random& random) {
  HalfSpaces<3> planes = ordinary(random);
  const Polytope<3> part = shapes::block<3>(planes);
  const int corner = shapes::integer(random, 0, static_cast<int>(part.vertices.size()) - 1);
  Vector<3> out = Vector<3>::Zero();
  for (const int f : shapes::faces_at<3>(part, {corner}))
    out += part.faces[f].normal;
  out.normalize();
  planes.push_back({out, out.dot(part.vertices[corner]) - 0.1 / ratio});
  return planes;
}

// planes that touch a sphere
HalfSpaces<3> round(int faces, Random& random) {
  if (faces <= 6) return faces == 4 ? shapes::platonic_solids(0.3)[0].planes : shapes::cube<3>(0.4);
  HalfSpaces<3> planes = shapes::platonic_solids(0.5)[0].planes;  // closes it
  while (static_cast<int>(planes.size()) < faces)
    planes.push_back({shapes::direction<3>(random), 0.5});
  return planes;
}

// ---- features -------------------------------------------------------------------------------------------------------

// between the normals of the faces, strictly
Vector<3> direction_between(const Polytope<3>& part, const std::vector<int>& faces, Random& random) {
  Vector<3> sum = Vector<3>::Zero();
  for (const int f : faces)
    sum += shapes::uniform(random, 0.3, 1) * part.faces[f].normal;
  return sum.norm() > 1e-3 ? Vector<3>(sum.normalized()) : part.faces[faces.front()].normal;
}

int any_face(const Polytope<3>& part, Random& random) {
  return shapes::integer(random, 0, static_cast<int>(part.faces.size()) - 1);
}

int any_corner(const std::vector<int>& loop, Random& random) {
  return shapes::integer(random, 0, static_cast<int>(loop.size()) - 1);
}

Feature corner_of(const Polytope<3>& part, Random& random) {
  const std::vector<int>& loop = part.loops[any_face(part, random)];
  const int corner = loop[any_corner(loop, random)];
  return {part.vertices[corner], direction_between(part, shapes::faces_at<3>(part, {corner}), random)};
}

Feature edge_of(const Polytope<3>& part, Random& random) {
  const std::vector<int>& loop = part.loops[any_face(part, random)];
  const int k = any_corner(loop, random), from = loop[k], to = loop[(k + 1) % loop.size()];
  const Vector<3> middle =
      part.vertices[from] + shapes::uniform(random, 0.3, 0.7) * (part.vertices[to] - part.vertices[from]);
  return {middle, direction_between(part, shapes::faces_at<3>(part, {from, to}), random)};
}

Feature face_of(const Polytope<3>& part, Random& random) {
  const int face = any_face(part, random);
  Vector<3> point = Vector<3>::Zero();
  double sum = 0;
  for (const int corner : part.loops[face]) {
    const double weight = shapes::uniform(random, 0.3, 1);
    point += weight * part.vertices[corner];
    sum += weight;
  }
  return {point / sum, part.faces[face].normal};
}

// the foremost corner of a face that is tilted by the angle
Feature tilted_face_of(const Polytope<3>& part, double angle, Random& random) {
  const Feature face = face_of(part, random);
  Feature best = face;
  double highest = -std::numeric_limits<double>::infinity();
  Vector<3> along = shapes::direction<3>(random);
  along = (along - along.dot(face.direction) * face.direction).normalized();
  best.direction = (std::cos(angle) * face.direction + std::sin(angle) * along).normalized();
  for (const Vector<3>& v : part.vertices)
    if (best.direction.dot(v) > highest) {
      highest = best.direction.dot(v);
      best.point = v;
    }
  return best;
}

// the kinds of meeting, in turn
struct Kind {
  Feature (*a)(const Polytope<3>&, Random&);
  Feature (*b)(const Polytope<3>&, Random&);
};
constexpr std::array<Kind, 5> meeting_kinds{
    {{face_of, face_of}, {face_of, corner_of}, {edge_of, edge_of}, {edge_of, face_of}, {corner_of, corner_of}}};

double smaller_diameter(const Polytope<3>& a, const Polytope<3>& b) {
  return 2 * std::min(a.inscribed_radius, b.inscribed_radius);
}

}  // namespace

Shapes random_shapes(const Place& place, Random& random) {
  Shapes s;
  switch (place.axis) {
    case Axis::thinness:
      s.a = thin(place.value, random);
      s.b = thin(place.value, random);
      break;
    case Axis::angle:
      s.a = shapes::integer(random, 0, 1) ? with_turned_face(place.value, random) : wedge(place.value);
      s.b = shapes::cube<3>(0.5);
      break;
    case Axis::ratio:
      s.a = shapes::integer(random, 0, 1) ? with_small_face(place.value, random)
                                          : shapes::scaled<3>(ordinary(random), place.value);
      s.b = ordinary(random);
      break;
    case Axis::placed:
    case Axis::made:
      s.a = ordinary(random);
      s.b = ordinary(random);
      break;
    case Axis::faces:
      s.a = round(static_cast<int>(place.value), random);
      s.b = round(static_cast<int>(place.value), random);
  }
  s.a = shapes::turned_anyhow<3>(s.a, random);
  s.b = shapes::turned_anyhow<3>(s.b, random);
  if (place.axis == Axis::made) s.made = place.value * shapes::direction<3>(random);
  return s;
}

Meeting meet(const Polytope<3>& a, const Polytope<3>& b, const Place& place, int kind, Random& random) {
  Meeting m;
  m.a = make_body<3>({a}, 1);
  m.b = make_body<3>({b}, 1);
  const Polytope<3>&own_a = m.a.parts[0], &own_b = m.b.parts[0];
  const Kind& features = meeting_kinds[kind % meeting_kinds.size()];
  const Feature at_a = features.a(own_a, random);
  const Feature at_b =
      place.axis == Axis::angle ? tilted_face_of(own_b, place.value, random) : features.b(own_b, random);

  // b is rotated so that its feature faces that of a, and about the common direction at random
  const Quaternion facing = rotation_onto(at_b.direction, -at_a.direction).quaternion;
  const Quaternion spin(Eigen::AngleAxisd(shapes::uniform(random, -3, 3), at_a.direction));
  m.turn.quaternion = (spin * facing).normalized();
  const Vector<3> between =
      at_a.point - place.depth * smaller_diameter(a, b) * at_a.direction - matrix(m.turn) * at_b.point;

  // far from the origin the references take the part that they can represent and the displacement the remainder
  const Vector<3> far =
      place.axis == Axis::placed ? Vector<3>(place.value * shapes::direction<3>(random)) : Vector<3>(Vector<3>::Zero());
  m.a.reference = far;
  m.b.reference = far + between;
  m.displacement_b = between - (m.b.reference - m.a.reference);
  return m;
}

HalfSpace<3> cutting_plane(const Polytope<3>& block, const Place& place, int kind, Random& random) {
  constexpr std::array<Feature (*)(const Polytope<3>&, Random&), 3> features{face_of, edge_of, corner_of};
  const Feature at = features[kind % features.size()](block, random);
  return {at.direction, at.direction.dot(at.point) - place.depth * 2 * block.inscribed_radius};
}

}  // namespace voussoir::atlas
