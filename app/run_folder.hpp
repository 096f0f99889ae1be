// The folder of a run: what a later `voussoir resume` needs, and the lock that keeps a second run out.
//
//   .lock                      held while a run writes here; dies with the process
//   scene.toml, run.json       what is run and how, written before the first step
//   checkpoint, checkpoint.previous
//   history.csv, frames/, *.pvd
//   results.json               comes last: where it is, the run is complete and the checkpoints are gone
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/bad_input.hpp"
#include "core/checkpoint/checkpoint.hpp"

namespace voussoir {

// the folder is in use; the program ends with exit code 3
struct FolderInUse : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Makes the folder if need be, holds its lock and removes what killed programs left half-written. Throws OutputError,
// or FolderInUse with the holder's name.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

// what is run, and how: the results depend on the scene alone
struct RunConduct {
  std::string scene_hash;  // LoadedScene::hash
  int threads = 1;
  long long checkpoint_steps = 0;     // between checkpoints; 0: steps do not matter
  double checkpoint_seconds = 300;    // wall clock between checkpoints; 0: time does not matter
  std::vector<std::string> warnings;  // what looked implausible in the scene as it was given, with its lines
};

// throws OutputError
void write_conduct(const std::filesystem::path& folder, const RunConduct& conduct);
// throws BadInput with the file's name when it cannot be understood
RunConduct read_conduct(const std::filesystem::path& folder);

// what a command says that would replace results
BadInput folder_is_taken(const std::filesystem::path& folder);
bool holds_results(const std::filesystem::path& folder);
bool holds_unfinished_run(const std::filesystem::path& folder);
bool holds_checkpoints(const std::filesystem::path& folder);

// removes what a run writes, and nothing else; results.json first, so that a folder without it holds nothing complete
void remove_old_run(const std::filesystem::path& folder);
void remove_checkpoints(const std::filesystem::path& folder);

// keeps the one before
template <int Dim>
void save_checkpoint(const std::filesystem::path& folder, const Progress<Dim>& progress, const std::string& scene_hash);

// What the newest good checkpoint holds, or the begin of the scene where there is none. `remarks` gains a line for each
// checkpoint that was passed over, and then replaced by the one before it, or that another program wrote. Throws
// BadInput when none of those there can be used, and OutputError.
template <int Dim>
Progress<Dim> last_progress(const std::filesystem::path& folder, const Prepared<Dim>& scene,
                            const std::string& scene_hash, std::vector<std::string>& remarks);

}  // namespace voussoir
