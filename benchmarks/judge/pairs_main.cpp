// voussoir_pairs OUT [--seed S] [--pairs N]: pairs.json in the folder OUT, N pairs per shape and state (20) of the seed
// S (the benchmark's own).
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>

#include "benchmarks/judge/exact_pairs.hpp"
#include "benchmarks/judge/text_out.hpp"

namespace {

constexpr int usual_count = 20;
constexpr long long most_pairs = 1000;

std::optional<long long> whole_number(const char* text) {
  char* end = nullptr;
  const long long value = std::strtoll(text, &end, 10);
  if (*text == 0 || *end != 0 || value < 0) return std::nullopt;
  return value;
}

int fail(const std::string& line) {
  fmt::print(stderr, "voussoir_pairs: {}\n", line);
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  std::string out;
  long long seed = voussoir::benchmarks::workload_seed, count = usual_count;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word != "--seed" && word != "--pairs") {
      if (word.starts_with("-") || !out.empty()) return fail("usage: voussoir_pairs OUT [--seed S] [--pairs N]");
      out = word;
      continue;
    }
    const std::optional<long long> value = i + 1 < argc ? whole_number(argv[++i]) : std::nullopt;
    if (!value) return fail(word + " needs a whole number");
    (word == "--seed" ? seed : count) = *value;
  }
  if (out.empty()) return fail("usage: voussoir_pairs OUT [--seed S] [--pairs N]");
  if (count < 1 || count > most_pairs) return fail(fmt::format("--pairs {}: allowed are 1 to {}", count, most_pairs));
  try {
    const std::filesystem::path path = std::filesystem::path(out) / "pairs.json";
    const voussoir::benchmarks::PairFile file =
        voussoir::benchmarks::all_exact_pairs(static_cast<std::uint64_t>(seed), static_cast<int>(count));
    voussoir::benchmarks::write_text(path, voussoir::benchmarks::pair_file_text(file));
    fmt::print("{}: {} pairs, seed {}\n", path.string(), file.pairs.size(), seed);
  } catch (const std::exception& fault) {
    return fail(fault.what());
  }
  return 0;
}
