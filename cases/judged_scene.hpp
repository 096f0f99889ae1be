// The verdicts of block theory on a scene of a case, as `voussoir blocks` prints them.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases/case_tools.hpp"
#include "core/key_blocks/block_survey.hpp"

namespace voussoir::cases {

template <int Dim = 3>
Survey<Dim> judged(const std::string& scene, const std::vector<std::string>& overrides = {},
                   const SurveyRequest& request = {}) {
  return survey_blocks(
      std::get<Prepared<Dim>>(load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / scene, overrides).prepared),
      request);
}

// of a scene with one block that can move
template <int Dim>
const SurveyRow<Dim>& only_block(const Survey<Dim>& survey) {
  if (survey.rows.size() != 1) throw std::runtime_error("the scene must have one free block");
  return survey.rows.front();
}

template <int Dim>
const RockFace<Dim>* face_on(const Survey<Dim>& survey, const SurveyRow<Dim>& row, const std::string& joint) {
  const auto found = std::find_if(row.faces.begin(), row.faces.end(),
                                  [&](const RockFace<Dim>& face) { return survey.joint_name(face) == joint; });
  return found == row.faces.end() ? nullptr : &*found;
}

// N, 0 on an unloaded face
template <int Dim>
double normal_force_on(const Survey<Dim>& survey, const SurveyRow<Dim>& row, const std::string& joint) {
  const Verdict<Dim>& verdict = row.bolted.verdict;
  for (int k = 0; k < verdict.loaded; ++k)
    if (survey.joint_name(row.faces[verdict.faces[k]]) == joint) return verdict.forces[k];
  return 0;
}

}  // namespace voussoir::cases
