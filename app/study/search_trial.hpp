// One trial of a search at the limit of a reliability analysis, instead of the search: only whether the scene stands.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/study/sweep.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {

// The overrides that end the search of the scene's last stage at the limit after one trial; empty if `quantity` is not
// what that stage finds by bisection, or its failed side is not that of the search.
std::vector<std::string> trial_at_limit(const Scene& scene, const std::string& quantity, const Fails& fails);

// Whether the trial of a run's last search failed, from results.json; nothing if it ended otherwise. Throws as
// read_file and nlohmann::json do.
std::optional<bool> trial_failed(const std::filesystem::path& folder);

}  // namespace voussoir
