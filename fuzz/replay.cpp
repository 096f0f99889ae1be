// replay FILE …: a fuzz target's checks on these inputs only, without a fuzzer and with any compiler. A broken
// invariant ends the program; the last line printed names the input.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    std::printf("%s\n", argv[i]);
    std::fflush(stdout);
    std::ifstream file(argv[i], std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (!file || bytes.empty()) {
      std::fprintf(stderr, "no input could be read from %s\n", argv[i]);
      return 1;
    }
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  if (argc < 2) {
    std::fprintf(stderr, "usage: replay FILE ...\n");
    return 2;
  }
  std::printf("%d inputs replayed, no invariant broken\n", argc - 1);
}
