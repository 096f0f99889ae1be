// Reads study.toml.
#pragma once

#include <filesystem>

#include "app/study/sweep.hpp"

namespace voussoir {

// Paths in the plan are relative to it. Strict: an unknown key is a SceneError with line and repair.
StudyPlan read_study_plan(const std::filesystem::path& path);

}  // namespace voussoir
