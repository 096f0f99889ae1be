#include "reference/tunnel/ring_moment.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <vector>

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace voussoir::reference::ring_moment_test {
namespace {

constexpr double pi = std::numbers::pi;

struct FrameForces {
  std::vector<double> start_moment, end_moment,
      thrust;  // per member, sagging (tension inside) and compression positive
};

// A closed polygonal frame by the direct stiffness method: corners clockwise from the crown, members with axial
// stiffness EA and bending stiffness EI under a load per member length, uniform over the member. Rigid motions are held
// at corner 0; the loads balance, so the reactions are zero.
FrameForces solve_frame(const std::vector<Vector2d>& corner, const std::function<Vector2d(int member)>& load, double ea,
                        double ei) {
  const int count = static_cast<int>(corner.size());
  MatrixXd stiffness = MatrixXd::Zero(3 * count, 3 * count);
  VectorXd force = VectorXd::Zero(3 * count);
  struct Member {
    MatrixXd local, turn;
    VectorXd fixed;
    int freedom[6];
  };
  std::vector<Member> members;
  for (int i = 0; i < count; ++i) {
    const int j = (i + 1) % count;
    const Vector2d along = corner[j] - corner[i];
    const double length = along.norm(), c = along.x() / length, s = along.y() / length;
    Member m{MatrixXd::Zero(6, 6),
             MatrixXd::Zero(6, 6),
             VectorXd::Zero(6),
             {3 * i, 3 * i + 1, 3 * i + 2, 3 * j, 3 * j + 1, 3 * j + 2}};
    const double a = ea / length, b = ei / (length * length * length);
    m.local << a, 0, 0, -a, 0, 0,                                                                 //
        0, 12 * b, 6 * b * length, 0, -12 * b, 6 * b * length,                                    //
        0, 6 * b * length, 4 * b * length * length, 0, -6 * b * length, 2 * b * length * length,  //
        -a, 0, 0, a, 0, 0,                                                                        //
        0, -12 * b, -6 * b * length, 0, 12 * b, -6 * b * length,                                  //
        0, 6 * b * length, 2 * b * length * length, 0, -6 * b * length, 4 * b * length * length;
    for (int end = 0; end < 2; ++end) {
      m.turn(3 * end, 3 * end) = m.turn(3 * end + 1, 3 * end + 1) = c;
      m.turn(3 * end, 3 * end + 1) = s;
      m.turn(3 * end + 1, 3 * end) = -s;
      m.turn(3 * end + 2, 3 * end + 2) = 1;
    }
    const Vector2d q = load(i);
    const double axial = c * q.x() + s * q.y(), across = -s * q.x() + c * q.y();
    m.fixed << axial * length / 2, across * length / 2, across * length * length / 12, axial * length / 2,
        across * length / 2, -across * length * length / 12;
    const MatrixXd global = m.turn.transpose() * m.local * m.turn;
    const VectorXd equivalent = m.turn.transpose() * m.fixed;
    for (int p = 0; p < 6; ++p) {
      force(m.freedom[p]) += equivalent(p);
      for (int q2 = 0; q2 < 6; ++q2)
        stiffness(m.freedom[p], m.freedom[q2]) += global(p, q2);
    }
    members.push_back(m);
  }
  for (int p = 0; p < 3; ++p) {
    stiffness.row(p).setZero();
    stiffness.col(p).setZero();
    stiffness(p, p) = ei;
    force(p) = 0;
  }
  const VectorXd moved = stiffness.ldlt().solve(force);
  FrameForces result;
  for (const Member& m : members) {
    VectorXd ends(6);
    for (int p = 0; p < 6; ++p)
      ends(p) = moved(m.freedom[p]);
    const VectorXd end_force = m.local * (m.turn * ends) - m.fixed;
    // A counter-clockwise couple stretches the left side at a member's start (a clamped beam under its load: the top),
    // the right side at its end. Clockwise members have the inside on their right.
    result.start_moment.push_back(-end_force(2));
    result.end_moment.push_back(end_force(5));
    result.thrust.push_back((end_force(0) - end_force(3)) / 2);
  }
  return result;
}

std::vector<Vector2d> regular_polygon(int sides, double circumradius) {
  std::vector<Vector2d> corner;
  for (int i = 0; i < sides; ++i)
    corner.emplace_back(circumradius * std::sin(2 * pi * i / sides), circumradius * std::cos(2 * pi * i / sides));
  return corner;
}

TEST(RingMoment, VerticalPressureAgainstAFrame) {
  const int count = 180;
  const double a = 5, p = 662175;
  const auto corner = regular_polygon(count, a);
  const FrameForces frame = solve_frame(
      corner,
      [&](int i) {
        const Vector2d along = corner[(i + 1) % count] - corner[i];
        // p per horizontal length, downwards on the upper half and upwards on the lower
        return Vector2d(0, -p * along.x() / along.norm());
      },
      1e12, 1e6);
  for (int i = 0; i < count; ++i) {
    const MemberForces closed = ring_under_vertical_pressure(p, a, 2 * pi * i / count);
    EXPECT_NEAR(frame.start_moment[i], closed.moment, 1e-3 * p * a * a / 4);  // the polygon differs by (pi/n)^2
    const double middle = ring_under_vertical_pressure(p, a, 2 * pi * (i + 0.5) / count).thrust;
    EXPECT_NEAR(frame.thrust[i], middle, 2e-3 * p * a);
  }
  EXPECT_NEAR(ring_under_vertical_pressure(p, a, 0).moment, p * a * a / 4, 1e-6);  // the crown sags
  EXPECT_NEAR(ring_under_vertical_pressure(p, a, pi / 2).thrust, p * a, 1e-6);
}

TEST(RingMoment, PolygonAgainstAFrame) {
  for (const int sides : {3, 4, 12, 25}) {
    const double a = 5, q = 1e5;
    const auto corner = regular_polygon(sides, a);
    const FrameForces frame = solve_frame(
        corner,
        [&](int i) {
          const Vector2d along = (corner[(i + 1) % sides] - corner[i]).normalized();
          return Vector2d(q * along.y(), -q * along.x());  // to the right: inwards
        },
        1e9, 1e6);
    const MemberForces vertex = polygon_under_pressure(q, a, sides, 0),
                       middle = polygon_under_pressure(q, a, sides, 0.5);
    const double sine = std::sin(pi / sides);
    EXPECT_NEAR(vertex.moment, -q * a * a * sine * sine / 3, 1e-9 * q * a * a);
    EXPECT_NEAR(middle.moment, -vertex.moment / 2, 1e-9 * q * a * a);
    for (int i = 0; i < sides; ++i) {
      EXPECT_NEAR(frame.start_moment[i], vertex.moment, 1e-7 * q * a * a);
      EXPECT_NEAR(frame.end_moment[i], vertex.moment, 1e-7 * q * a * a);
      EXPECT_NEAR(frame.thrust[i], vertex.thrust, 1e-7 * q * a);
    }
  }
}

TEST(RingMoment, LimitsAndScaling) {
  EXPECT_NEAR(polygon_under_pressure(1, 5, 100000, 0).moment, 0, 1e-7);  // a circle has no ripple
  EXPECT_NEAR(polygon_under_pressure(1, 5, 100000, 0).thrust, 5, 1e-7);
  EXPECT_NEAR(polygon_under_pressure(7, 50, 12, 0.2).moment, 700 * polygon_under_pressure(1, 5, 12, 0.2).moment, 1e-9);
  EXPECT_THROW(polygon_under_pressure(1, 5, 2, 0), std::invalid_argument);
  EXPECT_THROW(ring_under_vertical_pressure(1, 0, 0), std::invalid_argument);
}

// Eqs I.1-I.3: cut the ring at the crown, integrate, close it by mean and first harmonics of the cut ring's moment.
TEST(RingMoment, RingMomentsByCuttingAndClosing) {
  const int count = 720;
  const double a = 5;
  auto pressure_at = [](double t) {
    return 3 + 2 * std::cos(t) - std::sin(t) + 1.5 * std::cos(2 * t) + 0.7 * std::sin(3 * t) - 0.2 * std::cos(5 * t);
  };
  std::vector<double> pressure(count);
  double up = 0, right = 0;  // resultants of the inward pressure
  for (int k = 0; k < count; ++k) {
    const double t = 2 * pi * k / count;
    pressure[k] = pressure_at(t);
    up -= pressure[k] * std::cos(t) * a * 2 * pi / count;
    right -= pressure[k] * std::sin(t) * a * 2 * pi / count;
  }
  // shear, positive along growing t (clockwise: right cos t, up -sin t), that balances them
  auto shear_at = [&](double t) { return -right / (pi * a) * std::cos(t) + up / (pi * a) * std::sin(t); };
  // moment of the cut ring from the loads between the crown and t
  std::vector<double> cut(count, 0.0);
  for (int k = 0; k < count; ++k) {
    const double t = 2 * pi * k / count;
    for (int j = 0; j < k; ++j) {
      const double s = 2 * pi * (j + 0.5) / count, part = a * 2 * pi / count;
      const double fx = (-pressure_at(s) * std::sin(s) + shear_at(s) * std::cos(s)) * part;
      const double fy = (-pressure_at(s) * std::cos(s) - shear_at(s) * std::sin(s)) * part;
      const double x = a * (std::sin(s) - std::sin(t)), y = a * (std::cos(s) - std::cos(t));
      cut[k] -= x * fy - y * fx;  // balanced by the couple on this part's end, counter-clockwise = sagging
    }
  }
  double mean = 0, cosine = 0, sine = 0;
  for (int k = 0; k < count; ++k) {
    const double t = 2 * pi * k / count;
    mean += cut[k] / count, cosine += 2 * cut[k] * std::cos(t) / count, sine += 2 * cut[k] * std::sin(t) / count;
  }
  const std::vector<double> closed = ring_moments(pressure, a);
  for (int k = 0; k < count; ++k) {
    const double t = 2 * pi * k / count;
    EXPECT_NEAR(closed[k], cut[k] - mean - cosine * std::cos(t) - sine * std::sin(t), 2e-3 * a * a);
  }
  // uniform pressure: none; an oval one: a^2/3 at the crown, sagging
  EXPECT_NEAR(ring_moments({4, 4, 4, 4, 4, 4}, 5)[1], 0, 1e-12);
  std::vector<double> oval(12);
  for (int k = 0; k < 12; ++k)
    oval[k] = std::cos(2 * pi * 2 * k / 12);
  EXPECT_NEAR(ring_moments(oval, 5)[0], 25.0 / 3, 1e-12);
}

TEST(RingMoment, PressureFromASide) {
  std::vector<double> position, moment;
  for (int i = 0; i <= 6; ++i) {
    position.push_back(1000 + 0.4 * i);
    moment.push_back(polygon_under_pressure(2e5, 5, 12, i / 6.0).moment);
  }
  const double length = 2 * 5 * std::sin(pi / 12);
  for (int i = 0; i <= 6; ++i)
    position[i] = 1000 + length * i / 6;
  EXPECT_NEAR(pressure_from_moments(position, moment), 2e5, 1e-4);
  EXPECT_THROW(pressure_from_moments({1, 1, 1}, {0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(ring_moments({1, 2}, 5), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::ring_moment_test
