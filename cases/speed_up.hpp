// Savings of a cheap search for the critical friction against the thesis' method: 0.025 deg/s from 5 degrees above,
// failure at 0.1 m (Boon 2013, 4.8).
#pragma once

#include <string>

#include "cases/case_tools.hpp"

namespace voussoir::cases {

inline double evaluations(const SceneRun& run) {
  return static_cast<double>(run.results.counters.contact_evaluations);
}

struct SoughtAngle {
  double expected = 0;  // deg
  std::string source, because;
};

// the cheap search finds the angle within 0.05 degrees with at least 20 times fewer contact evaluations
inline void expect_speed_up(verification::CaseReport& report, const SoughtAngle& sought, const std::string& name,
                            const SceneRun& cheap, const SceneRun& thesis) {
  using verification::Bound;
  using verification::Kind;
  constexpr double wanted_deg = 0.05, wanted_saving = 20;
  report.record({"critical friction, " + name,
                 "deg",
                 Kind::exact,
                 sought.source,
                 sought.expected,
                 {wanted_deg, 0},
                 sought.because},
                value(cheap, "critical_friction"), cost(cheap));
  report.record({"contact evaluations of the thesis' rate over those of " + name,
                 "1",
                 Kind::limit,
                 "demanded: at least 20 times fewer",
                 wanted_saving,
                 {0, 0, Bound::at_least},
                 "no margin: evaluations are counted"},
                evaluations(thesis) / evaluations(cheap), cost(cheap));
}

// the thesis' method finds it too late, by no more than its error bar
inline void expect_honest_bar(verification::CaseReport& report, const SoughtAngle& sought, const std::string& name,
                              const SceneRun& run) {
  using verification::Bound;
  using verification::Kind;
  const Value& found = *run.results.find("critical_friction");
  report.record({"error of " + name + " as a fraction of its error bar",
                 "1",
                 Kind::limit,
                 "promise: definition of an error bar",
                 1,
                 {0, 0, Bound::at_most},
                 "no margin: the bar is the claim"},
                std::abs(found.value - sought.expected) / *found.error_bar);
}

}  // namespace voussoir::cases
