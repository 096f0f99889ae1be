#pragma once
// The manual from its pages: a folder with a page a subject, one file with all of them, and the text that is printed.
#include <filesystem>
#include <string>
#include <vector>

namespace voussoir::reports {

struct BookPage {
  std::string chapter, group;
  std::string id, title;                // the anchor, which is the name of its file too; the title as HTML
  std::string html;                     // a <section> with that anchor; links to other pages are anchors, href="#…"
  bool printed = true, in_file = true;  // in the print, in the single file
};

struct BookStyle {
  std::string version, cover;  // the cover of a print, HTML
  std::string css, script;     // manual.css, manual.js
  std::string viewer;          // the common script of all views of blocks; empty if there is none
};

// Gives every heading an anchor, "page--heading"; a link with a page's folder as its words gets that page's title, and
// a link to an anchor that no page has becomes plain words. Returns those links, a sentence each.
std::vector<std::string> connect(std::vector<BookPage>& pages);

// All pages that belong in one file; for a print those that are printed, and a list of contents whose page numbers are
// empty (print_manual.sh).
std::string single_file(const std::vector<BookPage>& pages, const BookStyle& style, bool for_print);

// Writes the folder anew: index.html, the first page, and ID.html of each other; manual.css, manual.js, search.js and
// viewer.js; each drawing as a file of its own. Nothing in it is requested from a network.
void write_pages(const std::filesystem::path& folder, const std::vector<BookPage>& pages, const BookStyle& style);

// search.js: the text below each anchor, as a list that manual.js searches.
std::string search_index(const std::vector<BookPage>& pages);

}  // namespace voussoir::reports
