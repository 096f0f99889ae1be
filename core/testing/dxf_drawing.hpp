// Test help: a small reader of DXF that shares no code with the writer or the importer.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/geometry/types.hpp"

namespace voussoir::test {

struct DxfEntity {
  std::string kind, layer;
  std::vector<Vector<3>> points;  // of a POLYLINE: its vertices
  int flags = 0;
};

inline std::vector<DxfEntity> read_drawing(const std::string& text) {
  std::istringstream lines(text);
  std::vector<DxfEntity> entities;
  std::string code, value, section;
  bool named = false;  // whether the section's name follows
  while (std::getline(lines, code) && std::getline(lines, value)) {
    const int group = std::stoi(code);
    if (group == 0) {
      named = value == "SECTION";
      if (value == "ENDSEC") section.clear();
      if (section == "ENTITIES") entities.push_back({value, {}, {}, 0});
    } else if (group == 2 && named) {
      section = value;
      named = false;
    } else if (section == "ENTITIES") {
      DxfEntity& entity = entities.back();
      if (group == 8) entity.layer = value;
      if (group == 70) entity.flags = std::stoi(value);
      if (group >= 10 && group < 20) entity.points.emplace_back(Vector<3>::Zero());
      if (group >= 10 && group < 40) entity.points.at(group % 10)[group / 10 - 1] = std::stod(value);
    }
  }
  if (value != "EOF") throw std::runtime_error("the drawing ends before EOF");

  // vertices to their POLYLINE
  std::vector<DxfEntity> whole;
  for (const DxfEntity& entity : entities) {
    if (entity.kind == "VERTEX")
      whole.back().points.push_back(entity.points.at(0));
    else if (entity.kind != "SEQEND")
      whole.push_back(entity);
    if (entity.kind == "POLYLINE") whole.back().points.clear();
  }
  return whole;
}

// of the entities of a kind on a layer, relative to the first point, far from which differences would be lost
inline std::vector<std::vector<Vector<3>>> points_on(const std::vector<DxfEntity>& entities, const std::string& kind,
                                                     const std::string& layer) {
  std::vector<std::vector<Vector<3>>> all;
  Vector<3> first = Vector<3>::Zero();
  for (const DxfEntity& entity : entities) {
    if (entity.kind != kind || entity.layer != layer) continue;
    if (all.empty()) first = entity.points.at(0);
    for (Vector<3>& point : all.emplace_back(entity.points))
      point -= first;
  }
  return all;
}

// m³, of the solids that the 3DFACEs of a layer bound, counter-clockwise seen from outside
inline double volume_on(const std::vector<DxfEntity>& entities, const std::string& layer) {
  double volume = 0;
  for (const std::vector<Vector<3>>& face : points_on(entities, "3DFACE", layer))
    for (const std::size_t k : {1U, 2U})
      volume += face.at(0).dot(face.at(k).cross(face.at(k + 1))) / 6;
  return volume;
}

// m², of the closed POLYLINEs of a layer, counter-clockwise
inline double area_on(const std::vector<DxfEntity>& entities, const std::string& layer) {
  double area = 0;
  for (const std::vector<Vector<3>>& outline : points_on(entities, "POLYLINE", layer))
    for (std::size_t k = 0; k < outline.size(); ++k)
      area += outline[k].cross(outline[(k + 1) % outline.size()])[2] / 2;
  return area;
}

}  // namespace voussoir::test
