// Blocks and faces stated by hand, for the tests of limit analysis in space.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "core/limit/limit.hpp"
#include "text/angle.hpp"

namespace voussoir::corner_scenes {

using Point = Vector<3>;

// Blocks and faces stated by hand; the body 0 is fixed.
struct CornerScene {
  CornerAssembly<3> assembly{{CornerBody<3>{Point::Zero(), 1, 1, {}}}, {}, {}};
  std::vector<Load<3>> dead{1}, live{1};

  int add(const Point& centroid, double weight, double radius, bool turns = true) {
    assembly.bodies.push_back({centroid, weight, radius, {true, true, true, turns, turns, turns}});
    dead.push_back({Point(0, 0, -weight), Point::Zero()});
    live.emplace_back();
    return static_cast<int>(assembly.bodies.size()) - 1;
  }
  void touch(int a, int b, const std::vector<Point>& corners, const Point& normal, double degrees,
             double cohesion = 0) {
    assembly.faces.push_back({a, b, normal.normalized(), corners, 0, degrees * degree, cohesion});
  }
  void push(int body, const Point& force, const Point& place) {
    live[body] = {force, (place - assembly.bodies[body].centroid).cross(force)};
  }
  LoadFactor<3> factor() const { return find_load_factor(assembly, dead, live); }
  CriticalStrength<3> friction() const {
    return find_critical_friction(assembly, dead, std::vector<bool>(assembly.faces.size(), true));
  }
};

struct Plane {
  double dip, direction;  // degrees
  Point normal() const {
    const double t = dip * degree, d = direction * degree;
    return {std::sin(t) * std::sin(d), std::sin(t) * std::cos(d), std::cos(t)};
  }
};

inline Point meet(const Point& a, double at_a, const Point& b, double at_b, const Point& c, double at_c) {
  return (at_a * b.cross(c) + at_b * c.cross(a) + at_c * a.cross(b)) / a.dot(b.cross(c));
}

// The tetrahedron between two joints, a level top and a slope face; the line of the joints daylights 1 m below the
// crest.
inline CornerScene wedge(const Point& a, const Point& b, const Point& face, double degrees, bool turns) {
  const Point low(0, 0, -1), up(0, 0, 1),
      far = meet(a, a.dot(low), b, b.dot(low), up, 0), on_a = meet(a, a.dot(low), face, face.dot(low), up, 0),
      on_b = meet(b, b.dot(low), face, face.dot(low), up, 0), centroid = (low + far + on_a + on_b) / 4;
  double radius = 0;
  for (const Point& corner : {low, far, on_a, on_b})
    radius = std::max(radius, (corner - centroid).norm());
  CornerScene scene;
  const int block = scene.add(centroid, 1, radius, turns);
  scene.touch(0, block, {low, far, on_a}, a, degrees);
  scene.touch(0, block, {low, far, on_b}, b, degrees);
  Point line = a.cross(b);
  if (line[2] > 0) line = -line;
  scene.push(block, Point(line[0], line[1], 0).normalized(), centroid);
  return scene;
}

// planes at half an angle to the vertical plane of their line, which plunges to the north
inline std::array<Point, 2> symmetric(double plunge, double half) {
  const Point above(0, std::sin(plunge * degree), std::cos(plunge * degree)), aside(std::cos(half * degree), 0, 0);
  return {aside + std::sin(half * degree) * above, -aside + std::sin(half * degree) * above};
}

inline std::vector<Point> rectangle(double x, double y) {
  return {{-x / 2, -y / 2, 0}, {x / 2, -y / 2, 0}, {x / 2, y / 2, 0}, {-x / 2, y / 2, 0}};
}

// running bond on a rigid floor, pushed in its plane or across
inline CornerScene wall(int courses, int bricks, double length, double height, double thickness, double degrees,
                        const Point& push) {
  struct Brick {
    double begin, end;
    int body;
  };
  CornerScene scene;
  std::vector<Brick> below{{0, bricks * length, 0}};
  const auto upright = [&](double x, double z) {
    return std::vector<Point>{{x, 0, z}, {x, thickness, z}, {x, thickness, z + height}, {x, 0, z + height}};
  };
  for (int course = 0; course < courses; ++course) {
    std::vector<double> ends{0};
    for (int k = 0; k < bricks; ++k)
      ends.push_back(course % 2 == 0 ? (k + 1) * length : (k + 0.5) * length);
    if (course % 2 == 1) ends.push_back(bricks * length);
    const double z = course * height;
    std::vector<Brick> row;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const double begin = ends[k], end = ends[k + 1], weight = (end - begin) * height * thickness;
      const Point centroid((begin + end) / 2, thickness / 2, z + height / 2);
      const int body = scene.add(centroid, weight, 0.5 * Point(end - begin, thickness, height).norm());
      scene.push(body, weight * push, centroid);
      if (!row.empty()) scene.touch(row.back().body, body, upright(begin, z), {1, 0, 0}, degrees);
      for (const Brick& under : below) {
        const double from = std::max(begin, under.begin), to = std::min(end, under.end);
        if (to - from > 1e-9)
          scene.touch(under.body, body, {{from, 0, z}, {to, 0, z}, {to, thickness, z}, {from, thickness, z}}, {0, 0, 1},
                      degrees);
      }
      row.push_back({begin, end, body});
    }
    below = row;
  }
  return scene;
}

// a cube between two parallel walls, pushed down by its weight
inline CornerScene drawer() {
  CornerScene scene;
  const int block = scene.add(Point::Zero(), 1, 0.87);
  const auto side = [](double x) {
    return std::vector<Point>{{x, -0.5, -0.5}, {x, 0.5, -0.5}, {x, 0.5, 0.5}, {x, -0.5, 0.5}};
  };
  scene.touch(0, block, side(-0.5), {1, 0, 0}, 35);
  scene.touch(block, 0, side(0.5), {1, 0, 0}, 35);
  scene.push(block, {0, 0, -1}, Point::Zero());
  return scene;
}

}  // namespace voussoir::corner_scenes
