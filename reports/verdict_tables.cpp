#include "reports/verdict_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/html.hpp"

namespace voussoir::reports {
namespace {

using namespace verification;

bool is_judged(const VerdictGroup& group) {
  return group.kinds.front() != Kind::reported;
}

std::string cost_cells(const Row& row) {
  return fmt::format("<td class=\"number\">{}</td><td class=\"number\">{:.3g}</td>", row.cost.contact_evaluations,
                     row.cost.seconds);
}

// the move since the last version of the history; no cell without a history
std::string moved_cell(const Verdicts& verdicts, const Row& row) {
  return verdicts.compared_with.empty() ? "" : "<td>" + escape(show_moved(move_of(verdicts, row))) + "</td>";
}

std::string moved_head(const Verdicts& verdicts) {
  return verdicts.compared_with.empty() ? "" : "<th>moved since " + escape(verdicts.compared_with) + "</th>";
}

std::string judged_cells(const Row& row) {
  const Check& check = row.check;
  return fmt::format(
      "<td>{}</td><td>{}</td><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
      "<td class=\"number\">{:.2e}</td><td class=\"number\">{:.2e}</td><td class=\"number\">{:.3g}</td><td>{}</td>",
      escape(check.quantity), escape(check.unit), name_of(check.kind), show_expected(check), show(row.computed),
      error_of(row), width(check.expected, check.tolerance), margin(row.computed, check), badge(verdict_of(row)));
}

constexpr const char* judged_head =
    "<th>quantity</th><th>unit</th><th>kind</th><th class=\"number\">expected</th><th class=\"number\">computed</th>"
    "<th class=\"number\">error</th><th class=\"number\">tolerance</th><th "
    "class=\"number\">margin</th><th>verdict</th>";
constexpr const char* reported_head =
    "<th>quantity</th><th>unit</th><th class=\"number\">value</th><th>verdict</th><th>note</th>";
constexpr const char* cost_head = "<th class=\"number\">contact evaluations</th><th class=\"number\">seconds</th>";

std::string reported_cells(const Row& row) {
  return fmt::format("<td>{}</td><td>{}</td><td class=\"number\">{}</td><td>{}</td><td>{}</td>",
                     escape(row.check.quantity), escape(row.check.unit), show(row.computed), badge("reported"),
                     escape(row.check.because));
}

std::string table(const std::string& head, const std::string& body) {
  return fmt::format("<div class=\"scroll\"><table><thead><tr>{}</tr></thead><tbody>\n{}</tbody></table></div>\n", head,
                     body);
}

bool among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string failure_list(const Verdicts& verdicts, const std::vector<std::string>& cases) {
  std::string items;
  for (const Failure& failure : verdicts.failures)
    if (among(cases, failure.case_name))
      items += fmt::format("<li>{} {}: {}</li>\n", badge("FAILED"), escape(failure.case_name), escape(failure.message));
  return items.empty() ? "" : "<h3>Failures outside a check</h3>\n<ul class=\"failures\">\n" + items + "</ul>\n";
}

}  // namespace

std::string badge(std::string_view verdict) {
  return fmt::format("<span class=\"verdict {}\">{}</span>", slug(verdict), escape(verdict));
}

std::string case_overview(const Verdicts& verdicts, const std::vector<std::string>& cases) {
  std::string body;
  for (const CaseStatus& status : verdicts.cases) {
    if (!among(cases, status.name)) continue;
    int failed = 0, reported = 0, verified = 0, validated = 0, drift = 0;
    long long contact_evaluations = 0;
    for (const Row& row : verdicts.rows) {
      if (row.case_name != status.name) continue;
      // several checks may judge one run, so their costs must not be added
      contact_evaluations = std::max(contact_evaluations, row.cost.contact_evaluations);
      if (row.check.kind == Kind::reported)
        ++reported;
      else if (!passed(row))
        ++failed;
      else
        ++(row.check.kind == Kind::published ? validated : row.check.kind == Kind::drift ? drift : verified);
    }
    for (const Failure& failure : verdicts.failures)
      failed += failure.case_name == status.name;

    const std::string state = failed > 0                         ? "FAILED"
                              : status.state != CaseState::run   ? std::string(name_of(status.state))
                              : verified + validated + drift > 0 ? "passed"
                                                                 : "reported";
    body += fmt::format(
        "<tr><td><a href=\"#{}\">{}</a></td><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
        "<td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td "
        "class=\"number\">{}</td></tr>\n",
        slug(status.name), escape(status.name), badge(state), verified, validated, drift, failed, reported,
        contact_evaluations);
  }
  return table(
      "<th>case</th><th>verdict</th><th class=\"number\">verification passed</th>"
      "<th class=\"number\">validation passed</th><th class=\"number\">drift passed</th><th "
      "class=\"number\">failed</th>"
      "<th class=\"number\">reported</th><th class=\"number\">contact evaluations, costliest run</th>",
      body);
}

std::string answer_table(const Verdicts& verdicts, const std::string& case_name) {
  constexpr int most = 5;
  int judged = 0;
  std::string body;
  for (const Row& row : verdicts.rows)
    if (row.case_name == case_name && row.check.kind != Kind::reported && ++judged <= most)
      body += fmt::format(
          "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td>{}</td><td>{}</td><td>{}</td>"
          "</tr>\n",
          escape(row.check.quantity), show(row.computed), show_expected(row.check), escape(row.check.unit),
          escape(row.check.source), badge(verdict_of(row)));
  if (judged == 0) return {};
  return table(
             "<th>quantity</th><th class=\"number\">computed</th><th class=\"number\">expected</th><th>unit</th>"
             "<th>source</th><th>verdict</th>",
             body) +
         fmt::format("<p class=\"quiet\">{} of {} checks; <a href=\"#{}-checks\">all, with their tolerances</a></p>\n",
                     std::min(judged, most), judged, slug(case_name));
}

std::string tables_of(const Verdicts& verdicts, const std::vector<std::string>& cases) {
  std::string text = failure_list(verdicts, cases);
  for (const VerdictGroup& group : verdict_groups()) {
    std::string body, above;
    for (const Row& row : verdicts.rows) {
      if (!among(cases, row.case_name) || !belongs_to(row, group)) continue;
      if (row.case_name != above)
        body += fmt::format("<tr class=\"of\"><th colspan=\"12\"><a href=\"#{}\">{}</a></th></tr>\n",
                            slug(row.case_name), escape(row.case_name));
      above = row.case_name;
      body +=
          "<tr>" + (is_judged(group) ? judged_cells(row) : reported_cells(row)) + moved_cell(verdicts, row) + "</tr>\n";
    }
    if (body.empty()) continue;
    text += fmt::format("<h3>{}</h3>\n<p>{}</p>\n", group.title, escape(group.explanation));
    text += table(std::string(is_judged(group) ? judged_head : reported_head) + moved_head(verdicts), body);
  }
  return text;
}

std::string case_tables(const Verdicts& verdicts, const std::string& case_name) {
  std::string text = failure_list(verdicts, {case_name});
  for (const VerdictGroup& group : verdict_groups()) {
    std::string body;
    for (const Row& row : verdicts.rows) {
      if (row.case_name != case_name || !belongs_to(row, group)) continue;
      if (!is_judged(group)) {
        body += "<tr>" + reported_cells(row) + cost_cells(row) + moved_cell(verdicts, row) + "</tr>\n";
        continue;
      }
      body += fmt::format(
          "<tr class=\"check\">{}{}{}</tr>\n<tr class=\"reason\"><td colspan=\"12\"><b>Source</b> {}. <b>Tolerance</b> "
          "because {}. <span class=\"quiet\">Commit {}</span></td></tr>\n",
          judged_cells(row), cost_cells(row), moved_cell(verdicts, row), escape(row.check.source),
          escape(row.check.because), escape(row.commit));
    }
    if (body.empty()) continue;
    text += fmt::format("<h4>{}</h4>\n", group.title);
    text += table(std::string(is_judged(group) ? judged_head : reported_head) + cost_head + moved_head(verdicts), body);
  }
  return text;
}

}  // namespace voussoir::reports
