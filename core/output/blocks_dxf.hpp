// Blocks and bolts as a drawing for CAD.
#pragma once

#include <set>
#include <string>

#include "core/model/model.hpp"
#include "core/output/vtp.hpp"

namespace voussoir {

inline constexpr const char* dxf_file = "blocks.dxf";

// ASCII DXF of release 12, in m and to the last bit. Each face of a block is 3DFACEs, counter-clockwise seen from
// outside, whose edges inside the face are invisible; in the plane each part of a block is a closed POLYLINE. Blocks
// are on the layers KEY_BLOCKS, FIXED_BLOCKS and BLOCKS; each bolt of the scene is a LINE from collar to toe on BOLTS.
// `faces`: block_faces of the model; `key`: the bodies that are key blocks.
template <int Dim>
std::string blocks_dxf(const Model<Dim>& model, const PolyData& faces, const std::set<int>& key = {});

}  // namespace voussoir
