#include "reports/html.hpp"

#include <cmark-gfm-core-extensions.h>
#include <cmark-gfm.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <memory>
#include <regex>
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

// calls `replace` for every match and keeps the text between
template <class Replace>
std::string replace_all(const std::string& text, const std::regex& pattern, Replace replace) {
  std::string result;
  auto rest = text.cbegin();
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    result.append(rest, (*match)[0].first);
    result += replace(*match);
    rest = (*match)[0].second;
  }
  return result.append(rest, text.cend());
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

std::string markdown_to_html(const std::string& markdown, int heading_shift, bool leave_out_title) {
  const Parser parser = make_parser();
  const Node document = parse(parser, markdown);
  if (cmark_node* title = title_of(document.get()); title && leave_out_title) cmark_node_free(title);
  for (cmark_node* node = cmark_node_first_child(document.get()); node; node = cmark_node_next(node))
    if (cmark_node_get_type(node) == CMARK_NODE_HEADING)
      cmark_node_set_heading_level(node, std::clamp(cmark_node_get_heading_level(node) + heading_shift, 1, 6));
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

std::string apply_links(const std::string& html, const LinkRules& rules) {
  static const std::regex image(R"re((?:<p>)?<img src="([^"]*)" alt="([^"]*)"[^>]*/>(?:</p>)?)re");
  static const std::regex link(R"re(<a href="([^"]*)"[^>]*>([\s\S]*?)</a>)re");
  const std::string with_links = replace_all(html, link, [&](const std::smatch& match) {
    const auto target = rules.link(match[1].str());
    return target ? fmt::format("<a href=\"{}\">{}</a>", *target, match[2].str()) : match[2].str();
  });
  return replace_all(with_links, image, [&](const std::smatch& match) {
    return rules.image(match[1].str(), match[2].str()).value_or("");
  });
}

std::string inline_svg(const std::filesystem::path& path, const std::string& prefix) {
  const std::string text = verification::read_text(path);
  const auto start = text.find("<svg");
  const auto end = text.rfind("</svg>");
  if (start == std::string::npos || end == std::string::npos)
    throw std::runtime_error(path.filename().string() + " holds no figure");

  // every gnuplot file uses the same ids; in one page the first one would win
  static const std::regex id(R"re((\bid=['"]|href=['"]#|url\(['"]?#))re");
  return std::regex_replace(text.substr(start, end + 6 - start), id, "$1" + prefix + "-");
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
