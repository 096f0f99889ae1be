// `voussoir docs`: every key and column with its meaning, and the pages made of the parser.
#include <fmt/ranges.h>

#include "app/testing/program.hpp"

namespace voussoir::docs_test {
namespace {

using namespace program;

TEST_F(Program, DocsHoldEveryColumnOfTheHistoryWithItsMeaning) {
  const std::string docs = run("docs").out;
  ASSERT_EQ(run("run " + cubes_ + "--out out").code, 0);
  std::string header = lines_of(read(folder_ / "out/history.csv")).front();
  std::istringstream columns(header);
  for (std::string column; std::getline(columns, column, ',');) {
    // a monitor's name stands for `m`
    if (column.starts_with("top_")) column.replace(0, 3, "m");
    EXPECT_NE(docs.find("`" + column + "`"), std::string::npos) << column;
  }
  const std::size_t begin = docs.find("# history.csv");
  ASSERT_NE(begin, std::string::npos);
  for (const std::string& line : lines_of(docs.substr(begin)))
    EXPECT_EQ(line.find("|  |"), std::string::npos) << "a column without a meaning: " << line;
  for (const char* part : {"| `trial` |", "| `friction_rock_deg` |", "`m_normal_force_N`", "`m_mobilised_friction_deg`",
                           "`m_angular_velocity_x_rad_per_s`", "critical angles above 15 deg"})
    EXPECT_NE(docs.find(part), std::string::npos) << part;
}

TEST_F(Program, DocsHoldTheKeysOfStudies) {
  const std::string docs = run("docs").out;
  for (const char* row : {"| the top of the file | `quantity` |", "| history | `take` |", "| sweep | `values` |",
                          "| extrapolate | `power` |"})
    EXPECT_NE(docs.find(row), std::string::npos) << row;
}

// ---- the pages made of the parser -----------------------------------------------------------------------------------

struct Listed {
  std::string path;  // "", "run", …, "study run"
  std::vector<std::string> commands, options;
};

// a command and all below it, as help prints them, which the parser does by itself
class CommandPages : public Program {
 protected:
  std::vector<Listed> listed(const std::string& path = "") const {
    Listed own{path, {}, {}};
    bool among_commands = false;
    for (const std::string& line : lines_of(run(path + " --help").out)) {
      const bool indented = line.starts_with("  ") && !line.starts_with("   ");
      if (!indented) among_commands = line == "Subcommands:" || (among_commands && line.starts_with(" "));
      if (indented && among_commands) own.commands.push_back(line.substr(2, line.find(' ', 2) - 2));
      if (indented && line[2] == '-') {
        const std::size_t begin = line.find("--");
        own.options.push_back(line.substr(begin, line.find(' ', begin) - begin));
      }
    }
    std::vector<Listed> all{own};
    for (const std::string& command : own.commands)
      for (const Listed& below : listed(path.empty() ? command : path + " " + command))
        all.push_back(below);
    return all;
  }

  // what bash offers for the last of these words
  std::string completed(const std::string& words) const {
    return run("--version >/dev/null && bash -c '. <(\"$0\" docs --completion); COMP_WORDS=(" + words +
               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _voussoir; echo \"${COMPREPLY[@]}\"' " VOUSSOIR_PROGRAM)
        .out;
  }
};

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}\n", fmt::join(words, " "));
}

TEST_F(CommandPages, ManualHoldsAllThatHelpLists) {
  std::string page = run("docs --man").out;
  std::erase(page, '\\');
  const std::vector<Listed> all = listed();
  EXPECT_GE(all.size(), 14u);
  for (const auto& [path, commands, options] : all) {
    const std::size_t begin = path.empty() ? 0 : page.find(".SS voussoir " + path + " [");
    ASSERT_NE(begin, std::string::npos) << path;
    const std::string section =
        page.substr(begin, page.find(path.empty() ? ".SH COMMANDS" : "\n.S", begin + 1) - begin);
    EXPECT_GE(options.size(), 1u) << path;
    for (const std::string& option : options)
      EXPECT_NE(section.find("fB" + option + "fR"), std::string::npos) << path << ' ' << option;
  }
  for (const char* line : {"fB0fR\ndone", "fB8fR\nnot enough memory", "fB128fR + n\nended by signal n"})
    EXPECT_NE(page.find(line), std::string::npos) << line;
}

TEST_F(CommandPages, BashCompletesAllThatHelpLists) {
  for (const auto& [path, commands, options] : listed()) {
    EXPECT_EQ(completed("voussoir " + path + " --"), joined(options)) << path;
    if (commands.empty()) continue;
    EXPECT_EQ(completed("voussoir " + path + " \"\""), joined(commands)) << path;
  }
}

TEST_F(CommandPages, BashCompletesValuesFilesAndFolders) {
  write("slope.toml", "");
  fs::create_directories(folder_ / "slopes");
  EXPECT_EQ(completed("voussoir limit --load \"\""), "gravity applied left right east west north south up down\n");
  EXPECT_EQ(completed("voussoir limit --load = g"), "gravity\n") << "bash parts words at =";
  const std::string both = completed("voussoir run sl");  // in the order in which the file system lists them
  EXPECT_TRUE(both == "slope.toml slopes\n" || both == "slopes slope.toml\n") << both;
  EXPECT_EQ(completed("voussoir run slope.toml --out sl"), "slopes\n");
  EXPECT_EQ(completed("voussoir run slope.toml --threads \"\""), "\n") << "a number";
  EXPECT_EQ(completed("voussoir study --out run --o"), "--out --overwrite\n") << "run is a folder here, no command";
}

}  // namespace
}  // namespace voussoir::docs_test
