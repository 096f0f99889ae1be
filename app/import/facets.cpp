#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>

#include "app/import/formats.hpp"
#include "core/geometry/half_space.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr int written_digits = 6;  // of the program's numbers
// Dip and dip direction are whole degrees there: a larger deviation from the normal is an error
constexpr double another_rounded_plane = 3 * degree;

using Triple = std::array<const char*, 3>;
constexpr Triple centre_columns{"CenterX", "CenterY", "CenterZ"}, normal_columns{"NormalX", "NormalY", "NormalZ"},
    global_centre_columns{"GlobalCenterX", "GlobalCenterY", "GlobalCenterZ"};

std::vector<Word> cells_of(std::string_view line, int number) {
  std::vector<Word> cells;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(';', at), line.size());
    std::size_t from = at, to = end;
    const auto is_edge = [&](std::size_t k) { return line[k] == ' ' || line[k] == '\t' || line[k] == '"'; };
    while (from < to && is_edge(from))
      ++from;
    while (to > from && is_edge(to - 1))
      --to;
    cells.push_back({line.substr(from, to - from), number, static_cast<int>(from) + 1});
    at = end + 1;
  }
  return cells;
}

struct FittedFacet {
  JointSource origin;
  StatedPlane plane;  // local
  double along_strike = 0, down_dip = 0;
  std::vector<Vector<3>> corners;
};

// The rounding error of a number of the file: half a unit of its last digit; it has at least the digits that the
// program writes.
double rounding_of(const Word& word, double number) {
  const std::string_view mantissa = word.text.substr(0, word.text.find_first_of("eE"));
  const auto digits = static_cast<int>(
      std::count_if(mantissa.begin(), mantissa.end(), [](unsigned char c) { return std::isdigit(c) != 0; }));
  if (number == 0) return 0;
  return 0.5 * std::pow(10.0, std::floor(std::log10(std::abs(number))) + 1 - std::max(digits, written_digits));
}

// the shift of the centres of all facets, within the bounds of rounding
struct Between {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();

  double half_width() const { return (high - low) / 2; }
  // a shift is a number that someone chose: the roundest within the bounds
  double roundest() const {
    if (low <= 0 && high >= 0) return 0;
    for (int power = 12; power > -7; --power) {
      const double step = std::pow(10.0, power), number = std::ceil(low / step) * step;
      if (number <= high) return number;
    }
    return (low + high) / 2;
  }
};

class FacetsReader {
 public:
  explicit FacetsReader(std::string_view text) : lines_(text) {}

  ImportedJoints read(const Vector<3>& shift) {
    header();
    while (lines_.next()) {
      if (lines_.line().find_first_not_of(" \t;") == std::string_view::npos) continue;
      row();
    }
    const Vector<3> moved = global_shift() + shift;
    for (FittedFacet& facet : facets_) {
      facet.plane.centre += moved;
      for (Vector<3>& corner : facet.corners)
        corner += moved;
      if (facet.corners.empty())
        joints_.ellipse(facet.origin, facet.plane, facet.along_strike, facet.down_dip);
      else
        joints_.polygon(facet.origin, facet.corners, facet.plane);
    }
    const auto ellipses =
        std::count_if(facets_.begin(), facets_.end(), [](const FittedFacet& f) { return f.corners.empty(); });
    if (ellipses > 0)
      joints_.remark(
          fmt::format("{} facets have no polygon and were replaced by the ellipses of their extensions", ellipses));
    if (largest_rms_ > 0)
      joints_.remark(fmt::format(
          "points deviate from the fitted planes by at most {:.3g} m (root mean square of one facet)", largest_rms_));
    return joints_.finish();
  }

 private:
  void header() {
    while (lines_.next() && lines_.line().find_first_not_of(" \t") == std::string_view::npos) {
    }
    const std::string_view line = lines_.line();
    if (line.find("Strike,Dip,Dip_Dir,") != std::string_view::npos)
      throw FileFault(std::max(1, lines_.number()), 0, planes_of_compass);
    if (line.find(';') == std::string_view::npos)
      throw FileFault(
          std::max(1, lines_.number()), 0,
          "the header has no semicolons; export the facets as CSV in CloudCompare and leave the file as it is");
    const std::vector<Word> names = cells_of(line, lines_.number());
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (names[k].text.empty()) continue;
      if (!places_.emplace(names[k].text, k).second)
        throw FileFault(names[k].line, names[k].column,
                        "the column " + shown(names[k].text) + " appears twice; remove one");
      columns_ = k + 1;
    }
    for (const Triple& names_of : {centre_columns, normal_columns})
      for (const char* name : names_of)
        if (!places_.contains(name))
          throw FileFault(lines_.number(), 0,
                          fmt::format("the header lacks the column {}; export the facets in CloudCompare again", name));
    for (const char* name : global_centre_columns)
      has_global_ = has_global_ && places_.contains(name);
  }
  const Word* find(const char* name) const {
    const auto at = places_.find(name);
    return at == places_.end() || cells_[at->second].text.empty() ? nullptr : &cells_[at->second];
  }
  double number(const char* name) const { return coordinate_of(cells_[places_.find(name)->second], name); }
  Vector<3> vector(const Triple& names) const { return {number(names[0]), number(names[1]), number(names[2])}; }

  void row() {
    cells_ = cells_of(lines_.line(), lines_.number());
    if (cells_.size() < columns_)
      throw FileFault(
          lines_.number(), 0,
          fmt::format("the row has {} cells, the header {}; is the line truncated?", cells_.size(), columns_));
    FittedFacet facet;
    facet.origin.line = lines_.number();
    const Word* index = find("Index");
    facet.origin.name = "facet-" + (index ? std::string(index->text) : std::to_string(facets_.size() + 1));
    if (const Word* family = find("Family ind."); family && number_of(*family, "Family ind.") >= 0)
      facet.origin.set = "family-" + std::string(family->text);
    facet.plane = {unit_normal(), vector(centre_columns)};
    if (const Word* rms = find("RMS")) largest_rms_ = std::max(largest_rms_, number_of(*rms, "RMS"));
    if (const Word* polygon = find("PolygonZ"); polygon && polygon->text.starts_with("POLYGON"))
      facet.corners = corners_of(*polygon);
    if (facet.corners.empty() && (!places_.contains("Horiz_ext") || !places_.contains("Vert_ext")))
      throw FileFault(lines_.number(), 0,
                      "the facet has neither a PolygonZ nor Horiz_ext and Vert_ext; export one of them");
    if (facet.corners.empty()) {
      facet.along_strike = number("Horiz_ext");
      facet.down_dip = number("Vert_ext");
    }
    if (has_global_) narrow_shift(facet.plane.centre);
    facets_.push_back(std::move(facet));
  }
  Vector<3> unit_normal() const {
    const Vector<3> stated = vector(normal_columns);
    const double length = stated.norm();
    const Word& word = cells_[places_.find(normal_columns[0])->second];
    if (!is_unit(length * length))
      throw FileFault(word.line, word.column,
                      fmt::format("the normal must have length 1 (here {:.6g}); are columns exchanged?", length));
    const Vector<3> unit = stated[2] < 0 ? Vector<3>(-stated / length) : Vector<3>(stated / length);
    const Word *dip = find("Dip"), *direction = find("Dip dir.");
    if (!dip || !direction) return unit;
    const Vector<3> by_angles =
        upward_normal_3d(coordinate_of(*dip, "Dip") * degree, coordinate_of(*direction, "Dip dir.") * degree);
    if (by_angles.cross(unit).norm() > std::sin(another_rounded_plane))
      throw FileFault(dip->line, dip->column,
                      "Dip and Dip dir. are those of another plane than the normal; are the two columns exchanged?");
    return unit;
  }
  // POLYGON Z ((x y z, x y z, …))
  static std::vector<Vector<3>> corners_of(const Word& cell) {
    const std::size_t open = cell.text.find("(("), close = cell.text.find("))");
    if (open == std::string_view::npos || close == std::string_view::npos || close < open)
      throw FileFault(cell.line, cell.column, "PolygonZ must be POLYGON Z ((x y z, x y z, …)); is the line truncated?");
    std::vector<Vector<3>> corners;
    for (std::size_t at = open + 2; at < close;) {
      const std::size_t end = std::min(cell.text.find(',', at), close);
      const std::vector<Word> words = words_of(cell.text.substr(at, end - at), cell.line);
      const int column = cell.column + static_cast<int>(at);
      if (words.size() != 3) throw FileFault(cell.line, column, "a corner of PolygonZ has three coordinates, x y z");
      corners.emplace_back();
      for (int k = 0; k < 3; ++k)
        corners.back()[k] = coordinate_of({words[k].text, cell.line, column}, std::string(1, "xyz"[k]));
      at = end + 1;
    }
    return corners;
  }
  void narrow_shift(const Vector<3>& local) {
    for (int k = 0; k < 3; ++k) {
      const Word &here = cells_[places_.find(centre_columns[k])->second],
                 &there = cells_[places_.find(global_centre_columns[k])->second];
      const double global = coordinate_of(there, global_centre_columns[k]);
      const double doubt = rounding_of(here, local[k]) + rounding_of(there, global);
      between_[k].low = std::max(between_[k].low, global - local[k] - doubt);
      between_[k].high = std::min(between_[k].high, global - local[k] + doubt);
      if (between_[k].low > between_[k].high)
        throw FileFault(
            there.line, there.column,
            fmt::format("the shift from {1} to {0} differs from that of the rows before; export each cloud by itself",
                        global_centre_columns[k], centre_columns[k]));
    }
  }
  Vector<3> global_shift() {
    Vector<3> shift = Vector<3>::Zero();
    if (!has_global_ || facets_.empty()) return shift;
    double doubt = 0;
    for (int k = 0; k < 3; ++k) {
      shift[k] = between_[k].roundest();
      doubt = std::max(doubt, between_[k].half_width());
    }
    if (!shift.isZero(0))
      joints_.remark(
          fmt::format("global shift {}, {}, {} m added: the roundest that the global centres allow; their digits "
                      "determine it within {:.2g} m",
                      shift[0], shift[1], shift[2], doubt));
    return shift;
  }

  LineReader lines_;
  std::map<std::string, std::size_t, std::less<>> places_;
  std::size_t columns_ = 0;
  bool has_global_ = true;
  std::vector<Word> cells_;
  std::vector<FittedFacet> facets_;
  std::array<Between, 3> between_;
  double largest_rms_ = 0;
  JointCollector joints_{3};
};

}  // namespace

ImportedJoints read_facets(std::string_view text, const Vector<3>& shift) {
  return FacetsReader(text).read(shift);
}

}  // namespace voussoir
