// search.js: pages as plain text, in pieces that begin at anchors.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "reports/book.hpp"
#include "reports/html.hpp"

namespace voussoir::reports {
namespace {

// the tag's name, in small letters as our pages have them; "/p" of an end
std::string_view name_of_tag(std::string_view tag) {
  std::size_t end = 1;
  while (end < tag.size() && !std::isspace(static_cast<unsigned char>(tag[end])) && tag[end] != '>')
    ++end;
  return tag.substr(1, end - 1);
}

std::string value_in_tag(std::string_view tag, std::string_view attribute) {
  const std::size_t at = tag.find(fmt::format(" {}=\"", attribute));
  if (at == std::string_view::npos) return {};
  const std::size_t begin = at + attribute.size() + 3;
  return std::string(tag.substr(begin, tag.find('"', begin) - begin));
}

std::string without_entities(std::string text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> entities{
      {{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&amp;", "&"}}};
  for (const auto& entity : entities)
    for (std::size_t at = text.find(entity.first); at != std::string::npos; at = text.find(entity.first, at + 1))
      text.replace(at, entity.first.size(), entity.second);
  return text;
}

struct Piece {
  std::string id, title, text;
  bool title_open = true;
};

void append(std::string& text, std::string_view more) {
  for (const char letter : more) {
    const bool blank = std::isspace(static_cast<unsigned char>(letter));
    if (!blank || (!text.empty() && text.back() != ' ')) text += blank ? ' ' : letter;
  }
}

// whether words before and after a tag are apart
bool separates(std::string_view name) {
  constexpr std::array<std::string_view, 9> within{"/a",    "/b",    "/code",   "/em", "/i",
                                                   "/mark", "/span", "/strong", "/sub"};
  return name == "br" || (name.starts_with("/") && std::find(within.begin(), within.end(), name) == within.end());
}

// of one page; drawings, scripts and the TeX of formulas are no text
std::vector<Piece> pieces_of(const BookPage& page) {
  std::vector<Piece> pieces{{page.id, page.title, ""}};
  const std::string_view html = page.html;
  for (std::size_t at = 0; at < html.size();) {
    if (html[at] != '<') {
      const std::size_t next = std::min(html.find('<', at), html.size());
      if (pieces.back().title_open && pieces.size() > 1) append(pieces.back().title, html.substr(at, next - at));
      append(pieces.back().text, html.substr(at, next - at));
      at = next;
      continue;
    }
    const std::string_view tag = html.substr(at, std::min(html.find('>', at), html.size() - 1) + 1 - at);
    const std::string_view name = name_of_tag(tag);
    at = name == "svg" ? end_of_drawing(html, at) : at + tag.size();
    for (const std::string_view skipped : {"script", "annotation"})
      if (name == skipped) at = std::min(html.find(fmt::format("</{}>", skipped), at), html.size());
    const bool begins = (name.size() == 2 && name[0] == 'h') || name == "tr" || name == "details";
    if (const std::string id = value_in_tag(tag, "id"); begins && !id.empty()) {
      const std::string key = value_in_tag(tag, "data-name");
      pieces.push_back({id, key, "", key.empty()});
    }
    if (name.starts_with("/h") || name == "/td" || name == "/summary") pieces.back().title_open = false;
    if (separates(name)) append(pieces.back().text, " ");
  }
  return pieces;
}

}  // namespace

std::string search_index(const std::vector<BookPage>& pages) {
  nlohmann::json titles = nlohmann::json::array(), entries = nlohmann::json::array();
  for (const BookPage& page : pages) {
    for (const Piece& piece : pieces_of(page))
      entries.push_back({titles.size(), piece.id, without_entities(piece.title), without_entities(piece.text)});
    titles.push_back({page.id, without_entities(page.title), page.chapter});
  }
  return fmt::format("window.voussoirManual = {};\n", nlohmann::json{{"pages", titles}, {"entries", entries}}.dump());
}

}  // namespace voussoir::reports
