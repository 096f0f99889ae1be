#pragma once
// The pages of the manual, as book.toml lists them.
#include <string>
#include <vector>

#include "reports/book.hpp"
#include "reports/book_list.hpp"
#include "reports/links.hpp"
#include "verification/verdicts.hpp"

namespace voussoir::reports {

// common inputs of all pages
struct Sources {
  Folders folders;
  std::filesystem::path keys;  // markdown list of all scene keys
  std::filesystem::path book;  // list of chapters (book_list.hpp)
  std::string version;
  verification::Verdicts verdicts;
  std::vector<std::string>& missing;  // parts that could not be shown, one sentence each
};

// In the order of the list, connected (book.hpp). Cases that the verdicts do not have are left out; throws
// std::runtime_error for one that no group lists, and for a page that does not exist.
std::vector<BookPage> all_pages(Sources& sources);

// the anchors of all texts that the groups list
Anchors anchors_of(const std::vector<PageGroup>& groups);

// A line on the state of the checks, and one on the version: the cover of a print.
std::string cover(const Sources& sources);

}  // namespace voussoir::reports
