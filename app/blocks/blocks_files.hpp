// The texts that `voussoir blocks` prints and writes.
#pragma once

#include <string>

#include "app/blocks/block_survey.hpp"

namespace voussoir {

// header, a line a class, the worst blocks and clusters, rounds, notes; kN and m³ (2-D: per metre)
template <int Dim>
std::string blocks_summary(const Survey<Dim>& survey, const std::string& title, int top);

// a row for every free block by body, then the clusters; empty cells for what does not apply
template <int Dim>
std::string blocks_csv(const Survey<Dim>& survey);

// The same with the proof of every verdict (core/key_blocks): faces, load, motion and normal forces, a direction, or
// weights.
template <int Dim>
std::string blocks_json(const Survey<Dim>& survey, const LoadedScene& scene);

// the faces of the blocks with their verdict
template <int Dim>
std::string blocks_vtp(const Survey<Dim>& survey);

// the normal force on each face, zero for unloaded ones, N
template <int Dim>
std::vector<double> normal_forces(const SurveyRow<Dim>& row);

// names of its loaded faces' joints, each once
template <int Dim>
std::vector<std::string> loaded_joints(const Survey<Dim>& survey, const SurveyRow<Dim>& row);

}  // namespace voussoir
