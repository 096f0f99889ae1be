#include "app/report/report_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/report/joints_data.hpp"
#include "app/run_folder/run_folder.hpp"
#include "core/base/bad_input.hpp"
#include "core/scene/toml_text.hpp"
#include "text/read_file.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

// rows of a history in a page: more than a figure has pixels
constexpr std::ptrdiff_t most_rows = 2000;

constexpr const char* reported = "a run, a study, a kinematic analysis or a slice with --report";

std::string text_of(const fs::path& file) {
  constexpr std::uintmax_t most = std::uintmax_t{1} << 30;
  try {
    return read_file(file, most);
  } catch (const ReadFault& fault) {
    throw BadInput(fmt::format("'{}': {}", file.string(), fault.what()));
  }
}

nlohmann::json json_of(const fs::path& file) {
  nlohmann::json data = nlohmann::json::parse(text_of(file), nullptr, false);
  if (data.is_discarded()) throw BadInput(fmt::format("'{}' is damaged: make it again", file.string()));
  return data;
}

[[noreturn]] void refuse_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw BadInput(fmt::format("'{}' is not a folder: name the folder of {}", folder.string(), reported));
  if (holds_unfinished_run(folder))
    throw BadInput(fmt::format("the run in '{0}' has not ended: end it with 'voussoir resume {0}'", folder.string()));
  if (fs::exists(folder / "manifest.jsonl", error))
    throw BadInput(
        fmt::format("the study in '{0}' has no results yet: run it with 'voussoir study run {0}', then "
                    "'voussoir study gather {0}'",
                    folder.string()));
  throw BadInput(fmt::format("'{0}' contains no run: make one with 'voussoir run SCENE --out {0}'", folder.string()));
}

// each so many-th row, and the last; the head stays
std::string thinned(const std::string& table, std::ptrdiff_t every) {
  std::string kept;
  std::ptrdiff_t row = 0;
  for (std::size_t at = 0; at < table.size(); ++row) {
    const std::size_t end = std::min(table.find('\n', at), table.size() - 1) + 1;
    if (row == 0 || (row - 1) % every == 0 || end == table.size()) kept.append(table, at, end - at);
    at = end;
  }
  return kept;
}

// of the effective scene, which states every name and number in one form
nlohmann::json lining_sections(const std::string& scene) {
  const Node tree = parse_toml(scene, std::make_shared<const std::string>("scene.toml"));
  auto sections = nlohmann::json::array();
  for (const Subject& lining : children({&tree, ""}, "linings")) {
    nlohmann::json& section = sections.emplace_back();
    section["name"] = name_of(*lining.node);
    for (const auto& [key, column] : {std::pair{"thickness", "thickness_m"},
                                      {"compressive_strength", "compressive_strength_Pa"},
                                      {"tensile_strength", "tensile_strength_Pa"}})
      if (const Node* number = lining.node->find(key); number && number->is_number()) section[column] = number->number;
  }
  return sections;
}

void add_run(const fs::path& folder, nlohmann::json& data) {
  data["results"] = json_of(folder / "results.json");
  if (data["results"].value("schema", "") != "voussoir.results")
    throw BadInput(fmt::format(
        "'{}' has results of another command than 'run', of which there is no report: name the folder of {}",
        folder.string(), reported));
  nlohmann::json& files = data["files"];
  files["scene"] = text_of(folder / "scene.toml");
  std::error_code error;
  for (const char* name : {"history", "search", "lining"}) {
    const fs::path file = folder / fmt::format("{}.csv", name);
    if (fs::exists(file, error)) files[name] = text_of(file);
  }
  if (files.contains("lining")) data["linings"] = lining_sections(files["scene"]);
  if (!files.contains("history")) return;
  const auto& text = files["history"].get_ref<const std::string&>();
  const std::ptrdiff_t every =
      std::max<std::ptrdiff_t>((std::ranges::count(text, '\n') + most_rows - 1) / most_rows, 1);
  data["every"] = every;
  if (every > 1) files["history"] = thinned(text, every);
}

void add_study(const fs::path& folder, nlohmann::json& data) {
  const nlohmann::json& study = data["study"] = json_of(folder / "study.json");
  nlohmann::json& files = data["files"];
  files["study"] = text_of(folder / "study.csv");
  files["manifest"] = text_of(folder / "manifest.jsonl");
  files["input"] = nlohmann::json::array();
  std::error_code error;
  for (const auto& [kind, list] : {std::pair{"sample", "samples"}, {"grid", "grids"}, {"reliability", "reliability"}}) {
    auto& found = files[list] = nlohmann::json::array();
    for (int k = 1; fs::exists(folder / fmt::format("{}_{}.json", kind, k), error); ++k)
      found.push_back({{"json", text_of(folder / fmt::format("{}_{}.json", kind, k))},
                       {"csv", text_of(folder / fmt::format("{}_{}.csv", kind, k))}});
  }
  for (const nlohmann::json& input : study.at("input")) {
    const std::string name = input.at("file");
    if (name.ends_with(".toml")) files["input"].push_back({{"name", name}, {"text", text_of(folder / name)}});
  }
}

void add_kinematics(const fs::path& folder, nlohmann::json& data) {
  data["kinematics"] = json_of(folder / "kinematics.json");
  data["files"]["pairs"] = text_of(folder / "kinematic_pairs.csv");
}

void add_joints(const fs::path& folder, nlohmann::json& data) {
  const fs::path file = folder / joints_data_file;
  nlohmann::json& joints = data["joints"] = json_of(file);
  if (!joints.is_object() || joints.value("schema", "") != joints_schema)
    throw BadInput(
        fmt::format("'{}' is no file of 'voussoir slice --report': name the folder of {}", file.string(), reported));
}

}  // namespace

std::string report_data(const fs::path& folder, const TitleBlock& block) {
  nlohmann::json data;
  std::error_code error;
  if (holds_results(folder))
    add_run(folder, data);
  else if (fs::exists(folder / "study.json", error) && fs::exists(folder / "study.csv", error))
    add_study(folder, data);
  else if (fs::exists(folder / "kinematics.json", error))
    add_kinematics(folder, data);
  else if (fs::exists(folder / joints_data_file, error))
    add_joints(folder, data);
  else
    refuse_folder(folder);
  data["block"] = {{"project", block.project},
                   {"section", block.section},
                   {"author", block.author},
                   {"checked_by", block.checked_by},
                   {"date", block.date}};
  return data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace voussoir
