#include "reports/matrix_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "reports/html.hpp"
#include "reports/verdict_tables.hpp"

namespace voussoir::reports {
namespace {

using namespace verification;

std::string join(const std::vector<std::string>& items, const char* between) {
  std::string text;
  for (const std::string& item : items)
    text += (text.empty() ? "" : between) + item;
  return text;
}

// a long name may break after a sign between its parts, and before a capital
std::string code(const std::string& text) {
  std::string broken;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool capital = std::isupper(static_cast<unsigned char>(text[k]));
    if (capital && k > 0 && std::islower(static_cast<unsigned char>(text[k - 1]))) broken += "<wbr>";
    broken += escape(std::string(1, text[k]));
    if (text[k] == '/' || text[k] == '.' || text[k] == '_') broken += "<wbr>";
  }
  return "<code>" + broken + "</code>";
}

std::string codes(const std::vector<std::string>& names) {
  std::vector<std::string> items;
  for (const std::string& name : names)
    items.push_back(code(name));
  return join(items, "<br>");
}

std::string case_link(const std::string& name, const std::string& words) {
  return fmt::format("<a href=\"#{}\">{}</a>", slug(name), escape(words));
}

std::string check_links(const std::vector<CaseChecks>& counts) {
  std::vector<std::string> items;
  for (const CaseChecks& count : counts)
    items.push_back(case_link(
        count.case_name, fmt::format("{}: {} check{}", count.case_name, count.checks, count.checks == 1 ? "" : "s")));
  return join(items, "<br>");
}

std::string table(const std::string& name, const std::vector<std::string>& head, const std::string& body) {
  std::string heads;
  for (const std::string& title : head)
    heads += "<th>" + title + "</th>";
  return fmt::format(
      "<div class=\"scroll\"><table class=\"{}\"><thead><tr>{}</tr></thead><tbody>\n{}</tbody></table></div>\n", name,
      heads, body);
}

// subject of a chapter of the thesis
std::string chapter_title(char chapter) {
  switch (chapter) {
    case '3':
      return "Chapter 3: rock slicing and contact detection";
    case '4':
      return "Chapter 4: contact laws";
    case '5':
      return "Chapter 5: supported openings";
    case '6':
      return "Chapter 6: the Vaiont slide";
    default:
      return "Appendices";
  }
}

std::string equation_row(const Matrix& matrix, const Verdicts& verdicts, const Equation& equation) {
  const EquationPlaces at = equation_places(matrix, equation);
  std::string subject = escape(equation.subject);
  for (const auto& [title, reason] : {std::pair{"Instead", equation.instead},
                                      {"Left out", equation.left_out},
                                      {"Not verified", equation.not_verified}})
    if (!reason.empty())
      subject += fmt::format("<br><span class=\"quiet\"><b>{}:</b> {}</span>", title, escape(reason));
  std::vector<std::string> files = at.code;
  files.insert(files.end(), at.references.begin(), at.references.end());
  const std::string state = verified(equation) == Verified::yes            ? ""
                            : verified(equation) == Verified::not_verified ? badge("not verified")
                                                                           : badge("left out");
  std::string tests = codes(at.tests);
  for (const std::string& part : {check_links(checks_on_equation(verdicts, equation.number)), state})
    if (!part.empty()) tests += (tests.empty() ? "" : "<br>") + part;
  return fmt::format(
      "<tr id=\"eq-{}\"><td class=\"number\">{}</td><td>{}<div "
      "class=\"formula\">{}</div></td><td>{}</td><td>{}</td></tr>\n",
      slug(equation.number), escape(equation.number), subject, equation.formula, codes(files), tests);
}

}  // namespace

std::string equations_page(const Matrix& matrix, const Verdicts& verdicts) {
  int counts[3] = {};
  for (const Equation& equation : matrix.equations)
    ++counts[static_cast<int>(verified(equation))];
  std::string text = fmt::format(
      "<p>Every numbered equation of Boon (2013): {} are in the code and verified by a test, {} are left out, {} are "
      "not verified, each with its reason. If the code does something else instead, the named tests verify that. Code "
      "and tests name equations, and this table is made of those names and of the sources of the checks; a name "
      "without equation and an equation without test are failures of <code>report.equations</code>.</p>\n",
      counts[0], counts[static_cast<int>(Verified::left_out)], counts[static_cast<int>(Verified::not_verified)]);
  for (auto equation = matrix.equations.begin(); equation != matrix.equations.end();) {
    const std::string title = chapter_title(equation->number[0]);
    std::string body;
    for (; equation != matrix.equations.end() && chapter_title(equation->number[0]) == title; ++equation)
      body += equation_row(matrix, verdicts, *equation);
    text += fmt::format("<h3>{}</h3>\n", title) + table("equations", {"Eq.", "subject", "in", "verified by"}, body);
  }
  return section("equations", "Equations by tests", text);
}

std::string room_equations(const Matrix& matrix, const std::string& room) {
  const std::string folder = fmt::format("core/{}/", room);
  std::string body;
  for (const Equation& equation : matrix.equations) {
    std::vector<std::string> files;
    for (const std::string& file : equation_places(matrix, equation).code)
      if (file.starts_with(folder)) files.push_back(file);
    if (!files.empty())
      body += fmt::format(
          "<tr><td class=\"number\"><a href=\"#eq-{}\">{}</a></td><td>{}<div "
          "class=\"formula\">{}</div></td><td>{}</td></tr>\n",
          slug(equation.number), escape(equation.number), escape(equation.subject), equation.formula, codes(files));
  }
  if (body.empty()) return {};
  return "<h3>Equations of this room</h3>\n<p>Numbers are those of Boon (2013).</p>\n" +
         table("equations", {"Eq.", "equation", "in"}, body);
}

std::string thesis_page(const Matrix& matrix) {
  std::string body;
  for (const ThesisCase& entry : matrix.thesis_cases) {
    std::vector<std::string> by;
    for (const std::string& name : entry.cases)
      by.push_back(case_link(name, name));
    for (const std::string& test : entry.tests)
      by.push_back(code(test));
    body += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", escape(entry.thesis),
                        escape(entry.subject), join(by, "<br>"), escape(entry.remark));
  }
  return section("thesis-cases", "Cases of the thesis",
                 "<p>Computations, figures and tables of Boon (2013), in its order, and our cases for them. A remark "
                 "states which parts are not repeated, and why.</p>\n" +
                     table("thesis", {"thesis", "subject", "ours", "remark"}, body));
}

std::string promises_page(const Matrix& matrix) {
  std::string body;
  for (const Promise& promise : matrix.promises) {
    std::string guards = codes(promise.tests);
    if (!promise.programs.empty()) guards += (guards.empty() ? "" : "<br>") + codes(promise.programs);
    body += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", escape(promise.readme), escape(promise.meaning),
                        guards);
  }
  return section(
      "promises", "Promises by tests",
      "<p>Promises of the README and the pages of docs, and the tests that fail when they are broken.</p>\n" +
          table("promises", {"in the pages' words", "meaning", "guarded by"}, body));
}

std::string grounds_page(const Matrix& matrix, const Verdicts& verdicts) {
  std::string text =
      "<p>A check's source names the origin of its expected value: an equation of the thesis, a closed form in "
      "<code>reference/</code>, which shares no code with the method, a published work, or a principle.</p>\n";
  for (const bool works : {true, false}) {
    std::string body;
    for (const Ground& ground : matrix.grounds)
      if (ground.is_work == works)
        body += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", escape(ground.name), escape(ground.meaning),
                            check_links(checks_on_ground(verdicts, ground.name)));
    text += fmt::format("<h3>{}</h3>\n", works ? "Works" : "Principles") +
            table("grounds", {"name", works ? "work" : "meaning", "checks"}, body);
  }
  return section("grounds", "Basis of the checks", text);
}

}  // namespace voussoir::reports
