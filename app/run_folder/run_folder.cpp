#include "app/run_folder/run_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "app/run_folder/search_files.hpp"
#include "core/base/preset.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/json_parts.hpp"
#include "core/output/record_output.hpp"
#include "core/output/support_table.hpp"
#include "core/run/simulate.hpp"
#include "core/scene/scene.hpp"
#include "text/read_file.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

constexpr int options_version = 1;
constexpr int most_threads = 1024;  // as on the command line
const char* const newest = "checkpoint";
const char* const previous = "checkpoint.previous";
const char* const end_state = "end_state";

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

// bytes: of run.json; of a checkpoint's head, which gives its size
constexpr std::uintmax_t largest_options = 16 << 20, checkpoint_head = 4096;

std::string content_of(const fs::path& path, std::uintmax_t most) {
  try {
    return read_file(path, most);
  } catch (const ReadFault& fault) {
    throw BadInput(fmt::format("'{}': {}", path.string(), fault.what()));
  }
}

// a file that cannot be a checkpoint is not read, and no memory is allocated for it
std::string checkpoint_content(const fs::path& path) {
  try {
    std::uintmax_t size = 0;
    const std::string head = read_head(path, checkpoint_head, size);
    if (const std::uintmax_t stated = checkpoint_size(head); size > checkpoint_head && size != stated)
      throw CheckpointError("is damaged or cut short");
  } catch (const ReadFault& fault) {
    throw BadInput(fmt::format("'{}': {}", path.string(), fault.what()));
  }
  return content_of(path, std::numeric_limits<std::uintmax_t>::max());
}

void remark_build(const fs::path& path, const std::string& bytes, std::vector<std::string>& remarks) {
  if (const std::string build = checkpoint_record(bytes).build; build != build_name())
    remarks.push_back(fmt::format("'{}' was written by {}, this is {}: the last bits may differ", path.string(), build,
                                  build_name()));
}

std::vector<AccuracyRound> rounds_of(const nlohmann::json& list) {
  std::vector<AccuracyRound> rounds;
  for (const nlohmann::json& round : list)
    rounds.push_back({round.at("settings"), round.at("told"), round.at("contact_evaluations"),
                      round.value("parts", std::map<std::string, double>())});
  return rounds;
}

}  // namespace

void write_options(const fs::path& folder, const RunOptions& options) {
  const nlohmann::ordered_json json = {{"schema", "voussoir.run"},
                                       {"schema_version", options_version},
                                       {"program", build_name()},
                                       {"scene_hash", options.scene_hash},
                                       {"threads", options.threads},
                                       {"checkpoint_steps", options.checkpoint_steps},
                                       {"checkpoint_seconds", options.checkpoint_seconds},
                                       {"until", options.until},
                                       {"keep", options.keep},
                                       {"warnings", options.warnings},
                                       {"rounds", rounds_json(options.rounds)},
                                       {"settings", options.settings},
                                       {"origins", origins_json(options.origins)}};
  write_file(folder / "run.json", json.dump(2) + "\n");
}

RunOptions read_options(const fs::path& folder) {
  const fs::path path = folder / "run.json";
  try {
    const nlohmann::json json = nlohmann::json::parse(content_of(path, largest_options));
    if (json.at("schema") != "voussoir.run" || json.at("schema_version") != options_version)
      throw BadInput(fmt::format("'{}' was written by another version of this program", path.string()));
    const RunOptions options{json.at("scene_hash"),
                             json.at("threads"),
                             json.at("checkpoint_steps"),
                             json.at("checkpoint_seconds"),
                             json.value("until", ""),
                             json.value("keep", false),
                             json.at("warnings"),
                             rounds_of(json.value("rounds", nlohmann::json::array())),
                             json.value("settings", std::vector<std::string>()),
                             origins_of(json.value("origins", nlohmann::json::array()))};
    if (options.threads < 1 || options.threads > most_threads || options.checkpoint_steps < 0 ||
        !(options.checkpoint_seconds >= 0))
      throw BadInput(
          fmt::format("'{}' is damaged (a number is out of range): start again with 'voussoir run "
                      "--overwrite'",
                      path.string()));
    return options;
  } catch (const nlohmann::json::exception& error) {
    throw BadInput(
        fmt::format("'{}' is damaged ({}): start again with 'voussoir run --overwrite'", path.string(), error.what()));
  }
}

Outputs run_outputs() {
  Outputs outputs{
      "run",
      {"results.json", "run.json", newest, previous, end_state, "history.csv", "view.bin", "view.html", "scene.toml"},
      true};
  for (const std::string& table : support_table_files())
    outputs.files.push_back(table);
  outputs.files.insert(outputs.files.end(), {search_table, report_file, record_spectra_file, monitor_spectra_file});
  return outputs;
}

Outputs resume_outputs() {
  Outputs outputs = run_outputs();
  std::erase(outputs.files, "run.json");
  std::erase(outputs.files, "scene.toml");
  return outputs;
}

bool holds_results(const fs::path& folder) {
  return is_there(folder / "results.json");
}

bool holds_unfinished_run(const fs::path& folder) {
  return is_there(folder / "run.json") && !holds_results(folder);
}

bool holds_checkpoints(const fs::path& folder) {
  return is_there(folder / newest) || is_there(folder / previous);
}

void remove_checkpoints(const fs::path& folder) {
  remove_file(folder / newest);
  remove_file(folder / previous);
}

template <int Dim>
void save_checkpoint(const fs::path& folder, const Progress<Dim>& progress, const std::string& scene_hash) {
  write_file_and_keep(folder / newest, folder / previous, checkpoint_bytes(progress, scene_hash));
}

template <int Dim>
void save_end_state(const fs::path& folder, const Progress<Dim>& progress, const std::string& scene_hash) {
  write_file(folder / end_state, checkpoint_bytes(progress, scene_hash));
}

bool holds_end_state(const fs::path& folder) {
  return is_there(folder / end_state);
}

template <int Dim>
Progress<Dim> read_end_state(const fs::path& folder, const std::string& scene_hash, std::vector<std::string>& remarks) {
  const fs::path path = folder / end_state;
  try {
    const std::string bytes = checkpoint_content(path);
    Progress<Dim> progress = read_checkpoint<Dim>(bytes, scene_hash);
    remark_build(path, bytes, remarks);
    return progress;
  } catch (const CheckpointError& error) {
    throw BadInput(
        fmt::format("'{}' {}; make it again with 'voussoir run --until … --overwrite'", path.string(), error.what()));
  }
}

template <int Dim>
Progress<Dim> last_progress(const fs::path& folder, const Prepared<Dim>& scene, const std::string& scene_hash,
                            std::vector<std::string>& remarks) {
  std::vector<std::string> refusals;
  for (const char* name : {newest, previous}) {
    const fs::path path = folder / name;
    if (!is_there(path)) continue;
    try {
      const std::string bytes = checkpoint_content(path);
      Progress<Dim> progress = read_checkpoint<Dim>(bytes, scene_hash);
      remark_build(path, bytes, remarks);
      // an unusable checkpoint must not displace a usable one when the next is written
      if (!refusals.empty()) {
        move_file(path, folder / newest);
        remarks.push_back(fmt::format("{}; the one before it is used", refusals.front()));
      }
      return progress;
    } catch (const CheckpointError& error) {
      refusals.push_back(fmt::format("'{}' {}", path.string(), error.what()));
    } catch (const BadInput& error) {
      refusals.push_back(error.what());
    }
  }
  if (!refusals.empty())
    throw BadInput(
        fmt::format("no checkpoint can be used: {}; restore the changed files, or start again with 'voussoir "
                    "run --overwrite'",
                    fmt::join(refusals, "; ")));
  return initial_progress(scene);
}

std::string other_scene(const fs::path& scene, const std::string& hash, const std::string& otherwise) {
  const std::string name = fmt::format("'{}'", scene.string());
  if (input_hash(read_scene(scene, {fmt::format("preset=\"{}\"", thesis_preset)})) == hash)
    return fmt::format("{} was run with the defaults of an earlier version: write preset = \"{}\" at its top", name,
                       thesis_preset);
  return fmt::format("{} is not the scene that was run there: put it back, or {}", name, otherwise);
}

template void save_checkpoint<2>(const fs::path&, const Progress<2>&, const std::string&);
template void save_checkpoint<3>(const fs::path&, const Progress<3>&, const std::string&);
template void save_end_state<2>(const fs::path&, const Progress<2>&, const std::string&);
template void save_end_state<3>(const fs::path&, const Progress<3>&, const std::string&);
template Progress<2> read_end_state<2>(const fs::path&, const std::string&, std::vector<std::string>&);
template Progress<3> read_end_state<3>(const fs::path&, const std::string&, std::vector<std::string>&);
template Progress<2> last_progress<2>(const fs::path&, const Prepared<2>&, const std::string&,
                                      std::vector<std::string>&);
template Progress<3> last_progress<3>(const fs::path&, const Prepared<3>&, const std::string&,
                                      std::vector<std::string>&);

}  // namespace voussoir
