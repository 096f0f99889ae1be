// The folder of a run: the files that a later `voussoir resume` needs.
//
//   .lock, .voussoir-made      app/run_folder/claimed_folder.hpp
//   scene.toml, run.json       the scene and the options, written before the first step
//   checkpoint, checkpoint.previous
//   end_state                  on request: the state at which another run can begin
//   (app/run_folder/begin_run.hpp) history.csv, frames/, blocks.pvd, contacts.pvd; with bolts also bolts.pvd and
//   bolts.csv, with linings linings.pvd and lining.csv; view.bin, view.html on request; of a search also
//   search.csv (app/run_folder/search_files.hpp), trial_blocks.pvd, trial_contacts.pvd
//   report.html, when `voussoir report` made it
//   results.json               comes last: if it exists, the run is complete and the checkpoints are gone
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/run_folder/claimed_folder.hpp"
#include "core/base/bad_input.hpp"
#include "core/output/results_json.hpp"
#include "core/run/checkpoint.hpp"

namespace voussoir {

// the scene and the options of a run: the results depend on the scene alone
struct RunOptions {
  std::string scene_hash;  // LoadedScene::hash
  int threads = 1;
  long long checkpoint_steps = 0;          // between checkpoints; 0: not used
  double checkpoint_seconds = 300;         // wall clock between checkpoints; 0: not used
  std::string until;                       // the stage after which the run ends; empty: the last
  bool keep = false;                       // the state at the end
  std::vector<std::string> warnings;       // warnings about the original scene, with its lines
  std::vector<AccuracyRound> rounds = {};  // that are done
  std::vector<std::string> settings = {};  // overrides of scene.toml in the present round
  std::vector<Origin> origins = {};        // of all processes that took part in it
};

// throws OutputError
void write_options(const std::filesystem::path& folder, const RunOptions& options);
// throws BadInput with the file's name if it cannot be read
RunOptions read_options(const std::filesystem::path& folder);

inline constexpr const char* report_file = "report.html";

// the files of a run, and those that a continued run writes again
Outputs run_outputs();
Outputs resume_outputs();

bool holds_results(const std::filesystem::path& folder);
bool holds_unfinished_run(const std::filesystem::path& folder);
bool holds_checkpoints(const std::filesystem::path& folder);

void remove_checkpoints(const std::filesystem::path& folder);

// keeps the one before
template <int Dim>
void save_checkpoint(const std::filesystem::path& folder, const Progress<Dim>& progress, const std::string& scene_hash);

// the state at the end of the last stage, at which other runs can begin
template <int Dim>
void save_end_state(const std::filesystem::path& folder, const Progress<Dim>& progress, const std::string& scene_hash);
bool holds_end_state(const std::filesystem::path& folder);
// throws BadInput with the file's name if it cannot be used
template <int Dim>
Progress<Dim> read_end_state(const std::filesystem::path& folder, const std::string& scene_hash,
                             std::vector<std::string>& remarks);

// The state of the newest valid checkpoint, or the begin of the scene if there is none. `remarks` gains a line for each
// checkpoint that was skipped, and then replaced by the one before it, or that another program wrote. Throws BadInput
// if there are checkpoints but none can be used, and OutputError.
template <int Dim>
Progress<Dim> last_progress(const std::filesystem::path& folder, const Prepared<Dim>& scene,
                            const std::string& scene_hash, std::vector<std::string>& remarks);

// Why the scene of a folder is not the one with this hash, and the repair. Earlier versions had other defaults, those
// of preset = "thesis".
std::string other_scene(const std::filesystem::path& scene, const std::string& hash, const std::string& otherwise);

}  // namespace voussoir
