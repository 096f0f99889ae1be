#pragma once
// The manual's chapters: book.toml, beside this file.
#include <filesystem>
#include <string>
#include <vector>

namespace voussoir::reports {

// Pages of a chapter that belong together.
struct PageGroup {
  std::string chapter, title;      // the title is empty if the chapter has one group only
  std::vector<std::string> pages;  // a text of the repository, the folder of a case, or the name of a computed page
  bool printed = true;             // false: left to a screen, as tables of keys
  bool in_file = true;             // false: left to the folder of pages
};

// Throws std::runtime_error, which names file, line, key and repair, for a list that cannot be read or that names a
// page twice.
std::vector<PageGroup> read_book(const std::filesystem::path& list);

// The anchor of a text: "docs/water.md" → "docs-water", "core/contact/README.md" → "core-contact".
std::string anchor_of_text(const std::filesystem::path& text);

// Names of the cases of a group, in its order.
std::vector<std::string> cases_of(const PageGroup& group);

}  // namespace voussoir::reports
