// The forecast and the warnings that follow from a scene's numbers before it is run.
#pragma once

#include <string>
#include <vector>

#include "app/base/run_scene.hpp"
#include "app/check/forecast.hpp"

namespace voussoir {

struct Assessment {
  Forecast forecast;
  std::vector<std::string> warnings;  // one line each, with the repair; first those of stated values
};

Assessment assess(const LoadedScene& scene);

}  // namespace voussoir
