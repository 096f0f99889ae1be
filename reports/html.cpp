#include "reports/html.hpp"

#include <cmark-gfm-core-extensions.h>
#include <cmark-gfm.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <stdexcept>

#include "verification/verdict_file.hpp"

namespace voussoir::reports {
namespace {

using Parser = std::unique_ptr<cmark_parser, decltype(&cmark_parser_free)>;
using Node = std::unique_ptr<cmark_node, decltype(&cmark_node_free)>;

Parser make_parser() {
  cmark_gfm_core_extensions_ensure_registered();
  Parser parser(cmark_parser_new(CMARK_OPT_DEFAULT), &cmark_parser_free);
  for (const char* name : {"table", "strikethrough", "autolink"})
    cmark_parser_attach_syntax_extension(parser.get(), cmark_find_syntax_extension(name));
  return parser;
}

Node parse(const Parser& parser, const std::string& markdown) {
  cmark_parser_feed(parser.get(), markdown.data(), markdown.size());
  return {cmark_parser_finish(parser.get()), &cmark_node_free};
}

cmark_node* title_of(cmark_node* document) {
  cmark_node* first = cmark_node_first_child(document);
  const bool is_title =
      first && cmark_node_get_type(first) == CMARK_NODE_HEADING && cmark_node_get_heading_level(first) == 1;
  return is_title ? first : nullptr;
}

std::string owned(char* text) {
  std::string copy = text ? text : "";
  std::free(text);
  return copy;
}

// All nodes of some types below a node, none of them a leaf: in the order of the text, nested ones first.
std::vector<cmark_node*> nodes_below(cmark_node* root, std::initializer_list<cmark_node_type> types) {
  std::vector<cmark_node*> found;
  const std::unique_ptr<cmark_iter, decltype(&cmark_iter_free)> walk(cmark_iter_new(root), &cmark_iter_free);
  for (cmark_event_type event; (event = cmark_iter_next(walk.get())) != CMARK_EVENT_DONE;) {
    cmark_node* node = cmark_iter_get_node(walk.get());
    if (event == CMARK_EVENT_EXIT && std::find(types.begin(), types.end(), cmark_node_get_type(node)) != types.end())
      found.push_back(node);
  }
  return found;
}

void remove(cmark_node* node) {
  cmark_node_unlink(node);
  cmark_node_free(node);
}

void follow(const LinkRules& rules, cmark_node* link) {
  if (const auto target = rules.link(cmark_node_get_url(link))) {
    cmark_node_set_url(link, target->c_str());
    return;
  }
  while (cmark_node* words = cmark_node_first_child(link))
    cmark_node_insert_before(link, words);
  remove(link);
}

// the children of a picture as HTML; they are removed from it
std::string caption_of(cmark_node* picture) {
  const Node page(cmark_node_new(CMARK_NODE_DOCUMENT), &cmark_node_free);
  cmark_node* line = cmark_node_new(CMARK_NODE_PARAGRAPH);
  cmark_node_append_child(page.get(), line);
  while (cmark_node* words = cmark_node_first_child(picture))
    cmark_node_append_child(line, words);
  const std::string html = owned(cmark_render_html(page.get(), CMARK_OPT_DEFAULT, nullptr));
  const std::size_t start = html.find('>') + 1, end = html.rfind("</p>");
  return end == std::string::npos ? "" : html.substr(start, end - start);
}

bool is_of_pictures_alone(cmark_node* paragraph) {
  for (cmark_node* node = cmark_node_first_child(paragraph); node; node = cmark_node_next(node))
    if (const cmark_node_type type = cmark_node_get_type(node);
        type != CMARK_NODE_IMAGE && type != CMARK_NODE_SOFTBREAK && type != CMARK_NODE_LINEBREAK)
      return false;
  return true;
}

// puts HTML before a node
void put(const std::string& html, cmark_node_type type, cmark_node* before) {
  cmark_node* place = cmark_node_new(type);
  cmark_node_set_on_enter(place, html.c_str());
  cmark_node_insert_before(before, place);
}

void draw(const LinkRules& rules, cmark_node* document) {
  std::vector<cmark_node*> emptied;
  for (cmark_node* picture : nodes_below(document, {CMARK_NODE_IMAGE})) {
    const std::string target = cmark_node_get_url(picture);
    const std::string html = rules.picture(target, caption_of(picture)).value_or("");
    cmark_node* parent = cmark_node_parent(picture);
    const bool alone = cmark_node_get_type(parent) == CMARK_NODE_PARAGRAPH && is_of_pictures_alone(parent);
    if (alone) {
      put(html, CMARK_NODE_CUSTOM_BLOCK, parent);
      if (emptied.empty() || emptied.back() != parent) emptied.push_back(parent);
    } else {
      put(html, CMARK_NODE_CUSTOM_INLINE, picture);
      remove(picture);
    }
  }
  for (cmark_node* paragraph : emptied)
    remove(paragraph);
}

}  // namespace

std::string escape(std::string_view text) {
  std::string safe;
  for (const char character : text) {
    switch (character) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += character;
    }
  }
  return safe;
}

std::string slug(std::string_view text) {
  std::string name;
  for (const char character : text) {
    if (std::isalnum(static_cast<unsigned char>(character)))
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(character)));
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  while (!name.empty() && name.back() == '-')
    name.pop_back();
  return name;
}

std::string markdown_to_html(const std::string& markdown, int heading_shift, bool leave_out_title,
                             const LinkRules& rules) {
  const Parser parser = make_parser();
  const Node document = parse(parser, markdown);
  if (cmark_node* title = title_of(document.get()); title && leave_out_title) remove(title);
  for (cmark_node* heading : nodes_below(document.get(), {CMARK_NODE_HEADING}))
    cmark_node_set_heading_level(heading, std::clamp(cmark_node_get_heading_level(heading) + heading_shift, 1, 6));
  if (rules.link)
    for (cmark_node* link : nodes_below(document.get(), {CMARK_NODE_LINK}))
      follow(rules, link);
  if (rules.picture) draw(rules, document.get());
  return owned(cmark_render_html(document.get(), CMARK_OPT_DEFAULT, cmark_parser_get_syntax_extensions(parser.get())));
}

std::optional<std::string> markdown_title(const std::string& markdown) {
  const Parser parser = make_parser();
  const Node document = parse(parser, markdown);
  cmark_node* title = title_of(document.get());
  if (!title) return std::nullopt;
  std::string text = owned(cmark_render_plaintext(title, CMARK_OPT_DEFAULT, 0));
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
    text.pop_back();
  return text;
}

namespace {

void replace_all(std::string& text, std::string_view found, std::string_view other) {
  for (std::size_t at = text.find(found); at != std::string::npos; at = text.find(found, at + other.size()))
    text.replace(at, found.size(), other);
}

// rgb( 96,  96,  96) at the beginning of the text as #606060, and the length of that text; empty if it is none
std::optional<std::pair<std::string, std::size_t>> short_colour(std::string_view text) {
  const std::string head(text.substr(0, std::string_view("rgb(255, 255, 255)").size()));
  int red = 0, green = 0, blue = 0, length = 0;
  if (std::sscanf(head.c_str(), "rgb(%d ,%d ,%d )%n", &red, &green, &blue, &length) != 3 || length == 0) return {};
  return std::pair(fmt::format("#{:02x}{:02x}{:02x}", red, green, blue), static_cast<std::size_t>(length));
}

// Attributes that gnuplot repeats for every line and letter are written once, at the figure and in manual.css, or are
// SVG's defaults: half of a figure's size. The titles that it gives to its elements would show as hints beneath the
// pointer.
std::string compact(std::string svg) {
  constexpr std::string_view font = " font-family=\"DejaVu Sans,Helvetica,Arial,sans-serif\"";
  replace_all(svg, font, "");
  const std::string_view root = std::string_view(svg).substr(0, svg.find('>'));
  if (root.find("font-family=") == std::string_view::npos) svg.insert(std::string_view("<svg").size(), font);
  replace_all(svg, " stroke-linecap=\"butt\" stroke-linejoin=\"miter\"", "");
  replace_all(svg, "fill=\"none\" color=\"black\" stroke=\"currentColor\"", "class=\"line\"");
  std::string shorter;
  for (std::size_t i = 0; i < svg.size(); ++i) {
    const auto rest = std::string_view(svg).substr(i);
    if (rest.starts_with("<title>gnuplot_plot") || rest.starts_with("<title>Gnuplot")) {
      i = std::min(svg.find("</title>", i), svg.size()) + std::string_view("</title>").size() - 1;
    } else if (const auto colour = rest.starts_with("rgb(") ? short_colour(rest) : std::nullopt) {
      shorter += colour->first;
      i += colour->second - 1;
    } else if (!std::isspace(static_cast<unsigned char>(svg[i]))) {
      shorter += svg[i];
    } else if (shorter.back() != ' ') {
      shorter += ' ';
    }
  }
  return shorter;
}

}  // namespace

std::size_t end_of_drawing(std::string_view html, std::size_t begin) {
  constexpr std::string_view opens = "<svg", closes = "</svg>";
  std::size_t at = begin + opens.size();
  for (int depth = 1; depth > 0;) {
    const std::size_t open = html.find(opens, at), close = html.find(closes, at);
    if (close == std::string_view::npos) throw std::runtime_error("a drawing of the manual has no end");
    depth += open < close ? 1 : -1;
    at = open < close ? open + opens.size() : close + closes.size();
  }
  return at;
}

std::string inline_svg(const std::filesystem::path& path, const std::string& prefix) {
  const std::string text = verification::read_text(path);
  const auto start = text.find("<svg");
  const auto end = text.rfind("</svg>");
  if (start == std::string::npos || end == std::string::npos)
    throw std::runtime_error(path.filename().string() + " contains no figure");

  // every gnuplot file uses the same ids; in one page the first one would win
  std::string svg = compact(text.substr(start, end + 6 - start));
  for (const std::string_view place : {" id='", " id=\"", "href='#", "href=\"#", "url(#", "url('#", "url(\"#"})
    replace_all(svg, place, fmt::format("{}{}-", place, prefix));
  return svg;
}

std::string section(const std::string& id, const std::string& title, const std::string& content) {
  return fmt::format("<section class=\"case\" id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, title, content);
}

std::string figure(const std::string& content, const std::string& caption) {
  return fmt::format("<figure>{}{}</figure>\n", content,
                     caption.empty() ? "" : fmt::format("<figcaption>{}</figcaption>", caption));
}

std::string drawn_figure(const std::vector<std::filesystem::path>& folders, const std::string& stem,
                         const std::string& prefix, const std::string& caption) {
  for (const std::filesystem::path& folder : folders)
    if (const auto path = folder / (stem + ".svg"); std::filesystem::exists(path))
      return figure(inline_svg(path, prefix), caption);
  throw std::runtime_error(fmt::format("The figure {} was not drawn.", stem));
}

}  // namespace voussoir::reports
