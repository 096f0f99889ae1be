// Messages of 'voussoir limit' about blocks between walls, if no number is a result.
#include "app/testing/program.hpp"

namespace voussoir::limit_words_test {
namespace {

using namespace program;

class LimitWords : public Program {
 protected:
  // a key of 1 m between two fixed walls that lean inwards by this many metres over their height
  void write_slot(double inwards) const {
    write(
        "slot.toml",
        fmt::format(
            "dimension = 2\ngravity = [0, -9.81]\ndensity = 2000\n"
            "blocks = [{{ name = \"left\", vertices = [[-0.5, 0], [{0}, 1], [-2, 1], [-2, 0]], fixed = true }},\n"
            "          {{ name = \"right\", vertices = [[0.5, 0], [{1}, 1], [2, 1], [2, 0]], fixed = true }},\n"
            "          {{ name = \"key\", vertices = [[-0.5, 0], [0.5, 0], [{1}, 1], [{0}, 1]] }}]\n"
            "joint_properties = [{{ name = \"rock\", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 30 "
            "}}]\n"
            "stage = [{{ name = \"s\", kind = \"settle\" }}]\n",
            -0.5 + inwards, 0.5 - inwards));
  }
  Ended limit(const std::string& options = "") const { return run("limit slot.toml --overwrite --out out " + options); }
  bool says(const Ended& ended, const std::string& words) const { return ended.out.find(words) != std::string::npos; }
};

constexpr const char* not_asked_for =
    "may depend on self-stress, normal forces that the loads do not cause, between faces of blocks";

TEST_F(LimitWords, OfParallelWallsAreNoAngleAndNoFactor) {
  write_slot(0);
  for (const std::string option : {"", "--factor"}) {
    const Ended ended = limit(option + " --with-dilation");
    EXPECT_EQ(ended.code, 1) << ended.out << ended.err;
    EXPECT_TRUE(says(ended, "above 0, by unbounded normal forces, which need not exist")) << ended.out;
    EXPECT_TRUE(says(ended, option.empty() ? "stable at any friction" : "stable at any strength")) << ended.out;
    EXPECT_FALSE(says(ended, "inf")) << ended.out;
    EXPECT_EQ(results("out")["status"], "incomplete");
    EXPECT_TRUE(results("out")["values"].empty());
    EXPECT_EQ(read(folder_ / "out/results.json").find("null,\n      \"unit\""), std::string::npos);
  }
}

TEST_F(LimitWords, OfASlotThatOpensDownwardsAreACaveat) {
  write_slot(0.2);
  const Ended ended = limit("--factor --with-dilation");
  EXPECT_EQ(ended.code, 0);
  EXPECT_TRUE(says(ended, "factor_of_safety_upper_bound 2.886")) << ended.out;
  EXPECT_TRUE(says(ended, not_asked_for)) << ended.out;
  EXPECT_NE(results("out")["caveat"].get<std::string>().find(not_asked_for), std::string::npos);
  EXPECT_TRUE(says(limit("--with-dilation"), not_asked_for));
  EXPECT_TRUE(says(limit("--load left"), "result")) << "with any value";
  // nothing presses it: it falls
  const Ended falls = limit();
  EXPECT_EQ(falls.code, 1);
  EXPECT_TRUE(says(falls, "no friction up to 89 degrees is enough without dilation")) << falls.out;
  write_slot(-0.2);  // the walls support the key without friction
  EXPECT_FALSE(says(limit("--with-dilation"), not_asked_for));
  EXPECT_TRUE(says(limit("--with-dilation"), "associated flow"));
}

// If the strength that is needed is less than the search resolves, there is no number either.
TEST_F(LimitWords, OfNextToNoStrengthAreNoInfinity) {
  write("plane.toml",
        "dimension = 2\ngravity = [1e-8, -10]\ndensity = 2000\n"
        "blocks = [{ name = \"base\", box = { min = [-2, -1], max = [2, 0] }, fixed = true },\n"
        "          { name = \"block\", box = { min = [-1, 0], max = [1, 1] } }]\n"
        "joint_properties = [{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]\n"
        "stage = [{ name = \"s\", kind = \"settle\" }]\n");
  const Ended ended = run("limit plane.toml --factor --out out");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_FALSE(says(ended, "inf")) << ended.out;
  EXPECT_TRUE(says(ended, "no factor up to it is critical")) << ended.out;
}

}  // namespace
}  // namespace voussoir::limit_words_test
