// Boxes on inclines that are free to turn: factor and eccentricity of pressure say how each moves.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>

#include "cases/judged_scene.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::boxes_test {
namespace {

using verification::CaseReport;
using verification::Kind;

struct Box {
  double breadth, depth, height;  // m
  double lean, sideways;          // of its top against its base, over the height
  double turned;                  // rad, about the normal of the plane
  double slope, friction;         // rad

  std::vector<Vector<3>> corners() const {
    std::vector<Vector<3>> all;
    for (const double z : {0.0, height})
      for (const double x : {-0.5, 0.5})
        for (const double y : {-0.5, 0.5}) {
          const double u = x * breadth + lean * z, v = y * depth + sideways * z;
          all.emplace_back(std::cos(turned) * u - std::sin(turned) * v, std::sin(turned) * u + std::cos(turned) * v, z);
        }
    return all;
  }
  std::vector<std::string> overrides() const {
    std::string list;
    for (const Vector<3>& corner : corners())
      list += fmt::format("{}[{:.12g}, {:.12g}, {:.12g}]", list.empty() ? "" : ", ", corner[0], corner[1], corner[2]);
    return {fmt::format("gravity=[{:.12g}, 0, {:.12g}]", 9.81 * std::sin(slope), -9.81 * std::cos(slope)),
            "blocks.box.vertices=[" + list + "]",
            fmt::format("joint_properties.rock.friction_deg={:.12g}", friction / degree)};
  }
};

class Boxes {
 public:
  explicit Boxes(unsigned seed) : random_(seed) {}
  Box next() {
    const double height = between(0.5, 2);
    return {height * between(0.2, 3), height * between(0.2, 3), height,
            between(-0.3, 0.3),       between(-0.3, 0.3),       between(0, 3),
            between(8, 42) * degree,  between(12, 55) * degree};
  }

 private:
  double between(double low, double high) {
    return boost::random::uniform_real_distribution<double>(low, high)(random_);
  }
  boost::random::mt19937 random_;
};

// by limit equilibrium; of a box that would do both, inertia decides which of the two it does (Sagaseta 1986)
enum class Motion { stands, slides, turns, slides_or_turns };
constexpr std::array<const char*, 4> words{"stand", "slide", "turn", "slide, turn or both"};

struct Start {
  double slip = 0, turn = 0;  // m, rad
};

// the least displacement of a corner of the base is slip: a box that turns about an edge leaves it in its place
Start start_of(const Box& box, const SceneRun& run) {
  const auto last = [&](const std::string& quantity, char axis) {
    return column(run, fmt::format("box_{}_{}", quantity, axis) + (quantity == "displacement" ? "_m" : "_deg")).back() *
           (quantity == "displacement" ? 1 : degree);
  };
  const Vector<3> way(last("displacement", 'x'), last("displacement", 'y'), last("displacement", 'z')),
      rotation(last("rotation", 'x'), last("rotation", 'y'), last("rotation", 'z'));
  Vector<3> centroid(0, 0, 0.5 * box.height);
  for (const Vector<3>& corner : box.corners())
    centroid.head<2>() += corner.head<2>() / 8;
  Start start{1e9, rotation.norm()};
  for (const Vector<3>& corner : box.corners()) {
    if (corner[2] > 0) continue;
    const Vector<3> arm = corner - centroid;
    const Vector<3> turned =
        start.turn > 0 ? Vector<3>(Eigen::AngleAxisd(start.turn, rotation / start.turn) * arm) : arm;
    start.slip = std::min(start.slip, (way + turned - arm).norm());
  }
  return start;
}

bool is(Motion motion, const Start& start, double size) {
  const bool slips = start.slip > 0.005 * size, turns = start.turn > 0.02;
  switch (motion) {
    case Motion::stands:
      return !slips && !turns;
    case Motion::slides:
      return slips && !turns;
    case Motion::turns:
      return turns;
    case Motion::slides_or_turns:
      return slips || turns;
  }
  return false;
}

TEST(Boxes, MoveAsFactorAndEccentricityOfPressureSay) {
  CaseReport report("key_blocks", {"boxes that move otherwise"});
  Boxes drawn(5);
  std::array<int, 4> wanted{6, 6, 6, 6}, counts{}, right{};
  int left_out = 0;
  while (counts != wanted) {
    const Box box = drawn.next();
    const Survey<3> survey = judged("box.toml", box.overrides());
    const SurveyRow<3>& row = only_block(survey);
    const double factor = *row.bolted.factor, eccentricity = *row.eccentricity;
    // an elastic joint without tension lets go before the pressure is at the edge; the ramp of gravity overshoots
    if (std::abs(eccentricity - 1) < 0.1 || std::abs(factor - 1) < 0.05) {
      ++left_out;
      continue;
    }
    const Motion motion = factor >= 1 ? (eccentricity < 1 ? Motion::stands : Motion::turns)
                                      : (eccentricity < 1 ? Motion::slides : Motion::slides_or_turns);
    const int k = static_cast<int>(motion);
    if (counts[k] == wanted[k]) continue;
    ++counts[k];
    const SceneRun done = run("box.toml", box.overrides());
    const Start start = start_of(box, done);
    right[k] += is(motion, start, box.height);
    report.report(
        fmt::format("slip of box {} that shall {}", counts[k], words[k]), "m", start.slip,
        fmt::format("turns by {:.3f} rad; factor {:.3f}, eccentricity {:.3f}", start.turn, factor, eccentricity),
        cost(done));
  }
  for (std::size_t k = 0; k < words.size(); ++k)
    report.record({fmt::format("boxes that {}", words[k]),
                   "1",
                   Kind::exact,
                   "limit equilibrium of forces and moments, core/key_blocks/pressure_eccentricity",
                   counts[k] * 1.0,
                   {0, 0},
                   "a count: boxes within 10 % of the edge and 5 % of the strength are not drawn"},
                  right[k]);
  report.record(
      {"boxes that move otherwise", "1", Kind::exact, "limit equilibrium of forces and moments", 0, {0, 0}, "a count"},
      24 - right[0] - right[1] - right[2] - right[3]);
  report.report("boxes left out", "1", left_out, "too close to a border");
}

}  // namespace
}  // namespace voussoir::cases::boxes_test
