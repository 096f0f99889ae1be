#include "verification/architecture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <regex>
#include <set>

#include "verification/verdict_file.hpp"

namespace voussoir::verification {
namespace {

namespace fs = std::filesystem;

constexpr int longest_file = 500;  // lines; a longer one holds two ideas
constexpr int one_screen = 60;     // lines of core/step.cpp: the whole method at a glance

constexpr std::array top_folders{"text",  "core",       "app",     "reference", "verification",
                                 "cases", "benchmarks", "reports", "fuzz"};

// from the ground up; a room may include the rooms of the lines above its own
const std::vector<std::vector<std::string>> layers{
    {"geometry", "settings", "accuracy", "energy", "floating_point_traps", "on_threads"},
    {"law", "exchange"},
    {"optimise", "load", "support"},
    {"contact", "slicing", "joint_sets", "model"},
    {"state", "limit"},
    {"prepared"},
    {"results", "scene"},
    {"motion", "monitor", "output"},
    {"step", "state_hash"},
    {"run"},
    {"reduction"},
    {"progress"},
    {"checkpoint", "simulate"},
};

// what another folder of the house may include besides itself, folders or single files; core is ordered by its layers
struct Reach {
  std::string_view folder;
  std::vector<std::string_view> may_include;
};
const std::vector<Reach> reaches{
    {"text", {}},
    {"core", {"text"}},
    {"reference", {}},
    {"verification", {"text"}},
    {"app", {"core", "text"}},
    {"cases", {"core", "app", "reference", "verification"}},
    {"benchmarks", {"core", "app"}},
    {"reports",
     {"verification", "text", "core/accuracy.hpp"}},  // what the accuracy levels promise, which reports judge
    {"fuzz", {"core", "app", "text"}},
};

std::string top_folder(std::string_view path) {
  return std::string(path.substr(0, path.find('/')));
}

bool is_ours(std::string_view path) {
  return path.find('/') != std::string_view::npos &&
         std::find(top_folders.begin(), top_folders.end(), top_folder(path)) != top_folders.end();
}

// core/contact/overlap.hpp -> contact, core/step.cpp -> step, core/run_test.cpp -> run
std::string room_of(std::string_view path) {
  std::string_view rest = path.substr(path.find('/') + 1);
  if (const auto slash = rest.find('/'); slash != std::string_view::npos) return std::string(rest.substr(0, slash));
  std::string stem(rest.substr(0, rest.find('.')));
  if (stem.ends_with("_test")) stem.resize(stem.size() - 5);
  return stem;
}

std::optional<std::size_t> layer_of(const std::string& room) {
  for (std::size_t i = 0; i < layers.size(); ++i)
    if (std::find(layers[i].begin(), layers[i].end(), room) != layers[i].end()) return i;
  return std::nullopt;
}

// a test, and the shapes that tests share, may use any room of the core, but stay inside the house's order otherwise
bool is_test(std::string_view path) {
  return path.ends_with("_test.cpp") || path.ends_with("_test.hpp") || path.starts_with("core/testing/");
}

std::string judge_rooms(const std::string& from_path, const std::string& to_path) {
  const std::string from = room_of(from_path), to = room_of(to_path);
  if (from == to || is_test(from_path)) return {};
  const auto from_layer = layer_of(from), to_layer = layer_of(to);
  if (!from_layer || !to_layer) return {};  // reported once, as an unknown room
  if (from == "output" && to == "scene") return "output and scene do not know each other";
  if (*to_layer < *from_layer) return {};
  return *to_layer == *from_layer ? fmt::format("{} and {} are rooms of the same floor", from, to)
                                  : fmt::format("{} lies above {}", to, from);
}

std::string judge_folders(const std::string& from, const std::string& to_path) {
  const std::string to = top_folder(to_path);
  if (from == to) return {};
  const auto reach = std::find_if(reaches.begin(), reaches.end(), [&](const Reach& r) { return r.folder == from; });
  if (reach != reaches.end() && std::any_of(reach->may_include.begin(), reach->may_include.end(),
                                            [&](std::string_view may) { return may == to || may == to_path; }))
    return {};
  return fmt::format("{} must not know {}", from, to);
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
  std::set<std::string> unknown_rooms;
  const auto check_room = [&](const std::string& path) {
    if (top_folder(path) == "core" && room_of(path) != "testing" && !layer_of(room_of(path)) &&
        unknown_rooms.insert(room_of(path)).second)
      found.push_back(fmt::format("core/{} has no floor: give it one in verification/architecture.cpp", room_of(path)));
  };

  for (const SourceFile& source : sources) {
    check_room(source.path);
    for (const std::string& path : source.includes) {
      if (path.starts_with("./") || path.starts_with("../"))
        found.push_back(fmt::format("{} includes {}: write the path from the repository's root", source.path, path));
      if (!is_ours(path)) continue;
      check_room(path);
      const std::string from = top_folder(source.path);
      std::string problem = judge_folders(from, path);
      if (problem.empty() && from == "core") problem = judge_rooms(source.path, path);
      if (!problem.empty()) found.push_back(fmt::format("{} includes {}: {}", source.path, path, problem));
    }

    const int limit = source.path == "core/step.cpp" ? one_screen : longest_file;
    if (source.lines > limit)
      found.push_back(fmt::format("{} has {} lines, more than {}", source.path, source.lines, limit));
  }
  return found;
}

}  // namespace voussoir::verification
