// Sliced masses: verdicts, rounds and pairs of the projection against enumeration on contacts found by other code.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "cases/judged_scene.hpp"
#include "reference/key_blocks/judged_mass.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::masses_test {
namespace {

using reference::JudgedBlock;
using reference::JudgedMass;
using reference::MassVerdict;
using verification::CaseReport;
using verification::Kind;

reference::Vector3 plain(const Vector<3>& v) {
  return {v[0], v[1], v[2]};
}

JudgedMass mass_of(const Model<3>& model) {
  reference::BlockMass mass;
  mass.tan_friction = std::tan(model.properties[0].friction);
  for (const Body<3>& body : model.bodies) {
    reference::MassBlock& block = mass.blocks.emplace_back();
    block.fixed = body.fixed;
    block.volume = volume(body);
    if (!body.fixed) mass.load = plain(body.mass / block.volume * model.gravity);
    for (const Polytope<3>& part : body.parts)
      for (std::size_t f = 0; f < part.faces.size(); ++f) {
        reference::MassFace& face = block.faces.emplace_back();
        face.joint = part.joints[f];
        face.outward = plain(part.faces[f].normal);
        for (const int vertex : part.loops[f])
          face.corners.push_back(plain(body.reference + part.vertices[vertex]));
      }
  }
  return JudgedMass(std::move(mass));
}

MassVerdict verdict_of(const SurveyRow<3>& row) {
  switch (row.kind()) {
    case BlockKind::enclosed:
      return MassVerdict::enclosed;
    case BlockKind::tapered:
      return MassVerdict::tapered;
    case BlockKind::slides:
      return row.bolted.verdict.loaded == 1 ? MassVerdict::one_face : MassVerdict::two_faces;
    case BlockKind::falls:
      return MassVerdict::falls;
    default:
      return MassVerdict::stable;
  }
}

constexpr std::array<const char*, 6> words{
    "enclosed", "tapered", "stable without friction", "that slide on a face", "that slide on two faces", "that fall"};

struct Compare {
  CaseReport& report;
  std::string mass;  // ", name"

  void equal(const std::string& quantity, double expected, double found) const {
    report.record({quantity + mass, "1", Kind::exact, "enumeration, reference/key_blocks", expected, {0, 0}, "a count"},
                  found);
  }
  void at_most(const std::string& quantity, double bound, const std::string& because, double found) const {
    report.record({quantity + mass,
                   "1",
                   Kind::limit,
                   "enumeration, reference/key_blocks",
                   0,
                   {bound, 0, verification::Bound::at_most},
                   because},
                  found);
  }

  void verdicts(const Survey<3>& survey, const JudgedMass& reference) const {
    std::array<int, 6> expected{}, found{};
    int different = 0;
    double factors = 0, directions = 0;
    for (const SurveyRow<3>& row : survey.rows) {
      const JudgedBlock other = reference.judge(row.bodies);
      const MassVerdict verdict = verdict_of(row);
      ++expected[static_cast<int>(other.verdict)];
      ++found[static_cast<int>(verdict)];
      different += verdict != other.verdict;
      if (!other.moves() || !moves(row.kind())) continue;
      factors = std::max(factors, std::abs(*row.bolted.factor - other.factor) / (1 + other.factor));
      for (int k = 0; k < 3; ++k)
        directions = std::max(directions, std::abs(row.bolted.verdict.direction()[k] - other.direction[k]));
    }
    equal("contacts", static_cast<double>(reference.contacts().size()),
          static_cast<double>(survey.assembly.contacts.list.size()));
    for (std::size_t k = 0; k < words.size(); ++k)
      if (expected[k] + found[k] > 0) equal(std::string("blocks ") + words[k], expected[k], found[k]);
    equal("blocks whose verdicts differ", 0, different);
    if (expected[3] + expected[4] == 0) return;
    const std::string rounding = "rounding of the normals, 1e-16, over the sine between two faces";
    at_most("factors, largest difference of F/(1 + F)", 1e-9, rounding, factors);
    at_most("directions, largest difference", 1e-9, rounding, directions);
  }

  // in the text of each round the number of blocks that fail
  void rounds(const std::string& rule, const std::vector<std::vector<int>>& expected,
              const SuccessiveFailure& found) const {
    int blocks = 0, different = 0;
    double removed = 0;
    for (std::size_t r = 0; r < expected.size(); ++r) {
      blocks += static_cast<int>(expected[r].size());
      different += r >= found.rounds.size() || found.rounds[r] != expected[r];
    }
    for (const double of_round : found.volumes)
      removed += of_round;
    int found_blocks = 0;
    for (const std::vector<int>& round : found.rounds)
      found_blocks += static_cast<int>(round.size());
    equal("rounds, " + rule, static_cast<double>(expected.size()), static_cast<double>(found.rounds.size()));
    equal("blocks removed, " + rule, blocks, found_blocks);
    equal("rounds that remove other blocks, " + rule, 0, different);
    report.report("volume removed, " + rule + mass, "m3", removed, "by the program");
  }

  void pairs(const Survey<3>& survey, const JudgedMass& reference) const {
    long moving = 0;
    std::size_t lower = 0;
    const auto factor = [&](const std::vector<int>& bodies) {
      const JudgedBlock judged = reference.judge(bodies);
      return judged.moves() ? judged.factor : std::numeric_limits<double>::max();
    };
    const std::vector<std::pair<int, int>> all = reference.pairs();
    for (const auto& [a, b] : all) {
      const double pair = factor({a, b});
      if (pair == std::numeric_limits<double>::max()) continue;
      ++moving;
      lower += pair < std::min(factor({a}), factor({b})) * (1 - 1e-9);
    }
    const std::vector<BoltedVerdict<3>> single = judge_all<3>(survey.assembly, {});
    equal("pairs", static_cast<double>(all.size()), static_cast<double>(survey.pairs));
    equal("pairs that move as one", static_cast<double>(moving), static_cast<double>(survey.moving_pairs));
    equal("pairs lower than both blocks", static_cast<double>(lower),
          static_cast<double>(find_clusters<3>(survey.assembly, single, {}, 2).lower.size()));
  }
};

void compare(CaseReport& report, const std::string& scene, const std::string& name,
             const std::vector<std::string>& overrides = {}) {
  const Survey<3> survey = judged(scene, overrides, {.frictionless = true});
  const JudgedMass reference = mass_of(survey.assembly.model);
  const Compare with{report, ", " + name};
  with.verdicts(survey, reference);
  with.rounds("F < 1", reference.rounds(1), survey.below_one);
  with.rounds("blocks that move without friction", reference.rounds(std::numeric_limits<double>::max()),
              survey.frictionless);
  with.pairs(survey, reference);
}

TEST(Masses, HaveTheVerdictsRoundsAndPairsOfAnEnumeration) {
  CaseReport report("key_blocks", {"blocks whose verdicts differ, bench", "pairs lower than both blocks, scatter"});
  compare(report, "../slicing/rock_mass.toml", "rock mass");
  compare(report, "../slicing/bench.toml", "bench");
  compare(report, "scatter.toml", "scatter");
  compare(report, "columns.toml", "columns");
}

// of sixty masses these have pairs lower than both their blocks; in the first two the pair is below 1 and neither block
// is
TEST(Masses, HavePairsBelowOneWhoseBlocksAreNot) {
  CaseReport report("key_blocks");
  for (const int s : {16, 17, 46}) {
    const std::string name = fmt::format("seeds {}, {}, {}", 100 + s, 200 + s, 300 + s);
    const std::vector<std::string> seeds{fmt::format("joint_sets.bedding.seed={}", 100 + s),
                                         fmt::format("joint_sets.steep.seed={}", 200 + s),
                                         fmt::format("joint_sets.cross.seed={}", 300 + s)};
    const Survey<3> survey = judged("scatter.toml", seeds);
    const JudgedMass reference = mass_of(survey.assembly.model);
    const std::vector<BoltedVerdict<3>> single = judge_all<3>(survey.assembly, {});
    const std::vector<Cluster<3>> lower = find_clusters<3>(survey.assembly, single, {}, 2).lower;
    ASSERT_FALSE(lower.empty()) << name;
    const std::vector<int>& pair = lower[0].bodies;
    const auto factor = [&](const std::string& of, const std::vector<int>& bodies, std::optional<double> found) {
      const JudgedBlock judged_block = reference.judge(bodies);
      if (!judged_block.moves()) {
        EXPECT_FALSE(found) << name;
        return;
      }
      report.record({"factor, " + of + ", " + name,
                     "1",
                     Kind::exact,
                     "enumeration, reference/key_blocks",
                     judged_block.factor,
                     {0, 1e-9},
                     "rounding"},
                    found.value_or(0));
    };
    factor(fmt::format("blocks {} and {} as one", pair[0], pair[1]), pair, lower[0].verdict.factor);
    for (const int body : pair)
      factor(fmt::format("block {}", body), {body}, single[body].factor);
  }
}

// nothing is fixed and nothing is around: all of it goes
TEST(MassesLong, OfAHundredThousandBlocks) {
  CaseReport report("key_blocks");
  compare(report, "../slicing/table_4_1_persistent.toml", "Table 4.1",
          {"joint_sets.A.intensity=0.54", "joint_sets.B.intensity=0.54", "joint_sets.C.intensity=0.54"});
}

}  // namespace
}  // namespace voussoir::cases::masses_test
