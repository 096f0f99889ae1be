#include "core/output/blocks_dxf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

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

void add_head(DxfText& dxf) {
  dxf.add(999, "blocks and bolts, coordinates in m");
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

void add_outline(DxfText& dxf, const char* layer, const std::vector<Corner>& corners) {
  dxf.entity("POLYLINE", layer);
  dxf.add(66, 1);  // vertices follow
  dxf.point(0, {0, 0, 0});
  dxf.add(70, 1);  // closed
  for (const Corner& corner : corners) {
    dxf.entity("VERTEX", layer);
    dxf.point(0, corner);
  }
  dxf.entity("SEQEND", layer);
}

}  // namespace

template <int Dim>
std::string blocks_dxf(const Model<Dim>& model, const PolyData& faces, const std::set<int>& key) {
  DxfText dxf;
  add_head(dxf);
  dxf.add(0, "SECTION");
  dxf.add(2, "ENTITIES");
  const std::vector<double>& bodies = *values_of(faces.cell_data, "body");
  for (std::size_t c = 0; c < faces.cells.size(); ++c) {
    const int body = static_cast<int>(bodies[c]);
    const char* layer = key.contains(body) ? key_layer : model.bodies[body].fixed ? fixed_layer : blocks_layer;
    std::vector<Corner> corners;
    for (const int p : faces.cells[c])
      corners.push_back(faces.points[p]);
    if constexpr (Dim == 3)
      add_face(dxf, layer, corners);
    else
      add_outline(dxf, layer, corners);
  }
  for (const Bolt<Dim>& bolt : model.bolts) {
    dxf.entity("LINE", bolts_layer);
    dxf.point(0, in_space(Vector<Dim>(model.origin + bolt.collar)));
    dxf.point(1, in_space(Vector<Dim>(model.origin + bolt.toe)));
  }
  dxf.add(0, "ENDSEC");
  dxf.add(0, "EOF");
  return std::move(dxf).text();
}

template std::string blocks_dxf<2>(const Model<2>&, const PolyData&, const std::set<int>&);
template std::string blocks_dxf<3>(const Model<3>&, const PolyData&, const std::set<int>&);

}  // namespace voussoir
