#include "core/output/blocks_dxf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

#include "core/geometry/outline.hpp"
#include "core/output/drawn_points.hpp"

namespace voussoir {
namespace {

using Corner = std::array<double, 3>;

constexpr const char *blocks_layer = "BLOCKS", *fixed_layer = "FIXED_BLOCKS", *key_layer = "KEY_BLOCKS",
                     *bolts_layer = "BOLTS";

// with the colours of AutoCAD's index: white, grey, red, green
constexpr std::array<std::pair<const char*, int>, 4> layers{
    {{blocks_layer, 7}, {fixed_layer, 8}, {key_layer, 1}, {bolts_layer, 3}}};

// a file is pairs of lines: a group's code and its value
class DxfText {
 public:
  template <class Value>
  void add(int code, const Value& value) {
    fmt::format_to(std::back_inserter(text_), "{}\n{}\n", code, value);
  }
  // the k-th point of an entity
  void point(int k, const Corner& p) {
    for (int axis = 0; axis < 3; ++axis)
      add(10 * (axis + 1) + k, p[axis]);
  }
  void entity(const char* kind, const char* layer) {
    add(0, kind);
    add(8, layer);
  }
  std::string text() && { return std::move(text_); }

 private:
  std::string text_;
};

void add_head(DxfText& dxf, const char* content) {
  dxf.add(999, fmt::format("{}, coordinates in m", content));
  dxf.add(0, "SECTION");
  dxf.add(2, "HEADER");
  dxf.add(9, "$ACADVER");
  dxf.add(1, "AC1009");
  dxf.add(0, "ENDSEC");
  dxf.add(0, "SECTION");
  dxf.add(2, "TABLES");
  dxf.add(0, "TABLE");
  dxf.add(2, "LTYPE");
  dxf.add(70, 1);
  dxf.add(0, "LTYPE");
  dxf.add(2, "CONTINUOUS");
  dxf.add(70, 0);
  dxf.add(3, "Solid line");
  dxf.add(72, 65);
  dxf.add(73, 0);
  dxf.add(40, 0);
  dxf.add(0, "ENDTAB");
  dxf.add(0, "TABLE");
  dxf.add(2, "LAYER");
  dxf.add(70, layers.size());
  for (const auto& layer : layers) {
    dxf.add(0, "LAYER");
    dxf.add(2, layer.first);
    dxf.add(70, 0);
    dxf.add(62, layer.second);
    dxf.add(6, "CONTINUOUS");
  }
  dxf.add(0, "ENDTAB");
  dxf.add(0, "ENDSEC");
  dxf.add(0, "SECTION");
  dxf.add(2, "ENTITIES");
}

std::string finished(DxfText dxf) {
  dxf.add(0, "ENDSEC");
  dxf.add(0, "EOF");
  return std::move(dxf).text();
}

template <int Dim>
const char* layer_of(const Model<Dim>& model, int body, const std::set<int>& key) {
  return key.contains(body) ? key_layer : model.bodies[body].fixed ? fixed_layer : blocks_layer;
}

// a fan of quadrilaterals, and a triangle if a corner is left
void add_face(DxfText& dxf, const char* layer, const std::vector<Corner>& corners) {
  const std::size_t last = corners.size() - 1;
  for (std::size_t i = 1; i < last; i += 2) {
    const std::size_t third = i + 1, fourth = std::min(i + 2, last);
    dxf.entity("3DFACE", layer);
    dxf.point(0, corners[0]);
    dxf.point(1, corners[i]);
    dxf.point(2, corners[third]);
    dxf.point(3, corners[fourth]);
    // the edges from the fan's centre, unless they are the face's own
    if (const int invisible = (i > 1 ? 1 : 0) + (fourth < last ? 8 : 0); invisible > 0) dxf.add(70, invisible);
  }
}

// flags of a POLYLINE, and that of its vertices if these have heights of their own
constexpr int closed_line = 1, line_in_space = 8, vertex_in_space = 32;

void add_outline(DxfText& dxf, const char* layer, const std::vector<Corner>& corners, bool has_heights) {
  dxf.entity("POLYLINE", layer);
  dxf.add(66, 1);  // vertices follow
  dxf.point(0, {0, 0, 0});
  dxf.add(70, closed_line + (has_heights ? line_in_space : 0));
  for (const Corner& corner : corners) {
    dxf.entity("VERTEX", layer);
    dxf.point(0, corner);
    if (has_heights) dxf.add(70, vertex_in_space);
  }
  dxf.entity("SEQEND", layer);
}

// The plane cuts a part this much farther along its normal, of the part's radius: far above the rounding of faces that
// lie in the plane, far below what a drawing shows.
constexpr double beyond_plane = 1e-9;

// m² over the squared radius: a smaller section is that of a corner or an edge which touches the plane
constexpr double least_section = 1e-7;

}  // namespace

template <int Dim>
std::string blocks_dxf(const Model<Dim>& model, const PolyData& faces, const std::set<int>& key) {
  DxfText dxf;
  add_head(dxf, "blocks and bolts");
  const std::vector<double>& bodies = *values_of(faces.cell_data, "body");
  for (std::size_t c = 0; c < faces.cells.size(); ++c) {
    const int body = static_cast<int>(bodies[c]);
    const char* layer = layer_of(model, body, key);
    std::vector<Corner> corners;
    for (const int p : faces.cells[c])
      corners.push_back(faces.points[p]);
    if constexpr (Dim == 3)
      add_face(dxf, layer, corners);
    else
      add_outline(dxf, layer, corners, false);
  }
  for (const Bolt<Dim>& bolt : model.bolts) {
    dxf.entity("LINE", bolts_layer);
    dxf.point(0, in_space(Vector<Dim>(model.origin + bolt.collar)));
    dxf.point(1, in_space(Vector<Dim>(model.origin + bolt.toe)));
  }
  return finished(std::move(dxf));
}

template std::string blocks_dxf<2>(const Model<2>&, const PolyData&, const std::set<int>&);
template std::string blocks_dxf<3>(const Model<3>&, const PolyData&, const std::set<int>&);

std::vector<SectionPolygon> cut_blocks(const Model<3>& model, const SectionPlane& plane) {
  std::vector<SectionPolygon> polygons;
  for (const PartId& id : model.parts) {
    const Body<3>& body = model.bodies[id.body];
    if (!body.present) continue;
    const Polytope<3>& part = body.parts[id.part];
    // near the part, since far from the origin an offset has lost digits
    const Vector<3> point = (plane.point - model.origin) - body.reference;
    const Vector<3> beyond = beyond_plane * part.radius * plane.normal;
    const std::vector<Vector<3>> section = section_of({plane.normal, plane.normal.dot(point + beyond)}, part);
    std::vector<int> loop(section.size());
    std::iota(loop.begin(), loop.end(), 0);
    if (face_area<3>(section, loop) < least_section * part.radius * part.radius) continue;
    SectionPolygon& polygon = polygons.emplace_back(SectionPolygon{id.body, {}});
    for (const Vector<3>& corner : section)
      polygon.corners.emplace_back(model.origin + (body.reference + (corner - beyond)));
  }
  return polygons;
}

std::string section_dxf(const Model<3>& model, const std::vector<SectionPolygon>& polygons, const std::set<int>& key) {
  DxfText dxf;
  add_head(dxf, "section of blocks");
  for (const SectionPolygon& polygon : polygons) {
    std::vector<Corner> corners;
    for (const Vector<3>& corner : polygon.corners)
      corners.push_back(in_space(corner));
    add_outline(dxf, layer_of(model, polygon.body, key), corners, true);
  }
  return finished(std::move(dxf));
}

}  // namespace voussoir
