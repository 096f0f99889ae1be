// The constant side of a simulation: bodies, joints, properties, loads. Const within a stage; `apply` makes the next.
// All coordinates are relative to `origin`, so that nothing is lost far from it.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/geometry/polytope.hpp"
#include "core/joint_laws/joint_properties.hpp"
#include "core/load/boundary_stress.hpp"
#include "core/load/load.hpp"
#include "core/load/quiet_plate.hpp"
#include "core/solvers/solvers.hpp"
#include "core/support/bolt.hpp"
#include "core/support/lining.hpp"

namespace voussoir {

template <int Dim>
struct Body {
  std::string name;                                      // empty when the scene gave none
  std::vector<Polytope<Dim>> parts;                      // in the body's frame: origin at its centroid; none: a node of
                                                         // a lining
  Vector<Dim> reference = Vector<Dim>::Zero();           // centroid at the start, m
  double mass = 0;                                       // kg (2-D: per metre)
  Spin<Dim> inertia = Spin<Dim>::Zero();                 // principal moments, kg m²
  Matrix<Dim> principal_axes = Matrix<Dim>::Identity();  // columns in the body's frame
  double radius = 0;                                     // largest distance of a vertex from the centroid, m
  double size = 0;                                       // smallest inscribed radius of its parts, m
  bool fixed = false;                                    // held, except for the motion in Model::prescribed
  bool prescribed = false;                               // moves as Model::prescribed states
  bool present = true;                                   // false once excavated: ids never change
  bool column = false;                                   // of a free-field column: no selector chooses it
  bool image = false;                                    // of such a column: repeats the motion of another body
  std::array<bool, Dim> free_translation;                // world axes; all true unless restrained
  std::array<bool, spin_freedoms<Dim>> free_rotation;

  bool immobile() const { return fixed && !prescribed; }
};

// a record that moves a body along a direction
template <int Dim>
struct RecordedAxis {
  Vector<Dim> direction = Vector<Dim>::Zero();  // unit vector
  std::shared_ptr<const GroundMotion> motion;
};

// a motion forced upon a body: its forced degrees of freedom are not free while it lasts
template <int Dim>
struct PrescribedMotion {
  int body = 0;
  std::array<bool, Dim> translation{};             // forced axes
  bool rotation = false;                           // forced about all axes
  Vector<Dim> velocity = Vector<Dim>::Zero();      // m/s, at a factor of 1
  Spin<Dim> angular_velocity = Spin<Dim>::Zero();  // rad/s, world axes
  TimeFactor factor;                               // of the time since the stage began
  std::vector<RecordedAxis<Dim>> records{};        // velocities that are added, without the factor
  int repeats = -1;                                // instead: the body whose motion it repeats
  std::array<bool, Dim> free_translation{};        // of the body when the motion ends
  std::array<bool, spin_freedoms<Dim>> free_rotation{};
};

// the stress on a body's outer faces, as forces
template <int Dim>
struct BoundaryForces {
  int body = 0;
  std::vector<DeadLoad<Dim>> forces;
  DepthStress<Dim> stress{};
};

// a motion that enters at a quiet side
template <int Dim>
struct EnteringWave {
  Vector<Dim> velocity = Vector<Dim>::Zero();  // m/s, at a factor of 1
  TimeFactor factor{};                         // of the time since the stage began
  std::vector<RecordedAxis<Dim>> records{};    // velocities that are added, without the factor
  double upgoing = 1;                          // share of the sum that is the upgoing wave
};

// the rock beyond a side, and how it was found
struct Medium {
  double normal_speed = 0, shear_speed = 0;  // m/s: of waves along the side's normal; of the slower shear wave
  bool stated = false;                       // its impedances are the scene's
  bool regular = false;                      // the joint sets' own: else an estimate from the side's blocks
};

// a side that waves leave
template <int Dim>
struct OpenSide {
  std::string name;  // "bottom", …
  bool free_field = false;
  Medium medium;
  EnteringWave<Dim> wave{};
};

// A face of a body on such a side. Before a free field its plate is moved by the face of the column's body.
template <int Dim>
struct OpenFace {
  int body = 0, side = 0;                   // side: of Model::open_sides
  Vector<Dim> place = Vector<Dim>::Zero();  // its centroid, body frame, m
  QuietPlate<Dim> plate;
  int column = -1;  // the body of the column at the same height; -1: ground that carries the entering wave
};

// A body of a free-field column beside the model, which repeats a body of the side with the same joints.
template <int Dim>
struct ColumnBody {
  int side = 0;  // of Model::open_sides
  int body = 0, of_side = 0;
};

// Its image in the next column, by which the column is joined to itself.
template <int Dim>
struct ColumnImage {
  int body = 0, of_column = 0;  // bodies
  int of_model = -1;            // the body of the model that stands beside the side's body as the image does beside the
                                // column's; or the opposite, if it is mirrored; -1: none
  bool mirrored = false;
  bool outside = false;  // it stands where the model has ended
};

// a force that the scene puts on a body
template <int Dim>
struct AppliedForce {
  std::string name;
  int body = 0;
  Vector<Dim> place = Vector<Dim>::Zero();  // point of action, body frame, m
  Vector<Dim> force = Vector<Dim>::Zero();  // N, at a factor of 1; world axes, or the body's if it turns with it
  bool turns_with_body = false;
  TimeFactor factor;       // of the time since the stage began
  double last_factor = 1;  // when it ends
};

// a water: its numbers are those of core/load/water.hpp in model coordinates, or one pressure
struct Water {
  std::string name;
  double unit_weight = 9810;   // N/m³
  bool uniform = false;        // a constant pressure
  std::vector<double> values;  // before the first stage; the present ones are in State::schedule
};

// the numbers of each water
using WaterValues = std::vector<std::vector<double>>;

// a convex region that a stage excavates
template <int Dim>
struct Excavation {
  std::string name;
  HalfSpaces<Dim> region;   // m
  double least_radius = 0;  // m: a body of which only smaller parts remain is removed, too
};

// a named discontinuity, in slicing order
template <int Dim>
struct Joint {
  std::string name;
  HalfSpace<Dim> plane;  // upward normal
  int properties = 0;    // index into Model::properties
  bool holds = false;    // a construction joint: its two sides are one body
};

// a convex part of a body: contacts are between parts
struct PartId {
  int body, part;
};

template <int Dim>
struct Model {
  Vector<Dim> origin = Vector<Dim>::Zero();  // world = origin + model coordinates, m
  std::vector<Body<Dim>> bodies;             // ids are places in this list: canonical order, never changed
  std::vector<PartId> parts;                 // every part, by body
  bool particles = false;                    // some of them are potential particles
  std::vector<Joint<Dim>> joints;
  std::vector<JointProperties> properties;
  std::vector<PrescribedMotion<Dim>> prescribed;  // of this stage, by ascending body, at most one for each
  std::vector<BoundaryForces<Dim>> boundary;      // by ascending body, at most one for each
  std::vector<OpenSide<Dim>> open_sides;          // in the order of the scene
  std::vector<OpenFace<Dim>> open_faces;          // as sides were opened; those of a stage never leave the list
  std::vector<ColumnBody<Dim>> column_bodies;     // by side, then by the side's body
  std::vector<ColumnImage<Dim>> column_images;    // by column body
  std::vector<int> unsupported;                   // bodies that this stage released for an open side, ascending
  std::vector<AppliedForce<Dim>> applied;         // by ascending body
  std::vector<Water> waters;
  std::vector<int>
      water_of_joint;            // the water on the faces of each joint and, last, on faces that no joint made; -1: dry
  bool water_by_volume = false;  // the one water is a table on all faces: its load has a potential
  std::vector<BodyStiffness> water_bounds;      // by body: core/load/water.hpp, greatest_water_stiffness
  std::vector<Excavation<Dim>> excavations;     // that stages excavate, in the order of the scene
  std::vector<BoltProperties> bolt_properties;  // by name, in alphabetical order
  std::vector<Bolt<Dim>> bolts;                 // by their properties: those that stages install
  std::vector<Lining> linings;                  // likewise, by name, in alphabetical order; in the plane
  int default_properties = 0;                   // of contacts between faces that no joint made
  Vector<Dim> gravity = Vector<Dim>::Zero();    // m/s²
  Solvers<Dim> solvers;                         // the two convex programs' solvers in use

  const Polytope<Dim>& polytope(int part) const { return bodies[parts[part].body].parts[parts[part].part]; }
};

// A body from its parts (common frame, m) and density (kg/m³): moves them to the centroid, finds mass and principal
// axes.
template <int Dim>
Body<Dim> make_body(std::vector<Polytope<Dim>> parts, double density);

// The same from parts in their final order.
template <int Dim>
Body<Dim> assemble_body(std::vector<Polytope<Dim>> parts, double density);

// m: inscribed radius of its largest part; splinters that an outline cuts off and the body holds are no measure
template <int Dim>
double inscribed_radius(const Body<Dim>& body);

// of all its parts, m³ (2-D: m²)
template <int Dim>
double volume(const Body<Dim>& body);

// Sorts bodies by centroid then volume, so that ids do not depend on the order of input, and lists the parts.
template <int Dim>
void number_bodies(Model<Dim>& model);

// fills Model::parts from its bodies
template <int Dim>
void list_parts(Model<Dim>& model);

// Gives the model its waters: which one is on the faces of each joint and, last, on faces that no joint made; -1: none.
template <int Dim>
void assign_waters(Model<Dim>& model, std::vector<Water> waters, std::vector<int> water_of_joint);

// Model::water_bounds, if there is water
template <int Dim>
void bound_water_stiffness(Model<Dim>& model);

// the names of the sides of a model, by axis the lower and the upper one
template <int Dim>
std::vector<std::string> side_names();

// The bodies a selector names, in ascending order. Sides of joints are those of a body's reference centroid, `inside`
// (world coordinates) tests its parts, and a side of the model is the end of its outer faces along an axis; several
// conditions must all hold. An unknown name throws std::out_of_range with the name; choosing none is not an error here.
template <int Dim>
std::vector<int> select(const Model<Dim>& model, const Selector& selector);

// Stresses the faces of a body that no joint made, its surface in model coordinates; it replaces the stress on the body
// before.
template <int Dim>
void load_boundary(Model<Dim>& model, int body, const DepthStress<Dim>& stress);

// The model of the next stage: prescribed motions ended, regions excavated (excavation.hpp), bodies fixed, released or
// removed, friction set, outer faces stressed, forces applied, linings' nodes added, motions prescribed. Two motions of
// one body are a mistake of the caller.
template <int Dim>
Model<Dim> apply(Model<Dim> model, const Change& change);

// The part of this that needs no model.
void set_friction(const Change& change, std::vector<JointProperties>& properties);

}  // namespace voussoir
