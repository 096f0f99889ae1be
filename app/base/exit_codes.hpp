// The meanings of the program's exit codes, as its help and its manual page print them.
#pragma once

#include "core/output/results.hpp"

namespace voussoir {

enum class ExitCode {
  done = 0,
  incomplete = 1,  // complete, but a goal was not reached: no equilibrium, no bracket
  bad_input = 2,
  in_use = 3,         // another run writes to the folder
  numerical = 4,      // a contact without a solution, a number that is not finite
  output = 5,         // a result could not be written or renamed
  disk_full = 6,      // or a quota or a limit on the size of files
  not_permitted = 7,  // a folder or file without write permission
  no_memory = 8,
  signal = 128  // and the number of the signal that ended a run: 130 for SIGINT, 143 for SIGTERM
};

ExitCode exit_code(Outcome outcome);
ExitCode ended_by(int signal);

struct ExitCodeMeaning {
  ExitCode code;
  const char* text;
};

inline constexpr ExitCodeMeaning exit_code_meanings[] = {
    {ExitCode::done, "done"},
    {ExitCode::incomplete, "a goal was not reached"},
    {ExitCode::bad_input, "bad input"},
    {ExitCode::in_use, "the folder is in use by another run"},
    {ExitCode::numerical, "numerical failure"},
    {ExitCode::output, "a result could not be written"},
    {ExitCode::disk_full, "disk full"},
    {ExitCode::not_permitted, "folder not writable"},
    {ExitCode::no_memory, "not enough memory"},
};
inline constexpr const char* ended_by_signal = "ended by signal n (with a checkpoint)";  // signal + n

}  // namespace voussoir
