#include "core/output/vtp.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>

#include "text/plain_text.hpp"

namespace voussoir {
namespace {

using Text = std::back_insert_iterator<std::string>;

void append_number(Text out, double number, bool integer) {
  if (!std::isfinite(number))
    fmt::format_to(out, "0 ");
  else if (integer)
    fmt::format_to(out, "{} ", static_cast<long long>(number));
  else
    fmt::format_to(out, "{} ", number);
}

// by its size before the conversion to single precision: an overflow would trap
void append_single(Text out, double number) {
  using Single = std::numeric_limits<float>;
  const double size = std::isfinite(number) ? std::abs(number) : 0;
  if (size < Single::min() || size > Single::max())
    fmt::format_to(out, "0 ");
  else
    fmt::format_to(out, "{} ", static_cast<float>(number));
}

void append_array(Text out, const DataArray& array) {
  fmt::format_to(out, "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n",
                 array.integer  ? "Int64"
                 : array.single ? "Float32"
                                : "Float64",
                 xml_escaped(array.name), array.components);
  for (std::size_t k = 0; k < array.values.size(); ++k) {
    if (array.single)
      append_single(out, array.values[k]);
    else
      append_number(out, array.values[k], array.integer);
    if ((k + 1) % array.components == 0) fmt::format_to(out, "\n");
  }
  fmt::format_to(out, "        </DataArray>\n");
}

void append_arrays(Text out, const char* section, const std::vector<DataArray>& arrays) {
  fmt::format_to(out, "      <{}>\n", section);
  for (const DataArray& array : arrays)
    append_array(out, array);
  fmt::format_to(out, "      </{}>\n", section);
}

void append_points(Text out, const std::vector<std::array<double, 3>>& points) {
  DataArray coordinates{"Points", 3, false, {}};
  for (const std::array<double, 3>& point : points)
    coordinates.values.insert(coordinates.values.end(), point.begin(), point.end());
  append_arrays(out, "Points", {coordinates});
}

// connectivity lists the points of all cells, offsets where each cell's list ends
void append_cells(Text out, const char* section, const std::vector<std::vector<int>>& cells) {
  DataArray connectivity{"connectivity", 1, true, {}}, offsets{"offsets", 1, true, {}};
  for (const std::vector<int>& cell : cells) {
    connectivity.values.insert(connectivity.values.end(), cell.begin(), cell.end());
    offsets.values.push_back(static_cast<double>(connectivity.values.size()));
  }
  append_arrays(out, section, {connectivity, offsets});
}

// VTK's ASCII form of a string is its bytes as numbers, terminated by 0
void append_names(Text out, const std::string& name, const std::vector<std::string>& texts) {
  fmt::format_to(out, "      <Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">\n",
                 xml_escaped(name), texts.size());
  for (const std::string& text : texts) {
    for (const char character : text)
      fmt::format_to(out, "{} ", static_cast<int>(static_cast<unsigned char>(character)));
    fmt::format_to(out, "0\n");
  }
  fmt::format_to(out, "      </Array>\n");
}

void append_field_data(Text out, const PolyData& data) {
  fmt::format_to(out, "    <FieldData>\n");
  fmt::format_to(out, "      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">\n");
  append_number(out, data.time, false);
  fmt::format_to(out, "\n      </DataArray>\n");
  for (const auto& [name, texts] : data.names)
    if (!texts.empty()) append_names(out, name, texts);
  fmt::format_to(out, "    </FieldData>\n");
}

}  // namespace

std::string xml_escaped(const std::string& text) {
  std::string safe;
  for (const char character : printable(text)) {
    switch (character) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += character;
    }
  }
  return safe;
}

constexpr std::array kind_names{"Polys", "Verts", "Lines"};  // in the order of PolyData::Cells

std::string vtp(const PolyData& data) {
  const auto count = [&](PolyData::Cells kind) { return data.kind == kind ? data.cells.size() : 0; };
  std::string text;
  Text out(text);
  fmt::format_to(out, "<?xml version=\"1.0\"?>\n");
  fmt::format_to(out,
                 "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n");
  fmt::format_to(out, "  <PolyData>\n");
  append_field_data(out, data);
  fmt::format_to(out,
                 "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
                 "NumberOfPolys=\"{}\">\n",
                 data.points.size(), count(PolyData::Cells::vertices), count(PolyData::Cells::lines),
                 count(PolyData::Cells::polygons));
  append_arrays(out, "PointData", data.point_data);
  append_arrays(out, "CellData", data.cell_data);
  append_points(out, data.points);
  append_cells(out, kind_names[static_cast<std::size_t>(data.kind)], data.cells);
  fmt::format_to(out, "    </Piece>\n  </PolyData>\n</VTKFile>\n");
  return text;
}

std::string pvd(const std::vector<TimedFile>& files) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n";
  text += "  <Collection>\n";
  for (const TimedFile& file : files)
    text += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", file.time,
                        xml_escaped(file.file));
  return text + "  </Collection>\n</VTKFile>\n";
}

}  // namespace voussoir
