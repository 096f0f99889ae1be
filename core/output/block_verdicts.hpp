// The files of block theory's verdicts.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/key_blocks/block_survey.hpp"
#include "core/output/origin.hpp"
#include "core/output/vtp.hpp"

namespace voussoir {

// a row for every free block by body, then the clusters; empty cells for what does not apply
template <int Dim>
std::string blocks_csv(const Survey<Dim>& survey);

// The same with the proof of every verdict (core/key_blocks): faces, load, motion and normal forces, a direction, or
// weights.
template <int Dim>
std::string blocks_json(const Survey<Dim>& survey, const std::string& title, const std::string& input_hash,
                        const std::vector<Origin>& origins);

// what the factor of safety of block theory divides
inline constexpr const char* divided_by_blocks = "divides tan(friction) and cohesion";

// the values of the mass, as studies take them (core/key_blocks/mass_values.hpp)
template <int Dim>
std::string blocks_results_json(const Survey<Dim>& survey, const std::string& title, const std::string& input_hash,
                                const std::vector<Origin>& origins);

// the faces of the blocks with their verdict
template <int Dim>
PolyData block_verdict_faces(const Survey<Dim>& survey);

// whether a block or cluster moves with a factor below the required one
template <int Dim>
bool is_key(const Survey<Dim>& survey, const SurveyRow<Dim>& row);

// the bodies of all key blocks and clusters
template <int Dim>
std::set<int> key_blocks(const Survey<Dim>& survey);

// Outlines in plan of the key blocks and clusters as a map, in the scene's coordinates.
// `faces`: block_verdict_faces.
std::string key_blocks_geojson(const Survey<3>& survey, const PolyData& faces);

// the normal force on each face, zero for unloaded ones, N
template <int Dim>
std::vector<double> normal_forces(const SurveyRow<Dim>& row);

// names of its loaded faces' joints, each once
template <int Dim>
std::vector<std::string> loaded_joints(const Survey<Dim>& survey, const SurveyRow<Dim>& row);

}  // namespace voussoir
