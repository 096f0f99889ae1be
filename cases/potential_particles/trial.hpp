// A scene that a study writes and runs for one number.
#pragma once

#include <functional>
#include <string>

#include "cases/case_tools.hpp"
#include "cases/potential_particles/rounded_scene.hpp"

namespace voussoir::cases {

struct Trial {
  bool answered = false;      // a number was found
  double value = 0;           // see each problem
  std::string why;            // if there is none
  double load_seconds = 0;    // of the processor: reading, with the cubature of each particle's mass
  double seconds = 0;         // of the processor: simulating
  long long evaluations = 0;  // of contacts

  double nanoseconds() const { return 1e9 * seconds / static_cast<double>(evaluations); }  // of a contact
};

// keeps the scene among the case's data
std::filesystem::path write_scene(const std::string& name, const std::string& text);

Trial ask(const std::string& name, const std::string& text, const std::function<double(const SceneRun&)>& answer,
          const std::vector<std::string>& overrides = {});

}  // namespace voussoir::cases
