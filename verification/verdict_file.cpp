#include "verification/verdict_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>

namespace voussoir::verification {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

// JSON has no word for NaN and infinity; a failed result must still reach the table with its value
json number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
}

double number_at(const json& object, const char* key) {
  const json& value = object.at(key);
  if (value.is_number()) return value.get<double>();
  const auto word = value.get<std::string>();
  if (word == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (word == "inf") return std::numeric_limits<double>::infinity();
  if (word == "-inf") return -std::numeric_limits<double>::infinity();
  throw std::runtime_error(fmt::format("{} is neither a number nor nan, inf, -inf: '{}'", key, word));
}

// one lock file beside each data file, held while it is read, changed and renamed
class FileLock {
 public:
  explicit FileLock(const fs::path& data) {
    const std::string path = data.string() + ".lock";
    descriptor_ = ::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
    if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX) != 0) {
      if (descriptor_ >= 0) ::close(descriptor_);
      throw std::runtime_error("cannot lock " + path);
    }
  }
  ~FileLock() { ::close(descriptor_); }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace

json to_json(const Row& row) {
  const Check& check = row.check;
  json text{{"case", row.case_name},
            {"quantity", check.quantity},
            {"unit", check.unit},
            {"kind", name_of(check.kind)},
            {"source", check.source},
            {"computed", number(row.computed)},
            {"verdict", verdict_of(row)},
            {"because", check.because},
            {"contact_evaluations", row.cost.contact_evaluations},
            {"seconds", row.cost.seconds},
            {"commit", row.commit}};
  if (check.by_the_clock) text["by_the_clock"] = true;
  if (check.kind == Kind::reported) return text;
  text["expected"] = check.expected;
  text["error"] = number(error_of(row));
  text["tolerance"] = width(check.expected, check.tolerance);
  text["tolerance_absolute"] = check.tolerance.absolute;
  text["tolerance_relative"] = check.tolerance.relative;
  text["bound"] = name_of(check.tolerance.bound);
  text["margin"] = number(margin(row.computed, check));
  return text;
}

Row row_from_json(const json& text) {
  try {
    Row row;
    text.at("case").get_to(row.case_name);
    text.at("quantity").get_to(row.check.quantity);
    text.at("unit").get_to(row.check.unit);
    text.at("source").get_to(row.check.source);
    text.at("because").get_to(row.check.because);
    text.at("commit").get_to(row.commit);
    row.check.kind = kind_of(text.at("kind").get<std::string>());
    row.check.by_the_clock = text.value("by_the_clock", false);
    row.computed = number_at(text, "computed");
    row.cost = {text.at("contact_evaluations").get<long long>(), number_at(text, "seconds")};
    if (row.check.kind != Kind::reported) {
      row.check.expected = number_at(text, "expected");
      row.check.tolerance = {number_at(text, "tolerance_absolute"), number_at(text, "tolerance_relative"),
                             bound_of(text.at("bound").get<std::string>())};
      require_complete(row.check);
    }

    // the stored verdict is for readers of the file; the rule decides
    const auto stored = text.at("verdict").get<std::string>();
    if (stored != verdict_of(row))
      throw std::runtime_error(
          fmt::format("'{}' is stored as {} but its numbers say {}", row.check.quantity, stored, verdict_of(row)));
    return row;
  } catch (const json::exception& problem) {
    throw std::runtime_error(fmt::format("a row is incomplete: {}", problem.what()));
  } catch (const std::invalid_argument& problem) {
    throw std::runtime_error(problem.what());
  }
}

CaseFile read_case_file(const fs::path& path) {
  try {
    const json text = json::parse(read_text(path));
    CaseFile file;
    text.at("case").get_to(file.case_name);
    text.at("failures").get_to(file.failures);
    std::set<std::string> seen;
    for (const json& stored : text.at("rows")) {
      Row row = row_from_json(stored);
      if (row.case_name != file.case_name) throw std::runtime_error("a row belongs to case '" + row.case_name + "'");
      if (!seen.insert(row.check.quantity).second)
        throw std::runtime_error("'" + row.check.quantity + "' has more than one row");
      file.rows.push_back(std::move(row));
    }
    return file;
  } catch (const std::exception& problem) {
    throw std::runtime_error(fmt::format("{}: {}", path.filename().string(), problem.what()));
  }
}

void merge_into_case_file(const fs::path& path, const std::string& case_name, const std::vector<Row>& rows,
                          const std::string& test, const std::string& failure) {
  update_json(path, [&](json& file) {
    file["case"] = case_name;
    json& stored = file["rows"];
    if (!stored.is_array()) stored = json::array();
    json& failures = file["failures"];
    if (!failures.is_object()) failures = json::object();

    for (const Row& row : rows) {
      const auto same = [&](const json& other) { return other.value("quantity", "") == row.check.quantity; };
      const auto found = std::find_if(stored.begin(), stored.end(), same);
      if (found == stored.end())
        stored.push_back(to_json(row));
      else
        *found = to_json(row);
    }
    failures.erase(test);
    if (!failure.empty()) failures[test] = failure;
  });
}

void write_atomically(const fs::path& path, const std::string& text) {
  if (path.has_parent_path()) fs::create_directories(path.parent_path());
  const fs::path draft = fmt::format("{}.{}.draft", path.string(), ::getpid());
  {
    std::ofstream stream(draft, std::ios::binary);
    stream << text;
    stream.flush();
    if (!stream) throw std::runtime_error("cannot write " + draft.string());
  }
  fs::rename(draft, path);
}

void update_json(const fs::path& path, const std::function<void(json&)>& change) {
  if (path.has_parent_path()) fs::create_directories(path.parent_path());
  const FileLock lock(path);
  json content = json::object();
  if (fs::exists(path) && fs::file_size(path) > 0) content = json::parse(read_text(path));
  change(content);
  write_atomically(path, content.dump(1) + "\n");
}

std::string read_text(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + path.string());
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace voussoir::verification
