#pragma once
// The page "Joint stiffness": how it was chosen in each case and what it changes (joint_stiffness.toml), beside the
// values of the case's scenes.
#include <filesystem>
#include <string>
#include <vector>

#include "reports/links.hpp"
#include "verification/verdicts.hpp"

namespace voussoir::reports {

struct StiffnessChoice {
  std::string case_name;
  std::string chosen, changes;  // why this stiffness; its effect on the result
};

// Throws std::runtime_error, which names file, line, key and repair.
std::vector<StiffnessChoice> read_stiffness_choices(const std::filesystem::path& list);

// Pairs of normal and shear stiffness of the scenes of a folder, "10e9 / 1e9 Pa/m", each once; "N/m" if constant.
std::vector<std::string> stiffness_of_scenes(const std::filesystem::path& folder);

std::string stiffness_page(const Folders& folders, const verification::Verdicts& verdicts,
                           std::vector<std::string>& missing);

}  // namespace voussoir::reports
