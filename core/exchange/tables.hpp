// The two tables that users own: joints, and the planes of blocks. Numbers are written with the fewest digits that read
// back to the same number, so that planes return exactly.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/outline.hpp"
#include "text/file_fault.hpp"

namespace voussoir {

// A joint as a row: columns name, dip_deg, dip_direction_deg or normal_x … (which takes precedence if both are stated,
// and is then exact), in space strike_deg instead of the dip direction, which by the right-hand rule is strike + 90°,
// x_m, y_m, z_m of any point (of a finite joint its centre), shape (infinite, or empty; ellipse, rectangle, polygon; in
// 2-D trace), length_m along the strike and width_m down the dip (2-D: length_m), of a polygon corners_m as "x y z; x y
// z; …", properties, set. inside_m2 (2-D: inside_m) is written for information and not read.
struct JointRow {
  int line = 0;  // of the file it came from
  std::string name, set, properties;
  std::optional<double> dip_deg, dip_direction_deg;
  std::vector<double> normal;  // empty if the row states none; upward, unit
  std::vector<double> point;   // m
  OutlineForm shape = OutlineForm::none;
  std::vector<double> extents;               // m, along the strike and down the dip; 2-D: the length; empty: persistent
  std::vector<std::vector<double>> corners;  // m, of a polygon
  std::optional<double> inside;              // m² (2-D: m)
};

// why a table of planes of CloudCompare's plugin qCompass is not read, and which tables are
inline constexpr const char* planes_of_compass =
    "is a table of planes of CloudCompare's qCompass, which states no outlines; rename its columns Name, Dip, Dip_Dir, "
    "Cx, Cy, Cz to name, dip_deg, dip_direction_deg, x_m, y_m, z_m and remove the others, and a scene reads it as "
    "joints_file; or export facets of the plugin qFacets, which 'voussoir import --as facets' reads";

// as scenes and tables name it
std::string shape_text(OutlineForm shape, int dimension);

inline constexpr std::size_t most_table_joints = 10'000;  // as a scene may state

// Throws FileFault, but leaves the ranges of angles and coordinates to the scene. `remarks` receives notes for the user
// on how the table was read.
std::vector<JointRow> read_joint_table(std::string_view text, int dimension,
                                       std::vector<FileRemark>* remarks = nullptr);
std::string joint_table(const std::vector<JointRow>& rows, int dimension);

// A face of a convex part: normal · x <= offset. Columns block, part (from 0; may be left out), joint (which made it,
// not read), normal_x …, offset_m.
struct PlaneRow {
  int line = 0;
  std::string block;
  int part = 0;
  std::string joint;
  std::vector<double> normal;
  double offset = 0;  // m
};

std::vector<PlaneRow> read_plane_table(std::string_view text, int dimension);
std::string plane_table(const std::vector<PlaneRow>& rows, int dimension);

}  // namespace voussoir
