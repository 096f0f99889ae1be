#include "app/run_folder/results_hash.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "app/base/digest.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "core/output/atomic_file.hpp"
#include "text/csv_table.hpp"
#include "text/plain_text.hpp"
#include "text/read_file.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

constexpr const char *results_file = "results.json", *history_file = "history.csv";
constexpr std::uintmax_t largest_hashes = 1 << 16;     // bytes
constexpr std::size_t most_history_columns = 100'000;  // more than any scene has

bool file_stands(const fs::path& file) {
  std::error_code error;
  return fs::exists(file, error);
}

std::optional<std::string> bytes_of_file(const fs::path& file, std::uintmax_t most) {
  try {
    return read_file(file, most);
  } catch (const ReadFault&) {
    return std::nullopt;
  }
}

std::string stated_hash(const fs::path& folder, const char* name) {
  const std::string text = bytes_of_file(folder / hash_file, largest_hashes).value_or("");
  const nlohmann::json hashes = nlohmann::json::parse(text, nullptr, false);
  if (!hashes.is_object() || !hashes.contains(name) || !hashes.at(name).is_string()) return "";
  return hashes.at(name);
}

bool is_table(const std::string& text) {
  try {
    CsvReader reader(text, most_history_columns);
    for (CsvRow row; reader.next(row);) {
    }
    return true;
  } catch (const FileFault&) {
    return false;
  }
}

// sound, damaged or changed
template <class Readable>
CheckedResults check_file(const fs::path& folder, const char* name, std::uintmax_t most, const Readable& is_readable) {
  const fs::path file = folder / name;
  const std::optional<std::string> bytes = bytes_of_file(file, most);
  if (!bytes) return {ResultsState::damaged, file};
  const std::string stated = stated_hash(folder, name);
  if (digest(*bytes) == stated) return {ResultsState::sound, file};
  if (!is_readable(*bytes)) return {ResultsState::damaged, file};
  return stated.empty() ? CheckedResults{ResultsState::damaged, folder / hash_file}
                        : CheckedResults{ResultsState::changed, file};
}

}  // namespace

void write_results(const fs::path& folder, const std::string& results) {
  if (file_stands(folder / worker_file)) {
    nlohmann::ordered_json hashes = {{results_file, digest(results)}};
    if (file_stands(folder / history_file))
      hashes[history_file] = digest(read_file(folder / history_file, largest_history));
    write_file(folder / hash_file, hashes.dump(2) + "\n");
  }
  write_file(folder / results_file, results);
}

CheckedResults check_results(const fs::path& folder, bool with_history) {
  if (!file_stands(folder / results_file)) return {};
  const CheckedResults results = check_file(folder, results_file, largest_results,
                                            [](const std::string& text) { return nlohmann::json::accept(text); });
  if (!with_history || results.state != ResultsState::sound) return results;
  return check_file(folder, history_file, largest_history, is_table);
}

std::string describe(const CheckedResults& checked) {
  const std::string file = one_line(checked.file.string(), 1000);
  if (checked.state == ResultsState::changed) return fmt::format("'{}' differs from the file that its run wrote", file);
  return file_stands(checked.file) ? fmt::format("'{}' is damaged", file) : fmt::format("'{}' is missing", file);
}

}  // namespace voussoir
