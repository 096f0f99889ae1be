#include "core/scene/support_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/plain_text.hpp"

namespace voussoir {
namespace {

bool has_name(const std::vector<std::string>& list, const std::string& name) {
  return std::ranges::find(list, name) != list.end();
}

// the names of all supports, each once
std::vector<std::string> names_of_supports(const Scene& scene) {
  std::vector<std::string> names;
  for (const SceneSupport& row : scene_supports)
    if (row.stated)
      for (const StatedSupport& support : row.stated(scene)) {
        if (has_name(names, support.name))
          refuse(support.subject, "name",
                 "is also the name of bolts or of another lining; stages install by name, so choose another");
        names.push_back(support.name);
      }
  return names;
}

// the names that stages install
std::vector<std::string> installed_names(const Scene& scene) {
  const std::vector<std::string> names = names_of_supports(scene);
  std::vector<std::string> installed, excavated, later;
  for (const StageSpec& stage : scene.stages)
    later.insert(later.end(), stage.plan.change.excavate.begin(), stage.plan.change.excavate.end());
  for (const StageSpec& stage : scene.stages) {
    for (const std::string& name : stage.plan.change.excavate)
      excavated.push_back(name);
    for (const std::string& name : stage.plan.change.install) {
      if (!has_name(names, name))
        refuse(stage.subject, "install",
               names.empty()
                   ? "there is nothing to install; add [[bolts]] or [[linings]] with a name"
                   : "no bolts or linings are named '" + one_line(name, 60) + "'; " + suggestion(name, names));
      if (has_name(installed, name))
        refuse(stage.subject, "install",
               "installs '" + one_line(name, 60) + "' again; name bolts and linings in one stage, once");
      installed.push_back(name);
      for (const LiningSpec& spec : scene.linings)
        if (spec.properties.name == name && has_name(later, spec.excavation) && !has_name(excavated, spec.excavation))
          refuse(stage.subject, "install",
                 "installs the lining '" + one_line(name, 60) + "' before '" + one_line(spec.excavation, 60) +
                     "' is excavated; install it "
                     "in the stage that excavates, or after it");
    }
  }
  return installed;
}

}  // namespace

void check_installs(const Scene& scene) {
  const std::vector<std::string> installed = installed_names(scene);
  for (const SceneSupport& row : scene_supports)
    if (row.stated)
      for (const StatedSupport& support : row.stated(scene))
        if (!has_name(installed, support.name))
          refuse(support.subject, "name",
                 fmt::format("no stage installs {}; write install = [\"{}\"] in the stage before which it is "
                             "installed, or remove it",
                             row.these, one_line(support.name, 60)));
}

}  // namespace voussoir
