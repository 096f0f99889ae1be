// ASCII DXF: pairs of lines, a group code and its value. Code 0 begins an entity; 8 is its layer, 10, 20, 30 are a
// point.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>

#include "app/import/formats.hpp"
#include "app/import/units.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

struct Group {
  int code = 0;
  Word value;
};

struct Entity {
  std::string kind;
  int line = 0;
  std::vector<Group> groups;

  const Word* find(int code) const {
    for (const Group& group : groups)
      if (group.code == code) return &group.value;
    return nullptr;
  }
  double number(int code, double otherwise) const {
    const Word* word = find(code);
    return word ? coordinate_of(*word, fmt::format("group {}", code)) : otherwise;
  }
  bool flag(int bit) const { return (static_cast<long long>(number(70, 0)) & bit) != 0; }
  // 10, 20, 30 and so on from `code`
  Vector<3> point(int code) const { return {number(code, 0), number(code + 10, 0), number(code + 20, 0)}; }
};

constexpr int closed = 1, polygon_mesh = 16, polyface_mesh = 64, in_space = 8;  // flags of a POLYLINE
constexpr int frozen = 1;                                                       // flag of a LAYER
constexpr int control_point = 16;                                               // flag of a VERTEX
constexpr double chord_angle = 3 * degree;  // of an arc; a circle is 120 chords, 0.05 % smaller

// a corner of a line in its own plane; `bulge` is the tangent of a quarter of the arc's angle to the next corner
struct Corner {
  Vector<3> place;
  double bulge = 0;
};

// The corners, and additional points on every arc, so that its chords are short. A line that is not closed has no arc
// after its last corner.
std::vector<Vector<3>> with_arcs(const std::vector<Corner>& corners, bool is_closed) {
  std::vector<Vector<3>> points;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Corner& from = corners[k];
    points.push_back(from.place);
    if (from.bulge == 0 || (k + 1 == corners.size() && !is_closed)) continue;
    const Vector<3> along = corners[(k + 1) % corners.size()].place - from.place;
    const Vector<3> left(-along[1], along[0], 0);
    const double angle = 4 * std::atan(from.bulge);  // counter-clockwise
    const int chords = static_cast<int>(std::ceil(std::abs(angle) / chord_angle));
    for (int c = 1; c < chords; ++c) {
      // the point at the angle t of the arc: half its chord's angle off the line between the ends
      const double t = angle * c / chords, reach = std::sin(t / 2) / std::sin(angle / 2), off = (t - angle) / 2;
      points.emplace_back(from.place + reach * (std::cos(off) * along + std::sin(off) * left));
    }
  }
  return points;
}

// the axes of an entity drawn in a plane of its own, from that plane's normal (the arbitrary axis algorithm of DXF)
Eigen::Matrix3d axes_of(const Entity& entity) {
  const Vector<3> stated(entity.number(210, 0), entity.number(220, 0), entity.number(230, 1));
  const double length = stated.norm();
  if (!(length > 0)) throw FileFault(entity.line, 0, entity.kind + ": its extrusion 210, 220, 230 has no length");
  const Vector<3> z = stated / length;
  constexpr double near_vertical = 1.0 / 64;
  const bool steep = std::abs(z[0]) < near_vertical && std::abs(z[1]) < near_vertical;
  const Vector<3> x = (steep ? Vector<3>(0, 1, 0) : Vector<3>(0, 0, 1)).cross(z).normalized();
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  return axes;
}

class DxfReader {
 public:
  DxfReader(std::string_view text, const Vector<3>& shift) : lines_(text), place_(shift) {}

  ImportedJoints read() {
    while (next_entity()) {
      if (entity_.kind == "EOF") break;
      if (entity_.kind == "SECTION") section_ = entity_.find(2) ? upper_case(entity_.find(2)->text) : "";
      if (entity_.kind == "SECTION" && section_ == "HEADER") unit();
      if (section_ == "TABLES" && entity_.kind == "LAYER") layer();
      if (section_ == "ENTITIES" && entity_.kind != "a comment" && entity_.kind != "SECTION" &&
          entity_.kind != "ENDSEC")
        entity();
      if (entity_.kind == "ENDSEC") section_.clear();
    }
    if (entity_.kind != "EOF") throw FileFault(lines_.number(), 0, "the file ends without EOF; is it truncated?");
    place_.tell(joints_);
    if (arcs_ > 0)
      joints_.remark(fmt::format("{} arcs of polylines were taken as chords of at most {:g} degrees", arcs_,
                                 to_degrees(chord_angle)));
    if (heights_ > 0)
      joints_.remark(
          fmt::format("{} vertices of flat polylines have their own heights, which differ by up to {:.6g} m from the "
                      "polyline's elevation, which was used (first: line {}); draw them as 3D polylines if the heights "
                      "are intended",
                      heights_, largest_height_, first_height_));
    return joints_.finish();
  }

 private:
  bool next_group() {
    if (!lines_.next()) return false;
    const std::vector<Word> words = words_of(lines_.line(), lines_.number());
    const std::string_view text = words.empty() ? std::string_view() : words[0].text;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), group_.code);
    if (words.size() != 1 || error != std::errc() || end != text.data() + text.size())
      throw FileFault(lines_.number(), 0,
                      shown(lines_.line()) +
                          " is in the place of a group code, a whole number; is it an ASCII DXF with no "
                          "line lost?");
    if (!lines_.next())
      throw FileFault(lines_.number(), 0,
                      fmt::format("the file ends after group code {}; is it truncated?", group_.code));
    std::string_view value = lines_.line();
    const std::size_t from = std::min(value.find_first_not_of(" \t"), value.size());
    value = value.substr(from, value.find_last_not_of(" \t") + 1 - from);
    group_.value = {value, lines_.number(), static_cast<int>(from) + 1};
    return true;
  }
  // with its groups, up to the next code 0
  bool next_entity() {
    if (!ahead_ && !next_group()) return false;
    if (group_.code != 0 && group_.code != 999)  // 999: a comment
      throw FileFault(group_.value.line - 1, 0,
                      fmt::format("group code {} is in the place of a 0, which must begin an entity", group_.code));
    entity_ = {group_.code == 0 ? upper_case(group_.value.text) : "a comment", group_.value.line, {}};
    ahead_ = false;
    while (next_group()) {
      ahead_ = group_.code == 0;
      if (ahead_) break;
      entity_.groups.push_back(group_);
    }
    return true;
  }
  void unit() {
    for (std::size_t k = 0; k + 1 < entity_.groups.size(); ++k)
      if (entity_.groups[k].code == 9 && entity_.groups[k].value.text == "$INSUNITS")
        place_.drawing_unit(entity_.groups[k + 1].value);
  }
  // layers whose entities the drawing does not show
  void layer() {
    const Word* name = entity_.find(2);
    if (!name) return;
    if (entity_.flag(frozen))
      hidden_layers_[upper_case(name->text)] = "is frozen";
    else if (entity_.number(62, 0) < 0)
      hidden_layers_[upper_case(name->text)] = "is switched off";
  }
  // why the drawing does not show the entity; empty if it does
  std::string hidden() const {
    if (entity_.number(67, 0) == 1) return "an entity of the paper space (67 = 1), which is not part of the model";
    if (entity_.number(60, 0) == 1) return "an entity that is invisible (60 = 1)";
    const Word* name = entity_.find(8);
    const auto at = hidden_layers_.find(name ? upper_case(name->text) : "0");
    return at == hidden_layers_.end()
               ? ""
               : fmt::format("an entity on the layer {}, which {}", name ? shown(name->text) : "'0'", at->second);
  }
  JointSource origin() {
    const Word* layer = entity_.find(8);
    return {entity_.line, fmt::format("face-{}", ++count_), layer ? std::string(layer->text) : ""};
  }
  void entity() {
    if (entity_.kind == "POLYLINE") return polyline();
    if (const std::string reason = hidden(); !reason.empty()) return joints_.drop(entity_.line, reason);
    if (entity_.kind == "3DFACE") return face();
    if (entity_.kind == "LWPOLYLINE") return flat_polyline();
    const bool block = entity_.kind == "INSERT";
    joints_.drop(entity_.line,
                 one_kind() + (block ? ", a block; explode it in the drawing" : ", no face and no polyline"));
  }
  std::string one_kind() const { return "an entity " + shown(entity_.kind); }

  void face() {
    const JointSource from = origin();
    std::vector<Vector<3>> corners;
    for (int code = 10; code < 14; ++code) {
      const bool there = entity_.find(code) && entity_.find(code + 10);
      if (!there && code == 13) break;  // a triangle
      if (!there)
        throw FileFault(entity_.line, 0,
                        fmt::format("3DFACE lacks its corner {} ({}, {}); is a line lost?", code - 9, code, code + 10));
      corners.push_back(place_(entity_.point(code), entity_.line));
    }
    if (corners.size() == 4 && corners[3] == corners[2]) corners.pop_back();
    joints_.polygon(from, corners);
  }
  // its corners are VERTEX entities up to SEQEND
  void polyline() {
    const Entity head = entity_;
    const std::string reason = hidden();
    const JointSource from = reason.empty() ? origin() : JointSource{};
    const bool drawn_flat = !head.flag(in_space);
    std::vector<Corner> corners;
    while (true) {
      if (!next_entity() || (entity_.kind != "VERTEX" && entity_.kind != "SEQEND"))
        throw FileFault(
            lines_.number(), 0,
            fmt::format("the POLYLINE of line {} must continue with VERTEX or SEQEND; is it truncated?", head.line));
      if (entity_.kind == "SEQEND") break;
      if (!reason.empty()) continue;
      if (entity_.flag(control_point)) {
        joints_.drop(entity_.line, "a control point of a spline (a VERTEX of flag 16), which is not on the curve");
        continue;
      }
      Corner corner{entity_.point(10), drawn_flat ? entity_.number(42, 0) : 0};
      if (drawn_flat) corner.place[2] = elevation(head, corner.place[2]);
      corners.push_back(corner);
    }
    if (!reason.empty()) return joints_.drop(head.line, reason);
    if (head.flag(polygon_mesh) || head.flag(polyface_mesh))
      return joints_.drop(head.line, "a POLYLINE that is a mesh; explode it into 3DFACE in the drawing");
    add(from, corners, head.flag(closed), drawn_flat ? axes_of(head) : Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  }
  // of a flat polyline, whose vertices have no individual height
  double elevation(const Entity& head, double height_of_vertex) {
    const double height = head.number(30, 0), difference = std::abs(height_of_vertex - height);
    if (difference > 0 && entity_.find(30)) {
      if (heights_++ == 0) first_height_ = entity_.line;
      largest_height_ = std::max(largest_height_, difference * place_.metres());
    }
    return height;
  }
  void flat_polyline() {
    const JointSource from = origin();
    const double elevation = entity_.number(38, 0);
    std::vector<Corner> corners;
    std::optional<double> x;
    for (const Group& group : entity_.groups) {
      if (group.code == 42 && !corners.empty()) corners.back().bulge = number_of(group.value, "group 42");
      if (group.code == 10) x = coordinate_of(group.value, "x");
      if (group.code != 20) continue;
      if (!x)
        throw FileFault(group.value.line, 0, "a corner of the LWPOLYLINE has y (20) without x (10); is a line lost?");
      corners.push_back({Vector<3>(*x, coordinate_of(group.value, "y"), elevation), 0});
      x.reset();
    }
    add(from, corners, entity_.flag(closed), axes_of(entity_));
  }
  // a closed line may state its first corner again, instead of being marked as closed
  void add(const JointSource& from, std::vector<Corner> corners, bool is_closed, const Eigen::Matrix3d& axes) {
    const bool returns = corners.size() > 1 && corners.front().place == corners.back().place;
    if (!is_closed && !returns)
      return joints_.drop(from.line, "an open polyline, which bounds no face; close it if it should");
    if (returns) corners.pop_back();
    for (const Corner& corner : corners)
      arcs_ += corner.bulge != 0;
    std::vector<Vector<3>> points;
    for (const Vector<3>& point : with_arcs(corners, true))
      points.push_back(place_(axes * point, from.line));
    joints_.polygon(from, points);
  }

  LineReader lines_;
  FilePlacement place_;
  std::map<std::string, std::string> hidden_layers_;  // by upper-case name: why
  Group group_;
  bool ahead_ = false;  // the group that begins the next entity is read
  Entity entity_;
  std::string section_;
  long long count_ = 0, arcs_ = 0, heights_ = 0;
  double largest_height_ = 0;  // m
  int first_height_ = 0;       // line
  JointCollector joints_{3};
};

}  // namespace

ImportedJoints read_dxf(std::string_view text, const Vector<3>& shift) {
  if (text.starts_with("AutoCAD Binary DXF")) throw FileFault(0, 0, "is a binary DXF; save it as ASCII DXF");
  return DxfReader(text, shift).read();
}

}  // namespace voussoir
