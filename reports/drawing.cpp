#include "reports/drawing.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

namespace voussoir::reports {
namespace {

namespace fs = std::filesystem;

constexpr int not_installed = 77;  // exit code of draw.sh without gnuplot

// one word of a shell command, whatever characters it has
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char character : text)
    word += character == '\'' ? std::string("'\\''") : std::string(1, character);
  return word + "'";
}

}  // namespace

std::string as_words(const std::vector<std::string>& names) {
  std::string words;
  for (const std::string& name : names) {
    if (name.find('"') != std::string::npos)
      throw std::runtime_error(fmt::format("not drawn: the name {} has a double quote; remove it", name));
    words += fmt::format("{}\"{}\"", words.empty() ? "" : " ", name);
  }
  return words;
}

void draw(const fs::path& style_folder, const std::string& script, const fs::path& out,
          const std::vector<std::string>& variables) {
  std::string command = quoted((style_folder / "draw.sh").string());
  for (const std::string& word : {(style_folder / script).string(), out.string()})
    command += " " + quoted(word);
  for (const std::string& variable : variables)
    command += " " + quoted(variable);
  const int status = std::system(command.c_str());
  if (status != 0 && !(WIFEXITED(status) && WEXITSTATUS(status) == not_installed))
    throw std::runtime_error("not drawn: " + out.string());
}

std::vector<OfSubfolder> in_subfolders(const fs::path& folder, const std::string& file) {
  std::vector<OfSubfolder> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (fs::exists(entry.path() / file)) found.push_back({entry.path().filename().string(), entry.path() / file});
  std::sort(found.begin(), found.end(), [](const OfSubfolder& a, const OfSubfolder& b) { return a.name < b.name; });
  return found;
}

}  // namespace voussoir::reports
