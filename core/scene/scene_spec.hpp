// The statements of a scene file, in SI units and radians; nothing is derived here.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/joint_laws/joint_properties.hpp"
#include "core/joint_sets/joint_set.hpp"
#include "core/load/ground_motion.hpp"
#include "core/model/prepared.hpp"
#include "core/scene/node.hpp"
#include "core/slicing/slice.hpp"

namespace voussoir {

// `subject` is the place of a statement in the file, so that a later error can name line, key and value. Vectors have
// as many entries as the scene has dimensions; coordinates are the file's.

struct PlaneSpec {
  double dip = 0, dip_direction = 0;  // rad
  std::vector<double> point;          // m
  std::vector<double> normal;         // upward, unit: the plane to the last bit if stated; or empty
};

struct BoxSpec {
  Subject subject;
  std::vector<double> min, max;  // m
};

struct DomainPlaneSpec {
  Subject subject;
  PlaneSpec plane;
  bool keep_below = true;
};

struct DomainSpec {
  Subject subject;
  std::optional<BoxSpec> box;
  std::vector<DomainPlaneSpec> planes;
};

// extent of a joint in its plane, about the plane's point
struct OutlineSpec {
  OutlineForm shape = OutlineForm::none;     // 2-D: a trace is a rectangle
  double length = 0, width = 0;              // m: along the strike (2-D: of the trace), down the dip
  std::vector<std::vector<double>> corners;  // m, of a polygon, in space
};

// a tunnel or, in 2-D, a circle: a circumscribed prism
struct CylinderSpec {
  Subject subject;
  std::vector<double> from, to;  // m; 2-D: only the centre
  double radius = 0;             // m
  int sides = 24;
};

// convex; at most one of box and cylinder
struct RegionSpec {
  Subject subject;
  std::optional<BoxSpec> box;
  std::optional<CylinderSpec> cylinder;
  std::vector<DomainPlaneSpec> planes;
};

struct JointSpec {
  Subject subject;
  std::string name;
  PlaneSpec plane;
  std::optional<std::string> properties;
  OutlineSpec outline;
  std::string set;  // joints with the same name form a set; or empty
  JointKind kind = JointKind::rock;
  JointSide fixed_side = JointSide::none;
  std::optional<RegionSpec> within;  // the subdomain to which it is confined
  std::vector<std::string> ends_at;  // joints stated before it, and excavations
};

// excavated before the first stage or by a stage
struct ExcavationSpec {
  std::string name;
  RegionSpec region;
  bool outline = false;                  // construction joints along its faces
  std::optional<double> smallest_piece;  // m: inscribed radius of the remaining pieces of blocks
};

enum class JointEnds {
  extended,  // at the faces of the blocks that the joint meets
  healed,    // likewise, and blocks that it does not separate completely are joined again
  ignored    // not at all: every joint is persistent
};

struct SlicingSpec {
  CuttingOrder order = CuttingOrder::by_size;
  JointEnds ends = JointEnds::extended;
  double smallest_inscribed_radius = 0;  // m
  double largest_aspect_ratio = 0;       // of the box along the axes; 0: no bound
  int most_blocks = 1'000'000;
};

struct JointSetSpec {
  Subject subject;
  JointSet set;
  std::optional<std::string> properties;
  std::optional<RegionSpec> within;
};

struct PropertiesSpec {
  Subject subject;
  JointProperties properties;
};

struct BlockPlaneSpec {
  Subject subject;
  std::vector<double> normal;                // any length
  std::optional<double> offset;              // m, for the normal as given; or
  std::optional<std::vector<double>> point;  // m
};

struct MotionSpec {
  std::optional<std::vector<double>> velocity;          // m/s
  std::optional<std::vector<double>> angular_velocity;  // rad/s; 2-D one entry
};

enum class BlockShape { half_spaces, potential };

// the stated values of a potential particle (core/potential/shape.hpp)
struct ParticleSpec {
  std::optional<double> corner_radius, sphericity, sphere_radius;  // r, m; k; R, m
  std::optional<std::vector<double>> centre;                       // c, m
  double mass_tolerance = 1e-3;                                    // of the volume
};

struct BlockSpec {
  Subject subject;
  std::string name;
  BlockShape shape = BlockShape::half_spaces;
  ParticleSpec particle;
  std::vector<std::vector<double>> vertices;  // m; exactly one of these three is stated
  std::vector<BlockPlaneSpec> planes;
  std::optional<BoxSpec> box;
  std::string part_of;            // another block, to whose body this part belongs; or empty
  std::optional<double> density;  // kg/m³
  MotionSpec motion;
  bool fixed = false;
};

// the surface of a water, or a pressure: exactly one is stated
struct WaterSurfaceSpec {
  std::optional<double> level, pressure;   // m, Pa
  std::vector<std::vector<double>> table;  // m: points (x, h), 2-D
  std::optional<PlaneSpec> plane;          // 3-D
};

struct WaterSpec {
  Subject subject;
  std::string name;
  double unit_weight = 9810;              // N/m³
  std::vector<std::string> faces{"all"};  // "all", "outer", joints or joint sets
  WaterSurfaceSpec surface;
  std::vector<double> numbers;  // of the surface (core/load/water.hpp, the file's coordinates), or the pressure; enough
                                // for every change of the water
};

// a change of a water within a stage
struct WaterChangeSpec {
  Subject subject;
  std::string name;                      // of the water
  std::optional<double> duration, rate;  // s; m/s or Pa/s
  WaterSurfaceSpec surface;
};

// bolts on rays
struct FanSpec {
  std::vector<double> centre, axis;      // m; 3-D: perpendicular to the rays
  double from = 0, to = 0, spacing = 0;  // rad
  double start = 0, length = 0;          // m
};

struct RepeatSpec {
  std::vector<double> step;  // m
  int count = 2;
};

struct BoltSpec {
  Subject subject;
  BoltProperties properties;     // of one bolt
  std::vector<double> from, to;  // m; empty: a fan
  std::optional<FanSpec> fan;
  std::vector<RepeatSpec> repeat;
  std::optional<double> spacing;  // m, out of the plane
};

struct LiningSpec {
  Subject subject;
  LiningProperties properties;
  std::string excavation, interface_properties;
  int nodes = 0;
  std::optional<double> from, to;  // rad; without `to` a ring
};

struct SelectorSpec {
  Subject subject;
  Selector selector;  // `inside` in the file's coordinates
};

struct RestrainSpec {
  SelectorSpec bodies;
  std::array<bool, 3> translation{}, rotation{};  // true: no movement along or about this axis
};

struct InitialVelocitySpec {
  SelectorSpec bodies;
  MotionSpec motion;
};

// What a file of a record contains, as the scene may state it too.
struct SamplesSpec {
  std::vector<double> values;   // in its unit
  double interval = 0;          // s
  std::string unit, component;  // may be empty
  std::optional<MotionQuantity> quantity;
};

// an earthquake record that prescribes a motion along a direction
struct RecordSpec {
  Subject subject;
  std::string file;
  SamplesSpec samples;
  std::optional<MotionQuantity> quantity;
  MotionQuantity resolved = MotionQuantity::acceleration;  // that, or what the file or the unit says
  std::optional<std::string> unit;
  std::optional<double> interval;  // s
  std::optional<int> column;
  double scale = 1;
  bool reversed = false;
  RecordTreatment treatment;                     // its scale is that of the unit, `scale` and the polarity
  std::optional<std::vector<double>> direction;  // any length
  std::optional<double> azimuth;                 // rad, clockwise from north
};

struct StageSpec {
  Subject subject;
  StagePlan plan;
  std::vector<RecordSpec> records;     // by move, those of plan.change.move
  std::vector<WaterChangeSpec> water;  // their numbers are in plan.water
  std::map<std::string, std::vector<SelectorSpec>, std::less<>>
      chosen;  // the selectors of plan.change by key, in its order, with their places

  const std::vector<SelectorSpec>& chosen_by(std::string_view key) const {
    static const std::vector<SelectorSpec> none;
    const auto found = chosen.find(key);
    return found == chosen.end() ? none : found->second;
  }
};

struct MonitorSpec {
  SelectorSpec body;  // empty for a joint or a water
  std::string name, joint, water, bolts, lining;
  std::string excavation;          // of convergence
  std::vector<double> angles;      // deg, of convergence and lining_force
  std::string since, since_start;  // a stage from whose end, or start, it measures; empty: from the start of the run
  Aggregate over{};
  std::vector<Monitored> quantities;
};

// [[repeat]]; a scene that has been read has only the copies
struct CopiesSpec {
  std::vector<std::string> blocks, joints, bolts;
  int count = 0;
  std::vector<double> shift, about, axis;  // m; empty: not stated
  double turn = 0;                         // deg
};

struct Scene {
  std::string file, title;
  int dimension = 3;
  std::optional<std::vector<double>> gravity;  // m/s²
  std::optional<double> density;               // kg/m³
  std::optional<DomainSpec> domain;
  std::vector<JointSpec> joints;  // in the order of the file, before those of the sets
  std::vector<JointSetSpec> joint_sets;
  std::vector<PropertiesSpec> properties;
  std::vector<BlockSpec> blocks;
  std::vector<SelectorSpec> fix;
  std::vector<RestrainSpec> restrain;
  std::vector<InitialVelocitySpec> initial_velocity;
  Settings settings;
  SlicingSpec slicing;
  std::vector<ExcavationSpec> excavations;
  std::vector<WaterSpec> waters;
  std::vector<BoltSpec> bolts;
  std::vector<LiningSpec> linings;
  std::vector<StageSpec> stages;
  std::vector<MonitorSpec> monitors;
  OutputPlan output;
  std::vector<std::string> from_level;   // what accuracy.level set: "key = value"
  std::vector<std::string> from_preset;  // what the preset set
  std::vector<std::string> renamed;      // keys under an earlier name: "scene.toml:7: … is now …"
  std::vector<std::filesystem::path>
      files;                         // that were read: the scene's own, if it is a file, and those that it names
  std::vector<std::string> remarks;  // remarks on these files for the user, one line each
  std::shared_ptr<const Node> tree;  // the effective file, overrides applied; subjects point into it
};

}  // namespace voussoir
