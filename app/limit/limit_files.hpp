// The files of `voussoir limit`: results.json, a figure, and files for ParaView.
#pragma once

#include <filesystem>
#include <string>

#include "app/derivatives/derivative_table.hpp"
#include "app/limit/limit_analysis.hpp"

namespace voussoir {

// the result with its proof, the mechanism by block and the forces by interface, as JSON
template <int Dim>
std::string limit_json(const LimitAnalysis<Dim>& analysis);

// Two pictures side by side as SVG: the forces of the limit state at the ends of the interfaces, and the mechanism. The
// free blocks fill them; longer lines are larger forces.
std::string limit_svg(const LimitAnalysis<2>& analysis);

// results.json, blocks.vtp (velocity of the mechanism), mechanism.vtp (the blocks moved along it), forces.vtp,
// proof.json.gz if a bound is proved; in the plane limit.svg too; derivatives.csv and derivatives.svg of a table.
// Throws OutputError.
template <int Dim>
void write_limit_files(const LimitAnalysis<Dim>& analysis, const DerivativeTable* table,
                       const std::filesystem::path& folder);

}  // namespace voussoir
