#include "verification/architecture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

#include "verification/verdict_file.hpp"

namespace voussoir::verification {
namespace {

namespace fs = std::filesystem;

constexpr int longest_file = 500;  // lines; a longer one holds two ideas
constexpr int one_screen = 60;     // lines of core/step.cpp: the whole method at a glance

constexpr std::array top_folders{"text",       "core",    "app",  "reference", "verification", "cases",
                                 "benchmarks", "reports", "fuzz", "python",    "library"};

// the header that users of the library include
constexpr std::string_view entry_of_users = "library/voussoir.hpp";

// The rooms of the core from the ground up: a room may include those of the lines before its own. Files within a room
// need no line: there, as everywhere, only circles are refused. So contact, joint_laws, load and support do not know
// Model or State, and output and scene do not know each other.
const std::vector<std::vector<std::string_view>> floors{
    {"base/", "geometry/"},
    {"exchange/", "joint_laws/", "joint_sets/", "load/", "potential/", "solvers/"},
    {"contact/", "probability/", "slicing/", "support/"},
    {"model/"},
    {"key_blocks/", "stage/"},
    {"limit/", "output/", "scene/", "step/"},
    {"implicit/"},
    {"step"},  // step.hpp and step.cpp: one screen
    {"run/"},
    {"modes/"},
};

// the files and folders that another folder of the repository may include besides itself: top folders, folders within
// them (ending in /), single files. The longest folder that holds a file counts: a room may have more than its folder.
struct Reach {
  std::string_view folder;
  std::vector<std::string_view> may_include;
};
const std::vector<Reach> reaches{
    {"text", {}},
    {"core", {"text"}},
    {"reference", {"text/angle.hpp"}},
    {"verification", {"text"}},
    {"verification/problems", {"core", "text"}},  // a sliced rock mass
    {"app", {"core", "text", "verification/comparison/"}},
    {"cases", {"core", "app", "reference", "verification", "text"}},
    {"benchmarks", {"core", "app", "text"}},
    {"reports",
     {"verification", "text", "core/base/accuracy.hpp"}},  // the promises of the accuracy levels, which reports judge
    {"fuzz", {"core", "app", "text"}},
    {"python", {"core", "text"}},
    {"library", {"core", "text"}},
};

std::string top_folder(std::string_view path) {
  return std::string(path.substr(0, path.find('/')));
}

bool is_ours(std::string_view path) {
  return path.find('/') != std::string_view::npos &&
         std::find(top_folders.begin(), top_folders.end(), top_folder(path)) != top_folders.end();
}

// a member of a folder: a folder in it, or a header with its source. core/contact/pair.hpp -> contact/ in core, pair in
// core/contact
std::string_view name_in(std::string_view folder, std::string_view path) {
  const std::string_view rest = path.substr(folder.empty() ? 0 : folder.size() + 1);
  const std::size_t end = rest.find_first_of("/.");
  return rest.substr(0, end + (end < rest.size() && rest[end] == '/'));
}

std::string_view folder_of(std::string_view path) {
  return path.substr(0, path.rfind('/'));
}

// the innermost folder that holds both; empty: the repository's root
std::string common_folder(std::string_view a, std::string_view b) {
  std::string folder(folder_of(a));
  while (!folder.empty() && !b.starts_with(folder + '/'))
    folder = folder.find('/') == std::string::npos ? "" : std::string(folder_of(folder));
  return folder;
}

// empty: the room has no line
std::optional<std::size_t> floor_of(std::string_view room) {
  for (std::size_t i = 0; i < floors.size(); ++i)
    if (std::ranges::find(floors[i], room) != floors[i].end()) return i;
  return std::nullopt;
}

// a test, and the shapes that tests share, may use all of the core, but otherwise keep the order of folders
bool is_test(std::string_view path) {
  return path.ends_with("_test.cpp") || path.ends_with("_test.hpp") || path.starts_with("core/testing/");
}

// both files are in the core
std::string judge_floors(const std::string& from_path, const std::string& to_path) {
  if (is_test(from_path)) return {};
  if (is_test(to_path)) return "only tests may include it";
  const std::string_view from = name_in("core", from_path), to = name_in("core", to_path);
  const auto from_floor = floor_of(from), to_floor = floor_of(to);
  if (from == to || !from_floor || !to_floor || *to_floor < *from_floor)
    return {};  // a room without a line is reported once
  return *to_floor == *from_floor ? fmt::format("core/{} and core/{} are on one floor", from, to)
                                  : fmt::format("core/{} is above core/{}", to, from);
}

std::string judge_folders(const std::string& from_path, const std::string& to_path) {
  const std::string from = top_folder(from_path), to = top_folder(to_path);
  if (from == to) return {};
  const Reach* reach = nullptr;
  for (const Reach& r : reaches)
    if (from_path.starts_with(std::string(r.folder) + '/') && (!reach || r.folder.size() > reach->folder.size()))
      reach = &r;
  const auto allows = [&](std::string_view may) {
    return may == to || may == to_path || (may.ends_with('/') && to_path.starts_with(may));
  };
  if (reach && std::ranges::any_of(reach->may_include, allows)) return {};
  return fmt::format("{} must not know {}", from, to);
}

// each case is a program of its own
bool in_one_program(const std::string& a, const std::string& b) {
  const auto case_of = [](const std::string& path) { return top_folder(path) == "cases" ? folder_of(path) : ""; };
  return case_of(a).empty() || case_of(b).empty() || case_of(a) == case_of(b);
}

// The members of a folder and who includes whom there, with one #include for each arrow.
struct FolderGraph {
  std::map<std::string, std::map<std::string, std::string>> arrows;

  // the shortest circle through a name, as one sentence; empty: none
  std::string circle_through(const std::string& start) const {
    std::map<std::string, std::string> from;  // the predecessor of each
    std::vector<std::string> reached{start};
    for (std::size_t k = 0; k < reached.size(); ++k) {
      const auto out = arrows.find(reached[k]);
      if (out == arrows.end()) continue;
      for (const auto& [to, include] : out->second) {
        if (to == start) return sentence(start, reached[k], from);
        if (from.emplace(to, reached[k]).second) reached.push_back(to);
      }
    }
    return {};
  }

 private:
  std::string sentence(const std::string& start, std::string last,
                       const std::map<std::string, std::string>& from) const {
    std::string text = arrows.at(last).at(start);
    for (; last != start; last = from.at(last))
      text = arrows.at(from.at(last)).at(last) + ", " + text;
    return text;
  }
};

// circles of files and folders in any folder of the repository, each reported once; tests may include any file
void check_circles(const std::vector<SourceFile>& sources, std::vector<std::string>& found) {
  std::map<std::string, FolderGraph> graphs;
  for (const SourceFile& source : sources) {
    if (is_test(source.path)) continue;
    for (const std::string& path : source.includes) {
      if (!is_ours(path) || path.starts_with('.')) continue;
      const std::string folder = common_folder(source.path, path);
      const std::string from(name_in(folder, source.path)), to(name_in(folder, path));
      if (from != to) graphs[folder].arrows[from].emplace(to, source.path + " includes " + path);
    }
  }
  for (const auto& [folder, graph] : graphs) {
    std::set<std::string> reported;
    for (const auto& [name, out] : graph.arrows) {
      const std::string circle = graph.circle_through(name);
      if (circle.empty() || reported.contains(name)) continue;
      found.push_back(fmt::format("a circle in {}: {}", folder.empty() ? "the repository" : folder, circle));
      for (const auto& [other, unused] : graph.arrows)
        if (circle.find('/' + other + (other.ends_with('/') ? "" : ".")) != std::string::npos) reported.insert(other);
    }
  }
}

void check_types(const std::vector<SourceFile>& sources, std::vector<std::string>& found) {
  std::multimap<std::string, std::string> places;
  for (const SourceFile& source : sources)
    for (const std::string& type : std::set<std::string>(source.types.begin(), source.types.end())) {
      const auto [first, last] = places.equal_range(type);
      for (auto other = first; other != last; ++other)
        if (in_one_program(other->second, source.path))
          found.push_back(fmt::format("{} and {} both define {}: one program may contain both, rename one",
                                      other->second, source.path, type));
      places.emplace(type, source.path);
    }
}

}  // namespace

std::vector<std::string> include_paths(std::string_view text) {
  static const std::regex line(R"(^[ \t]*#[ \t]*include[ \t]*["<]([^">]+)[">])", std::regex::multiline);
  std::vector<std::string> paths;
  using Iterator = std::regex_iterator<std::string_view::const_iterator>;
  for (Iterator match(text.begin(), text.end(), line), end; match != end; ++match)
    paths.push_back((*match)[1].str());
  return paths;
}

std::vector<std::string> type_names(std::string_view text) {
  static const std::regex silent(R"re(//.*|"(\\.|[^"\\])*"|'\{'|'\}')re");
  static const std::regex space(R"(^\s*(?:inline )?namespace\s*([\w:]*)\s*\{)");
  static const std::regex type(
      R"(^(?:template\s*<.*>\s*)?(?:struct|class|enum(?: class)?)\s+(?:alignas\(.*\)\s*)?(\w+)\b[^;]*(?:\{.*)?$)");
  std::vector<std::string> found;
  std::vector<std::pair<long, std::string>> spaces;  // that are open: braces before them, name
  long open = 0;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    // regular expressions are slow: they see only lines that have a part of what they look for
    if (line.find_first_of("/\"'") != std::string::npos) line = std::regex_replace(line, silent, "");
    std::smatch match;
    if (line.find("namespace") != std::string::npos && std::regex_search(line, match, space))
      spaces.emplace_back(open, match[1]);
    const bool named = std::ranges::none_of(spaces, [](const auto& one) { return one.second.empty(); });
    const auto has = [&](const char* word) { return line.find(word) != std::string::npos; };
    const bool may_state_type = has("struct") || has("class") || has("enum");
    if (may_state_type && named && open == std::ssize(spaces) && std::regex_search(line, match, type)) {
      std::string name;
      for (const auto& [before, part] : spaces)
        name += part + "::";
      found.push_back(name + match[1].str());
    }
    open += std::ranges::count(line, '{') - std::ranges::count(line, '}');
    while (!spaces.empty() && open <= spaces.back().first)
      spaces.pop_back();
  }
  return found;
}

std::vector<SourceFile> read_sources(const fs::path& root) {
  std::vector<SourceFile> sources;
  for (const char* folder : top_folders) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path extension = entry.path().extension();
      if (!entry.is_regular_file() || (extension != ".hpp" && extension != ".cpp")) continue;
      const std::string text = read_text(entry.path());
      SourceFile source{entry.path().lexically_relative(root).generic_string(), {}, 0};
      source.lines = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
      source.types = type_names(text);
      for (std::string& path : include_paths(text)) {
        // written relative to the file, it would escape the rules below
        const fs::path beside = entry.path().parent_path() / path;
        if (!is_ours(path) && fs::exists(beside)) path = "./" + path;
        source.includes.push_back(std::move(path));
      }
      sources.push_back(std::move(source));
    }
  }
  std::sort(sources.begin(), sources.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return sources;
}

std::vector<std::string> violations(const std::vector<SourceFile>& sources) {
  std::vector<std::string> found;
  std::set<std::string> unknown;
  const auto check_room = [&](const std::string& path) {
    if (top_folder(path) != "core" || is_test(path)) return;
    const std::string room(name_in("core", path));
    if (!floor_of(room) && unknown.insert(room).second)
      found.push_back(fmt::format("core/{} has no floor: give it one in verification/architecture.cpp", room));
  };

  for (const SourceFile& source : sources) {
    check_room(source.path);
    for (const std::string& path : source.includes) {
      if (path.starts_with("./") || path.starts_with("../"))
        found.push_back(fmt::format("{} includes {}: write the path from the repository's root", source.path, path));
      if (!is_ours(path)) continue;
      check_room(path);
      const std::string from = top_folder(source.path);
      std::string problem = judge_folders(source.path, path);
      if (problem.empty() && from == "core" && top_folder(path) == "core") problem = judge_floors(source.path, path);
      if (!problem.empty()) found.push_back(fmt::format("{} includes {}: {}", source.path, path, problem));
    }

    const int limit = source.path == "core/step.cpp" ? one_screen : longest_file;
    if (source.lines > limit)
      found.push_back(fmt::format("{} has {} lines, more than {}", source.path, source.lines, limit));
  }
  check_circles(sources, found);
  check_types(sources, found);
  return found;
}

std::vector<std::string> unused_files(const std::vector<SourceFile>& sources, const std::set<std::string>& built) {
  std::set<std::string> included;
  for (const SourceFile& source : sources)
    for (const std::string& path : source.includes)
      if (path != source.path) included.insert(path);
  std::vector<std::string> unused;
  for (const SourceFile& source : sources)
    if (source.path.ends_with(".cpp") ? !built.contains(source.path)
                                      : !included.contains(source.path) && source.path != entry_of_users)
      unused.push_back(source.path +
                       (source.path.ends_with(".cpp") ? " is in no target of CMake" : " is included by no file"));
  return unused;
}

std::vector<std::string> cited_paths(std::string_view text) {
  static const std::regex quoted(R"re("(\\.|[^"\\])*")re"), comment(R"(//(.*))");
  static const std::regex path(R"((?:^|[\s(`',;:])((?:[\w-]+/)*[\w-]+(?:\.\w+)*))");
  static const std::regex file_name(R"(.*\.(md|hpp|cpp))");
  std::vector<std::string> cited;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    if (line.find("//") == std::string::npos) continue;
    line = std::regex_replace(line, quoted, "");
    std::smatch match;
    if (!std::regex_search(line, match, comment)) continue;
    const std::string words = match[1].str();
    for (std::sregex_iterator word(words.begin(), words.end(), path), end; word != end; ++word) {
      const std::string name = (*word)[1].str();
      const bool in_house =
          name.find('/') != std::string::npos && std::ranges::find(top_folders, top_folder(name)) != top_folders.end();
      if (in_house || std::regex_match(name, file_name)) cited.push_back(name);
    }
  }
  return cited;
}

std::vector<std::string> dead_citations(const fs::path& root) {
  static const std::set<std::string> written{"openings_draws.md"};  // by programs
  std::set<std::string> names;
  std::vector<fs::path> sources;
  for (const char* folder : top_folders) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (!entry.is_regular_file()) continue;
      names.insert(entry.path().filename().string());
      const fs::path extension = entry.path().extension();
      if (extension == ".hpp" || extension == ".cpp") sources.push_back(entry.path());
    }
  }
  const auto is_there = [](const fs::path& path) {
    return fs::exists(path) || fs::exists(path.string() + ".hpp") || fs::exists(path.string() + ".cpp");
  };
  std::ranges::sort(sources);
  std::vector<std::string> dead;
  for (const fs::path& source : sources) {
    const std::string from = source.lexically_relative(root).generic_string();
    for (const std::string& name : cited_paths(read_text(source))) {
      const bool alone = name.find('/') == std::string::npos;
      if (written.contains(name) || (alone && names.contains(name)) || is_there(root / name) ||
          is_there(source.parent_path() / name) || is_there(root / "core" / name) ||
          is_there(root / top_folder(from) / name))
        continue;
      dead.push_back(fmt::format("{} cites {}, which does not exist", from, name));
    }
  }
  return dead;
}

std::vector<std::string> rooms_without_file(const std::vector<SourceFile>& sources) {
  std::vector<std::string> names;
  for (const auto& line : floors)
    for (const std::string_view room : line)
      if (std::ranges::none_of(sources, [&](const SourceFile& source) {
            return top_folder(source.path) == "core" && name_in("core", source.path) == room;
          }))
        names.push_back(fmt::format("core/{}", room));
  return names;
}

}  // namespace voussoir::verification
