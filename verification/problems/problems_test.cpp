// The problem files against recomputation by other means: masses, planes, corners, moments; the schema; the sizes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "verification/problems/problems.hpp"
#include "verification/problems/references.hpp"
#include "verification/problems/schema_check.hpp"
#include "verification/problems/solid.hpp"
#include "verification/problems/write_geometry.hpp"
#include "verification/problems/write_json.hpp"
#include "verification/problems/write_programs.hpp"
#include "verification/problems/write_text.hpp"
#include "verification/verdict_file.hpp"

namespace voussoir::problems::problems_test {
namespace {

using Json = nlohmann::json;

const std::vector<Problem>& all() {
  static const std::vector<Problem> problems = all_problems();
  return problems;
}

Point point_of(const Json& json) {
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

// volume, and integrals over it of place and of products of coordinates: tetrahedra from the middle of the corners,
// each by the four points that integrate polynomials of second degree exactly
struct Integrals {
  double volume = 0;
  Point first = Point::Zero();
  Axes second = Axes::Zero();
};

Integrals integrals_of(const std::vector<Point>& corners, const Json& faces) {
  Integrals sum;
  Point middle = Point::Zero();
  for (const Point& p : corners)
    middle += p / static_cast<double>(corners.size());
  const double b = (5 - std::sqrt(5.0)) / 20, a = 1 - 3 * b;
  for (const Json& face : faces)
    for (std::size_t k = 1; k + 1 < face["corners"].size(); ++k) {
      const Point t[] = {middle, corners[face["corners"][0]], corners[face["corners"][k]],
                         corners[face["corners"][k + 1]]};
      const double volume = (t[1] - t[0]).dot((t[2] - t[0]).cross(t[3] - t[0])) / 6;
      sum.volume += volume;
      for (int i = 0; i < 4; ++i) {
        const Point q = b * (t[0] + t[1] + t[2] + t[3]) + (a - b) * t[i];
        sum.first += volume / 4 * q;
        sum.second += volume / 4 * q * q.transpose();
      }
    }
  return sum;
}

TEST(Problems, BlocksAgreeWithTheirCorners) {
  for (const Problem& problem : all()) {
    const Json json = Json::parse(blocks_json(problem).dump());
    for (const Json& block : json["blocks"]) {
      const std::string name = problem.name + ", " + block["name"].get<std::string>();
      std::vector<Point> world;
      for (const Json& v : block["vertices_m"])
        world.push_back(point_of(v));
      const Integrals sum = integrals_of(world, block["faces"]);
      const double mass = block["mass_kg"], density = block["density_kg_m3"], size = std::cbrt(sum.volume);
      EXPECT_NEAR(mass, density * sum.volume, 1e-10 * mass) << name;
      const Point centre = point_of(block["centre_m"]);
      EXPECT_LT((centre - sum.first / sum.volume).norm(), 1e-9 * size) << name;
      const Json& q = block["quaternion_wxyz"];
      const Axes axes =
          Eigen::Quaterniond(q[0].get<double>(), q[1].get<double>(), q[2].get<double>(), q[3].get<double>())
              .toRotationMatrix();
      const Axes about = sum.second - sum.volume * centre * centre.transpose();
      const Axes moments = axes.transpose() * (density * (about.trace() * Axes::Identity() - about)) * axes;
      const Point stated = point_of(block["moments_kg_m2"]);
      EXPECT_LT((moments - Axes(stated.asDiagonal())).cwiseAbs().maxCoeff(), 1e-8 * stated.maxCoeff()) << name;
      for (std::size_t k = 0; k < world.size(); ++k)
        EXPECT_LT((centre + axes * point_of(block["vertices_in_axes_m"][k]) - world[k]).norm(),
                  1e-12 * (1 + world[k].norm()))
            << name;
      if (!block["box_m"].is_null())
        for (const Point& corner : world)
          EXPECT_LT(((axes.transpose() * (corner - centre)).cwiseAbs() - 0.5 * point_of(block["box_m"])).norm(), 1e-12)
              << name;
    }
  }
}

TEST(Problems, PlanesHoldTheirCornersAndNoOthers) {
  for (const Problem& problem : all())
    for (const Solid& block : problem.blocks) {
      std::map<std::pair<int, int>, int> edges;  // each is in two faces, once in each direction
      for (const Face& face : block.faces) {
        EXPECT_NEAR(face.normal.norm(), 1, 1e-14);
        const std::set<int> own(face.corners.begin(), face.corners.end());
        for (std::size_t v = 0; v < block.vertices.size(); ++v) {
          const double off = face.normal.dot(block.vertices[v]) - face.offset;
          if (own.contains(static_cast<int>(v)))
            EXPECT_NEAR(off, 0, 1e-9) << problem.name << ", " << block.name;
          else
            EXPECT_LT(off, 1e-9) << problem.name << ", " << block.name;
        }
        for (std::size_t k = 0; k < face.corners.size(); ++k)
          ++edges[{face.corners[k], face.corners[(k + 1) % face.corners.size()]}];
      }
      for (const auto& [edge, times] : edges) {
        EXPECT_EQ(times, 1) << problem.name << ", " << block.name;
        EXPECT_TRUE(edges.contains({edge.second, edge.first})) << problem.name << ", " << block.name;
      }
    }
}

TEST(Problems, TheRockMassFillsItsBox) {
  double mass = 0;
  int free = 0;
  for (const Solid& block : all().back().blocks) {
    if (block.fixed) continue;
    mass += block.mass;
    ++free;
  }
  EXPECT_EQ(free, 327);
  EXPECT_NEAR(mass, 2600 * 5 * 4 * 4, 1e-6);
}

TEST(Problems, TheArchChangesWithItsThickness) {
  const Problem problem = arch();
  for (const Solid& block : problem.blocks) {
    if (block.fixed) continue;
    const std::vector<Point>& change = problem.search->change.at(block.name);
    ASSERT_EQ(change.size(), block.vertices.size());
    for (std::size_t k = 0; k < change.size(); ++k) {
      Point radial = block.vertices[k];
      radial[1] = 0;
      // radius is 5 m and half the thickness
      const double half = 0.5 * problem.search->nominal, beside = radial.norm() - 5;
      EXPECT_NEAR(std::abs(beside), half, 1e-12);
      EXPECT_LT((change[k] - 0.5 * (beside > 0 ? 1 : -1) * radial.normalized()).norm(), 1e-12);
    }
  }
}

TEST(Problems, KeepToTheSchema) {
  const Json schema =
      Json::parse(verification::read_text(VOUSSOIR_SOURCE_DIR "/verification/problems/blocks.schema.json"));
  for (const Problem& problem : all()) {
    const Json json = Json::parse(blocks_json(problem).dump());
    const std::vector<std::string> found = schema_violations(json, schema);
    EXPECT_TRUE(found.empty()) << problem.name << ": " << (found.empty() ? "" : found.front());
    // and the schema bites
    for (const auto& [key, value] : json.items()) {
      Json without = json;
      without.erase(key);
      EXPECT_FALSE(schema_violations(without, schema).empty()) << key;
    }
    Json other = json;
    other["blocks"][0]["mass_kg"] = -1;
    EXPECT_FALSE(schema_violations(other, schema).empty());
    other = json;
    other["blocks"][0]["colour"] = "red";
    EXPECT_FALSE(schema_violations(other, schema).empty());
  }
}

// a stopped block's two paths are rounding, so the rule needs its own length, in the file and in the words
TEST(Problems, GetsFasterStatesWhenABlockHasStopped) {
  const Json schema =
      Json::parse(verification::read_text(VOUSSOIR_SOURCE_DIR "/verification/problems/blocks.schema.json"));
  Json json = Json::parse(blocks_json(wedge()).dump());
  EXPECT_EQ(json["criterion"]["stopped_m"], 0.05);
  EXPECT_NE(task_text(wedge()).find("0.05 m"), std::string::npos);
  for (const char* key : {"stopped_m", "times_s", "block"}) {
    Json without = json;
    without["criterion"].erase(key);
    EXPECT_FALSE(schema_violations(without, schema).empty()) << key;
  }
  json["criterion"]["far_m"] = 0.3;  // belongs to the other criteria
  EXPECT_FALSE(schema_violations(json, schema).empty());
}

TEST(Problems, AskWhatTheyJudgeAndStayBelowFiveMegabytes) {
  std::size_t bytes = 0;
  for (const Problem& problem : all()) {
    ASSERT_EQ(problem.asked.size(), problem.references.size()) << problem.name;
    for (std::size_t k = 0; k < problem.asked.size(); ++k) {
      EXPECT_EQ(problem.asked[k].quantity, problem.references[k].quantity);
      EXPECT_TRUE(problem.references[k].joints || problem.references[k].rigid);
      EXPECT_NE(answer_text(problem).find(problem.asked[k].quantity), std::string::npos);
      EXPECT_NE(task_text(problem).find(problem.asked[k].quantity), std::string::npos);
    }
    const std::string program =
        problem.dimension == 2 ? udec_text(problem) : scene_text(problem) + three_dec_stages(problem);
    bytes += blocks_json(problem).dump(1).size() + blocks_obj(problem).size() + sketch_svg(problem).size() +
             task_text(problem).size() + scene_text(problem).size() + 3 * program.size();
  }
  EXPECT_LT(bytes, 5'000'000u);
}

TEST(Problems, NameCaseAndRowThatHaveNoVerdict) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "no_such_verdicts";
  std::filesystem::create_directories(folder);
  verification::write_atomically(folder / "incline.json", R"({"case": "incline", "rows": [], "failures": {}})");
  try {
    reference_json(incline(), folder);
    FAIL();
  } catch (const std::runtime_error& fault) {
    const std::string text = fault.what();
    EXPECT_NE(text.find("no row 'critical friction, 3-D'"), std::string::npos) << text;
    EXPECT_NE(text.find("ctest -R case.incline"), std::string::npos) << text;
  }
}

TEST(Problems, RefuseBlocksThatAreNotConvex) {
  const std::vector<std::pair<double, double>> dent{{0, 0}, {2, 0}, {1, 0.5}, {2, 2}};
  EXPECT_THROW(prism("dented", 1, dent, 1), std::invalid_argument);
  EXPECT_THROW(solid("bent", 1, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}, {0, 0, 1}}, {{3, 2, 1, 0}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::problems::problems_test
