// What a scene's joint sets turned out to be, held against what was stated: a table, joints.csv and figures.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/model.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {

// what slicing left, for the distribution of block sizes
struct BlockSizes {
  std::vector<double> volumes;  // m³ (2-D: m²), ascending
};

template <int Dim>
BlockSizes block_sizes(const Model<Dim>& model);

// Draws the sets of a scene and writes joints.csv, report.md and figures to the folder; returns report.md's text. Block
// sizes are left out where there are none: finite joints that no block can be cut by. Throws SceneError, OutputError.
std::string write_slice_report(const Scene& scene, const std::optional<BlockSizes>& blocks,
                               const std::filesystem::path& folder);

// whether sets of finite joints meet the domain
bool has_finite_joints(const Scene& scene);

}  // namespace voussoir
