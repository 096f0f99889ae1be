// unit.manual: the list of pages, links between them, and the pages as files.
#include "reports/book.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "reports/book_list.hpp"
#include "reports/key_page.hpp"
#include "reports/links.hpp"
#include "reports/parameters.hpp"
#include "reports/stiffness_page.hpp"
#include "verification/verdict_file.hpp"

namespace voussoir::reports::book_test {
namespace {

namespace fs = std::filesystem;
using verification::read_text;
using verification::write_atomically;

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::set<std::string> folders_of_cases() {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(VOUSSOIR_SOURCE_DIR) / "cases"))
    if (fs::exists(entry.path() / "README.md")) names.insert(entry.path().filename().string());
  return names;
}

TEST(BookList, HasEveryCaseAndEveryPageOfTheGuide) {
  const fs::path source = VOUSSOIR_SOURCE_DIR;
  std::set<std::string> pages, missing;
  for (const char* list : {"book.toml", "printed_book.toml"})
    for (const PageGroup& group : read_book(source / "reports" / list))
      for (const std::string& page : group.pages) {
        if (page.ends_with(".md") || page.starts_with("cases/")) EXPECT_TRUE(fs::exists(source / page)) << page;
        if (std::string(list) == "book.toml") pages.insert(page);
      }
  for (const std::string& name : folders_of_cases())
    if (!pages.contains("cases/" + name)) missing.insert("cases/" + name);
  for (const auto& entry : fs::directory_iterator(source / "docs"))
    if (const fs::path file = entry.path().filename(); file.extension() == ".md" && file != "README.md")
      if (!pages.contains("docs/" + file.string())) missing.insert("docs/" + file.string());
  EXPECT_TRUE(missing.empty()) << "reports/book.toml lacks " << *missing.begin();
}

TEST(BookList, NamesLineAndRepair) {
  const fs::path list = fs::path(testing::TempDir()) / "voussoir_book.toml";
  const auto message = [&](const std::string& text) -> std::string {
    write_atomically(list, text);
    try {
      read_book(list);
    } catch (const std::runtime_error& problem) {
      return problem.what();
    }
    return {};
  };
  EXPECT_EQ(message("[[group]]\nchapter = \"A\"\npages = [\"top\",\n \"top\"]\n"),
            "voussoir_book.toml:4: pages names \"top\" again; remove one of the two");
  EXPECT_TRUE(holds(message("[[group]]\nchapter = \"A\"\n"), "voussoir_book.toml:1: pages is missing"));
  EXPECT_TRUE(holds(message("[[group]]\nchapters = \"A\"\npages = [\"top\"]\n"), "unknown key chapters"));
  EXPECT_TRUE(holds(message("group = \n"), "voussoir_book.toml:1: "));
  EXPECT_EQ(anchor_of_text("docs/what_fails.md"), "docs-what-fails");
  EXPECT_EQ(anchor_of_text("core/contact/README.md"), "core-contact");
}

TEST(Links, LeadToTextsCasesAndScenes) {
  const Anchors anchors{{"docs/report.md", "docs-report"}, {"README.md", "top"}};
  EXPECT_EQ(place_of(anchors, "docs/water.md", "report.md#of-joints"), "#docs-report--of-joints");
  EXPECT_EQ(place_of(anchors, "cases/wedge/README.md", "../../docs/report.md"), "#docs-report");
  EXPECT_EQ(place_of(anchors, "cases/wedge/README.md", "../key_blocks/NOTES.md"), "#key-blocks-notes");
  EXPECT_EQ(place_of(anchors, "cases/wedge/README.md", "level.toml"), "#wedge-level-toml");
  EXPECT_EQ(place_of(anchors, "docs/water.md", "../cases/water/README.md"), "#water");
  EXPECT_EQ(place_of(anchors, "docs/water.md", "../README.md"), "#top");
  EXPECT_EQ(place_of(anchors, "docs/water.md", "#verdicts"), "#verdicts");
  EXPECT_EQ(place_of(anchors, "docs/water.md", "../Makefile"), std::nullopt);
}

std::vector<BookPage> two_pages() {
  return {
      {"", "", "top", "Front", "<section id=\"top\"><h1>Front</h1><a href=\"#key-blocks\">key_blocks: 3</a></section>"},
      {"Cases", "Kernels", "key-blocks", "Key blocks",
       "<section class=\"case\" id=\"key-blocks\"><h2>Key blocks</h2><h3>Run</h3><p>x &lt; y</p><h3>Run</h3>"
       "<a href=\"#top\">up</a> <a href=\"#gone\">gone</a> <a href=\"#key-blocks--run-2\">second</a>"
       "<figure><svg width='2'><svg x='1'></svg><text>hidden</text></svg></figure></section>",
       false}};
}

TEST(Book, ConnectsPages) {
  std::vector<BookPage> pages = two_pages();
  EXPECT_EQ(connect(pages), std::vector<std::string>{"key-blocks: no page has #gone"});
  EXPECT_TRUE(holds(pages[0].html, "<a href=\"#key-blocks\">Key blocks: 3</a>"));
  EXPECT_TRUE(holds(pages[1].html, "<h3 id=\"key-blocks--run\">Run</h3>"));
  EXPECT_TRUE(holds(pages[1].html, "<h3 id=\"key-blocks--run-2\">Run</h3>"));
  EXPECT_TRUE(holds(pages[1].html, "</a> gone <a"));
}

TEST(Book, WritesPagesOneFileAndAPrint) {
  std::vector<BookPage> pages = two_pages();
  connect(pages);
  const BookStyle style{"1.2", "<header></header>", "a{}", "b();",
                        "<script type=\"text/plain\" id=\"v\">d</script><script>e();</script>"};
  const fs::path folder = fs::path(testing::TempDir()) / "voussoir_book_pages";
  write_pages(folder, pages, style);
  const std::string first = read_text(folder / "index.html"), second = read_text(folder / "key-blocks.html");
  EXPECT_TRUE(holds(first, "<a href=\"key-blocks.html\">Key blocks: 3</a>"));
  EXPECT_TRUE(holds(second, "<a href=\"index.html\">up</a>"));
  EXPECT_TRUE(holds(second, "<a href=\"#key-blocks--run-2\">second</a>"));
  EXPECT_TRUE(holds(second, "src=\"pictures/key-blocks-1.svg\""));
  EXPECT_FALSE(holds(second, "<svg"));
  EXPECT_FALSE(holds(second, "viewer.js"));  // it shows no blocks
  EXPECT_TRUE(holds(read_text(folder / "pictures" / "key-blocks-1.svg"), "xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_TRUE(read_text(folder / "pictures" / "key-blocks-1.svg").ends_with("</svg><text>hidden</text></svg>"));
  EXPECT_TRUE(holds(read_text(folder / "viewer.js"), "e();"));

  const std::string file = single_file(pages, style, false), print = single_file(pages, style, true);
  EXPECT_TRUE(holds(file, "<a href=\"#key-blocks\">Key blocks: 3</a>"));
  EXPECT_TRUE(holds(file, "<svg width='2'>"));
  EXPECT_FALSE(holds(print, "<section class=\"case\" id=\"key-blocks\">"));
  EXPECT_TRUE(holds(print, "</h1>Key blocks: 3</section>"));  // its page is not printed
  EXPECT_TRUE(holds(print, "<span data-page=\"top\"></span>"));
}

TEST(Book, IndexesTheTextBelowEachAnchor) {
  std::vector<BookPage> pages = two_pages();
  connect(pages);
  const std::string script = search_index(pages);
  const std::size_t begin = script.find('{');
  const nlohmann::json index = nlohmann::json::parse(script.substr(begin, script.rfind('}') + 1 - begin));
  EXPECT_EQ(index["pages"], nlohmann::json::parse(R"([["top", "Front", ""], ["key-blocks", "Key blocks", "Cases"]])"));
  ASSERT_EQ(index["entries"].size(), 4u);
  EXPECT_EQ(index["entries"][2], nlohmann::json::parse("[1, \"key-blocks--run\", \"Run\", \"Run x < y \"]"));
  EXPECT_FALSE(holds(script, "hidden"));
}

TEST(KeyPage, GivesEveryKeyAnAnchorAndANameWithItsTable) {
  const fs::path list = fs::path(testing::TempDir()) / "voussoir_keys.md";
  const std::string table = "| key | value | unit | default | meaning |\n|---|---|---|---|---|\n";
  write_atomically(list, "# Scenes\n\n## `[[joints]]`\n\n" + table +
                             "| `dip` | number | deg | required | angle; more |\n\n# Studies\n\n" + table +
                             "| `jobs` | number | | 1 | how many |\n");
  std::vector<std::string> missing;
  EXPECT_TRUE(holds(list_page(list, 0, "keys", "Keys", "docs", missing),
                    "<tr id=\"keys-joints-dip\" data-name=\"joints.dip\">"));
  const std::string studies = list_page(list, 1, "studies", "Studies", "docs", missing);
  EXPECT_TRUE(holds(studies, "<tr id=\"studies-jobs\" data-name=\"jobs\">"));
  EXPECT_FALSE(holds(studies, "dip"));
  EXPECT_TRUE(missing.empty());

  const fs::path scene = fs::path(testing::TempDir()) / "voussoir_parameters.toml";
  write_atomically(scene, "density = 2600\n[[joints]]\nname = \"A\"\ndip = 40.5\npoint = [0, 0, -1]\n");
  const std::string parameters = parameter_table(scene, list);
  EXPECT_TRUE(holds(
      parameters, "<td>joint A</td><td><code>dip</code></td><td class=\"number\">40.5</td><td>deg</td><td>angle</td>"));
  EXPECT_TRUE(holds(parameters, "0, 0, -1"));
  EXPECT_TRUE(holds(parameters, "2600"));
  const fs::path steeper = fs::path(testing::TempDir()) / "voussoir_steeper.toml";
  write_atomically(steeper, "base = \"voussoir_parameters.toml\"\n[[joints]]\nname = \"A\"\ndip = 50\n");
  EXPECT_TRUE(holds(parameter_table(steeper, list), "<td class=\"number\">50</td>"));
  EXPECT_TRUE(holds(parameter_table(steeper, list), "2600"));
  EXPECT_EQ(parameter_table(scene.string() + ".none", list), "");
}

TEST(StiffnessPage, HasEveryCase) {
  const fs::path source = VOUSSOIR_SOURCE_DIR;
  std::set<std::string> cases = folders_of_cases();
  for (const StiffnessChoice& choice : read_stiffness_choices(source / "reports/joint_stiffness.toml"))
    EXPECT_EQ(cases.erase(choice.case_name), 1U) << choice.case_name << " is not a case";
  EXPECT_TRUE(cases.empty()) << "reports/joint_stiffness.toml lacks " << *cases.begin();
  const std::vector<std::string> pairs = stiffness_of_scenes(source / "cases" / "wedge");
  EXPECT_NE(std::find(pairs.begin(), pairs.end(), "1e+07 / 1e+06 Pa/m"), pairs.end());
}

}  // namespace
}  // namespace voussoir::reports::book_test
