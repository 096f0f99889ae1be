#include "reports/stiffness_page.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>

#include "reports/text_page.hpp"

namespace voussoir::reports {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_pairs = 4;  // of a case whose scenes sweep the stiffness

std::string shown(const toml::table& properties, const char* key) {
  const std::optional<double> value = properties[key].value<double>();
  return value ? fmt::format("{:g}", *value) : "–";
}

}  // namespace

std::vector<StiffnessChoice> read_stiffness_choices(const fs::path& list) {
  toml::table table;
  try {
    table = toml::parse_file(list.string());
  } catch (const toml::parse_error& problem) {
    throw std::runtime_error(
        fmt::format("{}:{}: {}", list.filename().string(), problem.source().begin.line, problem.description()));
  }
  std::vector<StiffnessChoice> choices;
  for (auto entry = table.begin(); entry != table.end(); ++entry) {
    const std::string name(entry->first.str());
    const auto text = [&](const char* key) {
      const toml::table* row = entry->second.as_table();
      const std::string value = row ? (*row)[key].value_or(std::string()) : std::string();
      if (value.empty())
        throw std::runtime_error(fmt::format("{}:{}: [{}] has no {}; add a sentence", list.filename().string(),
                                             entry->second.source().begin.line, name, key));
      return value;
    };
    choices.push_back({name, text("chosen"), text("changes")});
  }
  return choices;
}

std::vector<std::string> stiffness_of_scenes(const fs::path& folder) {
  std::vector<fs::path> scenes;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  std::vector<std::string> pairs;
  for (const fs::path& scene : scenes) {
    const toml::table table = toml::parse_file(scene.string());
    const toml::array* list = table["joint_properties"].as_array();
    for (std::size_t k = 0; list && k < list->size(); ++k) {
      const toml::table* properties = list->get(k)->as_table();
      if (!properties || !properties->contains("normal_stiffness")) continue;
      const std::string pair =
          fmt::format("{} / {} {}", shown(*properties, "normal_stiffness"), shown(*properties, "shear_stiffness"),
                      (*properties)["constant_stiffness"].value_or(false) ? "N/m" : "Pa/m");
      if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) pairs.push_back(pair);
    }
  }
  return pairs;
}

std::string stiffness_page(const Folders& folders, const verification::Verdicts& verdicts,
                           std::vector<std::string>& missing) {
  std::string page = text_page(folders, "reports/joint_stiffness.md", "joint-stiffness", missing);
  const std::vector<StiffnessChoice> choices = read_stiffness_choices(folders.source / "reports/joint_stiffness.toml");
  std::string body;
  for (const verification::CaseStatus& status : verdicts.cases) {
    const auto choice = std::find_if(choices.begin(), choices.end(),
                                     [&](const StiffnessChoice& other) { return other.case_name == status.name; });
    if (choice == choices.end()) continue;
    std::vector<std::string> pairs = stiffness_of_scenes(folders.source / "cases" / status.name);
    if (pairs.size() > most_pairs) {
      const std::string others = fmt::format("and {} others", pairs.size() - most_pairs);
      pairs.resize(most_pairs);
      pairs.push_back(others);
    }
    body += fmt::format("<tr><td><a href=\"#{0}\">{0}</a></td><td>{1}</td><td>{2}</td><td>{3}</td></tr>\n",
                        slug(status.name), fmt::join(pairs, "<br>"), escape(choice->chosen), escape(choice->changes));
  }
  page.insert(
      page.rfind("</section>"),
      "<h3>Case by case</h3>\n<div class=\"scroll\"><table class=\"stiffness\"><thead><tr><th>case</th><th>normal / "
      "shear, in its scenes</th><th>how chosen</th><th>what it changes</th></tr></thead><tbody>\n" +
          body + "</tbody></table></div>\n");
  return page;
}

}  // namespace voussoir::reports
