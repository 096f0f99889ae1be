// voussoir_contact_report <bench_contact's JSON> <folder>: writes contact.csv, the figures' data and the tables, which
// it also prints. Ends with status 1 if our kernel made a wrong decision.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "benchmarks/contact_report.hpp"

namespace {

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + " cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  if (!file.flush()) throw std::runtime_error(path.string() + " cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: voussoir_contact_report <json> <folder>\n");
    return 2;
  }
  try {
    using namespace voussoir::benchmarks;
    const Report report = read_report(read(argv[1]));
    const std::filesystem::path out = argv[2];
    const std::string summary = summary_tables(report), times = time_tables(report);
    write(out / "contact.csv", flat_csv(report));
    write(out / "contact_planes.csv", planes_csv(report));
    write(out / "contact_vertices.csv", vertices_csv(report));
    write(out / "contact_summary.md", summary);
    write(out / "contact_times.md", times);
    fmt::print("{}{}", summary, times);
    if (own_wrong_decisions(report) == 0) return 0;
    throw std::runtime_error(fmt::format("our kernel made {} wrong decisions", own_wrong_decisions(report)));
  } catch (const std::exception& problem) {
    fmt::print(stderr, "voussoir_contact_report: {}\n", problem.what());
    return 1;
  }
}
