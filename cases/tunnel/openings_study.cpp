// tunnel_openings_study: several draws of the 24 openings of Boon (2013), table 5.1, each excavated in a process of its
// own, as many at a time as requested. Completed rows are kept; a row of other blocks or of another program is
// repeated.
//
//   tunnel_openings_study FOLDER [--draws 5] [--jobs 2]    FOLDER/openings_draws.csv, openings_draws.md
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>

#include "app/base/message.hpp"
#include "app/run_folder/child_process.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "cases/tunnel/draws.hpp"
#include "core/base/fingerprint.hpp"
#include "core/output/atomic_file.hpp"
#include "text/read_file.hpp"

namespace {

namespace fs = std::filesystem;
using namespace voussoir;
using namespace voussoir::cases;

constexpr std::uintmax_t largest_row = 1 << 20;              // bytes
constexpr std::chrono::milliseconds time_between_looks{50};  // short compared with a row's seconds

struct Asked {
  fs::path folder;
  int draws = 5, jobs = 1;
  double seconds = 0.5;      // of motion
  int number = 0, draw = 0;  // of the one row of a child process; 0: all
};

fs::path file_of(const Asked& asked, int number, int draw) {
  return asked.folder / "rows" / fmt::format("{}_{}.csv", number, draw);
}

std::optional<DrawRow> kept_row(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  const std::vector<DrawRow> rows = read_draws(read_file(file, largest_row));
  return rows.size() == 1 ? std::optional(rows.front()) : std::nullopt;
}

void do_row(const Asked& asked) {
  const OpeningRow& row = opening_rows().at(asked.number - 1);
  const LoadedScene scene = opening_scene(row, asked.draw, asked.seconds);
  const std::string inputs = fingerprint(scene.hash + program_digest());
  const fs::path file = file_of(asked, asked.number, asked.draw);
  const std::optional<DrawRow> kept = kept_row(file);
  if (kept && kept->inputs == inputs) return;
  remove_file(file);  // no older row may count as one of these inputs
  write_file(file, draws_csv({draw_row(dig(row, scene), asked.draw, inputs)}));
}

// rows completed so far
void write_tables(const Asked& asked) {
  std::vector<DrawRow> rows;
  for (const OpeningRow& row : opening_rows())
    for (int draw = 0; draw < asked.draws; ++draw)
      if (const std::optional<DrawRow> kept = kept_row(file_of(asked, row.number, draw))) rows.push_back(*kept);
  write_file(asked.folder / "openings_draws.csv", draws_csv(rows));
  write_file(asked.folder / "openings_draws.md", agreement_table(rows));
}

struct Child {
  int number, draw;
  std::unique_ptr<ChildProcess> process;
};

// true: it has ended
bool look_after(const Asked& asked, const Child& child, int& failed) {
  const std::optional<ChildEnd> end = child.process->ended();
  if (!end) return false;
  if (end->code != 0) {
    ++failed;
    tell("opening {}, draw {}: no row (exit code {}, signal {}; messages beside it)", child.number, child.draw,
         end->code, end->signal);
  }
  write_tables(asked);
  return true;
}

// draw by draw, so that all openings have about the same number of draws when time runs out; returns how many failed
int do_all(const Asked& asked) {
  std::vector<Child> active;
  int failed = 0;
  const auto wait_until = [&](std::size_t left) {
    while (active.size() > left) {
      std::erase_if(active, [&](const Child& child) { return look_after(asked, child, failed); });
      std::this_thread::sleep_for(time_between_looks);
    }
  };
  for (int draw = 0; draw < asked.draws; ++draw)
    for (const OpeningRow& row : opening_rows()) {
      wait_until(asked.jobs - 1);
      const std::vector<std::string> arguments{
          asked.folder.string(), "--row",     std::to_string(row.number),      "--draw",
          std::to_string(draw),  "--seconds", fmt::format("{}", asked.seconds)};
      const fs::path messages = file_of(asked, row.number, draw).replace_extension(".txt");
      active.push_back({row.number, draw, std::make_unique<ChildProcess>(arguments, messages)});
    }
  wait_until(0);
  return failed;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Several draws of the 24 openings of Boon (2013), table 5.1."};
  Asked asked;
  app.add_option("folder", asked.folder, "folder of rows and tables")->required();
  app.add_option("--draws", asked.draws, "of each opening")->check(CLI::Range(1, 1000));
  app.add_option("--jobs", asked.jobs, "openings at the same time")->check(CLI::Range(1, 1000));
  app.add_option("--seconds", asked.seconds, "of motion after the excavation")->check(CLI::PositiveNumber);
  app.add_option("--row", asked.number, "only this opening")->check(CLI::Range(1, 24));
  app.add_option("--draw", asked.draw, "of it")->check(CLI::NonNegativeNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    if (asked.number > 0) {
      do_row(asked);
      return 0;
    }
    prepare_folder(asked.folder / "rows");
    const FolderLock lock(asked.folder);
    const int failed = do_all(asked);
    fmt::print("{}", read_file(asked.folder / "openings_draws.md", largest_row));
    return failed > 0;
  } catch (const std::exception& problem) {
    tell("tunnel_openings_study: {}", problem.what());
    return 1;
  }
}
