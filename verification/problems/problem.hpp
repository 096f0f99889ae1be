// A problem for any code: blocks, joints, loads, what is asked and how it is measured. SI units, angles in degrees as
// in the files; x east, y north, z up. A problem in the plane is one of prisms along y, drawn in x and z.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace voussoir::problems {

using Point = Eigen::Vector3d;
using Axes = Eigen::Matrix3d;  // columns: a block's axes in the world

struct Face {
  Point normal;              // outward, of length 1
  double offset = 0;         // m: normal . x <= offset inside the block
  std::vector<int> corners;  // of the block's vertices, counter-clockwise seen from outside
};

struct Solid {
  std::string name;
  bool fixed = false;
  double density = 0;           // kg/m3
  std::vector<Point> vertices;  // m, in the world
  std::vector<Face> faces;
  double mass = 0;                           // kg
  Point centre;                              // m, of mass
  Axes axes;                                 // through the centre, principal
  std::array<double, 3> moments{};           // kg m2, about those axes
  std::optional<std::array<double, 3>> box;  // m: edges along the axes, if the block is a box
  Point velocity = Point::Zero();            // m/s
  Point spin = Point::Zero();                // rad/s, in the world
};

struct Stiffness {
  double normal = 0, shear = 0;  // Pa/m
};

// of one pair of blocks, or of all pairs if `first` is empty
struct JointOf {
  std::string first, second;
  double friction_deg = 0, cohesion = 0, tension = 0;  // deg, Pa, Pa
  Stiffness stiff;
  std::optional<Stiffness> stated;  // if a second answer is asked
};

struct GravityAt {
  double time = 0;  // s
  Point gravity;    // m/s2
};

// a force on a block, at a point that moves with it, in a direction that does not turn
struct GivenForce {
  std::string block;
  Point force, point;                  // N, m
  std::vector<double> times, factors;  // s, 1: linear between, held after
};

struct Bolt {
  std::string name, from_block, to_block;
  Point from, to;                         // m
  double stiffness = 0, yield_force = 0;  // N/m, N
};

enum class SearchKind { friction, tension, gravity_direction, vertices };

struct Search {
  std::string parameter;  // friction_deg, tilt_deg, thickness_m, tension_Pa
  double lower = 0, upper = 0, tolerance = 0;
  bool fails_at_upper = false;
  SearchKind kind = SearchKind::friction;
  Point axis = Point::Zero();                        // gravity_direction: turned about it by the value
  double nominal = 0;                                // vertices: the value of the blocks as they are listed
  std::map<std::string, std::vector<Point>> change;  // vertices: of each vertex, by a unit of the value
};

struct Criterion {
  std::string kind;   // accelerates, gets faster, falls
  std::string block;  // "any block" for falls
  std::vector<double> times;
  double excess = 5e-4, far = 0.3;  // m
  double stopped = 0.05;            // m, gets faster: a path below it in the later interval is that of a stopped block
};

// a number that is asked, with one sentence on how it is measured
struct Asked {
  std::string quantity, unit, how;
};

// The value of a code with joint stiffness, or the interval of a rigid one; `case_name` and `row` name the row of the
// verdict table from which the value is taken.
struct Reference {
  std::string case_name, row;
  std::optional<std::string> lower_row;  // rigid: the lower end, if it is another row; `row` is then the upper one
  double absolute = 0, relative = 0;
  std::string because;
};

struct ReferenceOf {
  std::string quantity;
  std::optional<Reference> joints, rigid;
};

// the whole problem asked again with other velocities, gravity or search
struct Variant {
  std::string name;
  std::map<std::string, Point> velocities;
  std::vector<GravityAt> gravity;
  double duration = 0;
  std::optional<Search> search;
  std::optional<Criterion> criterion;
  std::vector<std::string> quantities;  // that it answers
};

// the whole problem turned: blocks, velocities, gravity
struct Position {
  std::string name;
  Eigen::Quaterniond turn;
};

// of the sketch: a line between two points of the world, with its length or a name
struct Dimension {
  Point from, to;
  std::string label;
};

// words of the task, a paragraph each
struct Words {
  std::string model, measured, protocol, two_answers, tolerance;
};

struct Problem {
  std::string name, title;
  int dimension = 3;
  double depth = 1;  // m, of the prisms of a problem in the plane
  std::vector<Solid> blocks;
  std::vector<JointOf> joints;
  std::vector<GravityAt> gravity;
  double duration = 0, output = 0.05;  // s
  std::vector<GivenForce> forces;
  std::vector<Bolt> bolts;
  std::optional<Search> search;
  std::optional<Criterion> criterion;
  std::vector<Position> positions;
  std::vector<Variant> variants;
  std::vector<Asked> asked;
  std::vector<ReferenceOf> references;
  std::vector<Dimension> dimensions;
  Words words;
};

}  // namespace voussoir::problems
