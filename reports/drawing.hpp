#pragma once
// How a program draws its figures: by draw.sh and a gnuplot file, both of the style folder.
#include <filesystem>
#include <string>
#include <vector>

namespace voussoir::reports {

// Names as one string of which gnuplot's words() and word() take one after the other, blanks included. Throws
// std::runtime_error for a name with a double quote, which they would take for its end.
std::string as_words(const std::vector<std::string>& names);

// Draws <script> of the style folder into a file; `variables` are name=value and reach the script as strings. If
// gnuplot is not installed nothing is drawn, which draw.sh prints. Throws std::runtime_error when the drawing fails.
void draw(const std::filesystem::path& style_folder, const std::string& script, const std::filesystem::path& out,
          const std::vector<std::string>& variables);

// A file of each subfolder that has one, by the subfolder's name, in the order of names; empty without the folder.
struct OfSubfolder {
  std::string name;
  std::filesystem::path file;
};
std::vector<OfSubfolder> in_subfolders(const std::filesystem::path& folder, const std::string& file);

}  // namespace voussoir::reports
