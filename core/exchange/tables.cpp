#include "core/exchange/tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "core/geometry/half_space.hpp"
#include "text/csv_table.hpp"
#include "text/plain_text.hpp"
#include "text/text_scan.hpp"

namespace voussoir {
namespace {

using Names = std::vector<std::string>;

Names point_columns(int dimension) {
  return dimension == 3 ? Names{"x_m", "y_m", "z_m"} : Names{"x_m", "y_m"};
}

Names normal_columns(int dimension) {
  return dimension == 3 ? Names{"normal_x", "normal_y", "normal_z"} : Names{"normal_x", "normal_y"};
}

Names extent_columns(int dimension) {
  return dimension == 3 ? Names{"length_m", "width_m"} : Names{"length_m"};
}

const char* inside_column(int dimension) {
  return dimension == 3 ? "inside_m2" : "inside_m";
}

Names joined(Names names, const Names& more) {
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

std::string cells(const std::vector<double>& numbers, std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k)
    text += "," + (k < numbers.size() ? csv_cell(numbers[k]) : std::string());
  return text;
}

std::string corners_text(const JointRow& joint) {
  std::string text;
  for (const std::vector<double>& corner : joint.corners)
    text += fmt::format("{}{}", text.empty() ? "" : "; ", fmt::join(corner, " "));
  return text;
}

std::string header(const Names& names) {
  return fmt::format("{}\n", fmt::join(names, ","));
}

std::vector<double> required(const CsvTable& table, const CsvRow& row, const Names& columns) {
  std::vector<double> numbers;
  for (const std::string& column : columns)
    numbers.push_back(table.required_number(row, column));
  return numbers;
}

// A unit normal is kept bit for bit; any other vector was written by hand and is a mistake.
std::vector<double> unit_normal(const CsvTable& table, const CsvRow& row, int dimension) {
  const Names columns = normal_columns(dimension);
  std::vector<double> normal = required(table, row, columns);
  const double square = squared_length(normal);
  if (!is_unit(square))
    table.refuse(row, columns.front(),
                 "the normal must have length 1 (here " + fmt::format("{:.6g}", std::sqrt(square)) +
                     "); divide it by its length");
  return normal;
}

// the direction of the horizontal line in a plane that dips to the right of it
void read_strike(const CsvTable& table, const CsvRow& row, JointRow& joint) {
  const std::optional<double> strike = table.number(row, "strike_deg");
  if (!strike) return;
  if (joint.dip_direction_deg) table.refuse(row, "strike_deg", "the row states dip_direction_deg too; leave one empty");
  if (!(*strike >= 0 && *strike <= 360)) table.refuse(row, "strike_deg", "must be from 0 to 360, clockwise from north");
  joint.dip_direction_deg = *strike >= 270 ? *strike - 270 : *strike + 90;
}

void read_orientation(const CsvTable& table, const CsvRow& row, int dimension, JointRow& joint) {
  joint.dip_deg = table.number(row, "dip_deg");
  joint.dip_direction_deg = table.number(row, "dip_direction_deg");
  read_strike(table, row, joint);
  bool any = false;
  for (const std::string& column : normal_columns(dimension))
    any = any || !table.text(row, column).empty();
  if (any) joint.normal = unit_normal(table, row, dimension);
  if (joint.normal.empty() && !joint.dip_deg)
    table.refuse(row, "dip_deg", "the joint needs an orientation: dip_deg and dip_direction_deg, or its upward normal");
}

void read_corners(const CsvTable& table, const CsvRow& row, JointRow& joint) {
  joint.shape = OutlineForm::polygon;
  std::istringstream corners(table.text(row, "corners_m"));
  for (std::string corner; std::getline(corners, corner, ';');) {
    std::vector<double> numbers;
    for (const Word& word : words_of(corner, row.line))
      numbers.push_back(number_of({word.text, row.line, 0}, "corners_m"));
    if (numbers.size() != 3) table.refuse(row, "corners_m", "must be corners like \"0 0 0; 1 0 0; 0 1 0\", in m");
    joint.corners.push_back(std::move(numbers));
  }
  if (joint.corners.size() < 3) table.refuse(row, "corners_m", "a polygon needs at least three corners");
}

void read_outline(const CsvTable& table, const CsvRow& row, int dimension, JointRow& joint) {
  const std::string shape = table.text(row, "shape");
  const Names columns = extent_columns(dimension);
  if (shape.empty() || shape == "infinite") {
    for (const std::string& column : columns)
      if (!table.text(row, column).empty())
        table.refuse(row, column,
                     std::string("an infinite joint has no extent; remove it, or write shape ") +
                         (dimension == 3 ? "ellipse or rectangle" : "trace"));
    return;
  }
  if (dimension == 2 && shape == "trace")
    joint.shape = OutlineForm::rectangle;
  else if (dimension == 3 && shape == "ellipse")
    joint.shape = OutlineForm::ellipse;
  else if (dimension == 3 && shape == "rectangle")
    joint.shape = OutlineForm::rectangle;
  else if (dimension == 3 && shape == "polygon")
    return read_corners(table, row, joint);
  else
    table.refuse(row, "shape",
                 dimension == 3 ? "must be infinite, ellipse, rectangle or polygon" : "must be infinite or trace");
  for (const std::string& column : columns) {
    const double extent = table.required_number(row, column);
    if (!(extent > 0)) table.refuse(row, column, "must be greater than 0; it is the full extent in m");
    joint.extents.push_back(extent);
  }
}

// names of these columns in field books and other programs
const std::map<std::string, std::string>& usual_names() {
  static const std::map<std::string, std::string> names{
      {"id", "name"},
      {"label", "name"},
      {"jointid", "name"},
      {"joint", "name"},
      {"jointset", "set"},
      {"setid", "set"},
      {"family", "set"},
      {"dipangle", "dip_deg"},
      {"inclination", "dip_deg"},
      {"dd", "dip_direction_deg"},
      {"ddr", "dip_direction_deg"},
      {"dipdir", "dip_direction_deg"},
      {"dipazimuth", "dip_direction_deg"},
      {"azimuth", "dip_direction_deg"},
      {"x", "x_m"},
      {"easting", "x_m"},
      {"east", "x_m"},
      {"y", "y_m"},
      {"northing", "y_m"},
      {"north", "y_m"},
      {"z", "z_m"},
      {"elevation", "z_m"},
      {"elev", "z_m"},
      {"height", "z_m"},
      {"nx", "normal_x"},
      {"ny", "normal_y"},
      {"nz", "normal_z"},
      {"tracelength", "length_m"},
      {"persistence", "length_m"},
  };
  return names;
}

// CloudCompare's qCompass writes its planes as a table of its own
void refuse_planes_of_compass(const CsvTable& table) {
  for (const char* column : {"Strike", "Dip", "Dip_Dir", "Cx", "Cy", "Cz"})
    if (!table.find(column)) return;
  throw FileFault(table.header_line, 0, planes_of_compass);
}

}  // namespace

std::string shape_text(OutlineForm shape, int dimension) {
  switch (shape) {
    case OutlineForm::none:
      return "infinite";
    case OutlineForm::ellipse:
      return dimension == 2 ? "trace" : "ellipse";
    case OutlineForm::rectangle:
      return dimension == 2 ? "trace" : "rectangle";
    case OutlineForm::polygon:
      break;
  }
  return "polygon";
}

std::vector<JointRow> read_joint_table(std::string_view text, int dimension, std::vector<FileRemark>* remarks) {
  const CsvTable table = parse_csv(text, most_table_joints);
  refuse_planes_of_compass(table);
  Names orientation = joined({"dip_deg", "dip_direction_deg"}, normal_columns(dimension));
  Names other = joined({"name", "set", "shape", "properties", inside_column(dimension)}, extent_columns(dimension));
  if (dimension == 3) other.push_back("corners_m");
  if (dimension == 3) orientation.push_back("strike_deg");
  table.check_header(point_columns(dimension), joined(orientation, other), usual_names());
  if (const auto strike = table.find("strike_deg"); strike && remarks)
    remarks->push_back(
        {table.header_line, "strike_deg is read by the right-hand rule: dip direction = strike + 90 degrees"});
  std::vector<JointRow> joints;
  for (const CsvRow& row : table.rows) {
    JointRow joint;
    joint.line = row.line;
    joint.name = table.text(row, "name");
    if (joint.name.empty()) joint.name = fmt::format("joint-{}", joints.size() + 1);
    joint.set = table.text(row, "set");
    joint.properties = table.text(row, "properties");
    read_orientation(table, row, dimension, joint);
    joint.point = required(table, row, point_columns(dimension));
    read_outline(table, row, dimension, joint);
    joints.push_back(std::move(joint));
  }
  return joints;
}

std::string joint_table(const std::vector<JointRow>& rows, int dimension) {
  Names names = joined({"name", "set", "dip_deg", "dip_direction_deg"}, normal_columns(dimension));
  names = joined(joined(names, point_columns(dimension)), {"shape"});
  names = joined(names, extent_columns(dimension));
  if (dimension == 3) names.push_back("corners_m");
  std::string text = header(joined(names, {"properties", inside_column(dimension)}));
  for (const JointRow& joint : rows)
    text += fmt::format("{},{},{},{}{}{},{}{}{},{},{}\n", csv_cell(joint.name), csv_cell(joint.set),
                        csv_cell(joint.dip_deg), csv_cell(joint.dip_direction_deg), cells(joint.normal, dimension),
                        cells(joint.point, dimension), shape_text(joint.shape, dimension),
                        cells(joint.extents, dimension - 1), dimension == 3 ? "," + csv_cell(corners_text(joint)) : "",
                        csv_cell(joint.properties), csv_cell(joint.inside));
  return text;
}

std::vector<PlaneRow> read_plane_table(std::string_view text, int dimension) {
  constexpr int most_parts = 10'000;  // of one body; more is a mistake in the columns
  const CsvTable table = parse_csv(text);
  table.check_header(joined({"block", "offset_m"}, normal_columns(dimension)), {"part", "joint"});
  std::vector<PlaneRow> planes;
  std::set<std::string> with_first;  // blocks that have a part 0
  for (const CsvRow& row : table.rows) {
    PlaneRow plane;
    plane.line = row.line;
    plane.block = table.text(row, "block");
    if (plane.block.empty()) table.refuse(row, "block", "must name the block that the plane belongs to");
    const double part = table.number(row, "part").value_or(0);
    if (!(part >= 0 && part < most_parts && part == std::floor(part)))
      table.refuse(row, "part", "must be a whole number from 0 on: which convex part of the block");
    plane.part = static_cast<int>(part);
    if (plane.part == 0) with_first.insert(plane.block);
    plane.joint = table.text(row, "joint");
    plane.normal = required(table, row, normal_columns(dimension));
    plane.offset = table.required_number(row, "offset_m");
    planes.push_back(std::move(plane));
  }
  for (std::size_t k = 0; k < planes.size(); ++k)
    if (!with_first.contains(planes[k].block))
      table.refuse(table.rows[k], "part",
                   fmt::format("block '{}' has no part 0; parts are numbered from 0: renumber them",
                               one_line(planes[k].block, 60)));
  return planes;
}

std::string plane_table(const std::vector<PlaneRow>& rows, int dimension) {
  std::string text = header(joined(joined({"block", "part", "joint"}, normal_columns(dimension)), {"offset_m"}));
  for (const PlaneRow& plane : rows)
    text += fmt::format("{},{},{}{},{}\n", csv_cell(plane.block), plane.part, csv_cell(plane.joint),
                        cells(plane.normal, dimension), plane.offset);
  return text;
}

}  // namespace voussoir
