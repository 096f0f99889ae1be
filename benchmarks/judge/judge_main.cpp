// voussoir_judge_kernel PAIRS KERNEL OUT [--no-times]: judges the shared library KERNEL by the file PAIRS (of
// voussoir_pairs), times it beside our kernel and the libraries that were found, prints the tables and writes them to
// OUT: one page, and a file of comma-separated values each for errors and times. Status 0 whatever the verdict, 2 if
// nothing could be judged.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "benchmarks/judge/judge_tables.hpp"
#include "benchmarks/judge/text_out.hpp"
#include "benchmarks/peers/peers.hpp"

namespace {

using namespace voussoir::benchmarks;

// ours cold and warm, and the libraries' forms that make no use of the step before
std::vector<Method> peers_beside() {
  std::vector<Method> list;
  for (const Method& method : own_methods()) {
    const bool stage = method.stage == "decision" || method.stage == "overlap";
    if (stage && (method.name == single_cold || method.name == single_warm)) list.push_back(method);
  }
  const std::vector<Method> libraries = library_methods();
  list.insert(list.end(), libraries.begin(), libraries.end());
  return list;
}

void judge(const std::string& pairs, const std::string& library, const std::filesystem::path& out, bool timed) {
  const Kernel kernel = load_kernel(library);
  const PairFile file = read_pair_file(pairs);
  const std::vector<Verdict> verdicts = judge_kernel(kernel, file);
  std::string text =
      fmt::format("# {}\n\nJudged by {} pairs of seed {}; wrong answers by shape and state.\n\n{}\n{}\n{}", kernel.name,
                  file.pairs.size(), file.seed, verdict_table(verdicts), verdict_sentence(kernel.name, verdicts),
                  verdict_sentence("voussoir", judge_kernel(own_kernel(), file)));
  write_text(out / "kernel_errors.csv", verdict_csv(kernel.name, verdicts));
  fmt::print("{}", text);
  if (timed) {
    const std::vector<KernelTime> times = time_kernel(kernel, peers_beside(), all_pairs_timed());
    const std::string table = fmt::format(
        "\nNanoseconds a pair, processor time, medians of 5 in turns, on the benchmark's pairs (README.md of the "
        "judge).\n\n{}",
        time_table(times));
    write_text(out / "kernel_times.csv", time_csv(times));
    fmt::print("{}", table);
    text += table;
  }
  write_text(out / "kernel.md", text);
}

}  // namespace

int main(int argc, char** argv) {
  const bool timed = argc != 5;
  if (argc != 4 && !(argc == 5 && std::string(argv[4]) == "--no-times")) {
    fmt::print(stderr, "usage: voussoir_judge_kernel PAIRS KERNEL OUT [--no-times]\n");
    return 2;
  }
  try {
    judge(argv[1], argv[2], argv[3], timed);
  } catch (const std::exception& fault) {
    fmt::print(stderr, "voussoir_judge_kernel: {}\n", fault.what());
    return 2;
  }
  return 0;
}
