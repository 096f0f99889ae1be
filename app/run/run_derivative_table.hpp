// What moves the answer of a run: derivatives by the numbers of its scene, of the strength that its last search has
// found, or of a monitored value at rest.
#pragma once

#include <filesystem>
#include <string>

#include "app/base/run_scene.hpp"
#include "app/derivatives/derivative_table.hpp"

namespace voussoir {

// `of`: a monitored value at rest; empty: what the last stage searches, or else the first displacement that a monitor
// follows. Throws BadInput if a run of the scene has no such value.
void require_answer(const LoadedScene& scene, const std::string& of);

// Runs the scene once more, beside its twins (core/run/run_derivatives.hpp). Where there are no derivatives the table
// has the reason.
DerivativeTable run_derivatives(const LoadedScene& scene, const std::string& of);

// adds the table to the results that are in the folder; says what moves the answer
void add_run_derivatives(const LoadedScene& scene, const std::string& of, const std::filesystem::path& folder,
                         bool quiet);

}  // namespace voussoir
