// The option --section: a plane that cuts the blocks for a drawing.
#pragma once

#include <string>
#include <vector>

#include "app/base/arguments.hpp"
#include "core/output/blocks_dxf.hpp"

namespace voussoir {

void add_section(CLI::App* command, std::vector<std::string>& sections, const std::string& layers);

// Throws BadInput if a plane is not one, the scene has no blocks of half-spaces in space, or a plane cuts none of them.
std::vector<SectionPolygon> section_polygons(const Model<2>& model, const std::vector<std::string>& sections);
std::vector<SectionPolygon> section_polygons(const Model<3>& model, const std::vector<std::string>& sections);

}  // namespace voussoir
