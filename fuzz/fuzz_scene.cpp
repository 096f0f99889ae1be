// Bytes to a scene: accepted or refused in one line, never a crash; an accepted one reads back to the same scene.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/scene/effective_scene.hpp"
#include "core/scene/judge_values.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/toml_text.hpp"
#include "fuzz/require.hpp"
#include "text/plain_text.hpp"

namespace voussoir::fuzz {
namespace {

// in a folder that does not exist, so that `base` finds nothing
const char* const name = "no_such_folder/scene.toml";

void require_one_line(const std::string& message) {
  require(message.starts_with(name), "an error begins with the file");
  require(!text_fault(message), "an error is one line of plain text");
}

// Slicing is not fuzzed here: n joints make up to n³/6 blocks, hulls and planes cost their fourth power.
bool is_small(const Scene& scene) {
  constexpr std::size_t many = 12;
  const bool domain = !scene.domain || scene.domain->planes.size() <= many;
  return scene.joints.size() <= many / 2 && scene.joint_sets.empty() && scene.excavations.empty() &&
         scene.blocks.size() <= many && domain &&
         std::all_of(scene.blocks.begin(), scene.blocks.end(), [](const BlockSpec& block) {
           return block.vertices.size() <= many && block.planes.size() <= many;
         });
}

template <int Dim>
void prepare_and_judge(const Scene& scene) {
  const Prepared<Dim> prepared = prepare<Dim>(scene);
  for (const Body<Dim>& body : prepared.model.bodies) {
    require(std::isfinite(body.mass) && body.mass > 0, "masses are finite and positive");
    require(body.inertia.allFinite() && body.inertia.minCoeff() > 0, "moments of inertia are finite and positive");
  }
  for (const std::string& warning : judge_values<Dim>(scene, prepared))
    require_one_line(warning);
}

// Ten thousand copies take a long time, and differ from two only in number.
bool repeats_much(std::string_view text) {
  constexpr double often = 8;
  try {
    const Node scene = parse_toml(text, std::make_shared<const std::string>(name));
    double product = 1;
    if (const Node* repeats = scene.find("repeat"))
      for (const Node& item : repeats->items)
        if (const Node* count = item.find("count")) product *= std::max(1.0, std::abs(count->number));
    return !(product <= often);
  } catch (const SceneError&) {
    return false;
  }
}

void read(std::string_view text) {
  if (repeats_much(text)) return;
  const Scene scene = parse_scene(text, name);
  const std::string canonical = canonical_text(scene);
  require(canonical_text(parse_scene(toml_text(*scene.tree), name)) == canonical, "a scene reads back to itself");
  if (!is_small(scene)) return;
  scene.dimension == 2 ? prepare_and_judge<2>(scene) : prepare_and_judge<3>(scene);
}

}  // namespace
}  // namespace voussoir::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace voussoir::fuzz;
  const Stopwatch stopwatch;
  try {
    read({reinterpret_cast<const char*>(data), size});
  } catch (const voussoir::SceneError& error) {
    require_one_line(error.what());
  }
  return 0;
}
