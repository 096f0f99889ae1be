// The program's arguments as a manual page and a completion script, made from the parser alone.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace voussoir {

// voussoir.1: commands, options and exit codes, for man (troff with the macros of man(7), UTF-8)
std::string manual_page(const CLI::App& program);

// a script that bash sources: completes commands, their options, options' values of a fixed list, files and folders
std::string bash_completion(const CLI::App& program);

}  // namespace voussoir
