#pragma once
// Small pieces of HTML: escaped text, rendered markdown, inlined figures.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voussoir::reports {

// & < > and quotes as entities, for text and attributes.
std::string escape(std::string_view text);

// Letters, digits and dashes: the form of an anchor.
std::string slug(std::string_view text);

// Treatment of the links and pictures of a markdown text. A link points to the target that its function returns; if
// that is empty, the link is removed and its words stay. A picture is replaced by the HTML that its function returns,
// `caption` being its words as HTML; if empty, it is left out. Without a function links and pictures stay as they are.
struct LinkRules {
  std::function<std::optional<std::string>(const std::string& target)> link = {};
  std::function<std::optional<std::string>(const std::string& target, const std::string& caption)> picture = {};
};

// GitHub's markdown with tables as HTML; raw HTML in the text is dropped. Headings move down by `heading_shift` levels.
// `leave_out_title` drops a heading of the first level at the very start, for a page that has its own. A paragraph of
// pictures only is replaced by them, since a figure must not be inside one.
std::string markdown_to_html(const std::string& markdown, int heading_shift = 0, bool leave_out_title = false,
                             const LinkRules& rules = {});

// The heading of the first level at the start of a markdown text, as plain text; empty if there is none.
std::optional<std::string> markdown_title(const std::string& markdown);

// The <svg> element of a gnuplot file, its ids made unique by `prefix`, so that one page can have many. Throws
// std::runtime_error when the file has no such element.
std::string inline_svg(const std::filesystem::path& path, const std::string& prefix);

// the place behind the drawing, <svg>, that begins at a place; it may have drawings inside
std::size_t end_of_drawing(std::string_view html, std::size_t begin);

// A page of the manual: its anchor, its title and the rest, all HTML.
std::string section(const std::string& id, const std::string& title, const std::string& content);

// <figure> with an optional caption (HTML).
std::string figure(const std::string& content, const std::string& caption);

// The drawing <stem>.svg of the first of some folders that has it, in a <figure>; `prefix` as for inline_svg. Throws
// std::runtime_error when there is none, or it is not a drawing.
std::string drawn_figure(const std::vector<std::filesystem::path>& folders, const std::string& stem,
                         const std::string& prefix, const std::string& caption);

}  // namespace voussoir::reports
