// Answers judged: full marks, wrong ones, files with faults, and references that were moved.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "app/judge/judgement.hpp"
#include "app/judge/judgement_text.hpp"
#include "app/testing/program.hpp"
#include "core/base/bad_input.hpp"

namespace voussoir::judge_test {
namespace {

using namespace program;
using Json = nlohmann::json;

Json wedge_reference() {
  const auto because = [](Json json) {
    json["because"] = "bracket";
    json["source"] = "closed form";
    return json;
  };
  return {{"format", "voussoir reference 1"},
          {"name", "wedge"},
          {"quantities",
           {{{"quantity", "critical friction, kinetic"},
             {"unit", "deg"},
             {"joints", because({{"value", 28.918559}, {"absolute", 0.02}, {"relative", 0}})},
             {"rigid", because({{"lower", 28.918559}, {"upper", 28.918559}, {"absolute", 0.02}, {"relative", 0}})}},
            {{"quantity", "critical friction, at rest"},
             {"unit", "deg"},
             {"joints", because({{"value", 28.918559}, {"absolute", 0.01}, {"relative", 1e-3}})},
             {"rigid", because({{"lower", 25.806829}, {"upper", 28.918559}, {"absolute", 0.03}, {"relative", 0}})}},
            {{"quantity", "settlement"},
             {"unit", "m"},
             {"joints", because({{"value", 8.6e-5}, {"absolute", 0}, {"relative", 0.01}})},
             {"rigid", nullptr}}}}};
}

const std::string header = "quantity,unit,value,seconds,note\n";
const std::string rigid = "# code: mine 1\n# model: rigid\n" + header;
const std::string elastic = "# code: mine 1\n# model: joint stiffness\n" + header;

class Judge : public program::Program {
 protected:
  fs::path put(const std::string& name, const std::string& text) const {
    write(name, text);
    return folder_ / name;
  }
  Judgement judge(const std::string& answer, const Json& reference = wedge_reference()) const {
    Judgement judgement;
    judge_answer(read_answer(put("answer.csv", answer)), read_reference(put("reference.json", reference.dump())),
                 judgement);
    complete(judgement);
    return judgement;
  }
  JudgedAs verdict(const Judgement& judgement, const std::string& quantity) const {
    for (const JudgedRow& row : judgement.rows)
      if (row.quantity == quantity) return row.verdict;
    ADD_FAILURE() << "no row " << quantity;
    return JudgedAs::faulty;
  }
  std::string refusal(const std::string& answer) const {
    try {
      read_answer(put("answer.csv", answer));
    } catch (const BadInput& fault) {
      return fault.what();
    }
    return {};
  }

  const std::string kinetic = "\"critical friction, kinetic\",deg,", rest = "\"critical friction, at rest\",deg,";
};

TEST_F(Judge, GivesFullMarksForTheClosedForms) {
  const Judgement found = judge(elastic + kinetic + "28.92,0.5,\n" + rest + "28.9,1,\nsettlement,m,8.6e-5,1,\n");
  EXPECT_EQ(judgement_counts(found), "3 passed, 0 failed, 0 not run, 0 cannot state, 0 not asked, 0 faulty");
  EXPECT_TRUE(found.faults.empty());
}

TEST_F(Judge, TakesAnIntervalFromRigidCodesAlone) {
  for (const char* value : {"25.78", "26", "28.94"})
    EXPECT_EQ(verdict(judge(rigid + rest + value + ",,\n"), "critical friction, at rest"), JudgedAs::passed) << value;
  for (const char* value : {"25.77", "28.95", "19.6"})
    EXPECT_EQ(verdict(judge(rigid + rest + value + ",,\n"), "critical friction, at rest"), JudgedAs::failed) << value;
  EXPECT_EQ(verdict(judge(elastic + rest + "26,,\n"), "critical friction, at rest"), JudgedAs::failed);
  // of what is not asked of its model a code need say nothing
  EXPECT_EQ(verdict(judge(rigid + rest + "26,,\n"), "settlement"), JudgedAs::not_asked);
}

TEST_F(Judge, CountsAMissingOrEmptyRowAsNotRun) {
  const Judgement found = judge(elastic + kinetic + ",,\n");
  EXPECT_EQ(judgement_counts(found), "0 passed, 0 failed, 3 not run, 0 cannot state, 0 not asked, 0 faulty");
}

TEST_F(Judge, NamesFileAndLineOfEachFaultyRow) {
  struct {
    std::string row, reason;
  } const faults[] = {{kinetic + "nan,,\n", "nan"},
                      {kinetic + "inf,,\n", "inf"},
                      {kinetic + "28.9x,,\n", "28.9x"},
                      {"\"critical friction, kinetic\",rad,0.5,,\n", "unit = 'rad'"},
                      {"friction,deg,28.9,,\n", "does not ask it"},
                      {kinetic + "cannot state,,\n", "reason"},
                      {kinetic + "28.9,-1,\n", "seconds"}};
  for (const auto& fault : faults) {
    const Judgement found = judge(elastic + fault.row);
    ASSERT_EQ(found.faults.size(), 1u) << fault.row;
    EXPECT_NE(found.faults[0].find("answer.csv:4: "), std::string::npos) << found.faults[0];
    EXPECT_NE(found.faults[0].find(fault.reason), std::string::npos) << found.faults[0];
    EXPECT_EQ(found.faults[0].find('\n'), std::string::npos);
    for (const JudgedRow& row : found.rows)
      EXPECT_NE(row.verdict, JudgedAs::passed) << fault.row;
  }
  EXPECT_EQ(judge(elastic + kinetic + "28.9,,\n" + kinetic + "28.9,,\n").faults.size(), 1u);
}

TEST_F(Judge, RefusesFilesWithAnotherHeadOrHeader) {
  EXPECT_NE(refusal("# code: mine\n# model: soft\n" + header + kinetic + "1,,\n").find(":2: model"), std::string::npos);
  EXPECT_NE(refusal("# model: rigid\n" + header + kinetic + "1,,\n").find("code"), std::string::npos);
  const std::string other = refusal("# code: mine\n# model: rigid\nquantity,units,value\na,deg,1\n");
  EXPECT_NE(other.find("answer.csv:3: "), std::string::npos) << other;
  EXPECT_FALSE(refusal("").empty());
  EXPECT_TRUE(read_answer(put("answer.csv",
                              "# code: NAME VERSION\n# model: rigid | joint stiffness\n" + header + kinetic + ",,\n"))
                  .empty);
}

// each number of the reference, moved by three tolerances, turns a verdict
TEST_F(Judge, NoticesEveryNumberOfAReferenceThatIsMoved) {
  for (const bool stiffness : {false, true}) {
    const std::string key = stiffness ? "joints" : "rigid";
    for (const std::size_t k : {0, 1, 2}) {
      const Json whole = wedge_reference();
      const Json right = whole["quantities"][k][key];
      if (right.is_null()) continue;
      for (const char* end : {"value", "lower", "upper"}) {
        if (!right.contains(end)) continue;
        const double value = right[end],
                     width = right["absolute"].get<double>() + right["relative"].get<double>() * value;
        const std::string answer =
            (stiffness ? elastic : rigid) + "\"" + whole["quantities"][k]["quantity"].get<std::string>() + "\"," +
            whole["quantities"][k]["unit"].get<std::string>() + "," + Json(value).dump() + ",,\n";
        EXPECT_EQ(judge(answer).rows[k].verdict, JudgedAs::passed) << answer;
        Json moved = whole;
        // inwards, else the interval only grows
        const double by = std::string(end) == "upper" ? -3 * width : 3 * width;
        moved["quantities"][k][key][end] = value + by;
        if (!stiffness && right["lower"] == right["upper"])
          moved["quantities"][k][key]["lower"] = moved["quantities"][k][key]["upper"] = value + by;
        EXPECT_EQ(judge(answer, moved).rows[k].verdict, JudgedAs::failed) << answer << moved.dump();
      }
    }
  }
}

TEST_F(Judge, RefusesReferencesThatAcceptEverything) {
  for (const char* change : {"/quantities/0/rigid/relative", "/quantities/0/rigid/absolute"})
    for (const double value : {-1.0, 1.5}) {
      Json moved = wedge_reference();
      moved[Json::json_pointer(change)] = value;
      if (value > 0 && std::string(change).ends_with("absolute")) continue;
      EXPECT_THROW(read_reference(put("reference.json", moved.dump())), BadInput) << change << value;
    }
  EXPECT_THROW(read_reference(put("reference.json", "{}")), BadInput);
  EXPECT_THROW(read_reference(put("reference.json", "no json")), BadInput);
}

TEST_F(Judge, ComparesCodesInOneTableAndDrawsTheirCost) {
  for (const char* name : {"a/wedge", "b/wedge", "problems/wedge"})
    fs::create_directories(folder_ / name);
  write("problems/wedge/reference.json", wedge_reference().dump());
  write("a/wedge/answer.csv", rigid + kinetic + "28.92,0.5,\n" + rest + "28.9,2,\n");
  write("b/wedge/answer.csv", "# code: <other> 2\n# model: joint stiffness\n" + header + kinetic +
                                  "27,5,\nsettlement,m,cannot state,,no kn | ks\n");
  const Ended done = run("judge a b --references problems --out out");
  EXPECT_EQ(done.code, 1) << done.out << done.err;
  const auto text = [&](const char* name) { return read(folder_ / "out" / name); };
  EXPECT_NE(text("judgement.md").find("| mine 1 | <other> 2 |"), std::string::npos) << text("judgement.md");
  EXPECT_NE(text("judgement.md").find("**FAILED**"), std::string::npos);
  EXPECT_NE(text("judgement.html").find("&lt;other&gt; 2"), std::string::npos);
  EXPECT_EQ(text("judgement.html").find("<other>"), std::string::npos);
  EXPECT_NE(text("judgement.csv").find("not run"), std::string::npos);
  EXPECT_NE(text("error_against_cost.svg").find("processor time, s"), std::string::npos);
  // all right and nothing missing: 0; a faulty row: 2, and its place on stderr
  EXPECT_EQ(run("judge a --references problems --out all").code, 0);
  write("b/wedge/answer.csv", rigid + kinetic + "nan,,\n");
  const Ended faulty = run("judge b --references problems --out faulty");
  EXPECT_EQ(faulty.code, 2);
  EXPECT_NE(faulty.err.find("answer.csv:4: "), std::string::npos) << faulty.err;
  EXPECT_EQ(run("judge problems --out none").code, 2);
}

}  // namespace
}  // namespace voussoir::judge_test
