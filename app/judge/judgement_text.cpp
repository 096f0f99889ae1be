#include "app/judge/judgement_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/csv_table.hpp"

namespace voussoir {
namespace {

constexpr JudgedAs verdicts_in_order[] = {JudgedAs::passed,       JudgedAs::failed,    JudgedAs::not_run,
                                          JudgedAs::cannot_state, JudgedAs::not_asked, JudgedAs::faulty};

std::string escaped_html(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

// a cell of a Markdown table
std::string escaped_cell(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string shown_right(const JudgedRow& row) {
  if (!row.lower) return {};
  return *row.lower == *row.upper ? fmt::format("{:.7g}", *row.lower)
                                  : fmt::format("{:.7g} to {:.7g}", *row.lower, *row.upper);
}

std::string shown_answer(const JudgedRow& row) {
  if (!row.value) return std::string(name_of(row.verdict));
  if (!row.error) return fmt::format("{:.7g} (not asked)", *row.value);
  return fmt::format("{:.7g} ({:+.2g}){}", *row.value, *row.error,
                     row.verdict == JudgedAs::failed ? " **FAILED**" : "");
}

// the rows of one question, one for each code
using Question = std::vector<const JudgedRow*>;

std::vector<Question> questions_of(const Judgement& judgement) {
  std::vector<Question> questions;
  for (const JudgedRow& row : judgement.rows) {
    if (questions.empty() || questions.back().front()->problem != row.problem ||
        questions.back().front()->quantity != row.quantity)
      questions.emplace_back();
    questions.back().push_back(&row);
  }
  return questions;
}

// what is right, by model if the codes' models differ
std::string right_of(const Question& question) {
  std::vector<std::string> seen;
  for (const JudgedRow* row : question)
    if (const std::string right = shown_right(*row); !right.empty() && std::ranges::find(seen, right) == seen.end())
      seen.push_back(right);
  std::string text;
  for (const std::string& right : seen)
    text += (text.empty() ? "" : "; ") + right;
  return text;
}

std::string tolerance_of(const Question& question) {
  for (const JudgedRow* row : question)
    if (row->tolerance) return fmt::format("{:.2g}", *row->tolerance);
  return {};
}

}  // namespace

std::string judgement_counts(const Judgement& judgement, const std::string& code) {
  std::string text;
  for (const JudgedAs verdict : verdicts_in_order) {
    const auto number = std::ranges::count_if(judgement.rows, [&](const JudgedRow& row) {
      return row.verdict == verdict && (code.empty() || row.code == code);
    });
    const std::string name = verdict == JudgedAs::failed ? "failed" : std::string(name_of(verdict));
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", number, name);
  }
  return text;
}

std::string judgement_markdown(const Judgement& judgement) {
  std::string text =
      "# Codes judged\n\nValue (error from the nearer end of what is right). Codes with joint stiffness and rigid "
      "ones have references of their own.\n\n| problem | quantity | unit | right | tolerance |";
  std::string rule = "|---|---|---|---|---|";
  for (const std::string& code : judgement.codes) {
    text += " " + escaped_cell(code) + " |";
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (const Question& question : questions_of(judgement)) {
    const JudgedRow& first = *question.front();
    text += fmt::format("| {} | {} | {} | {} | {} |", first.problem, escaped_cell(first.quantity), first.unit,
                        right_of(question), tolerance_of(question));
    for (const JudgedRow* row : question)
      text += " " + escaped_cell(shown_answer(*row)) + " |";
    text += "\n";
  }
  text += "\n";
  for (const std::string& code : judgement.codes)
    text += fmt::format("- {}: {}.\n", code, judgement_counts(judgement, code));
  for (const JudgedRow& row : judgement.rows)
    if (row.verdict == JudgedAs::cannot_state)
      text += fmt::format("- {} cannot state {}, {}: {}\n", row.code, row.problem, row.quantity, row.note);
  if (!judgement.faults.empty()) text += "\n## Faults of the files\n\n";
  for (const std::string& fault : judgement.faults)
    text += "- " + fault + "\n";
  return text;
}

std::string judgement_html(const Judgement& judgement, const std::string& figure) {
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Codes "
      "judged</title><style>body{font:15px "
      "sans-serif;margin:2em}table{border-collapse:collapse}td,th{border:1px solid #bbb;padding:3px "
      "8px;text-align:left}"
      ".passed{background:#dff0d8}.FAILED,.faulty{background:#f6c9c9}.not,.cannot{color:#777}</style></head><body>\n"
      "<h1>Codes "
      "judged</h1>\n<table><tr><th>problem</th><th>quantity</th><th>unit</th><th>right</th><th>tolerance</th>";
  for (const std::string& code : judgement.codes)
    text += "<th>" + escaped_html(code) + "</th>";
  text += "</tr>\n";
  for (const Question& question : questions_of(judgement)) {
    const JudgedRow& first = *question.front();
    text +=
        fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>", escaped_html(first.problem),
                    escaped_html(first.quantity), escaped_html(first.unit), right_of(question), tolerance_of(question));
    for (const JudgedRow* row : question) {
      std::string shown = shown_answer(*row);
      if (const std::size_t mark = shown.find(" **"); mark != std::string::npos) shown.resize(mark);
      text += fmt::format("<td class=\"{}\" title=\"{}\">{}</td>", name_of(row->verdict),
                          escaped_html(row->note.empty() ? row->because : row->note), escaped_html(shown));
    }
    text += "</tr>\n";
  }
  text += "</table>\n<ul>\n";
  for (const std::string& code : judgement.codes)
    text += fmt::format("<li>{}: {}</li>\n", escaped_html(code), judgement_counts(judgement, code));
  for (const std::string& fault : judgement.faults)
    text += "<li>" + escaped_html(fault) + "</li>\n";
  return text + "</ul>\n" + figure + "</body></html>\n";
}

std::string judgement_csv(const Judgement& judgement) {
  std::string text = "problem,quantity,unit,code,verdict,value,lower,upper,error,tolerance,seconds,note\n";
  for (const JudgedRow& row : judgement.rows)
    text += csv_line({row.problem, row.quantity, row.unit, row.code, std::string(name_of(row.verdict))}) + "," +
            csv_cell(row.value) + "," + csv_cell(row.lower) + "," + csv_cell(row.upper) + "," + csv_cell(row.error) +
            "," + csv_cell(row.tolerance) + "," + csv_cell(row.seconds) + "," + csv_cell(row.note) + "\n";
  return text;
}

}  // namespace voussoir
