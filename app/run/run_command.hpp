// `voussoir run`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// runs a scene and writes results.json, history.csv, scene.toml and ParaView's files
void add_run(CLI::App& program, Action& action);

}  // namespace voussoir
