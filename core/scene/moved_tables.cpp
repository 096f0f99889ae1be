#include "core/scene/moved_tables.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/half_space.hpp"
#include "core/geometry/outline.hpp"
#include "core/scene/bodies.hpp"
#include "core/scene/bolts.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/read_plane.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// ---- values of a tree

Node number(double value, const Place& place) {
  Node node;
  node.kind = Node::Kind::number;
  node.number = value + 0.0;  // of two zeros the positive one
  node.place = place;
  return node;
}

template <class Vec>
Node list_of(const Vec& v, const Place& place) {
  Node node;
  node.kind = Node::Kind::list;
  node.place = place;
  for (Eigen::Index k = 0; k < v.size(); ++k)
    node.items.push_back(number(v[k], place));
  return node;
}

template <int Dim>
Vector<Dim> vector_of(const Node& list) {
  Vector<Dim> v;
  for (int k = 0; k < Dim; ++k)
    v[k] = list.items[k].number;
  return v;
}

void forget(Node& table, std::string_view key) {
  std::erase_if(table.members, [&](const Member& member) { return member.key == key; });
}

template <int Dim>
void move_point(Node* point, const RigidMove<Dim>& move) {
  if (point) *point = list_of(move(vector_of<Dim>(*point)), point->place);
}

template <int Dim>
void move_points(Node* points, const RigidMove<Dim>& move) {
  if (!points) return;
  for (Node& point : points->items)
    move_point<Dim>(&point, move);
}

template <int Dim>
void turn_direction(Node* direction, const RigidMove<Dim>& move) {
  if (direction && move.turns) *direction = list_of(move.turn * vector_of<Dim>(*direction), direction->place);
}

// ---- rotations

// cosine and sine, exact at multiples of 90 degrees
std::pair<double, double> cosine_and_sine(double degrees) {
  const double within = std::remainder(degrees, 360);
  const double quarters = std::round(within / 90);
  const double rest = (within - 90 * quarters) * degree;
  const double c = std::cos(rest), s = std::sin(rest);
  switch (static_cast<int>(quarters)) {
    case 1:
      return {-s, c};
    case -1:
      return {s, -c};
    case 0:
      return {c, s};
    default:
      return {-c, -s};
  }
}

template <int Dim>
Matrix<Dim> turn_of(const CopiesSpec&, double degrees) {
  const auto [c, s] = cosine_and_sine(degrees);
  return (Matrix<2>() << c, -s, s, c).finished();
}

// Rodrigues' formula
template <>
Matrix<3> turn_of<3>(const CopiesSpec& spec, double degrees) {
  const auto [c, s] = cosine_and_sine(degrees);
  const Vector<3> axis = to_vector<3>(spec.axis).normalized();
  Matrix<3> across;
  across << 0, -axis[2], axis[1], axis[2], 0, -axis[0], -axis[1], axis[0], 0;
  return c * Matrix<3>::Identity() + s * across + (1 - c) * axis * axis.transpose();
}

// ---- blocks

// a box that is no longer aligned with the axes
template <int Dim>
Node planes_of_box(const Node& box, const RigidMove<Dim>& move) {
  Node planes;
  planes.kind = Node::Kind::list;
  planes.place = box.place;
  for (int k = 0; k < Dim; ++k)
    for (const auto& [corner, sign] : {std::pair("min", -1.0), std::pair("max", 1.0)}) {
      Node plane;
      plane.place = box.place;
      plane.set("normal", list_of(move.turn * (sign * Vector<Dim>::Unit(k)), box.place));
      plane.set("point", list_of(move(vector_of<Dim>(*box.find(corner))), box.place));
      planes.items.push_back(std::move(plane));
    }
  return planes;
}

template <int Dim>
void move_plane(Node& plane, const RigidMove<Dim>& move) {
  const Vector<Dim> before = vector_of<Dim>(*plane.find("normal"));
  turn_direction<Dim>(plane.find("normal"), move);
  move_point<Dim>(plane.find("point"), move);
  if (Node* offset = plane.find("offset")) {
    const Vector<Dim> after = move.turn * before;
    *offset = number(offset->number + after.dot(move.about + move.shift) - before.dot(move.about), offset->place);
  }
}

// ---- joints

// corners of a rectangle about a point of its plane
template <int Dim>
Node corners_of(const Node& joint, const Vector<3>& normal, const RigidMove<Dim>& move) {
  const Node& shape = *joint.find("shape");
  Node corners;
  corners.kind = Node::Kind::list;
  corners.place = shape.place;
  const PlaneAxes<3> axes = plane_axes(normal);
  const Vector<3> centre = vector_of<3>(*joint.find("point"));
  const double a = joint.find("length")->number / 2, b = joint.find("width")->number / 2;
  for (const auto& [u, v] : {std::pair(-a, -b), std::pair(a, -b), std::pair(a, b), std::pair(-a, b)})
    corners.items.push_back(list_of(move(centre + axes * Vector<2>(u, v)), shape.place));
  return corners;
}

// an outline in 3-D; in 2-D a trace remains a trace
void move_outline(Node& joint, const std::string& path, const Vector<3>& normal, const Vector<3>& upward,
                  const RigidMove<3>& move) {
  Node* shape = joint.find("shape");
  if (!shape) return;
  move_points<3>(joint.find("corners"), move);
  if (!move.turns) return;
  if (shape->text == "rectangle") {
    joint.set("corners", corners_of<3>(joint, normal, move));
    joint.find("shape")->text = "polygon";
    forget(joint, "length");
    forget(joint, "width");
  } else if (shape->text == "ellipse" && joint.find("length")->number != joint.find("width")->number) {
    constexpr double rounding = 1e-9;
    const Matrix<2> between = plane_axes(upward).transpose() * move.turn * plane_axes(normal);
    if (std::abs(between(0, 1)) > rounding)
      refuse({&joint, path}, "shape",
             "its axes are along strike and dip, and would not be after this rotation; write shape = \"polygon\" and "
             "corners, or repeat it by "
             "shift only");
  }
}

void move_outline(Node&, const std::string&, const Vector<2>&, const Vector<2>&, const RigidMove<2>&) {}

template <int Dim>
Vector<Dim> stated_normal(const PlaneSpec& plane) {
  return to_half_space<Dim>(plane, Vector<Dim>::Zero()).normal;
}

// if a joint is turned upside down, the side below it becomes the side above
void swap_sides(Node& joint) {
  if (Node* fixed = joint.find("fixed_side")) fixed->text = fixed->text == "below" ? "above" : "below";
}

// ---- bolts

// Angles of rays are measured from the horizontal, which a rotation may tilt.
template <int Dim>
double degrees_gained(const Node&, const RigidMove<Dim>& move) {
  return move.degrees;
}

template <>
double degrees_gained<3>(const Node& fan, const RigidMove<3>& move) {
  const Vector<3> axis = vector_of<3>(*fan.find("axis")), turned = move.turn * axis;
  const Vector<3> right = move.turn * ray_axes<3>({axis.data(), axis.data() + 3})[0];
  const auto axes = ray_axes<3>({turned.data(), turned.data() + 3});
  return to_degrees(std::atan2(right.dot(axes[1]), right.dot(axes[0])));
}

template <int Dim>
void move_fan(Node& fan, const RigidMove<Dim>& move) {
  move_point<Dim>(fan.find("centre"), move);
  if (!move.turns) return;
  double gained = degrees_gained<Dim>(fan, move);
  if constexpr (Dim == 3) turn_direction<Dim>(fan.find("axis"), move);
  Node &from = *fan.find("from_deg"), &to = *fan.find("to_deg");
  constexpr double most = 360;
  if (to.number + gained > most) gained -= 360;
  if (from.number + gained < -most) gained += 360;
  from = number(from.number + gained, from.place);
  to = number(to.number + gained, to.place);
}

}  // namespace

template <int Dim>
Vector<Dim> RigidMove<Dim>::operator()(const Vector<Dim>& point) const {
  return about + turn * (point - about) + shift;
}

template <int Dim>
RigidMove<Dim> move_of(const CopiesSpec& spec, int times) {
  RigidMove<Dim> move;
  if (!spec.shift.empty()) move.shift = times * to_vector<Dim>(spec.shift);
  move.turns = spec.turn != 0;
  if (!move.turns) return move;
  move.about = to_vector<Dim>(spec.about);
  move.degrees = std::remainder(times * spec.turn, 360);
  move.turn = turn_of<Dim>(spec, move.degrees);
  return move;
}

template <int Dim>
void move_block(Node& block, const RigidMove<Dim>& move) {
  move_points<Dim>(block.find("vertices"), move);
  if (Node* planes = block.find("planes"))
    for (Node& plane : planes->items)
      move_plane<Dim>(plane, move);
  if (Node* box = block.find("box"); box && move.turns) {
    Node planes = planes_of_box<Dim>(*box, move);
    forget(block, "box");
    block.set("planes", std::move(planes));
  } else if (box) {
    move_point<Dim>(box->find("min"), move);
    move_point<Dim>(box->find("max"), move);
  }
  move_point<Dim>(block.find("centre"), move);
  turn_direction<Dim>(block.find("velocity"), move);
  if constexpr (Dim == 3) turn_direction<Dim>(block.find("angular_velocity"), move);
}

template <int Dim>
void move_joint(Node& joint, const std::string& path, const RigidMove<Dim>& move) {
  const Vector<Dim> before = stated_normal<Dim>(read_plane({&joint, path}, "joints", Dim));
  Vector<Dim> after = move.turn * before;
  const bool over = after[Dim - 1] < 0;
  if (over) after = -after;
  move_outline(joint, path, before, after, move);
  move_point<Dim>(joint.find("point"), move);
  if (!move.turns) return;
  // dip and dip direction would be rounded
  const Place place = joint.find("point")->place;
  forget(joint, "dip");
  forget(joint, "dip_direction");
  joint.set("normal", list_of(after.cwiseMax(-1.0).cwiseMin(1.0), place));
  if (over) swap_sides(joint);
}

template <int Dim>
void move_bolt(Node& bolt, const RigidMove<Dim>& move) {
  move_point<Dim>(bolt.find("from"), move);
  move_point<Dim>(bolt.find("to"), move);
  if (Node* fan = bolt.find("fan")) move_fan<Dim>(*fan, move);
  if (Node* rows = bolt.find("repeat"))
    for (Node& row : rows->items)
      turn_direction<Dim>(row.find("step"), move);
}

template struct RigidMove<2>;
template struct RigidMove<3>;
template RigidMove<2> move_of<2>(const CopiesSpec&, int);
template RigidMove<3> move_of<3>(const CopiesSpec&, int);
template void move_block<2>(Node&, const RigidMove<2>&);
template void move_block<3>(Node&, const RigidMove<3>&);
template void move_joint<2>(Node&, const std::string&, const RigidMove<2>&);
template void move_joint<3>(Node&, const std::string&, const RigidMove<3>&);
template void move_bolt<2>(Node&, const RigidMove<2>&);
template void move_bolt<3>(Node&, const RigidMove<3>&);

}  // namespace voussoir
