#include "reports/book_list.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <set>
#include <stdexcept>
#include <string_view>

#include "reports/html.hpp"

namespace voussoir::reports {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& list, const toml::node& node, const std::string& problem) {
  throw std::runtime_error(fmt::format("{}:{}: {}", list.filename().string(), node.source().begin.line, problem));
}

PageGroup read_group(const fs::path& list, const toml::table& table, std::set<std::string>& known) {
  for (const auto& [key, node] : table)
    if (key != "chapter" && key != "title" && key != "pages" && key != "printed" && key != "in_file")
      refuse(list, node, fmt::format("unknown key {}; use chapter, title, pages, printed, in_file", key.str()));
  PageGroup group{table["chapter"].value_or(std::string()),
                  table["title"].value_or(std::string()),
                  {},
                  table["printed"].value_or(true),
                  table["in_file"].value_or(true)};
  const toml::array* pages = table["pages"].as_array();
  if (!pages || pages->empty()) refuse(list, table, "pages is missing; name at least one page");
  for (const toml::node& page : *pages) {
    group.pages.push_back(page.value_or(std::string()));
    if (!known.insert(group.pages.back()).second)
      refuse(list, page, fmt::format("pages names \"{}\" again; remove one of the two", group.pages.back()));
  }
  return group;
}

}  // namespace

std::vector<PageGroup> read_book(const fs::path& list) {
  toml::table book;
  try {
    book = toml::parse_file(list.string());
  } catch (const toml::parse_error& problem) {
    throw std::runtime_error(
        fmt::format("{}:{}: {}", list.filename().string(), problem.source().begin.line, problem.description()));
  }
  const toml::array* tables = book["group"].as_array();
  if (!tables) throw std::runtime_error(list.filename().string() + ": it has no [[group]]; add one");
  std::vector<PageGroup> groups;
  std::set<std::string> known;
  for (const toml::node& node : *tables)
    if (const toml::table* table = node.as_table()) groups.push_back(read_group(list, *table, known));
  return groups;
}

std::string anchor_of_text(const fs::path& text) {
  return slug((text.filename() == "README.md" ? text.parent_path() : text.parent_path() / text.stem()).string());
}

std::vector<std::string> cases_of(const PageGroup& group) {
  constexpr std::string_view folder = "cases/";
  std::vector<std::string> cases;
  for (const std::string& page : group.pages)
    if (page.starts_with(folder)) cases.push_back(page.substr(folder.size()));
  return cases;
}

}  // namespace voussoir::reports
