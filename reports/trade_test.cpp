// unit.study_report: two made-up studies beside each other, and the sentences of the page on them.
#include "reports/trade.hpp"

#include <gtest/gtest.h>

#include "reports/study_report.hpp"

namespace voussoir::reports::trade_test {
namespace {

CaseStudy made(const std::string& name, const std::string& lines) {
  const std::string header =
      "sweep,key,value,unit,quantity,result,error_bar,result_unit,status,contact_evaluations,steps,seconds\n";
  const Study study = judge_study(read_study(header + lines), {{"angle", {30.0, "deg"}}});
  return {name, study_json(study)};
}

// as it is 0.05 % for 1000; 3 % for 100, 0.9 % for 200
const std::string slope =
    "default,,,,angle,30.015,0,deg,ok,1000,100,1\n"
    "tolerance,t,4,deg,angle,30.9,0,deg,ok,100,10,0.1\n"
    "tolerance,t,1,deg,angle,30.27,0,deg,ok,200,20,0.2\n"
    "point,p,corner,,angle,,,deg,no equilibrium,5,5,0.1\n";
// nothing touches: cost is steps; as it is 20 % for 10, no better than 2 % for 40
const std::string flight =
    "default,,,,angle,36,0,deg,ok,0,10,0\n"
    "step,dt,0.1,s,angle,30.6,0,deg,ok,0,40,0\n";

TEST(Trade, ComparesWithTheSceneAsItIs) {
  const std::vector<CaseStudy> studies{made("slope", slope), made("flight", flight)};
  EXPECT_EQ(compared_cases(studies), (std::vector<std::string>{"slope", "flight"}));
  const std::string csv = trade_csv(studies);
  EXPECT_EQ(csv.find("case,relative_cost,relative_error\nslope,0.1,0.0"), 0u) << csv;
  EXPECT_NE(csv.find("flight,1,0.2"), std::string::npos) << csv;
  EXPECT_NE(csv.find("flight,4,0.0"), std::string::npos) << csv;

  const std::string page = trade_markdown(studies);
  for (const char* part :
       {"**5 %** is reached in 2 of 2 cases", "2 (median; from 0.1 in slope to 4 in flight)",
        "The unchanged scenes reach it in 1.", "**1 %** is reached in 1 of 2 cases",
        "No setting tried reaches it in flight.", "| | | 1 % | `t = 1` deg | 0.9 % | × 0.2 | × 0.2 | × 0.2 |",
        "| | | 1 % | **none of the settings reaches it** |",
        "| [slope](../slope/README.md) | point | `p = corner` | no equilibrium |"})
    EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
}

TEST(Trade, ListsThePointsAlongAFace) {
  const std::string lines =
      "default,,,,angle,30,0,deg,ok,100,10,1\n"
      "points,joint_properties.rock.sub_contacts,1,1,angle,,,deg,no bracket,100,10,1\n"
      "points,joint_properties.rock.sub_contacts,2,1,angle,30.3,0,deg,ok,100,11,1.5\n"
      "whole faces,contact.face,integrated,,angle,30.03,0,deg,ok,100,12,0.5\n"
      "whole faces,contact.face,point,,angle,30.6,0,deg,ok,100,12,0.5\n";
  const std::string page = trade_markdown({made("slope", lines)});
  EXPECT_NE(page.find("| [slope](../slope/README.md) | points | 1 | **no bracket** |"), std::string::npos) << page;
  EXPECT_NE(page.find("| [slope](../slope/README.md) | points | 2 | 1 % | 100 | 11 | 1.5 |"), std::string::npos)
      << page;
  EXPECT_NE(page.find("| [slope](../slope/README.md) | whole faces | integrated | 0.1 % | 100 | 12 | 0.5 |"),
            std::string::npos)
      << page;
  EXPECT_EQ(page.find("| whole faces | point |"), std::string::npos) << page;
  EXPECT_EQ(trade_markdown({made("flight", flight)}).find("Points along"), std::string::npos);
}

TEST(Trade, ComparesTheStaticSolutionMethods) {
  const std::string lines =
      "default,,,,angle,30,0,deg,ok,100,10,1\n"
      "static solution: true motion,damping.viscous_ratio,0.3,,angle,,,deg,incomplete: step limit,100,10,1\n"
      "static solution: Newton,static_increments,4,,angle,30.3,0,deg,ok,7,11,1.5\n";
  const std::string page = trade_markdown({made("slope", lines), made("flight", flight)});
  EXPECT_NE(page.find("| error with error bar | true motion | Newton, 4 |\n|---|--:|--:|\n"
                      "| [slope](../slope/README.md) | **incomplete** | 1 % |\n\n"
                      "| contact evaluations | true motion | Newton, 4 |\n|---|--:|--:|\n"
                      "| [slope](../slope/README.md) | – | 7 |\n\n"),
            std::string::npos)
      << page;
  EXPECT_EQ(trade_markdown({made("flight", flight)}).find("Static solution methods"), std::string::npos);
}

TEST(Trade, LeavesOutCasesWithNothingToCompareWith) {
  const std::vector<CaseStudy> studies{
      made("broken", "default,,,,angle,,,deg,diverged,9,9,1\ntolerance,t,1,deg,angle,30,0,deg,ok,200,20,0.2\n")};
  EXPECT_TRUE(compared_cases(studies).empty());
  EXPECT_NE(trade_markdown(studies).find("**the scene failed as it is**"), std::string::npos);
  EXPECT_EQ(trade_markdown({}), "No study has a result.\n");
}

TEST(Trade, ShowsWhatLevelsReachAndNamesBrokenPromises) {
  const std::string header =
      "sweep,key,value,unit,quantity,result,error_bar,result_unit,status,contact_evaluations,steps,seconds\n";
  const auto study = [&](const std::string& lines) {
    return judge_study(read_study(header + lines), {{"angle", {30.0, "deg"}}});
  };
  const std::string kept = "level,accuracy.level,fast,,angle,31.2,0.1,deg,ok,10,10,1\n";
  EXPECT_EQ(broken_promises(study(kept)), "");
  EXPECT_NE(trade_markdown({{"slope", study_json(study(kept))}}).find("| fast | 5 % | 4.3 % |"), std::string::npos);

  const std::string missed = kept + "level,accuracy.level,balanced,,angle,30.2,0.2,deg,ok,10,10,1\n" +
                             "level,accuracy.level,reference,,angle,,,deg,no bracket,10,10,1\n";
  const std::string text = broken_promises(study(missed));
  EXPECT_NE(text.find("level balanced of angle promises 1 % and is 1.3 % off"), std::string::npos) << text;
  EXPECT_NE(text.find("level reference of angle failed: no bracket"), std::string::npos) << text;
  EXPECT_THROW(broken_promises(study("level,accuracy.level,best,,angle,30,0,deg,ok,1,1,1\n")), std::runtime_error);
}

}  // namespace
}  // namespace voussoir::reports::trade_test
