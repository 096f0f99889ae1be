#include "app/study/finding_names.hpp"

#include <fmt/format.h>

namespace voussoir {

std::vector<std::string> finding_names(const StudyPlan& plan) {
  std::vector<std::string> names;
  int grids = 0, samples = 0, analyses = 0;
  for (const Sweep& sweep : plan.sweeps) {
    if (sweep.varied == Varied::grid) {
      ++grids;
      for (const char* kind : {"csv", "json"})
        names.push_back(fmt::format("grid_{}.{}", grids, kind));
    }
    if (sweep.varied == Varied::sample) {
      ++samples;
      for (const char* kind : {"csv", "json"})
        names.push_back(fmt::format("sample_{}.{}", samples, kind));
    }
    if (sweep.varied == Varied::reliability) {
      ++analyses;
      for (const char* kind : {"csv", "json"})
        names.push_back(fmt::format("reliability_{}.{}", analyses, kind));
    }
  }
  return names;
}

}  // namespace voussoir
