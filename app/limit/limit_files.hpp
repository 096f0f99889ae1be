// The files of `voussoir limit`: results.json, a figure, and files for ParaView.
#pragma once

#include <filesystem>
#include <string>

#include "app/limit/limit_analysis.hpp"
#include "app/limit/limit_space.hpp"

namespace voussoir {

// the result with its proof, the mechanism by block and the forces by interface, as JSON
std::string limit_json(const LimitAnalysis& analysis);
std::string limit_json(const LimitAnalysisInSpace& analysis);

// Two pictures side by side as SVG: the forces of the limit state at the ends of the interfaces, and the mechanism. The
// free blocks fill them; longer lines are larger forces.
std::string limit_svg(const LimitAnalysis& analysis);

// results.json, limit.svg, blocks.vtp (velocity of the mechanism), mechanism.vtp (the blocks moved along it),
// forces.vtp; in space no figure. Throws OutputError.
void write_limit_files(const LimitAnalysis& analysis, const std::filesystem::path& folder);
void write_limit_files(const LimitAnalysisInSpace& analysis, const std::filesystem::path& folder);

}  // namespace voussoir
