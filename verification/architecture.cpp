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

constexpr std::array top_folders{"text",  "core",       "app",     "reference", "verification",
                                 "cases", "benchmarks", "reports", "fuzz",      "python"};

// What stands on what in a folder of the core, from the ground up: a line may include the lines before its own. A name
// is a folder, or a header with its source; a source without a header stands above the one that declares what it
// defines.
struct Order {
  std::string_view folder;
  std::vector<std::vector<std::string_view>> lines;
};
const std::vector<Order> orders{
    {"core",
     {{"geometry", "settings", "accuracy", "energy", "floating_point_traps", "on_threads"},
      {"law", "exchange"},
      {"optimise", "load", "support"},
      {"potential"},
      {"contact", "slicing", "joint_sets", "model"},
      {"waters", "excavation", "body_title"},
      {"apply", "state", "limit"},
      {"prepared"},
      {"results", "scene"},
      {"motion", "monitor", "output", "install", "cast_lining"},
      {"step", "state_hash", "bonded_contacts"},
      {"run", "take_out"},
      {"reduction", "settled"},
      {"progress", "history", "stable_state", "doubts"},
      {"checkpoint", "simulate", "snapshot", "begin"}}},
    {"core/geometry",
     {{"types"}, {"half_space"}, {"half_space_inl"}, {"facet_weights", "polytope", "surface"}, {"outline"}}},
    {"core/law",
     {{"joint_properties", "joint_state", "face_friction"}, {"elastic_coulomb"}, {"joint_law"}, {"joint_path"}}},
    {"core/exchange", {{"mesh", "tables"}, {"convex_corners"}}},
    {"core/optimise",
     {{"feasibility_program", "far_planes", "double_double", "symmetric_system", "glpk_environment", "block_matrix"},
      {"extended_precision_feasibility", "analytic_centre", "central_path", "block_factors"},
      {"feasibility", "block_solver", "weighted_centre"},
      {"solvers", "glpk", "ipopt"}}},
    {"core/support", {{"beam", "grout"}, {"bolt", "lining"}, {"grouted_bolt"}}},
    {"core/load", {{"load", "time_factor"}, {"boundary_stress", "water"}}},
    {"core/contact",
     {{"contact", "pair", "kernel_counters", "rounding", "carried_whole"},
      {"broad_phase", "thin_directions", "separation", "pair_geometry", "overlap_region", "bracketing",
       "extended_precision_overlap"},
      {"nearness", "sub_contacts", "face_integral", "region_integral", "sensitivity", "kernel", "reference_kernel"},
      {"narrow_phase", "pressed_face"},
      {"contact_between", "particles"}}},
    {"core/contact/kernel",
     {{"workspace", "packs_inl"},
      {"lanes_inl"},
      {"records_inl", "section_inl"},
      {"batch_inl"},
      {"warm_start_inl"},
      {"cold_start_inl", "central_inl"},
      {"kernel"}}},
    {"core/potential",
     {{"rounding"},
      {"shape"},
      {"descent", "surface", "first_point"},
      {"support", "contact"},
      {"mass", "valid_shape", "drawing", "ipopt"},
      {"particle"}}},
    {"core/slicing", {{"block", "joint"}, {"clump", "slice"}}},
    {"core/joint_sets", {{"portable_math"}, {"random_stream"}, {"joint_set"}, {"statistics"}}},
    {"core/limit", {{"interfaces", "linear_program"}, {"glpk_program", "self_stress"}, {"limit"}, {"mechanism"}}},
    {"core/scene",
     {{"scene_error"},
      {"node"},
      {"key_row", "effective_scene"},
      {"scene_text", "scene_spec"},
      {"keys", "toml_text", "accuracy_target"},
      {"check_keys"},
      {"accuracy_level", "overrides", "scene_files", "read_plane", "particles"},
      {"bodies"},
      {"base_scene", "plausibility", "joint_outline", "region", "read_slicing", "read_water", "wet_faces", "bolts",
       "stated_bodies"},
      {"joint_ends"},
      {"divided_strength", "domain_blocks", "draw_joint_sets", "linings", "read_joint_sets", "read_stages",
       "shared_stages", "stage_excavations", "wall_points", "moved_tables"},
      {"repeat", "scene"},
      {"canonical_text", "documentation", "prepare", "read_scene"}}},
    {"core/scene/keys",
     {{"ranges", "members"},
      {"tables"},
      {"accuracy",     "bolts",       "blocks",           "contact",    "copies",  "damping",
       "domain",       "excavations", "joint_properties", "joint_sets", "joints",  "linings",
       "monitors",     "move",        "output",           "selectors",  "slicing", "stage",
       "stage_change", "stage_loads", "stage_reduce",     "stage_run",  "time",    "top",
       "water"}}},
    {"core/motion", {{"integrate", "time_step", "free_fall"}, {"work", "prescribed"}, {"relaxation"}}},
    {"core/step",
     {{"neighbours", "pair_motion", "bolt_forces", "lining_forces", "motion", "tangent", "newton_base"},
      {"contacts", "face_forces", "step_length", "loads"},
      {"joint_forces"},
      {"pair_stiffness", "water_stiffness"},
      {"newton"}}},
    {"core/output",
     {{"fingerprint", "version", "output_error", "vtp"},
      {"atomic_file", "origin"},
      {"history_csv", "bolts_csv", "lining_csv", "paraview", "results_json"},
      {"view"}}},
    {"core/reduction", {{"reduction"}}},
    {"core/checkpoint", {{"fields"}, {"checkpoint"}}},
};

// what another folder of the house may include besides itself, folders or single files
struct Reach {
  std::string_view folder;
  std::vector<std::string_view> may_include;
};
const std::vector<Reach> reaches{
    {"text", {}},
    {"core", {"text"}},
    {"reference", {"text/angle.hpp"}},
    {"verification", {"text"}},
    {"app", {"core", "text"}},
    {"cases", {"core", "app", "reference", "verification", "text"}},
    {"benchmarks", {"core", "app", "text"}},
    {"reports",
     {"verification", "text", "core/accuracy.hpp"}},  // what the accuracy levels promise, which reports judge
    {"fuzz", {"core", "app", "text"}},
    {"python", {"core", "text"}},
};

std::string top_folder(std::string_view path) {
  return std::string(path.substr(0, path.find('/')));
}

bool is_ours(std::string_view path) {
  return path.find('/') != std::string_view::npos &&
         std::find(top_folders.begin(), top_folders.end(), top_folder(path)) != top_folders.end();
}

// what the order of a folder calls a file in it: core/contact/pair.hpp -> contact in core, pair in core/contact
std::string_view name_in(std::string_view folder, std::string_view path) {
  const std::string_view rest = path.substr(folder.size() + 1);
  return rest.substr(0, rest.find_first_of("/."));
}

std::string_view folder_of(std::string_view path) {
  return path.substr(0, path.rfind('/'));
}

// the innermost folder that holds both
std::string_view common_folder(std::string_view a, std::string_view b) {
  std::string_view folder = folder_of(a);
  while (!b.starts_with(std::string(folder) + '/'))
    folder = folder_of(folder);
  return folder;
}

// nothing: the folder's order has no such name
std::optional<std::size_t> line_of(std::string_view folder, std::string_view name) {
  const auto order = std::find_if(orders.begin(), orders.end(), [&](const Order& o) { return o.folder == folder; });
  if (order == orders.end()) return std::nullopt;
  for (std::size_t i = 0; i < order->lines.size(); ++i)
    if (std::find(order->lines[i].begin(), order->lines[i].end(), name) != order->lines[i].end()) return i;
  return std::nullopt;
}

// a test, and the shapes that tests share, may use all of the core, but stay inside the house's order otherwise
bool is_test(std::string_view path) {
  return path.ends_with("_test.cpp") || path.ends_with("_test.hpp") || path.starts_with("core/testing/");
}

// both files lie in the core
std::string judge_order(const std::string& from_path, const std::string& to_path) {
  if (is_test(from_path)) return {};
  if (is_test(to_path)) return "only tests may include it";
  const std::string_view folder = common_folder(from_path, to_path);
  const std::string_view from = name_in(folder, from_path), to = name_in(folder, to_path);
  const auto from_line = line_of(folder, from), to_line = line_of(folder, to);
  if (from == to || !from_line || !to_line) return {};  // what has no line is reported once
  if (from == "output" && to == "scene") return "output and scene do not know each other";
  if (*to_line < *from_line) return {};
  return *to_line == *from_line ? fmt::format("{} and {} stand side by side in {}", from, to, folder)
                                : fmt::format("{} stands above {} in {}", to, from, folder);
}

// the names under which the orders of the core's folders know a file, with their folders
std::vector<std::pair<std::string, std::string>> places_of(const std::string& path) {
  std::vector<std::pair<std::string, std::string>> places;
  if (top_folder(path) != "core" || path.starts_with("core/testing/")) return places;
  for (std::size_t slash = path.find('/'); slash != std::string::npos; slash = path.find('/', slash + 1)) {
    const bool innermost = path.find('/', slash + 1) == std::string::npos;
    const std::string folder = path.substr(0, slash);
    if (!innermost || !is_test(path)) places.emplace_back(folder, name_in(folder, path));
  }
  return places;
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

// each case is a program of its own
bool in_one_program(const std::string& a, const std::string& b) {
  const auto case_of = [](const std::string& path) { return top_folder(path) == "cases" ? folder_of(path) : ""; };
  return case_of(a).empty() || case_of(b).empty() || case_of(a) == case_of(b);
}

void check_types(const std::vector<SourceFile>& sources, std::vector<std::string>& found) {
  std::multimap<std::string, std::string> places;
  for (const SourceFile& source : sources)
    for (const std::string& type : std::set<std::string>(source.types.begin(), source.types.end())) {
      const auto [first, last] = places.equal_range(type);
      for (auto other = first; other != last; ++other)
        if (in_one_program(other->second, source.path))
          found.push_back(fmt::format("{} and {} both define {}: one program may hold both, rename one", other->second,
                                      source.path, type));
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
    line = std::regex_replace(line, silent, "");
    std::smatch match;
    if (std::regex_search(line, match, space)) spaces.emplace_back(open, match[1]);
    const bool named = std::ranges::none_of(spaces, [](const auto& one) { return one.second.empty(); });
    if (named && open == std::ssize(spaces) && std::regex_search(line, match, type)) {
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
  std::set<std::pair<std::string, std::string>> unknown;
  const auto check_places = [&](const std::string& path) {
    for (const auto& [folder, name] : places_of(path))
      if (!line_of(folder, name) && unknown.emplace(folder, name).second)
        found.push_back(fmt::format("{}/{} has no line: give it one in verification/architecture.cpp", folder, name));
  };

  for (const SourceFile& source : sources) {
    check_places(source.path);
    for (const std::string& path : source.includes) {
      if (path.starts_with("./") || path.starts_with("../"))
        found.push_back(fmt::format("{} includes {}: write the path from the repository's root", source.path, path));
      if (!is_ours(path)) continue;
      check_places(path);
      const std::string from = top_folder(source.path);
      std::string problem = judge_folders(from, path);
      if (problem.empty() && from == "core" && top_folder(path) == "core") problem = judge_order(source.path, path);
      if (!problem.empty()) found.push_back(fmt::format("{} includes {}: {}", source.path, path, problem));
    }

    const int limit = source.path == "core/step.cpp" ? one_screen : longest_file;
    if (source.lines > limit)
      found.push_back(fmt::format("{} has {} lines, more than {}", source.path, source.lines, limit));
  }
  check_types(sources, found);
  return found;
}

std::vector<std::string> cited_paths(std::string_view text) {
  static const std::regex quoted(R"re("(\\.|[^"\\])*")re"), comment(R"(//(.*))");
  static const std::regex path(R"((?:^|[\s(`',;:])((?:[\w-]+/)*[\w-]+(?:\.\w+)*))");
  static const std::regex file_name(R"(.*\.(md|hpp|cpp))");
  std::vector<std::string> cited;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
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
  static const std::set<std::string> written{"report.md", "openings_draws.md"};  // by programs
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
      dead.push_back(fmt::format("{} cites {}, which is not there", from, name));
    }
  }
  return dead;
}

std::vector<std::string> names_without_file(const std::vector<SourceFile>& sources) {
  std::set<std::pair<std::string, std::string>> there;
  for (const SourceFile& source : sources)
    for (const auto& place : places_of(source.path))
      there.insert(place);
  std::vector<std::string> names;
  for (const Order& order : orders)
    for (const auto& line : order.lines)
      for (const std::string_view name : line)
        if (!there.contains({std::string(order.folder), std::string(name)}))
          names.push_back(fmt::format("{}/{}", order.folder, name));
  return names;
}

}  // namespace voussoir::verification
