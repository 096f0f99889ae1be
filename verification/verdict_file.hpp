#pragma once
// One file of verdict rows per case: written by the case's test, read by the summary.
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "verification/row.hpp"

namespace voussoir::verification {

struct CaseFile {
  std::string case_name;
  std::vector<Row> rows;                        // in the order in which they were recorded
  std::map<std::string, std::string> failures;  // by test name: failures there that no row reports
};

nlohmann::json to_json(const Row& row);

// Throws std::runtime_error, naming the missing field, or when the stored verdict differs from the rule's for the
// numbers.
Row row_from_json(const nlohmann::json& text);

// Throws std::runtime_error, naming the file, when it is missing, empty, not JSON, of another case or has a row twice.
CaseFile read_case_file(const std::filesystem::path& path);

// Puts the rows into the file (same case and quantity: replaced), under a lock, so that programs may do so at the same
// time. `test` is the test that recorded them: its earlier failure is replaced by `failure`, or removed when that is
// empty.
void merge_into_case_file(const std::filesystem::path& path, const std::string& case_name, const std::vector<Row>& rows,
                          const std::string& test, const std::string& failure);

// Writes beside the target and renames, so that a reader never reads half a file. Throws std::runtime_error.
void write_atomically(const std::filesystem::path& path, const std::string& text);

// Reads, changes and writes a JSON file under a lock; starts from an empty object when there is no file.
void update_json(const std::filesystem::path& path, const std::function<void(nlohmann::json&)>& change);

// The whole text; throws std::runtime_error naming the file when it cannot be read.
std::string read_text(const std::filesystem::path& path);

}  // namespace voussoir::verification
