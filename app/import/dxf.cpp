// ASCII DXF: pairs of lines, a group code and its value. Code 0 begins an entity; 8 is its layer, 10, 20, 30 are a
// point.
#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "app/import/formats.hpp"

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

constexpr int polygon_mesh = 16, polyface_mesh = 64, in_space = 8;  // flags of a POLYLINE

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
  DxfReader(std::string_view text, const Vector<3>& shift) : lines_(text), shift_(shift) {}

  ImportedJoints read() {
    while (next_entity()) {
      if (entity_.kind == "EOF") break;
      if (entity_.kind == "SECTION") section_ = entity_.find(2) ? upper_case(entity_.find(2)->text) : "";
      if (entity_.kind == "SECTION" && section_ == "HEADER") unit();
      if (section_ == "ENTITIES" && entity_.kind != "a comment" && entity_.kind != "SECTION" &&
          entity_.kind != "ENDSEC")
        entity();
      if (entity_.kind == "ENDSEC") section_.clear();
    }
    if (entity_.kind != "EOF") throw FileFault(lines_.number(), 0, "the file ends without EOF; is it cut off?");
    if (arcs_ > 0) joints_.remark(fmt::format("{} arcs of polylines were taken as straight", arcs_));
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
                          " stands where a group code must, a whole number; is it an ASCII DXF with no "
                          "line lost?");
    if (!lines_.next())
      throw FileFault(lines_.number(), 0,
                      fmt::format("the file ends behind group code {}; is it cut off?", group_.code));
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
                      fmt::format("group code {} stands where 0 must begin something", group_.code));
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
    static constexpr int metres = 6, none = 0;
    for (std::size_t k = 0; k + 1 < entity_.groups.size(); ++k) {
      if (entity_.groups[k].code != 9 || entity_.groups[k].value.text != "$INSUNITS") continue;
      const double number = number_of(entity_.groups[k + 1].value, "$INSUNITS");
      if (number != metres && number != none)
        joints_.remark(
            fmt::format("the drawing says a unit other than m ($INSUNITS {:g}); its coordinates were taken as m, so "
                        "look at the box",
                        number));
    }
  }
  JointSource origin() {
    const Word* layer = entity_.find(8);
    return {entity_.line, fmt::format("face-{}", ++count_), layer ? std::string(layer->text) : ""};
  }
  void entity() {
    if (entity_.kind == "3DFACE") return face();
    if (entity_.kind == "POLYLINE") return polyline();
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
      corners.push_back(entity_.point(code) + shift_);
    }
    if (corners.size() == 4 && corners[3] == corners[2]) corners.pop_back();
    joints_.polygon(from, corners);
  }
  // its corners are VERTEX entities up to SEQEND
  void polyline() {
    const JointSource from = origin();
    const Entity head = entity_;
    const bool drawn_flat = !head.flag(in_space);
    const bool mesh = head.flag(polygon_mesh) || head.flag(polyface_mesh);
    const Eigen::Matrix3d axes = drawn_flat ? axes_of(head) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
    std::vector<Vector<3>> corners;
    while (true) {
      if (!next_entity() || (entity_.kind != "VERTEX" && entity_.kind != "SEQEND"))
        throw FileFault(
            lines_.number(), 0,
            fmt::format("the POLYLINE of line {} must go on with VERTEX or SEQEND; is it cut off?", head.line));
      if (entity_.kind == "SEQEND") break;
      Vector<3> corner = entity_.point(10);
      if (drawn_flat) corner[2] = head.number(30, 0);
      if (entity_.number(42, 0) != 0) ++arcs_;
      corners.emplace_back(axes * corner + shift_);
    }
    if (mesh) return joints_.drop(head.line, "a POLYLINE that is a mesh; explode it into 3DFACE in the drawing");
    add(from, std::move(corners));
  }
  void flat_polyline() {
    const JointSource from = origin();
    const Eigen::Matrix3d axes = axes_of(entity_);
    const double elevation = entity_.number(38, 0);
    std::vector<Vector<3>> corners;
    std::optional<double> x;
    for (const Group& group : entity_.groups) {
      if (group.code == 42 && number_of(group.value, "group 42") != 0) ++arcs_;
      if (group.code == 10) x = coordinate_of(group.value, "x");
      if (group.code != 20) continue;
      if (!x)
        throw FileFault(group.value.line, 0, "a corner of the LWPOLYLINE has y (20) without x (10); is a line lost?");
      corners.emplace_back(axes * Vector<3>(*x, coordinate_of(group.value, "y"), elevation) + shift_);
      x.reset();
    }
    add(from, std::move(corners));
  }
  // a closed line may state its first corner again
  void add(const JointSource& from, std::vector<Vector<3>> corners) {
    if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    joints_.polygon(from, corners);
  }

  LineReader lines_;
  Vector<3> shift_;
  Group group_;
  bool ahead_ = false;  // the group that begins the next entity is read
  Entity entity_;
  std::string section_;
  long long count_ = 0, arcs_ = 0;
  JointCollector joints_{3};
};

}  // namespace

ImportedJoints read_dxf(std::string_view text, const Vector<3>& shift) {
  if (text.starts_with("AutoCAD Binary DXF")) throw FileFault(0, 0, "is a binary DXF; save it as ASCII DXF");
  return DxfReader(text, shift).read();
}

}  // namespace voussoir
