// The folder that a command writes to: locked against other programs, and claimed by one rule for all commands. A
// command never overwrites a file that it reads, through any link, and overwrites another existing file only with
// --overwrite. Its first file lists the files it is going to write, so that --overwrite removes exactly the files of an
// older command.
//
//   .lock           held while a command writes here; dies with the process
//   .voussoir-made  files of the last command that wrote here
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

// A file lock that one process holds at a time, or several share; released when the process dies. Its text names the
// last holder. Throws OutputError, or BadInput if the name belongs to something else.
class FileLock {
 public:
  // nothing if others hold it; their name is then in `holder`
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

// the exclusive holder of a lock, if any; leaves no trace and needs no write permission
std::optional<std::string> holder_of_lock(const std::filesystem::path& file);

// Makes the folder if necessary, holds its lock and removes partly written files of killed programs. Throws
// OutputError, FolderInUse with the holder's name, or BadInput if the lock's name belongs to something else.
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

// Held while a command reads the folder of another one, which must not write there meanwhile; several may read at the
// same time. Throws FolderInUse. A folder without a lock is read as it is.
class ReadingLock {
 public:
  explicit ReadingLock(const std::filesystem::path& folder);
  ~ReadingLock();
  ReadingLock(const ReadingLock&) = delete;
  ReadingLock& operator=(const ReadingLock&) = delete;

 private:
  int file_;
};

// the files that a command writes into its folder
struct Outputs {
  std::string command;                    // run, slice, limit, joint-test, study
  std::vector<std::string> files;         // if the first exists, the folder contains results
  bool frames = false;                    // and a series of frames (core/output/paraview.hpp)
  std::vector<std::string> folders = {};  // of a study: one for every run
  bool goes_on =
      false;  // from the files of the same command: only files and folders that are no longer named are removed
};

// in the folder of a study's run: its output, its worker, the reason if it has no results, and the hashes of its
// results (app/run_folder/results_hash.hpp)
inline constexpr const char *messages_file = "messages.txt", *worker_file = ".worker", *failure_file = "failure.txt",
                            *hash_file = "results.hash";

// Throws BadInput if an input file would be overwritten.
void refuse_inputs(const std::filesystem::path& folder, const Outputs& outputs,
                   const std::vector<std::filesystem::path>& inputs);

// Whether the folder's list contains this file, so that it may be replaced.
bool made_here(const std::filesystem::path& folder, const std::string& name);

// Locks the folder, refuses to replace protected files, removes the files of an older command except `inputs`, and
// lists the files to be written. Protected: inputs always; without `overwrite` existing files of a name to be written,
// and an older command's results. Throws BadInput, FolderInUse, OutputError; a refused folder is left
// unchanged.
class ClaimedFolder {
 public:
  ClaimedFolder(const std::filesystem::path& folder, const Outputs& outputs,
                const std::vector<std::filesystem::path>& inputs, bool overwrite);

 private:
  FolderLock lock_;
};

// One file in a shared folder: no lock and no list. Refuses a folder of its name, an input, and without `overwrite` an
// existing file; makes the folder if necessary. Throws BadInput, OutputError.
void claim_file(const std::filesystem::path& file, const std::string& command,
                const std::vector<std::filesystem::path>& inputs, bool overwrite);

}  // namespace voussoir
