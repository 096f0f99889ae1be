#include "app/study/folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "app/base/digest.hpp"
#include "app/run_folder/run_folder.hpp"
#include "app/study/finding_names.hpp"
#include "core/base/bad_input.hpp"
#include "core/output/atomic_file.hpp"
#include "core/run/checkpoint.hpp"
#include "core/scene/scene.hpp"
#include "text/read_file.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t largest_notes = 64 << 20, largest_manifest = 2ull << 30, largest_input = 2ull << 30;  // bytes

constexpr const char *notes_file = "study.json", *manifest_file = "manifest.jsonl", *input_folder = "input";

// the place of a file, with links in the path to its folder resolved
fs::path place_of(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  return fs::canonical(folder) / file.filename();
}

fs::path common_folder(const fs::path& a, const fs::path& b) {
  fs::path common;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end() && *i == *j; ++i, ++j)
    common /= *i;
  return common;
}

std::string input_bytes(const fs::path& file) {
  try {
    return read_file(file, largest_input);
  } catch (const ReadFault& fault) {
    throw BadInput(fmt::format("'{}': {}", file.string(), fault.what()));
  }
}

fs::path copy_of(const fs::path& file, const std::vector<InputFile>& input) {
  const auto found =
      std::find_if(input.begin(), input.end(), [&](const InputFile& f) { return f.from == place_of(file); });
  return input_folder / found->to;
}

Json json_of(const PlannedRow& row) {
  Json json = {{"row", row.row}, {"hash", row.run.name}, {"scene", row.run.scene.string()}, {"set", row.run.overrides}};
  if (row.run.other) json["other"] = {{"command", row.run.other->name}, {"options", row.run.other->options}};
  if (!row.run.begin.empty()) json["begin"] = row.run.begin.string();
  json["cost"] = row.cost;
  return json;
}

PlannedRow row_of(const Json& json, const fs::path& folder) {
  PlannedRow row{json.at("row"), json.at("cost"), {}};
  row.run.name = json.at("hash");
  row.run.scene = folder / json.at("scene").get<std::string>();
  row.run.overrides = json.at("set").get<std::vector<std::string>>();
  if (json.contains("other"))
    row.run.other = OtherCommand{json.at("other").at("command"), json.at("other").at("options")};
  if (json.contains("begin")) row.run.begin = json.at("begin").get<std::string>();
  return row;
}

// Links among the files that a scene names are not copied as links: the copy would have other contents, or none.
void require_same_scenes(const fs::path& folder, const std::vector<PlannedRow>& rows,
                         const std::vector<PlannedRow>& copies) {
  std::set<fs::path> seen;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (!seen.insert(copies[k].run.scene).second) continue;
    const auto text = [&](const fs::path& scene) { return canonical_text(read_scene(scene, rows[k].run.overrides)); };
    const auto is_same = [&] {
      try {
        return text(folder / copies[k].run.scene) == text(rows[k].run.scene);
      } catch (const SceneError&) {
        return false;
      }
    };
    if (!is_same())
      throw BadInput(
          fmt::format("'{}' cannot be copied: one of the files that it names is a link; put the file "
                      "in its place",
                      rows[k].run.scene.string()));
  }
}

void write_if_new(const fs::path& file, const std::string& bytes) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) throw output_error(file.parent_path(), error.value());
  if (fs::exists(file) && input_bytes(file) == bytes) return;
  write_file(file, bytes);
}

BadInput not_planned(const fs::path& folder, const fs::path& file) {
  return BadInput(
      fmt::format("'{}' differs from the plan: plan again with 'voussoir study plan <study.toml> --out "
                  "{}', which keeps completed runs",
                  file.string(), folder.string()));
}

// study.json contains a digest of itself
Json with_digest(Json notes) {
  notes["digest"] = digest(notes.dump());
  return notes;
}

Json read_notes(const fs::path& folder) {
  const fs::path file = folder / notes_file;
  if (!fs::exists(file))
    throw BadInput(fmt::format("'{0}' contains no study: plan one with 'voussoir study plan <study.toml> --out {0}'",
                               folder.string()));
  try {
    Json notes = Json::parse(read_file(file, largest_notes));
    const Json stated = notes;
    notes.erase("digest");
    if (with_digest(notes) != stated) throw not_planned(folder, file);
    if (notes.at("schema") != "voussoir.study" || notes.at("schema_version") != 1)
      throw BadInput(fmt::format("'{}' was written by another version of this program", file.string()));
    return notes;
  } catch (const Json::exception&) {
    throw not_planned(folder, file);
  } catch (const ReadFault& fault) {
    throw BadInput(fmt::format("'{}': {}", file.string(), fault.what()));
  }
}

std::string planned_bytes(const fs::path& folder, const fs::path& name, std::uintmax_t most, const Json& stated) {
  try {
    std::string bytes = read_file(folder / name, most);
    if (digest(bytes) == stated) return bytes;
  } catch (const ReadFault&) {
  }
  throw not_planned(folder, folder / name);
}

}  // namespace

std::vector<InputFile> input_files(const fs::path& plan, const std::vector<PlannedRow>& rows) {
  std::set<fs::path> files{place_of(plan)};
  for (const PlannedRow& row : rows)
    for (const fs::path& file : row.run.files)
      files.insert(place_of(file));
  fs::path common = files.begin()->parent_path();
  for (const fs::path& file : files)
    common = common_folder(common, file.parent_path());
  std::vector<InputFile> input{{place_of(plan), place_of(plan).lexically_relative(common)}};
  for (const fs::path& file : files)
    if (file != input.front().from) input.push_back({file, file.lexically_relative(common)});
  return input;
}

Outputs study_outputs(const StudyPlan& plan, const std::vector<InputFile>& input, const std::vector<PlannedRow>& rows) {
  Outputs outputs{"study", {"study.csv", notes_file, manifest_file, report_file}, false, {}, true};
  for (const InputFile& file : input)
    outputs.files.push_back((input_folder / file.to).string());
  for (const std::string& name : finding_names(plan))
    outputs.files.push_back(name);
  std::set<std::string> folders;
  for (const PlannedRow& row : rows) {
    folders.insert("runs/" + row.run.name);
    if (!row.run.begin.empty()) folders.insert("runs/" + row.run.begin.string());
  }
  outputs.folders.assign(folders.begin(), folders.end());
  return outputs;
}

void write_study_folder(const fs::path& folder, const StudyPlan& plan, const std::vector<InputFile>& input,
                        std::vector<PlannedRow> rows, const std::string& program_digest) {
  Json inputs = Json::array();
  for (const InputFile& file : input) {
    const std::string bytes = input_bytes(file.from);
    write_if_new(folder / input_folder / file.to, bytes);
    inputs.push_back({{"file", (input_folder / file.to).string()}, {"hash", digest(bytes)}});
  }
  const std::vector<PlannedRow> originals = rows;
  std::map<fs::path, fs::path> copies;
  for (PlannedRow& row : rows) {
    const auto [copy, added] = copies.try_emplace(row.run.scene);
    if (added) copy->second = copy_of(row.run.scene, input);
    row.run.scene = copy->second;
  }
  require_same_scenes(folder, originals, rows);

  std::stable_sort(rows.begin(), rows.end(), [](const PlannedRow& a, const PlannedRow& b) { return a.cost > b.cost; });
  std::string manifest;
  for (const PlannedRow& row : rows)
    manifest += json_of(row).dump() + "\n";
  const bool is_same = fs::exists(folder / manifest_file) && input_bytes(folder / manifest_file) == manifest;
  if (!is_same) {
    remove_file(folder / "study.csv");
    for (const std::string& name : finding_names(plan))
      remove_file(folder / name);
    write_file(folder / manifest_file, manifest);
  }
  const Json notes = {{"schema", "voussoir.study"},   {"schema_version", 1},
                      {"program", build_name()},      {"program_hash", program_digest},
                      {"hashes", "XXH3, 128 bits"},   {"rows", rows.size()},
                      {"manifest", digest(manifest)}, {"input", inputs}};
  write_file(folder / notes_file, with_digest(notes).dump(2) + "\n");
}

StudyFolder read_study_folder(const fs::path& folder) {
  const Json notes = read_notes(folder);
  StudyFolder study;
  study.folder = folder;
  const std::string manifest = planned_bytes(folder, manifest_file, largest_manifest, notes.at("manifest"));
  for (const Json& input : notes.at("input"))
    planned_bytes(folder, input.at("file").get<std::string>(), largest_input, input.at("hash"));
  study.plan = read_study_plan(folder / notes.at("input").at(0).at("file").get<std::string>());
  for (std::size_t from = 0; from < manifest.size(); from = manifest.find('\n', from) + 1)
    study.rows.push_back(row_of(Json::parse(manifest.begin() + static_cast<std::ptrdiff_t>(from),
                                            manifest.begin() + static_cast<std::ptrdiff_t>(manifest.find('\n', from))),
                                folder));
  study.manifest_digest = notes.at("manifest");
  study.program = notes.at("program");
  study.program_digest = notes.at("program_hash");
  return study;
}

}  // namespace voussoir
