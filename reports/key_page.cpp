#include "reports/key_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "reports/html.hpp"
#include "verification/verdict_file.hpp"

namespace voussoir::reports {
namespace {

namespace fs = std::filesystem;

// text between two marks that begins at or after a place; empty if there is none before `end`
std::string between(const std::string& html, std::string_view begin, std::string_view close, std::size_t at,
                    std::size_t end) {
  const std::size_t from = html.find(begin, at);
  if (from == std::string::npos || from >= end) return {};
  const std::size_t start = from + begin.size();
  return html.substr(start, html.find(close, start) - start);
}

// A row of a key gets an anchor and, for the search, the key's name with its table: id="page-table-key"
// data-name="table.key".
std::string keys_with_anchors(const std::string& html, const std::string& page) {
  constexpr std::string_view row = "<tr>\n<td><code>";
  std::string text;
  std::set<std::string> known;
  for (std::size_t at = 0; at < html.size();) {
    const std::size_t next = std::min(html.find(row, at), html.size());
    text.append(html, at, next - at);
    if (next == html.size()) break;
    const std::size_t heading = html.rfind("<h3>", next);
    std::string table =
        heading == std::string::npos ? "" : between(html, "<code>", "</code>", heading, html.find("</h3>", heading));
    std::erase_if(table, [](char letter) { return letter == '[' || letter == ']'; });
    const std::string key = between(html, "<code>", "</code>", next, html.size());
    const std::string name = table.empty() ? key : table + "." + key;
    std::string id = fmt::format("{}-{}", page, slug(name));
    for (int number = 2; !known.insert(id).second; ++number)
      id = fmt::format("{}-{}-{}", page, slug(name), number);
    text += fmt::format("<tr id=\"{}\" data-name=\"{}\">", id, name);
    at = next + std::string_view("<tr>").size();
  }
  return text;
}

}  // namespace

std::string list_page(const fs::path& list, std::size_t number, const std::string& id, const std::string& title,
                      const std::string& maker, std::vector<std::string>& missing) {
  if (!fs::exists(list) || fs::file_size(list) == 0) {
    missing.push_back(fmt::format("{}: {} did not list them", title, maker));
    return section(id, title,
                   fmt::format("<p class=\"note\">The list is missing: <code>{}</code> was not available when this "
                               "manual was built.</p>",
                               maker));
  }
  std::vector<std::string> parts;
  bool fenced = false;
  std::istringstream lines(verification::read_text(list));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) fenced = !fenced;
    if (parts.empty() || (!fenced && line.starts_with("# "))) parts.emplace_back();
    parts.back() += line + "\n";
  }
  const LinkRules without_pictures{
      {}, [](const std::string&, const std::string&) -> std::optional<std::string> { return {}; }};
  return section(id, title,
                 number < parts.size()
                     ? keys_with_anchors(markdown_to_html(parts[number], 1, true, without_pictures), id)
                     : fmt::format("<p class=\"note\">{} lists none.</p>", maker));
}

}  // namespace voussoir::reports
