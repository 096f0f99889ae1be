#include <fmt/format.h>
#include <gtest/gtest.h>
#include <cstring>
#include "cases/potential_particles/problems.hpp"
namespace voussoir::cases {
TEST(ScratchLong, Half) {
  for (auto f :
       std::initializer_list<std::pair<const char*, Trial (*)(const RelativeRounding&)>>{{"wedge", sliding_wedge},
                                                                                         {"beam", hinged_beam},
                                                                                         {"peak", hinged_beam_peak},
                                                                                         {"settle", settled_column},
                                                                                         {"lean", leaning_column}}) {
    std::vector<RelativeRounding> rr{{0, 0}};
    if (const char* e = std::getenv("RR")) {
      double a, b;
      sscanf(e, "%lf,%lf", &a, &b);
      rr = {{a, b}};
    }
    if (const char* e = std::getenv("WHICH"))
      if (!strstr(e, f.first)) continue;
    for (auto r : rr) {
      Trial t = f.second(r);
      fmt::print("{} r={} k={}: {} {} {} {:.2f}s {}\n", f.first, r.radius, r.sphericity, t.answered, t.value, t.why,
                 t.seconds, t.evaluations);
    }
  }
}
}  // namespace voussoir::cases
#include "cases/potential_particles/pack.hpp"
namespace voussoir::cases {
TEST(ScratchLong, Pack) {
  const Pack pack = settle_pack();
  fmt::print("height {} size {}\n", pack.height, pack.size);
  std::vector<RelativeRounding> rr{{0, 0}};
  if (const char* e = std::getenv("RR")) {
    double a, b;
    sscanf(e, "%lf,%lf", &a, &b);
    rr = {{a, b}};
  }
  for (auto r : rr) {
    Trial t = settled_pack(pack, r);
    fmt::print("r={} k={}: {} {} {} {:.2f}s {}\n", r.radius, r.sphericity, t.answered, t.value, t.why, t.seconds,
               t.evaluations);
  }
}
}  // namespace voussoir::cases
