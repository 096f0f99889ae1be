// The program's own arguments as pages for others: whatever the parser knows is in them, and nothing else.
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
