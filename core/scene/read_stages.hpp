// Reads the parts of a scene that control the run: selectors, motions, settings, stages, monitors.
#pragma once

#include <vector>

#include "core/scene/scene_spec.hpp"

namespace voussoir {

SelectorSpec read_selector(const Subject& table);
std::vector<SelectorSpec> read_selectors(const Subject& table, std::string_view key);
Settings read_settings(const Subject& scene);
std::vector<StageSpec> read_stages(const Subject& scene, int dimension, const Settings& settings, double rock_weight);
// refuses a scene without stages: such a scene can only be sliced
void require_stages(const Scene& scene);
std::vector<MonitorSpec> read_monitors(const Subject& scene);

}  // namespace voussoir
