#include "app/judge/answer_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "core/base/bad_input.hpp"
#include "text/csv_table.hpp"
#include "text/read_file.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_bytes = 5'000'000;
constexpr const char* unfilled_code = "NAME VERSION";  // as the file is handed out
constexpr const char* unfilled_model = "rigid | joint stiffness";

std::string text_of(const fs::path& file) {
  try {
    return read_file(file, most_bytes);
  } catch (const ReadFault& fault) {
    throw BadInput(fmt::format("{}: {}", file.string(), fault.what()));
  }
}

std::string trimmed_text(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin));
}

struct Head {
  std::string code, model, setting;
  int model_line = 0;
};

// reads the comment lines and blanks them, so that the rows keep their line numbers
Head take_head(std::string& text) {
  Head head;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = trimmed_text(std::string_view(text).substr(begin, end - begin));
    ++number;
    if (line.starts_with("#")) {
      const std::string comment = trimmed_text(std::string_view(line).substr(1));
      const auto take = [&](std::string_view key, std::string& value) {
        if (!comment.starts_with(key)) return false;
        value = trimmed_text(std::string_view(comment).substr(key.size()));
        return true;
      };
      take("code:", head.code);
      take("setting:", head.setting);
      if (take("model:", head.model)) head.model_line = number;
      text.replace(begin, end - begin, end - begin, ' ');
    }
    begin = end + 1;
  }
  return head;
}

AnswerModel model_of(const Head& head, const fs::path& file) {
  if (head.model == "rigid") return AnswerModel::rigid;
  if (head.model == "joint stiffness") return AnswerModel::joint_stiffness;
  throw BadInput(
      fmt::format("{}:{}: model = '{}': write '# model: rigid' or '# model: joint stiffness' above the header",
                  file.string(), std::max(1, head.model_line), head.model));
}

// a number, or the fault that it is not one
void read_number(const CsvTable& table, const CsvRow& row, AnswerRow& answer) {
  try {
    answer.value = table.required_number(row, "value");
    answer.kind = std::isfinite(answer.value) ? AnswerKind::number : AnswerKind::faulty;
  } catch (const FileFault& fault) {
    answer.kind = AnswerKind::faulty;
    answer.fault = fault.what();
  }
}

AnswerRow read_row(const CsvTable& table, const CsvRow& row) {
  AnswerRow answer;
  answer.line = row.line;
  answer.quantity = table.text(row, "quantity");
  answer.unit = table.text(row, "unit");
  answer.note = table.text(row, "note");
  const std::string value = table.text(row, "value");
  if (value == "cannot state") {
    answer.kind = answer.note.empty() ? AnswerKind::faulty : AnswerKind::cannot_state;
    if (answer.note.empty()) answer.fault = "value = 'cannot state' without a reason: state it in the column note";
  } else if (!value.empty()) {
    read_number(table, row, answer);
  }
  try {
    answer.seconds = table.number(row, "seconds");
    if (answer.seconds && *answer.seconds < 0) throw FileFault(row.line, 0, "seconds < 0: state processor time");
  } catch (const FileFault& fault) {
    answer.seconds.reset();
    answer.kind = AnswerKind::faulty;
    answer.fault = fault.what();
  }
  return answer;
}

using Json = nlohmann::json;

ProblemReference reference_of(const Json& json, bool interval) {
  ProblemReference reference;
  reference.lower = json.at(interval ? "lower" : "value").get<double>();
  reference.upper = json.at(interval ? "upper" : "value").get<double>();
  reference.tolerance.absolute = json.at("absolute").get<double>();
  reference.tolerance.relative = json.at("relative").get<double>();
  reference.because = json.at("because").get<std::string>();
  reference.source = json.at("source").get<std::string>();
  return reference;
}

// a tolerance that accepts everything, or an interval without inside, would make every answer right or wrong
void require_sound(const ProblemReference& r, const std::string& quantity) {
  const verification::Tolerance& t = r.tolerance;
  if (!std::isfinite(r.lower) || !std::isfinite(r.upper) || r.lower > r.upper)
    throw std::invalid_argument("'" + quantity + "': lower and upper must be finite, and in this order");
  if (!(t.absolute >= 0) || !(t.relative >= 0) || !std::isfinite(t.absolute) || t.relative >= 1)
    throw std::invalid_argument("'" + quantity + "': a tolerance must be 0 or more, a relative one below 1");
}

}  // namespace

AnswerFile read_answer(const fs::path& file) {
  std::string text = text_of(file);
  const Head head = take_head(text);
  AnswerFile answer;
  answer.file = file;
  answer.code = head.code;
  answer.setting = head.setting;
  try {
    const CsvTable table = parse_csv(text);
    table.check_header({"quantity", "unit", "value"}, {"seconds", "note"});
    for (const CsvRow& row : table.rows) {
      answer.rows.push_back(read_row(table, row));
      answer.empty = answer.empty && answer.rows.back().kind == AnswerKind::not_run;
    }
  } catch (const FileFault& fault) {
    throw BadInput(fmt::format("{}:{}: {}", file.string(), fault.line, fault.what()));
  }
  answer.empty = answer.empty && (head.code == unfilled_code || head.code.empty()) &&
                 (head.model == unfilled_model || head.model.empty());
  if (answer.empty) return answer;
  if (head.code.empty() || head.code == unfilled_code)
    throw BadInput(
        fmt::format("{}:1: code = '{}': write '# code: name version' above the header", file.string(), head.code));
  answer.model = model_of(head, file);
  return answer;
}

ReferenceFile read_reference(const fs::path& file) {
  try {
    const Json json = Json::parse(text_of(file));
    if (json.at("format") != "voussoir reference 1")
      throw std::invalid_argument("format is not 'voussoir reference 1'");
    ReferenceFile reference;
    reference.problem = json.at("name").get<std::string>();
    for (const Json& one : json.at("quantities")) {
      ReferenceRow row;
      row.quantity = one.at("quantity").get<std::string>();
      row.unit = one.at("unit").get<std::string>();
      if (!one.at("joints").is_null()) row.joints = reference_of(one.at("joints"), false);
      if (!one.at("rigid").is_null()) row.rigid = reference_of(one.at("rigid"), true);
      for (const auto* r : {&row.joints, &row.rigid})
        if (*r) require_sound(**r, row.quantity);
      reference.rows.push_back(row);
    }
    return reference;
  } catch (const Json::exception& fault) {
    throw BadInput(fmt::format("{}: {}; write the problem files again", file.string(), fault.what()));
  } catch (const std::invalid_argument& fault) {
    throw BadInput(fmt::format("{}: {}; write the problem files again", file.string(), fault.what()));
  }
}

}  // namespace voussoir
