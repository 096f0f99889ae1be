#include "app/docs/command_pages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <vector>

#include "app/base/exit_codes.hpp"
#include "core/base/version.hpp"

namespace voussoir {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App* sub) { return !sub->get_name().empty(); });
}

std::vector<const CLI::Option*> arguments_of(const CLI::App& command, bool positional) {
  return command.get_options([=](const CLI::Option* option) { return option->nonpositional() != positional; });
}

// The parser writes a type as NAME, and with a check that describes itself as NAME:check.
struct Type {
  std::string name;     // empty: a flag
  std::string shown;    // the allowed values, as in the help text
  std::string choices;  // of a fixed list: its words, separated by blanks
};

Type type_of(const CLI::Option& option) {
  const std::string text = option.get_items_expected_max() == 0 ? "" : option.get_type_name();
  const std::size_t colon = text.find(':');
  Type type{text.substr(0, colon), colon == std::string::npos ? text : text.substr(colon + 1), ""};
  if (type.shown.starts_with('{') && type.shown.ends_with('}')) {
    type.choices = type.shown.substr(1, type.shown.size() - 2);
    type.shown = type.choices;
    for (std::size_t i = 0; (i = type.shown.find(',', i)) != std::string::npos;) {
      type.choices[i] = ' ';
      type.shown[i] = '|';
    }
  }
  return type;
}

// "study run" below "study" below "voussoir", whose own name is left out
std::string path_of(const std::string& above, const CLI::App& command) {
  return above.empty() ? command.get_name() : above + " " + command.get_name();
}

// ---- man ----------------------------------------------------------------------------------------------------------

// text that troff prints as it is
std::string plain(const std::string& text) {
  std::string escaped = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (const char c : text)
    escaped += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  return escaped;
}

std::string bold(const std::string& text) {
  return "\\fB" + plain(text) + "\\fR";
}

std::string italic(const std::string& text) {
  return "\\fI" + plain(text) + "\\fR";
}

std::string names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames())
    names.push_back(bold("-" + name));
  for (const std::string& name : option.get_lnames())
    names.push_back(bold("--" + name));
  return fmt::format("{}", fmt::join(names, ", "));
}

void describe_arguments(const CLI::App& command, std::string& page) {
  for (const CLI::Option* option : arguments_of(command, true))
    page += fmt::format(".TP\n{}\n{}\n", italic(option->get_name(true)), plain(option->get_description()));
  for (const CLI::Option* option : arguments_of(command, false)) {
    const std::string value = type_of(*option).shown;
    page += fmt::format(".TP\n{}{}\n{}\n", names_of(*option), value.empty() ? "" : " " + italic(value),
                        plain(option->get_description()));
  }
}

void describe_commands(const std::string& above, const CLI::App& command, std::string& page) {
  for (const CLI::App* sub : commands_of(command)) {
    const std::string path = path_of(above, *sub);
    page += fmt::format(".SS {} [OPTIONS]", plain("voussoir " + path));
    for (const CLI::Option* option : arguments_of(*sub, true))
      page += " " + italic(option->get_name(true)) + (option->get_items_expected_max() > 1 ? " ..." : "");
    page += fmt::format("\n{}\n", plain(sub->get_description()));
    describe_arguments(*sub, page);
    describe_commands(path, *sub, page);
  }
}

std::string exit_status() {
  std::string page = ".SH EXIT STATUS\n";
  for (const auto& [code, text] : exit_code_meanings)
    page += fmt::format(".TP\n{}\n{}\n", bold(std::to_string(static_cast<int>(code))), plain(text));
  return page + fmt::format(".TP\n{} + n\n{}\n", bold(std::to_string(static_cast<int>(ExitCode::signal))),
                            plain(ended_by_signal));
}

// ---- bash ---------------------------------------------------------------------------------------------------------

// in double quotes
std::string quoted(const std::string& text) {
  std::string escaped;
  for (const char c : text)
    escaped += std::string(c == '"' || c == '$' || c == '`' || c == '\\' ? "\\" : "") + c;
  return '"' + escaped + '"';
}

std::string expected_of(const CLI::Option& option) {
  const Type type = type_of(option);
  return !type.choices.empty() ? type.choices : type.name;
}

struct Tables {
  std::string options, commands, values, files;  // entries of bash's associative arrays, by the command's path
};

void tabulate(const std::string& path, const CLI::App& command, Tables& tables) {
  const auto add = [](std::string& table, const std::string& key, const std::string& entry) {
    if (!entry.empty()) table += fmt::format("    [{}]={}\n", quoted(key), quoted(entry));
  };
  std::vector<std::string> options, subs;
  for (const CLI::Option* option : arguments_of(command, false))
    for (const std::string& name : option->get_lnames()) {
      options.push_back("--" + name);
      add(tables.values, path + " --" + name, expected_of(*option));
    }
  for (const CLI::App* sub : commands_of(command))
    subs.push_back(sub->get_name());
  add(tables.options, path + ".", fmt::format("{}", fmt::join(options, " ")));
  add(tables.commands, path + ".", fmt::format("{}", fmt::join(subs, " ")));
  for (const CLI::Option* option : arguments_of(command, true))
    add(tables.files, path + ".", expected_of(*option));
  for (const CLI::App* sub : commands_of(command))
    tabulate(path_of(path, *sub), *sub, tables);
}

}  // namespace

std::string manual_page(const CLI::App& program) {
  std::string page = fmt::format(".TH VOUSSOIR 1 \"\" {} \"User Commands\"\n", quoted("voussoir " + version()));
  page += ".SH NAME\nvoussoir \\- distinct element models of jointed rock\n";
  page += ".SH SYNOPSIS\n.B voussoir\n[OPTIONS] COMMAND [OPTIONS] ...\n";
  page +=
      ".SH DESCRIPTION\nA scene is a file (TOML) that states blocks or the joints that cut them, their properties, "
      "loads "
      "and stages.\n.B voussoir docs\nlists all its keys,\n.B voussoir check\nreports the features that a scene "
      "uses,\n.B "
      "voussoir "
      "run\nruns it and writes results.json, history.csv and files for ParaView.\n";
  page += ".SH OPTIONS\n";
  describe_arguments(program, page);
  page += ".SH COMMANDS\n";
  describe_commands("", program, page);
  page += exit_status();
  page +=
      ".SH ENVIRONMENT\n.TP\n.B VOUSSOIR_TRAPS\n1: the first number that is not finite ends the program by SIGFPE.\n";
  page +=
      ".SH EXAMPLES\nScenes and a tutorial from a field table to a factor of safety are in "
      "/usr/share/doc/voussoir/examples.\n";
  return page;
}

std::string bash_completion(const CLI::App& program) {
  Tables tables;
  tabulate("", program, tables);
  std::string script =
      fmt::format("# Completion of voussoir {} for bash, made by: voussoir docs --completion\n", version());
  script += "_voussoir() {\n";
  script += fmt::format("  local -A options=(\n{}  ) commands=(\n{}  ) values=(\n{}  ) files=(\n{}  )\n",
                        tables.options, tables.commands, tables.values, tables.files);
  script += R"(  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command="" i
  if [ "$word" = "=" ]; then
    word=""
  elif [ "$before" = "=" ]; then
    before=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    # a command's name, unless it is the value of the option before it
    [ -z "${values["$command ${COMP_WORDS[i - 1]}"]-}" ] || continue
    [[ " ${commands["$command."]-} " == *" ${COMP_WORDS[i]} "* ]] && command="${command:+$command }${COMP_WORDS[i]}"
  done
  local expected=${values["$command $before"]-}
  if [ -z "$expected" ] && [[ $word == -* ]]; then
    expected=${options["$command."]-}
  elif [ -z "$expected" ]; then
    expected="${commands["$command."]-} ${files["$command."]-}"
  fi
  COMPREPLY=()
  for i in $expected; do
    case $i in
      FILE) mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -- "$word") ;;
      FOLDER) mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -d -- "$word") ;;
      [[:upper:]]*) ;;  # a number or a text that only the user knows
      *) [[ $i != "$word"* ]] || COMPREPLY+=("$i") ;;
    esac
  done
}
complete -o filenames -F _voussoir voussoir
)";
  return script;
}

}  // namespace voussoir
