#include "verification/csv.hpp"

#include <stdexcept>

namespace voussoir::verification {

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) line += ',';
    if (fields[i].find_first_of(",\"\r\n") == std::string::npos) {
      line += fields[i];
      continue;
    }
    line += '"';
    for (const char character : fields[i]) {
      if (character == '"') line += '"';
      line += character;
    }
    line += '"';
  }
  return line;
}

std::vector<std::vector<std::string>> parse_csv(std::string_view text) {
  std::vector<std::vector<std::string>> records;
  std::vector<std::string> record;
  std::string field;
  bool quoted = false;

  const auto end_record = [&] {
    record.push_back(std::move(field));
    field.clear();
    if (record.size() > 1 || !record.front().empty()) records.push_back(std::move(record));
    record.clear();
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char character = text[i];
    if (quoted) {
      if (character != '"')
        field += character;
      else if (i + 1 < text.size() && text[i + 1] == '"')
        field += text[++i];
      else
        quoted = false;
    } else if (character == '"') {
      quoted = true;
    } else if (character == ',') {
      record.push_back(std::move(field));
      field.clear();
    } else if (character == '\n') {
      end_record();
    } else if (character != '\r') {
      field += character;
    }
  }
  if (quoted) throw std::runtime_error("a quoted field is not closed before the end of the text");
  if (!field.empty() || !record.empty()) end_record();
  return records;
}

}  // namespace voussoir::verification
