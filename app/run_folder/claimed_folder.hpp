// The folder that a command writes to: locked against other programs, and claimed by the one rule that all commands
// keep. A command never writes over a file that it reads, whatever link leads to it, and never unasked over any other
// file that is there. Its first file lists what it is going to write, so that --overwrite removes what an older command
// left, all of it and nothing else.
//
//   .lock           held while a command writes here; dies with the process
//   .voussoir-made  what the last command that wrote here made
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace voussoir {

// the folder is in use; the program ends with exit code 3
struct FolderInUse : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A file that one process holds at a time, or several that share it; dies with the process. Its text names who held it
// last. Throws OutputError, or BadInput where the name stands for something else.
class FileLock {
 public:
  // nothing where others hold it; their name is then in `holder`
  static std::optional<FileLock> taken(const std::filesystem::path& file, bool shared, std::string& holder);
  FileLock(FileLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  FileLock& operator=(FileLock&& other) noexcept {
    std::swap(file_, other.file_);
    return *this;
  }
  ~FileLock();

 private:
  explicit FileLock(int file) : file_(file) {}

  int file_;
};

// who holds a lock alone, where somebody does; asks without a trace, of a folder that must not be written too
std::optional<std::string> holder_of_lock(const std::filesystem::path& file);

// Makes the folder if need be, holds its lock and removes what killed programs left half-written. Throws OutputError,
// FolderInUse with the holder's name, or BadInput where the lock's name stands for something else.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);

 private:
  FileLock lock_;
};

// The folder's lock, shared by processes that each write to places of their own in it. Throws as FolderLock.
class SharedFolderLock {
 public:
  explicit SharedFolderLock(const std::filesystem::path& folder);

 private:
  FileLock lock_;
};

// Held while a command reads the folder of another one, which must not write there meanwhile; any number may read at
// once. Throws FolderInUse. A folder without a lock is read as it is.
class ReadingLock {
 public:
  explicit ReadingLock(const std::filesystem::path& folder);
  ~ReadingLock();
  ReadingLock(const ReadingLock&) = delete;
  ReadingLock& operator=(const ReadingLock&) = delete;

 private:
  int file_;
};

// what a command writes into its folder
struct Outputs {
  std::string command;                    // run, slice, limit, joint-test, study
  std::vector<std::string> files;         // while the first is there, the folder holds results
  bool frames = false;                    // and a series of frames (core/output/paraview.hpp)
  std::vector<std::string> folders = {};  // of a study: one for every run
  bool goes_on = false;  // with what the same command left: only files and folders not named any more are removed
};

// in the folder of a study's run: what it printed, who works at it, why it has no results, and the hashes of those that
// it has (app/run_folder/results_hash.hpp)
inline constexpr const char *messages_file = "messages.txt", *worker_file = ".worker", *failure_file = "failure.txt",
                            *hash_file = "results.hash";

// Throws BadInput where a file that is read would be written over.
void refuse_inputs(const std::filesystem::path& folder, const Outputs& outputs,
                   const std::vector<std::filesystem::path>& inputs);

// Whether the folder's list says that a command made this file there, so that it may be replaced.
bool made_here(const std::filesystem::path& folder, const std::string& name);

// Locks the folder, refuses what must not be replaced, removes what an older command made there but for `inputs`, and
// lists what will be written. Refused: inputs always; without `overwrite` whatever stands under a name to be written,
// and an older command's results. Throws BadInput, FolderInUse, OutputError; a folder that is refused is left as it
// was.
class ClaimedFolder {
 public:
  ClaimedFolder(const std::filesystem::path& folder, const Outputs& outputs,
                const std::vector<std::filesystem::path>& inputs, bool overwrite);

 private:
  FolderLock lock_;
};

// One file in a folder that is not ours alone: no lock and no list. Refuses a folder of its name, an input, and without
// `overwrite` what is there; makes the folder if need be. Throws BadInput, OutputError.
void claim_file(const std::filesystem::path& file, const std::string& command,
                const std::vector<std::filesystem::path>& inputs, bool overwrite);

}  // namespace voussoir
