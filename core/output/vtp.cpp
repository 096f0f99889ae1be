#include "core/output/vtp.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <iterator>
#include <limits>
#include <new>

#include "text/plain_text.hpp"

namespace voussoir {
namespace {

using Text = std::back_insert_iterator<std::string>;

// zlib's fastest level, so that the same data are the same bytes with the same version of zlib: the ninth takes twenty
// times as long for 3 % less
constexpr int compression_level = 1;

// The numbers of a file, raw and little endian after the last element: each array compressed as one block, behind the
// header that VTK expects, of 64-bit words: blocks, bytes of a block, bytes of a last partial block (0: none), and
// compressed bytes of each.
class AppendedData {
 public:
  // the place of the array, from which its element finds it
  std::size_t add(const std::string& bytes) {
    const std::size_t at = bytes_.size();
    const std::uint64_t blocks = bytes.empty() ? 0 : 1;
    for (const std::uint64_t word : {blocks, std::max<std::uint64_t>(bytes.size(), 1), std::uint64_t{0}})
      append_bytes(bytes_, word);
    if (blocks == 0) return at;
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string packed(size, 0);
    if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                  static_cast<uLong>(bytes.size()), compression_level) != Z_OK)
      throw std::bad_alloc();
    append_bytes(bytes_, std::uint64_t{size});
    bytes_.append(packed, 0, size);
    return at;
  }
  const std::string& bytes() const { return bytes_; }

  // little endian, on any machine
  static void append_bytes(std::string& bytes, std::unsigned_integral auto word) {
    for (std::size_t k = 0; k < sizeof(word); ++k)
      bytes.push_back(static_cast<char>(word >> (8 * k) & 0xff));
  }

 private:
  std::string bytes_;
};

double finite_or_zero(double number) {
  return std::isfinite(number) ? number : 0;
}

// by its size before the conversion to single precision: an overflow would trap
float single_precision(double number) {
  using Single = std::numeric_limits<float>;
  const double size = std::abs(finite_or_zero(number));
  return size < Single::min() || size > Single::max() ? 0 : static_cast<float>(number);
}

std::string bytes_of(const DataArray& array) {
  std::string bytes;
  bytes.reserve(8 * array.values.size());
  for (const double number : array.values) {
    if (array.integer)
      AppendedData::append_bytes(bytes, static_cast<std::uint64_t>(static_cast<std::int64_t>(finite_or_zero(number))));
    else if (array.single)
      AppendedData::append_bytes(bytes, std::bit_cast<std::uint32_t>(single_precision(number)));
    else
      AppendedData::append_bytes(bytes, std::bit_cast<std::uint64_t>(finite_or_zero(number)));
  }
  return bytes;
}

void append_array(Text out, const DataArray& array, AppendedData& data) {
  fmt::format_to(out,
                 "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
                 "offset=\"{}\"/>\n",
                 array.integer  ? "Int64"
                 : array.single ? "Float32"
                                : "Float64",
                 xml_escaped(array.name), array.components, data.add(bytes_of(array)));
}

void append_arrays(Text out, const char* section, const std::vector<DataArray>& arrays, AppendedData& data) {
  fmt::format_to(out, "      <{}>\n", section);
  for (const DataArray& array : arrays)
    append_array(out, array, data);
  fmt::format_to(out, "      </{}>\n", section);
}

void append_points(Text out, const std::vector<std::array<double, 3>>& points, AppendedData& data) {
  DataArray coordinates{"Points", 3, false, {}};
  for (const std::array<double, 3>& point : points)
    coordinates.values.insert(coordinates.values.end(), point.begin(), point.end());
  append_arrays(out, "Points", {coordinates}, data);
}

// connectivity lists the points of all cells, offsets where each cell's list ends
void append_cells(Text out, const char* section, const std::vector<std::vector<int>>& cells, AppendedData& data) {
  DataArray connectivity{"connectivity", 1, true, {}}, offsets{"offsets", 1, true, {}};
  for (const std::vector<int>& cell : cells) {
    connectivity.values.insert(connectivity.values.end(), cell.begin(), cell.end());
    offsets.values.push_back(static_cast<double>(connectivity.values.size()));
  }
  append_arrays(out, section, {connectivity, offsets}, data);
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
  fmt::format_to(out, "{}\n      </DataArray>\n", finite_or_zero(data.time));
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
                 "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
                 "compressor=\"vtkZLibDataCompressor\">\n");
  fmt::format_to(out, "  <PolyData>\n");
  append_field_data(out, data);
  fmt::format_to(out,
                 "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
                 "NumberOfPolys=\"{}\">\n",
                 data.points.size(), count(PolyData::Cells::vertices), count(PolyData::Cells::lines),
                 count(PolyData::Cells::polygons));
  AppendedData appended;
  append_arrays(out, "PointData", data.point_data, appended);
  append_arrays(out, "CellData", data.cell_data, appended);
  append_points(out, data.points, appended);
  append_cells(out, kind_names[static_cast<std::size_t>(data.kind)], data.cells, appended);
  text += "    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_" + appended.bytes() +
          "\n  </AppendedData>\n</VTKFile>\n";
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
