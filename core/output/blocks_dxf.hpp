// Blocks, bolts and sections as drawings for CAD.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/model/model.hpp"
#include "core/output/vtp.hpp"

namespace voussoir {

inline constexpr const char *dxf_file = "blocks.dxf", *section_file = "section.dxf";

// ASCII DXF of release 12, in m and to the last bit. Each face of a block is 3DFACEs, counter-clockwise seen from
// outside, whose edges inside the face are invisible; in the plane each part of a block is a closed POLYLINE. Blocks
// are on the layers KEY_BLOCKS, FIXED_BLOCKS and BLOCKS; each bolt of the scene is a LINE from collar to toe on BOLTS.
// `faces`: block_faces of the model; `key`: the bodies that are key blocks.
template <int Dim>
std::string blocks_dxf(const Model<Dim>& model, const PolyData& faces, const std::set<int>& key = {});

// a plane that cuts the blocks, in world coordinates
struct SectionPlane {
  Vector<3> point, normal;  // m; unit
};

// where it cuts a part of a body
struct SectionPolygon {
  int body;
  std::vector<Vector<3>> corners;  // m, world coordinates, counter-clockwise seen from where the normal points
};

// Of blocks before any motion. Of two blocks that meet in the plane the one on the side of its normal is cut.
std::vector<SectionPolygon> cut_blocks(const Model<3>& model, const SectionPlane& plane);

// The polygons as closed POLYLINEs at their places in space, on the layers of blocks_dxf.
std::string section_dxf(const Model<3>& model, const std::vector<SectionPolygon>& polygons,
                        const std::set<int>& key = {});

}  // namespace voussoir
