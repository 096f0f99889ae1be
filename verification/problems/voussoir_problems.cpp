// voussoir_problems OUT [--blind] [--verdicts FOLDER] [--program FILE] [--only NAME]
// Writes the problems for any code: OUT/<name>/ with the task, sketch.svg, blocks.json, blocks.obj, scene.toml, a data
// file for UDEC (plane) or 3DEC (space), answer.csv and, unless --blind, reference.json; and OUT/blocks.schema.json.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "verification/problems/problems.hpp"
#include "verification/problems/references.hpp"
#include "verification/problems/write_geometry.hpp"
#include "verification/problems/write_json.hpp"
#include "verification/problems/write_programs.hpp"
#include "verification/problems/write_text.hpp"
#include "verification/verdict_file.hpp"

namespace voussoir::problems {
namespace {

namespace fs = std::filesystem;

constexpr const char* usage =
    "usage: voussoir_problems OUT [--blind] [--verdicts FOLDER] [--program FILE] [--only NAME]\n"
    "  --blind            leave out reference.json\n"
    "  --verdicts FOLDER  rows that the cases' tests wrote (default: those of this build)\n"
    "  --program FILE     voussoir, which writes blocks and joints for 3DEC (default: that of this build)\n"
    "  --only NAME        one problem\n";

struct Arguments {
  fs::path out, verdicts = VOUSSOIR_VERDICT_FOLDER, program = VOUSSOIR_PROGRAM;
  bool blind = false;
  std::string only;
};

std::optional<Arguments> read_arguments(int count, char** list) {
  Arguments arguments;
  for (int k = 1; k < count; ++k) {
    const std::string word = list[k];
    const bool takes_value = word == "--verdicts" || word == "--program" || word == "--only";
    if (takes_value && k + 1 == count) return std::nullopt;
    if (word == "--blind")
      arguments.blind = true;
    else if (word == "--verdicts")
      arguments.verdicts = list[++k];
    else if (word == "--program")
      arguments.program = list[++k];
    else if (word == "--only")
      arguments.only = list[++k];
    else if (word.starts_with("-") || !arguments.out.empty())
      return std::nullopt;
    else
      arguments.out = word;
  }
  if (arguments.out.empty()) return std::nullopt;
  return arguments;
}

std::string quoted(const fs::path& path) {
  std::string text = "'";
  for (const char c : path.string())
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

// blocks and joints as `voussoir export` writes them, stages as the problem has them
void write_three_dec(const Problem& problem, const fs::path& folder, const fs::path& program) {
  const fs::path file = folder / (problem.name + ".3dec");
  const std::string command = fmt::format("{} export {} --as 3dec --out {} --overwrite > /dev/null", quoted(program),
                                          quoted(folder / "scene.toml"), quoted(file));
  if (std::system(command.c_str()) != 0)
    throw std::runtime_error(fmt::format("failed: {}\n  build voussoir, or name it with --program", command));
  verification::write_atomically(file, verification::read_text(file) + three_dec_stages(problem));
}

void write_problem(const Problem& problem, const Arguments& arguments) {
  using verification::write_atomically;
  const fs::path folder = arguments.out / problem.name;
  fs::create_directories(folder);
  write_atomically(folder / "task.md", task_text(problem));
  write_atomically(folder / "sketch.svg", sketch_svg(problem));
  write_atomically(folder / "blocks.json", blocks_json(problem).dump(1) + "\n");
  write_atomically(folder / "blocks.obj", blocks_obj(problem));
  write_atomically(folder / "scene.toml", scene_text(problem));
  if (problem.dimension == 2)
    write_atomically(folder / (problem.name + ".udec"), udec_text(problem));
  else
    write_three_dec(problem, folder, arguments.program);
  // an answer that somebody filled in is kept
  if (!fs::exists(folder / "answer.csv")) write_atomically(folder / "answer.csv", answer_text(problem));
  if (arguments.blind)
    fs::remove(folder / "reference.json");
  else
    write_atomically(folder / "reference.json", reference_json(problem, arguments.verdicts).dump(1) + "\n");
}

int write_all(const Arguments& arguments) {
  fs::create_directories(arguments.out);
  fs::copy_file(VOUSSOIR_SOURCE_DIR "/verification/problems/blocks.schema.json", arguments.out / "blocks.schema.json",
                fs::copy_options::overwrite_existing);
  int written = 0;
  for (const Problem& problem : all_problems()) {
    if (!arguments.only.empty() && arguments.only != problem.name) continue;
    write_problem(problem, arguments);
    fmt::print("{:<16} {:>4} blocks, {} asked: {}\n", problem.name, problem.blocks.size(), problem.asked.size(),
               (arguments.out / problem.name).string());
    ++written;
  }
  if (written == 0) {
    fmt::print(stderr, "voussoir_problems: no problem '{}'\n", arguments.only);
    return 2;
  }
  fmt::print("{} problems in {}{}\n", written, arguments.out.string(), arguments.blind ? ", without references" : "");
  return 0;
}

}  // namespace
}  // namespace voussoir::problems

int main(int count, char** list) {
  using namespace voussoir::problems;
  const auto arguments = read_arguments(count, list);
  if (!arguments) {
    std::fputs(usage, stderr);
    return 2;
  }
  try {
    return write_all(*arguments);
  } catch (const std::exception& problem) {
    fmt::print(stderr, "voussoir_problems: {}\n", problem.what());
    return 2;
  }
}
