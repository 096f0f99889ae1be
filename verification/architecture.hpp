#pragma once
// Who may include whom: the order of the folders and of the rooms of the core is stated once, in architecture.cpp, and
// enforced by unit.architecture; all else follows from the #include lines: in no folder may files or folders include
// each other in a circle. And no two types of one program have one name: the linker would silently take the functions
// of either for both.
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace voussoir::verification {

// One source file: its path from the repository's root and the paths it includes that lie inside the repository.
struct SourceFile {
  std::string path;
  std::vector<std::string> includes;
  int lines = 0;
  std::vector<std::string> types = {};  // that it defines outside of unnamed namespaces, e.g. voussoir::cases::Trial
};

// The paths between "…" or <…> of every #include line.
std::vector<std::string> include_paths(std::string_view text);

// The structs, classes and enums that a text defines in named namespaces or none; not those within them.
std::vector<std::string> type_names(std::string_view text);

// All .hpp and .cpp files below the project's folders, sorted by path.
std::vector<SourceFile> read_sources(const std::filesystem::path& root);

// One sentence per violation: an arrow that runs back up or across, a circle of files or folders, a room of the core
// without a floor, a file that is too long, a type that another file defines, too.
std::vector<std::string> violations(const std::vector<SourceFile>& sources);

// One sentence for each source that no target builds, by the paths of those that targets do, and each header that no
// file includes.
std::vector<std::string> unused_files(const std::vector<SourceFile>& sources, const std::set<std::string>& built);

// The files and folders that the comments of a text cite: paths from one of the repository's folders, with their
// extension or without, and names of pages and sources.
std::vector<std::string> cited_paths(std::string_view text);

// One sentence for each that does not exist below the root, beside the file that cites it, in its top folder or in the
// core, nor, if it is a name without folder, anywhere.
std::vector<std::string> dead_citations(const std::filesystem::path& root);

// Rooms that have a floor and no file: renamed or deleted since.
std::vector<std::string> rooms_without_file(const std::vector<SourceFile>& sources);

}  // namespace voussoir::verification
