// What the program's exit codes mean, in the words that its help and its manual page print.
#pragma once

#include "app/commands/commands.hpp"

namespace voussoir {

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
