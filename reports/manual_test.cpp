// unit.manual: the pieces of the manual, and a page made from a hand-made case folder.
#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <filesystem>
#include <set>
#include <stdexcept>

#include "reports/case_page.hpp"
#include "reports/html.hpp"
#include "reports/kernel_page.hpp"
#include "reports/text_page.hpp"
#include "reports/trade_page.hpp"
#include "reports/verdict_tables.hpp"

namespace voussoir::reports::manual_test {
namespace {

namespace fs = std::filesystem;
using namespace verification;

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::string svg =
    "<?xml version=\"1.0\"?>\n<svg xmlns:xlink='x'><defs><circle id='gpDot'/></defs><use xlink:href='#gpDot'/></svg>\n";

TEST(Html, EscapesAndNames) {
  EXPECT_EQ(escape("a<b & \"c\""), "a&lt;b &amp; &quot;c&quot;");
  EXPECT_EQ(slug("Not yet modelled"), "not-yet-modelled");
  EXPECT_EQ(slug("scene.toml"), "scene-toml");
}

TEST(Html, RendersTablesShiftsHeadingsAndDropsRawHtml) {
  const std::string text = "# Title\n\n## Problem\n\n| a | b |\n|---|--:|\n| 1 | 2 |\n\n<script>alert(1)</script>\n";
  const std::string html = markdown_to_html(text, 1, true);
  EXPECT_FALSE(holds(html, "Title"));
  EXPECT_TRUE(holds(html, "<h3>Problem</h3>"));
  EXPECT_TRUE(holds(html, "<td align=\"right\">2</td>"));
  EXPECT_FALSE(holds(html, "<script>"));
  EXPECT_EQ(markdown_title(text), "Title");
  EXPECT_EQ(markdown_title("no title"), std::nullopt);
}

std::string with_rules(const std::string& markdown) {
  return markdown_to_html(
      markdown, 0, false,
      {[](const std::string& target) { return target == "drop" ? std::nullopt : std::optional("#" + target); },
       [](const std::string& target, const std::string& caption) -> std::optional<std::string> {
         return target == "drop" ? std::nullopt : std::optional("<figure>" + target + ": " + caption + "</figure>");
       }});
}

// inputs that would break regular expressions over HTML: code, quotes, brackets, links in tables, around pictures and
// in captions
TEST(Html, ChangesLinksAndPicturesInTheTree) {
  EXPECT_EQ(with_rules("[a](x) and [b *c*](drop)"), "<p><a href=\"#x\">a</a> and b <em>c</em></p>\n");
  EXPECT_EQ(with_rules("| t |\n|---|\n| [a](x) |\n").find("<a href=\"x\">"), std::string::npos);
  EXPECT_TRUE(
      holds(with_rules("`<a href=\"x\">y</a>` and `![p](q)`"), "<code>&lt;a href=&quot;x&quot;&gt;y&lt;/a&gt;</code>"));
  EXPECT_EQ(with_rules("![one](p)"), "<figure>p: one</figure>\n");
  EXPECT_EQ(with_rules("![one](p)\n![two `<x>` \"q\"](q)\n"),
            "<figure>p: one</figure>\n<figure>q: two <code>&lt;x&gt;</code> &quot;q&quot;</figure>\n");
  EXPECT_EQ(with_rules("words ![p](q) more"), "<p>words <figure>q: p</figure> more</p>\n");
  EXPECT_EQ(with_rules("words ![p](drop) more"), "<p>words  more</p>\n");
  EXPECT_EQ(with_rules("![see [a](x), ![inner](i)](p)"),
            "<figure>p: see <a href=\"#x\">a</a>, <figure>i: inner</figure></figure>\n");
  EXPECT_EQ(with_rules("> # T\n\n[![p](q)](x)\n").find("<img"), std::string::npos);
  // without rules they stay
  EXPECT_EQ(markdown_to_html("[a](x) ![p](q)"), "<p><a href=\"x\">a</a> <img src=\"q\" alt=\"p\" /></p>\n");
}

TEST(Html, MakesIdsOfAFigureUnique) {
  const fs::path path = fs::path(testing::TempDir()) / "voussoir_figure.svg";
  write_atomically(path, svg);
  const std::string text = inline_svg(path, "wedge");
  EXPECT_TRUE(text.starts_with("<svg"));
  EXPECT_TRUE(holds(text, "id='wedge-gpDot'"));
  EXPECT_TRUE(holds(text, "href='#wedge-gpDot'"));
  write_atomically(path, "");
  EXPECT_THROW(inline_svg(path, "wedge"), std::runtime_error);
}

TEST(Html, WritesOnceTheAttributesThatGnuplotRepeats) {
  const fs::path path = fs::path(testing::TempDir()) / "voussoir_figure.svg";
  const std::string font = "font-family=\"DejaVu Sans,Helvetica,Arial,sans-serif\"";
  write_atomically(
      path,
      "<svg><g id=\"gnuplot_plot_1\" ><title>gnuplot_plot_1</title>\n<g fill=\"none\" color=\"black\" "
      "stroke=\"currentColor\" stroke-width=\"0.80\" stroke-linecap=\"butt\" stroke-linejoin=\"miter\">\n\t"
      "<path stroke='rgb(  0, 114, 178)'  d='M1,2 \t\n\tL3,4'/></g></g>\n<title>of mine</title><text " +
          font + ">rgb(1)</text></svg>\n");
  EXPECT_EQ(inline_svg(path, "a"),
            "<svg " + font +
                "><g id=\"a-gnuplot_plot_1\" > <g class=\"line\" stroke-width=\"0.80\"> "
                "<path stroke='#0072b2' d='M1,2 L3,4'/></g></g> <title>of mine</title><text>rgb(1)</text></svg>");
}

TEST(Html, KeepsTheFontOfADrawingThatHasOne) {
  const fs::path path = fs::path(testing::TempDir()) / "voussoir_figure.svg";
  write_atomically(path, "<svg width='2' font-family=\"serif\"><g/></svg>");
  EXPECT_EQ(inline_svg(path, "a"), "<svg width='2' font-family=\"serif\"><g/></svg>");
}

TEST(TextPage, LinksToCasesAndTheirScenes) {
  const fs::path root = fs::path(testing::TempDir()) / "voussoir_text_page_test";
  write_atomically(root / "reports/water.md",
                   "# Of water\n\n## Loads\n\n[case](../cases/water/README.md), [scene](../cases/water/raft.toml), "
                   "[notes](../cases/water/NOTES.md), [elsewhere](../core/README.md)\n\n![A raft.](raft.svg)\n");
  std::vector<std::string> missing;
  const std::string page = text_page({root, root / "build"}, "reports/water.md", "of-water", missing);
  EXPECT_TRUE(holds(page, "id=\"of-water\""));
  EXPECT_TRUE(holds(page, "<h2>Of water</h2>"));
  EXPECT_TRUE(holds(page, "<h3>Loads</h3>"));
  EXPECT_TRUE(holds(page, "href=\"#water\""));
  EXPECT_TRUE(holds(page, "href=\"#water-raft-toml\""));
  EXPECT_TRUE(holds(page, "href=\"#water-notes\""));
  EXPECT_FALSE(holds(page, "core/README.md"));
  EXPECT_TRUE(holds(page, "The figure raft was not drawn."));
  EXPECT_EQ(missing, std::vector<std::string>{"of-water: The figure raft was not drawn."});
}

TEST(CasePage, ShowsExistingPartsAndNamesMissingOnes) {
  const fs::path root = fs::path(testing::TempDir()) / "voussoir_page_test";
  fs::remove_all(root);
  const Folders folders{root, root / "build"};
  write_atomically(root / "cases/wedge/README.md",
                   "# Sliding wedge\n\n## Result\n\n![It slides.](wedge.svg)\n\nSee [the scene](scene.toml), "
                   "[slump](../slump/README.md) and [the code](wedge_test.cpp).\n");
  write_atomically(root / "cases/wedge/scene.toml", "a = 1 # < 2\n");
  write_atomically(root / "cases/wedge/wedge.gp", "");
  write_atomically(root / "cases/wedge/other.gp", "");
  write_atomically(root / "build/reports/figures/wedge.svg", svg);

  Verdicts verdicts;
  verdicts.cases = {{"wedge", CaseState::run}};
  verdicts.rows = {
      {"wedge", {"angle", "deg", Kind::exact, "Author 1999", 30.0, {0.1, 0.0}, "two < three"}, 31.0, {}, "abc"}};
  std::vector<std::string> missing;
  const std::string page = case_page(folders, verdicts, verdicts.cases[0], missing);

  EXPECT_TRUE(holds(page, "<h2>Sliding wedge</h2>"));
  EXPECT_TRUE(holds(page, "wedge-wedge-gpDot"));
  EXPECT_TRUE(holds(page, "<figcaption>It slides.</figcaption>"));
  EXPECT_TRUE(holds(page, "href=\"#wedge-scene-toml\""));
  EXPECT_TRUE(holds(page, "href=\"#slump\""));
  EXPECT_FALSE(holds(page, "href=\"wedge_test.cpp\""));
  EXPECT_TRUE(holds(page, "because two &lt; three"));
  EXPECT_TRUE(holds(page, badge("FAILED")));
  EXPECT_TRUE(holds(page, "a = 1 # &lt; 2"));
  EXPECT_TRUE(holds(page, "The figure other was not drawn."));
  EXPECT_EQ(missing.size(), 1u);

  missing.clear();
  EXPECT_TRUE(holds(case_page(folders, verdicts, {"slump", CaseState::not_run}, missing), badge("not run")));
  EXPECT_EQ(missing.size(), 2u);  // no README.md, no check
  missing.clear();
  EXPECT_TRUE(holds(case_page(folders, verdicts, {"tunnel", CaseState::not_modelled}, missing), "not yet modelled"));
}

// every case shows its blocks, or states why it has none to show
TEST(Views, NameEveryCaseOnce) {
  const fs::path source = VOUSSOIR_SOURCE_DIR;
  const toml::table views = toml::parse_file((source / "reports" / "views.toml").string());
  std::set<std::string> shown, without;
  for (const toml::node& view : *views["view"].as_array()) {
    const toml::table& table = *view.as_table();
    const std::string name = table["case"].value_or(""), scene = table["scene"].value_or("");
    shown.insert(name);
    EXPECT_TRUE(fs::exists(source / "cases" / name / scene)) << name << "/" << scene;
    EXPECT_NE(table["look"].value_or(std::string()), "") << name;
    EXPECT_TRUE(std::string(table["caption"].value_or("")).ends_with(".")) << name;
  }
  for (const auto& [name, reason] : *views["without"].as_table()) {
    without.insert(std::string(name.str()));
    EXPECT_NE(reason.value_or(std::string()), "") << name.str();
    EXPECT_FALSE(shown.contains(std::string(name.str()))) << name.str();
  }
  for (const auto& entry : fs::directory_iterator(source / "cases"))
    if (fs::exists(entry.path() / "README.md")) {
      const std::string name = entry.path().filename().string();
      EXPECT_EQ(shown.erase(name) + without.erase(name), 1U) << name << " is not in reports/views.toml";
    }
  EXPECT_TRUE(shown.empty() && without.empty()) << "reports/views.toml names something that is not a case";
}

TEST(CasePage, ShowsTheNotesBehindTheCase) {
  const fs::path root = fs::path(testing::TempDir()) / "voussoir_notes_test";
  fs::remove_all(root);
  const Folders folders{root, root / "build"};
  write_atomically(root / "cases/wedge/README.md", "# Sliding wedge\n\n## Result\n\nIt slides ([notes](NOTES.md)).\n");
  write_atomically(root / "cases/wedge/scene.toml", "a = 1\n");
  write_atomically(root / "cases/wedge/trials.gp", "");
  std::vector<std::string> missing;
  const CaseStatus wedge{"wedge", CaseState::run};
  EXPECT_FALSE(holds(case_page(folders, {}, wedge, missing), "id=\"wedge-notes\""));

  write_atomically(root / "cases/wedge/NOTES.md",
                   "# Wedge: notes\n\n## Trials\n\n![Trials.](trials.svg)\n\nOf [the case](README.md), "
                   "[slump](../slump/README.md), [its notes](../slump/NOTES.md), [core](../../core/step/README.md).\n");
  write_atomically(root / "build/reports/figures/trials.svg", svg);
  const std::string page = case_page(folders, {}, wedge, missing);
  EXPECT_TRUE(holds(page, "<h3 id=\"wedge-notes\">Notes</h3>"));
  EXPECT_TRUE(holds(page, "<summary>Wedge: notes</summary>"));
  EXPECT_TRUE(holds(page, "<h4>Trials</h4>"));
  EXPECT_GT(page.find("wedge-notes\">Notes"), page.find("a = 1"));
  EXPECT_TRUE(holds(page, "href=\"#wedge-notes\""));
  EXPECT_TRUE(holds(page, "href=\"#wedge\""));
  EXPECT_TRUE(holds(page, "href=\"#slump\""));
  EXPECT_TRUE(holds(page, "href=\"#slump-notes\""));
  EXPECT_FALSE(holds(page, "href=\"#step\""));
  // the figure is shown once, where the notes name it
  EXPECT_TRUE(holds(page, "<figcaption>Trials.</figcaption>"));
  EXPECT_FALSE(holds(page, "<h3>Figures</h3>"));
}

TEST(KernelPage, ShowsTheRunAndNamesMissingParts) {
  const fs::path root = fs::path(testing::TempDir()) / "voussoir_kernel_page_test";
  fs::remove_all(root);
  const Folders folders{root, root / "build"};
  write_atomically(root / "reports/contact_kernel.md", "# Kernel\n\n## Result\n\n![Time.](contact_planes.svg)\n");
  std::vector<std::string> missing;
  std::string page = kernel_page(folders, missing);
  EXPECT_EQ(missing.size(), 3u);  // a figure and two tables
  EXPECT_TRUE(holds(page, "The figure contact_planes was not drawn."));

  write_atomically(root / "build/reports/figures/contact_planes.svg", svg);
  write_atomically(root / "build/reports/benchmarks/contact_summary.md", "| peer | ns |\n|---|--:|\n| libccd | 42 |\n");
  write_atomically(root / "build/reports/benchmarks/contact_times.md", "### Near\n");
  missing.clear();
  page = kernel_page(folders, missing);
  EXPECT_TRUE(missing.empty());
  EXPECT_TRUE(holds(page, "id=\"contact-kernel\""));
  EXPECT_TRUE(holds(page, "<figcaption>Time.</figcaption>"));
  EXPECT_TRUE(holds(page, "<td align=\"right\">42</td>"));
}

TEST(TradePage, ShowsTheComparisonAndNamesMissingParts) {
  const fs::path root = fs::path(testing::TempDir()) / "voussoir_trade_page_test";
  fs::remove_all(root);
  const Folders folders{root, root / "build"};
  std::vector<std::string> missing;
  EXPECT_TRUE(holds(trade_page(folders, missing), "No study was compared"));
  EXPECT_EQ(missing.size(), 1u);

  const fs::path studies = root / "build/reports/studies";
  write_atomically(studies / "trade.md",
                   "![All.](trade.svg)\n\n### Orders\n\n| [wedge](../wedge/README.md) |\n|---|\n");
  missing.clear();
  EXPECT_TRUE(holds(trade_page(folders, missing), "The figure trade was not drawn."));
  EXPECT_EQ(missing.size(), 1u);

  write_atomically(studies / "trade.svg", svg);
  missing.clear();
  const std::string page = trade_page(folders, missing);
  EXPECT_TRUE(missing.empty());
  EXPECT_TRUE(holds(page, "id=\"what-accuracy-costs\""));
  EXPECT_TRUE(holds(page, "<figcaption>All.</figcaption>"));
  EXPECT_TRUE(holds(page, "<h3>Orders</h3>"));
  EXPECT_TRUE(holds(page, "href=\"#wedge\"")) << page;
}

TEST(ChecksPage, NamesMissingParts) {
  const fs::path root = fs::path(testing::TempDir()) / "voussoir_checks_page_test";
  fs::remove_all(root);
  const Folders folders{root, root / "build"};
  std::vector<std::string> missing;
  EXPECT_TRUE(holds(checks_page(folders, missing), "The checks were not gathered"));
  EXPECT_EQ(missing.size(), 1u);
  const fs::path checks = root / "build/reports/checks";
  write_atomically(checks / "checks.md", "![All.](checks_values.svg)\n");
  write_atomically(checks / "checks_values.svg", svg);
  missing.clear();
  EXPECT_TRUE(holds(checks_page(folders, missing), "<figcaption>All.</figcaption>"));
  EXPECT_TRUE(missing.empty());
}

}  // namespace
}  // namespace voussoir::reports::manual_test
