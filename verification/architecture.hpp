#pragma once
// Who may include whom. The order of the rooms stands here once and is enforced by unit.architecture.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace voussoir::verification {

// One source file: its path from the repository's root and the paths it includes that lie inside the repository.
struct SourceFile {
  std::string path;
  std::vector<std::string> includes;
  int lines = 0;
};

// The paths between "…" or <…> of every #include line.
std::vector<std::string> include_paths(std::string_view text);

// All .hpp and .cpp files below the project's folders, sorted by path.
std::vector<SourceFile> read_sources(const std::filesystem::path& root);

// One sentence per violation: an arrow that runs back up or across, an unknown room, a file that is too long.
std::vector<std::string> violations(const std::vector<SourceFile>& sources);

}  // namespace voussoir::verification
