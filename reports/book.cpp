#include "reports/book.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "reports/html.hpp"
#include "verification/verdict_file.hpp"

namespace voussoir::reports {
namespace {

namespace fs = std::filesystem;

constexpr const char* first_page = "index";

// name of a page's file without its ending: a reader begins with the first
std::string file_of(const BookPage& page) {
  return page.id == "top" ? first_page : page.id;
}

std::set<std::string> ids_of(const std::string& html) {
  constexpr std::string_view mark = " id=\"";
  std::set<std::string> ids;
  for (std::size_t at = html.find(mark); at != std::string::npos; at = html.find(mark, at + 1))
    ids.insert(html.substr(at + mark.size(), html.find('"', at + mark.size()) - at - mark.size()));
  return ids;
}

// words without tags
std::string plain(std::string_view html) {
  std::string text;
  for (std::size_t at = 0; at < html.size(); ++at)
    if (html[at] == '<')
      at = std::min(html.find('>', at), html.size());
    else
      text += html[at];
  return text;
}

// headings below the page's title get the anchor page--heading, numbered if there are several of one name
std::string with_anchors(const std::string& html, const std::string& page) {
  std::string text;
  std::set<std::string> known = ids_of(html);
  for (std::size_t at = 0; at < html.size();) {
    const std::size_t next = std::min(html.find("<h", at), html.size());
    text.append(html, at, next - at);
    if (next == html.size()) break;
    at = next + 4;  // <h3>
    if (at > html.size() || html[next + 2] < '3' || html[next + 2] > '6' || html[next + 3] != '>') {
      text += "<h";
      at = next + 2;
      continue;
    }
    const std::string name = page + "--" + slug(plain(std::string_view(html).substr(at, html.find("</h", at) - at)));
    std::string id = name;
    for (int number = 2; !known.insert(id).second; ++number)
      id = fmt::format("{}-{}", name, number);
    text += fmt::format("<h{} id=\"{}\">", html[next + 2], id);
  }
  return text;
}

// each link to an anchor, <a href="#target">words</a>, replaced by the text that `other` returns
std::string with_links(const std::string& html,
                       const std::function<std::string(const std::string&, const std::string&)>& other) {
  constexpr std::string_view begin = "<a href=\"#", end = "</a>";
  std::string text;
  for (std::size_t at = 0; at < html.size();) {
    const std::size_t next = std::min(html.find(begin, at), html.size());
    text.append(html, at, next - at);
    if (next == html.size()) break;
    const std::size_t target = next + begin.size(), target_end = html.find('"', target);
    const std::size_t words = html.find('>', target_end) + 1, words_end = html.find(end, words);
    text += other(html.substr(target, target_end - target), html.substr(words, words_end - words));
    at = words_end + end.size();
  }
  return text;
}

// the list of pages: chapters, groups, pages; `href` gives the address of a page, `mark` what follows its link
std::string contents(const std::vector<BookPage>& pages, const BookPage* here,
                     const std::function<std::string(const BookPage&)>& href,
                     const std::function<std::string(const BookPage&)>& mark) {
  std::string text;
  for (auto page = pages.begin(); page != pages.end();) {
    const std::string chapter = page->chapter;
    const bool open = !here || here->chapter == chapter;
    if (!chapter.empty())
      text += fmt::format("<details{}><summary>{}</summary>\n", open ? " open" : "", escape(chapter));
    while (page != pages.end() && page->chapter == chapter) {
      const std::string group = page->group;
      text += (group.empty() ? "" : fmt::format("<p>{}</p>", escape(group))) + "<ul>\n";
      for (; page != pages.end() && page->chapter == chapter && page->group == group; ++page)
        text += fmt::format("<li><a href=\"{}\"{}>{}</a>{}</li>\n", href(*page),
                            here == &*page ? " aria-current=\"page\"" : "", page->title, mark(*page));
      text += "</ul>\n";
    }
    if (!chapter.empty()) text += "</details>\n";
  }
  return text;
}

std::string no_mark(const BookPage&) {
  return {};
}

std::string navigation(const BookStyle& style, const std::string& list, const char* home) {
  return fmt::format(
      "<nav><p class=\"name\"><a href=\"{}\">Voussoir</a> <span class=\"quiet\">{}</span></p>\n"
      "<div id=\"finder\" hidden><input type=\"search\" id=\"find\" placeholder=\"Search\" aria-label=\"Search the "
      "manual\" autocomplete=\"off\"><ul id=\"found\"></ul></div>\n<input type=\"checkbox\" id=\"unfold\"><label "
      "for=\"unfold\">Contents</label>\n<div class=\"contents\">\n{}</div></nav>\n",
      home, style.version, list);
}

std::string head(const BookStyle& style, const std::string& title, const std::string& css) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>{}: Voussoir {}</title>\n{}</head>\n<body>\n",
      title, style.version, css);
}

// the drawings of a page become files, which a browser loads when they come into sight
std::string with_files(const std::string& html, const std::string& page, const fs::path& folder) {
  constexpr std::string_view begin = "<figure><svg";
  std::string text;
  int number = 0;
  for (std::size_t at = 0; at < html.size();) {
    const std::size_t next = std::min(html.find(begin, at), html.size());
    text.append(html, at, next - at);
    if (next == html.size()) break;
    const std::size_t drawing = next + std::string_view("<figure>").size(), close = end_of_drawing(html, drawing);
    const std::string name = fmt::format("{}-{}.svg", page, ++number);
    std::string svg = html.substr(drawing, close - drawing);
    svg.insert(svg.find('>') + 1, "<style>.line{fill:none;color:black;stroke:currentColor}</style>");
    if (svg.find("xmlns=") == std::string::npos)
      svg.insert(std::string_view("<svg").size(), " xmlns=\"http://www.w3.org/2000/svg\"");
    verification::write_atomically(folder / "pictures" / name, svg);
    text += fmt::format(
        "<figure><a href=\"pictures/{0}\"><img loading=\"lazy\" alt=\"drawing\" src=\"pictures/{0}\"></a>", name);
    at = close;
  }
  return text;
}

// The common script of the views is HTML: data within elements, and a last <script>. As a file, it adds the data to the
// page.
std::string as_file(const std::string& viewer) {
  constexpr std::string_view begin = "<script>", end = "</script>";
  const std::size_t script = viewer.rfind(begin), close = viewer.rfind(end);
  if (script == std::string::npos || close < script) return {};
  return fmt::format("document.body.insertAdjacentHTML(\"beforeend\", {});\n{}",
                     nlohmann::json(viewer.substr(0, script)).dump(),
                     viewer.substr(script + begin.size(), close - script - begin.size()));
}

}  // namespace

std::vector<std::string> connect(std::vector<BookPage>& pages) {
  std::map<std::string, const BookPage*> by_id;
  std::set<std::string> known, lost;
  for (BookPage& page : pages) {
    page.html = with_anchors(page.html, page.id);
    known.merge(ids_of(page.html));
    by_id[page.id] = &page;
  }
  for (BookPage& page : pages)
    page.html = with_links(page.html, [&](const std::string& target, std::string words) {
      // "key_blocks" or "key_blocks: 3 checks" for the page of that case
      const std::string name = words.substr(0, words.find(':'));
      if (const auto found = by_id.find(target); found != by_id.end() && slug(plain(name)) == target)
        words = found->second->title + words.substr(name.size());
      if (known.contains(target)) return fmt::format("<a href=\"#{}\">{}</a>", target, words);
      lost.insert(fmt::format("{}: no page has #{}", page.id, target));
      return words;
    });
  return {lost.begin(), lost.end()};
}

std::string single_file(const std::vector<BookPage>& pages, const BookStyle& style, bool for_print) {
  std::vector<BookPage> shown;
  for (const BookPage& page : pages)
    if (for_print ? page.printed : page.in_file) shown.push_back(page);
  const auto href = [](const BookPage& page) { return "#" + page.id; };
  std::string text = head(style, "Manual", "<style>\n" + style.css + "</style>") + style.cover;
  if (for_print)
    text += "<nav><p class=\"name\">Voussoir</p>\n<div class=\"contents\">\n" +
            contents(shown, nullptr, href,
                     [](const BookPage& page) { return fmt::format("<span data-page=\"{}\"></span>", page.id); }) +
            "</div></nav>\n";
  else
    text += navigation(style, contents(shown, nullptr, href, no_mark), "#top");
  text += "<main>\n";
  std::set<std::string> known;
  for (const BookPage& page : shown)
    known.merge(ids_of(page.html));
  for (const BookPage& page : shown)
    text += with_links(page.html, [&](const std::string& target, const std::string& words) {
      return known.contains(target) ? fmt::format("<a href=\"#{}\">{}</a>", target, words) : words;
    });
  return text + "</main>\n" + style.viewer + "<script>\n" + style.script + "</script>\n</body></html>\n";
}

void write_pages(const fs::path& folder, const std::vector<BookPage>& pages, const BookStyle& style) {
  fs::remove_all(folder);
  std::map<std::string, std::string> file_by_id;
  std::set<std::string> page_ids;
  for (const BookPage& page : pages) {
    page_ids.insert(page.id);
    for (const std::string& id : ids_of(page.html))
      file_by_id.emplace(id, file_of(page) + ".html");
  }
  const auto href = [](const BookPage& page) { return file_of(page) + ".html"; };
  for (std::size_t k = 0; k < pages.size(); ++k) {
    const BookPage& page = pages[k];
    const std::string here = href(page);
    const std::string html = with_links(page.html, [&](const std::string& target, const std::string& words) {
      const std::string& file = file_by_id.at(target);
      const bool whole = page_ids.contains(target) && file != here;
      const std::string place = whole ? file : file == here ? "#" + target : file + "#" + target;
      return fmt::format("<a href=\"{}\">{}</a>", place, words);
    });
    std::string turn;
    if (k > 0) turn += fmt::format("<a rel=\"prev\" href=\"{}\">← {}</a>", href(pages[k - 1]), pages[k - 1].title);
    if (k + 1 < pages.size())
      turn += fmt::format("<a rel=\"next\" href=\"{}\">{} →</a>", href(pages[k + 1]), pages[k + 1].title);
    const bool views = html.find("class=\"voussoir\"") != std::string::npos && !style.viewer.empty();
    const std::string path = page.chapter.empty() ? "" : page.chapter + (page.group.empty() ? "" : " › " + page.group);
    verification::write_atomically(
        folder / here,
        head(style, page.chapter.empty() ? page.title : fmt::format("{} ({})", page.title, escape(page.chapter)),
             "<link rel=\"stylesheet\" href=\"manual.css\">") +
            navigation(style, contents(pages, &page, href, no_mark), "index.html") + "<main>\n<p class=\"path\">" +
            escape(path) + "</p>\n" + with_files(html, page.id, folder) + "<p class=\"turn\">" + turn +
            "</p></main>\n" + (views ? "<script src=\"viewer.js\"></script>\n" : "") +
            "<script src=\"manual.js\"></script>\n</body></html>\n");
  }
  verification::write_atomically(folder / "manual.css", style.css);
  verification::write_atomically(folder / "manual.js", style.script);
  verification::write_atomically(folder / "search.js", search_index(pages));
  if (!style.viewer.empty()) verification::write_atomically(folder / "viewer.js", as_file(style.viewer));
}

}  // namespace voussoir::reports
