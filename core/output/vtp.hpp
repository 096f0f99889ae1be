// VTK's XML PolyData (.vtp): points, polygons or vertices, and named arrays, compressed. Opens in ParaView.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace voussoir {

// text between tags or in quotes; characters that are not plain text are replaced
std::string xml_escaped(const std::string& text);

struct DataArray {
  std::string name;
  int components = 1;  // 3: a vector
  bool integer = false;
  std::vector<double> values;  // components × cells (or points)
  bool single = false;         // written to single precision; values that it cannot represent are 0
};

struct PolyData {
  enum class Cells { polygons, vertices, lines };
  Cells kind = Cells::polygons;
  std::vector<std::array<double, 3>> points;  // m
  std::vector<std::vector<int>> cells;        // indices in `points`
  std::vector<DataArray> cell_data;
  std::vector<DataArray> point_data;
  double time = 0;  // s, shown by ParaView
  // lists of names that integer arrays refer to, e.g. joint_names
  std::vector<std::pair<std::string, std::vector<std::string>>> names;
};

// A number that is not finite is written as 0: a failed run's last frame is useful, and no reader accepts "nan".
std::string vtp(const PolyData& data);

struct TimedFile {
  double time = 0;   // s
  std::string file;  // relative to the collection
};

// a .pvd collection: files and the times they belong to
std::string pvd(const std::vector<TimedFile>& files);

}  // namespace voussoir
