// unit.study_report: the page's section on error bars, from made-up sets and studies.
#include "reports/bars.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "reports/study_report.hpp"

namespace voussoir::reports::bars_test {
namespace {

TEST(Bars, CountTheErrorsThatTheyCover) {
  const BudgetSet set =
      read_budget_set("wedge", "truth_deg,error_deg,bar_deg,cost\n30,0.01,0.02,2\n40,0.01,0.04,3\n50,0.03,0.02,9\n");
  EXPECT_EQ(bars_csv({set}), "case,error_deg,bar_deg\nwedge,0.01,0.02\nwedge,0.01,0.04\nwedge,0.03,0.02\n");
  const std::string page = bars_markdown({set}, {}, {});
  EXPECT_NE(page.find("| [wedge](../wedge/README.md) | 3 | 2 | 2 | 3 |"), std::string::npos) << page;
  EXPECT_NE(page.find("(bars.svg)"), std::string::npos);
  EXPECT_EQ(page.find("Without a budget"), std::string::npos);
  EXPECT_THROW(read_budget_set("wedge", "truth_deg,error_deg\n1,2\n"), std::runtime_error);
  EXPECT_EQ(bars_markdown({}, {}, {}), "");
}

TEST(Bars, ListTheLinesOfABudget) {
  const auto results = nlohmann::json::parse(R"({"values": {"height": {"value": 1, "unit": "m"}, "critical_friction": {
    "value": 33.358, "unit": "deg", "error_bar": 0.012, "bracket": 0.0026, "budget": [
      {"varied": "shear stiffness", "change": "a ninth", "shift": 0.0051, "left": 0.0077, "sensitivity": false},
      {"varied": "stiffness of rock", "change": "1.1 times", "shift": -0.2, "left": 0, "sensitivity": true}]}}})");
  const std::string page = bars_markdown({}, {{"wedge", results}}, {});
  for (const char* part :
       {"| [wedge](../wedge/README.md) | critical_friction 33.358 ± 0.012 deg | its bracket | | 0.0026 |",
        "| | | shear stiffness, a ninth | +0.0051 | +0.0077 |",
        "| | | stiffness of rock, 1.1 times | -0.2 | measured, no error |"})
    EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
  EXPECT_EQ(page.find("height"), std::string::npos);
}

// 30 deg; bars of 0.5, 0.1 and none
TEST(Bars, OfBracketsOnlyAreCountedInTheStudies) {
  const Study study = judge_study(
      read_study("sweep,key,value,unit,quantity,result,error_bar,result_unit,status,contact_evaluations,steps,seconds\n"
                 "default,,,,angle,30.2,0.5,deg,ok,1000,100,1\n"
                 "tolerance,t,4,deg,angle,30.9,0.1,deg,ok,100,10,0.1\n"
                 "tolerance,t,1,deg,angle,30.3,0,deg,ok,200,20,0.2\n"),
      {{"angle", {30.0, "deg"}}});
  const std::string page = bars_markdown({}, {}, {{"slope", study_json(study)}});
  EXPECT_NE(page.find("| [slope](../slope/README.md) | 2 | 1 | 1.3 |"), std::string::npos) << page;
}

}  // namespace
}  // namespace voussoir::reports::bars_test
