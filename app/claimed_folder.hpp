// The folder that a command writes to: locked against other programs, and claimed by the one rule that all commands
// keep. A command never writes over a file that it reads, whatever link leads to it, and never unasked over any other
// file that is there. Its first file lists what it is going to write, so that --overwrite removes what an older command
// left, all of it and nothing else.
//
//   .lock           held while a command writes here; dies with the process
//   .voussoir-made  what the last command that wrote here made
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace voussoir {

// the folder is in use; the program ends with exit code 3
struct FolderInUse : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Makes the folder if need be, holds its lock and removes what killed programs left half-written. Throws OutputError,
// FolderInUse with the holder's name, or BadInput where the lock's name stands for something else.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
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
  bool goes_on = false;  // with what the same command left: only folders not named any more are removed
};

// caught from a run of a study, in the run's folder
inline constexpr const char* messages_file = "messages.txt";

// Throws BadInput where a file that is read would be written over.
void refuse_inputs(const std::filesystem::path& folder, const Outputs& outputs,
                   const std::vector<std::filesystem::path>& inputs);

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

}  // namespace voussoir
