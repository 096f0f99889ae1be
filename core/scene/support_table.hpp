// The supports of a scene, a row for each kind.
#pragma once

#include <string>
#include <vector>

#include "core/model/supports_state.hpp"
#include "core/scene/bolts.hpp"
#include "core/scene/linings.hpp"

namespace voussoir {

// a support that stages install by its name
struct StatedSupport {
  Subject subject;
  std::string name;
};

// A kind without entries is stated in the table of another.
struct SceneSupport {
  SupportKind kind;
  const char* table = nullptr;                                   // of the scene
  const char* these = nullptr;                                   // its name in messages
  void (*read)(const Subject& top, Scene&) = nullptr;            // throws SceneError
  std::vector<StatedSupport> (*stated)(const Scene&) = nullptr;  // in the order of the scene
  // independent of their order in the scene; the model's origin and joint properties are set
  void (*add_in_plane)(const Scene&, Model<2>&) = nullptr;
  void (*add_in_space)(const Scene&, Model<3>&) = nullptr;

  void add_to(const Scene& scene, Model<2>& model) const {
    if (add_in_plane) add_in_plane(scene, model);
  }
  void add_to(const Scene& scene, Model<3>& model) const {
    if (add_in_space) add_in_space(scene, model);
  }
};

template <auto list>
std::vector<StatedSupport> all_stated(const Scene& scene) {
  std::vector<StatedSupport> all;
  for (const auto& spec : scene.*list)
    all.push_back({spec.subject, spec.properties.name});
  return all;
}

inline constexpr SceneSupport scene_supports[] = {
    {.kind = SupportKind::bolt,
     .table = "bolts",
     .these = "these bolts",
     .read = read_bolts,
     .stated = all_stated<&Scene::bolts>,
     .add_in_plane = add_bolts<2>,
     .add_in_space = add_bolts<3>},
    {.kind = SupportKind::grouted_bolt},  // a kind of [[bolts]]
    {.kind = SupportKind::lining,
     .table = "linings",
     .these = "this lining",
     .read = read_linings,
     .stated = all_stated<&Scene::linings>,
     .add_in_plane = add_linings<2>},
};
static_assert(has_each_kind(scene_supports), "a row for each kind of support");

// Checks that every stage installs supports that exist, that each is installed by one stage, and a lining after its
// excavation. Throws SceneError.
void check_installs(const Scene& scene);

}  // namespace voussoir
