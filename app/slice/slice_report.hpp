// A report on a scene's joints in its domain: drawn sets, measured against stated, and listed joints by their set; a
// table, joints.csv, and the data of the page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/model/model.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {

// the blocks after slicing, for the distribution of block sizes
struct BlockSizes {
  std::vector<double> volumes;  // m³ (2-D: m²), ascending
};

template <int Dim>
BlockSizes block_sizes(const Model<Dim>& model);

// Draws the sets of a scene and writes joints.csv and joints.json (app/report/joints_data.hpp) to the folder; returns
// the tables as text. Throws SceneError, OutputError.
std::string write_slice_report(const Scene& scene, const BlockSizes& blocks, const std::filesystem::path& folder);

}  // namespace voussoir
