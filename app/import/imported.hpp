// The joints of another program's file: rows of our own table, and remarks and warnings for the user.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/exchange/tables.hpp"
#include "core/geometry/types.hpp"
#include "text/file_fault.hpp"
#include "text/text_scan.hpp"

namespace voussoir {

struct Dropped {
  std::string reason;
  int line = 0;  // 0: the file has none
};

struct ImportedJoints {
  int dimension = 3;
  std::vector<JointRow> joints;
  std::vector<std::optional<double>> out_of_plane;  // m, largest of a joint's corners; nothing if it has none
  std::vector<Dropped> dropped;
  std::vector<std::string> remarks;   // one line each
  std::vector<std::string> warnings;  // likewise, of data that may have been misinterpreted
  long long work = 0;                 // corners placed and names tried
};

// the place of a joint in the file
struct JointSource {
  int line = 0;
  std::string name, set;
};

struct StatedPlane {
  Vector<3> normal, centre;  // unit, m
};

// Collects the joints of a file. Throws FileFault at more joints than a scene may have, and at the end if there is
// none.
class JointCollector {
 public:
  explicit JointCollector(int dimension) { found_.dimension = dimension; }

  // The convex outline of the corners in the stated plane, or in that of least squares; dropped if they make no
  // face.
  void polygon(const JointSource& origin, const std::vector<Vector<3>>& corners,
               const std::optional<StatedPlane>& stated = std::nullopt);
  void ellipse(const JointSource& origin, const StatedPlane& plane, double along_strike, double down_dip);
  // 2-D, from end to end
  void trace(const JointSource& origin, const Vector<2>& from, const Vector<2>& to);

  void drop(int line, const std::string& reason) {
    found_.dropped.emplace_back().reason = reason;
    found_.dropped.back().line = line;
  }
  void remark(const std::string& text) { found_.remarks.push_back(text); }
  void warn(const std::string& text) { found_.warnings.push_back(text); }
  ImportedJoints finish();

 private:
  void add(const JointSource& origin, JointRow row, std::optional<double> out_of_plane);
  std::string free_name(const std::string& wanted);

  ImportedJoints found_;
  std::set<std::string> names_;
  std::map<std::string, int> repeated_;  // how often a name was used
  long long not_convex_ = 0;
  double largest_growth_ = 0;  // of an area by its convex outline, a fraction
};

// upward unit normal of the plane of least squares through its centre; nothing if the points are on a line
std::optional<StatedPlane> fitted_plane(const std::vector<Vector<3>>& points);

// a number that a scene takes for a coordinate, m
double coordinate_of(const Word& word, const std::string& what);
void refuse_far_coordinate(double coordinate, int line, int column);

std::string upper_case(std::string_view text);

}  // namespace voussoir
