#include "reports/matrix_lists.hpp"

#define TOML_EXCEPTIONS 1
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "reports/html.hpp"
#include "verification/verdict_file.hpp"

namespace voussoir::reports {
namespace {

namespace fs = std::filesystem;

// number of numbered equations of each chapter and appendix of the thesis
constexpr std::array chapters{std::pair{"3", 55}, std::pair{"4", 18}, std::pair{"5", 14}, std::pair{"6", 9},
                              std::pair{"A", 10}, std::pair{"B", 1},  std::pair{"C", 1},  std::pair{"D", 2},
                              std::pair{"E", 2},  std::pair{"F", 8},  std::pair{"G", 3},  std::pair{"H", 6},
                              std::pair{"I", 4}};

// the number of a chapter's last equation; 0 if there is no such chapter
int last_of(std::string_view chapter) {
  for (const auto& [name, last] : chapters)
    if (chapter == name) return last;
  return 0;
}

[[noreturn]] void refuse(const fs::path& file, long line, const std::string& problem) {
  throw std::runtime_error(fmt::format("{}:{}: {}", file.filename().string(), line, problem));
}

long line_of(const toml::node& node) {
  return static_cast<long>(node.source().begin.line);
}

toml::table parsed(const fs::path& file) {
  try {
    return toml::parse_file(file.string());
  } catch (const toml::parse_error& problem) {
    refuse(file, static_cast<long>(problem.source().begin.line), std::string(problem.description()));
  }
}

// One table of a list; the keys that are read are the keys that it may have.
class Entry {
 public:
  Entry(const fs::path& file, const toml::table& table, std::string name)
      : file_(file), table_(table), name_(std::move(name)) {}

  std::string text(const char* key) {
    known_.push_back(key);
    const toml::node* node = table_.get(key);
    if (!node) return "";
    if (!node->is_string() || node->ref<std::string>().empty())
      refuse(file_, line_of(*node), fmt::format("{}: {} must be a text that is not empty", name_, key));
    return node->ref<std::string>();
  }

  std::string needed(const char* key) {
    const std::string value = text(key);
    if (value.empty()) refuse(file_, line_of(table_), fmt::format("{}: {} is missing; write it", name_, key));
    return value;
  }

  std::vector<std::string> texts(const char* key) {
    known_.push_back(key);
    std::vector<std::string> values;
    const toml::node* node = table_.get(key);
    if (!node) return values;
    if (!node->is_array()) refuse(file_, line_of(*node), fmt::format("{}: {} must be a list of texts", name_, key));
    for (const toml::node& value : *node->as_array()) {
      if (!value.is_string()) refuse(file_, line_of(value), fmt::format("{}: {} must contain texts", name_, key));
      values.push_back(value.ref<std::string>());
    }
    return values;
  }

  void end() const {
    for (const auto& [key, node] : table_)
      if (std::find(known_.begin(), known_.end(), key.str()) == known_.end())
        refuse(file_, line_of(node), fmt::format("{}: {} is not a key here; remove it", name_, key.str()));
  }

 private:
  const fs::path& file_;
  const toml::table& table_;
  std::string name_;
  std::vector<std::string_view> known_;
};

// the tables of a list [[name]], each read by `read`
template <class Item, class Read>
std::vector<Item> read_list(const fs::path& file, const char* name, Read read) {
  const toml::table whole = parsed(file);
  const toml::array* list = whole[name].as_array();
  if (!list || whole.size() != 1) refuse(file, 1, fmt::format("must contain [[{}]] tables only", name));
  std::vector<Item> items;
  for (const toml::node& node : *list) {
    if (!node.is_table()) refuse(file, line_of(node), fmt::format("{} must be a table", name));
    Entry entry(file, *node.as_table(), name);
    items.push_back(read(entry));
    entry.end();
  }
  return items;
}

// by number
std::map<std::string, std::string> read_formulas(const fs::path& file) {
  std::map<std::string, std::string> formulas;
  std::istringstream lines(verification::read_text(file));
  for (std::string line; std::getline(lines, line);)
    if (const std::size_t space = line.find(' '); space != std::string::npos)
      formulas[line.substr(0, space)] = line.substr(space + 1);
  return formulas;
}

Equation read_equation(const fs::path& file, const toml::table& table, const std::string& number) {
  Entry entry(file, table, number);
  const Equation equation{.number = number,
                          .subject = entry.needed("subject"),
                          .tex = entry.needed("formula"),
                          .formula = {},
                          .instead = entry.text("instead"),
                          .left_out = entry.text("left_out"),
                          .not_verified = entry.text("not_verified")};
  entry.end();
  if (!equation.left_out.empty() && !(equation.not_verified + equation.instead).empty())
    refuse(file, line_of(table), number + ": an equation that is left out needs no other reason; remove one");
  return equation;
}

}  // namespace

std::vector<Equation> read_equations(const fs::path& list, const fs::path& formula_file) {
  const toml::table whole = parsed(list);
  const auto formulas = read_formulas(formula_file);
  std::vector<Equation> equations;
  for (const auto& [chapter, node] : whole) {
    const int last = last_of(chapter.str());
    if (last == 0 || !node.is_table())
      refuse(list, line_of(node),
             fmt::format("{} is not a chapter of the thesis with numbered equations", chapter.str()));
    for (const auto& [count, table] : *node.as_table()) {
      const std::string number = fmt::format("{}.{}", chapter.str(), count.str());
      const bool whole_number = count.str().find_first_not_of("0123456789") == std::string_view::npos;
      if (!whole_number || !table.is_table() || std::stoi(std::string(count.str())) > last)
        refuse(list, line_of(table), fmt::format("the thesis has no Eq. {}", number));
    }
  }
  for (const auto& [chapter, last] : chapters)
    for (int count = 1; count <= last; ++count) {
      const std::string number = fmt::format("{}.{}", chapter, count);
      const toml::node* node = whole[chapter][std::to_string(count)].node();
      if (!node) refuse(list, 1, fmt::format("Eq. {} is missing; give it a table [{}]", number, number));
      Equation equation = read_equation(list, *node->as_table(), number);
      const auto set = formulas.find(number);
      const std::string made_of =
          fmt::format("<annotation encoding=\"application/x-tex\">{}</annotation>", escape(equation.tex));
      if (set == formulas.end() || set->second.find(made_of) == std::string::npos)
        refuse(list, line_of(*node),
               fmt::format("{}: its MathML was made of another formula; run reports/set_formulas.sh", number));
      equation.formula = set->second;
      equations.push_back(std::move(equation));
    }
  return equations;
}

std::vector<ThesisCase> read_thesis_cases(const fs::path& list) {
  return read_list<ThesisCase>(list, "thesis_case", [](Entry& entry) {
    return ThesisCase{.thesis = entry.needed("thesis"),
                      .subject = entry.needed("subject"),
                      .cases = entry.texts("cases"),
                      .tests = entry.texts("tests"),
                      .remark = entry.text("remark")};
  });
}

std::vector<Promise> read_promises(const fs::path& list) {
  return read_list<Promise>(list, "promise", [](Entry& entry) {
    return Promise{.readme = entry.needed("readme"),
                   .meaning = entry.needed("meaning"),
                   .tests = entry.texts("tests"),
                   .programs = entry.texts("programs")};
  });
}

std::vector<Ground> read_grounds(const fs::path& list) {
  const toml::table whole = parsed(list);
  std::vector<Ground> grounds;
  for (const char* kind : {"works", "principles"}) {
    const toml::table* table = whole[kind].as_table();
    if (!table || whole.size() != 2) refuse(list, 1, "must contain the tables works and principles only");
    for (const auto& [name, meaning] : *table) {
      if (!meaning.is_string())
        refuse(list, line_of(meaning), fmt::format("{} must have its meaning as text", name.str()));
      grounds.push_back({std::string(name.str()), meaning.ref<std::string>(), std::string_view(kind) == "works"});
    }
  }
  return grounds;
}

}  // namespace voussoir::reports
