#pragma once
// Links and pictures of the repository's texts within the manual.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reports/html.hpp"

namespace voussoir::reports {

// Texts of the repository that the manual shows, by their paths in it: "docs/water.md" → "docs-water".
using Anchors = std::map<std::string, std::string>;

struct Folders {
  std::filesystem::path source;  // the repository
  std::filesystem::path build;   // folder in which verdicts, figures and studies were written
  Anchors anchors = {};          // of the texts besides the cases, whose anchors are their names
};

// The place in the manual, "#water-notes", of the target of a link in the text `text`, a path in the repository.
// Addresses of the network and anchors stay; empty if the manual does not show the target.
std::optional<std::string> place_of(const Anchors& anchors, const std::filesystem::path& text,
                                    const std::string& target);

// The picture `target` of a text as <figure>: the file beside the text, or the drawing of that name of the build, in
// `drawn` or the folder of all figures. Throws std::runtime_error if there is none.
std::string picture_of(const Folders& folders, const std::filesystem::path& text, const std::string& target,
                       const std::string& caption, const std::string& prefix,
                       const std::vector<std::filesystem::path>& drawn = {});

// Both rules for one text; pictures that do not exist are named in the text and in `missing`, after `who`.
LinkRules rules_of(const Folders& folders, const std::filesystem::path& text, const std::string& who,
                   std::vector<std::string>& missing);

}  // namespace voussoir::reports
