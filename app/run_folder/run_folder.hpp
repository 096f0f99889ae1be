// The folder of a run: what a later `voussoir resume` needs.
//
//   .lock, .voussoir-made      app/run_folder/claimed_folder.hpp
//   scene.toml, run.json       what is run and how, written before the first step
//   checkpoint, checkpoint.previous
//   end_state                  of a run that is asked for it: where another run can begin
//   (app/run_folder/begin_run.hpp) history.csv, frames/, blocks.pvd, contacts.pvd; with bolts also bolts.pvd and
//   bolts.csv, with linings linings.pvd and lining.csv; view.bin, view.html where they are asked for; of a search also
//   trial_blocks.pvd, trial_contacts.pvd results.json               comes last: where it is, the run is complete and
//   the checkpoints are gone
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/base/bad_input.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "core/output/results_json.hpp"
#include "core/run/checkpoint.hpp"

namespace voussoir {

// what is run, and how: the results depend on the scene alone
struct RunOptions {
  std::string scene_hash;  // LoadedScene::hash
  int threads = 1;
  long long checkpoint_steps = 0;          // between checkpoints; 0: steps do not matter
  double checkpoint_seconds = 300;         // wall clock between checkpoints; 0: time does not matter
  std::string until;                       // the stage after which the run ends; empty: the last
  bool keep = false;                       // the state at the end
  std::vector<std::string> warnings;       // what looked implausible in the scene as it was given, with its lines
  std::vector<AccuracyRound> rounds = {};  // that are done
  std::vector<std::string> settings = {};  // overrides of scene.toml in the round under way
  std::vector<Origin> origins = {};        // of all processes that had a part in it
};

// throws OutputError
void write_options(const std::filesystem::path& folder, const RunOptions& options);
// throws BadInput with the file's name when it cannot be understood
RunOptions read_options(const std::filesystem::path& folder);

// what a run writes, and what of it a run that continues writes again
Outputs run_outputs();
Outputs resume_outputs();

bool holds_results(const std::filesystem::path& folder);
bool holds_unfinished_run(const std::filesystem::path& folder);
bool holds_checkpoints(const std::filesystem::path& folder);

void remove_checkpoints(const std::filesystem::path& folder);

// keeps the one before
template <int Dim>
void save_checkpoint(const std::filesystem::path& folder, const Progress<Dim>& progress, const std::string& scene_hash);

// the state where the last stage ended, for other runs to begin with
template <int Dim>
void save_end_state(const std::filesystem::path& folder, const Progress<Dim>& progress, const std::string& scene_hash);
bool holds_end_state(const std::filesystem::path& folder);
// throws BadInput with the file's name where it cannot be used
template <int Dim>
Progress<Dim> read_end_state(const std::filesystem::path& folder, const std::string& scene_hash,
                             std::vector<std::string>& remarks);

// What the newest good checkpoint holds, or the begin of the scene where there is none. `remarks` gains a line for each
// checkpoint that was passed over, and then replaced by the one before it, or that another program wrote. Throws
// BadInput when none of those there can be used, and OutputError.
template <int Dim>
Progress<Dim> last_progress(const std::filesystem::path& folder, const Prepared<Dim>& scene,
                            const std::string& scene_hash, std::vector<std::string>& remarks);

}  // namespace voussoir
