// Wedges, slopes and roof blocks whose inputs and results are published, from scenes that state their planes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/judged_scene.hpp"
#include "core/testing/stated_block.hpp"
#include "reference/key_blocks/slope_wedge.hpp"
#include "reference/water/wet_slopes.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::published_test {
namespace {

using reference::SlopeWedge;
using reference::SlopeWedgeSolid;
using verification::CaseReport;
using verification::Kind;

constexpr double foot = 0.3048, psf = 47.88025898, pcf = 157.087463863, pound = 4.4482216152605;  // m, Pa, N/m³, N
constexpr double million_pounds = 1e6 * pound, gravity = 9.81;
const std::string printed = "Hoek & Bray (1981), comprehensive solution";
constexpr double computed = 1e-9;  // relative: rounding of two programs
const std::string rounding = "rounding: 1e-16 of coordinates up to 200 m, which areas of a few m2 magnify";

double plunge(const Vector<3>& v) {
  return -std::asin(v.normalized()[2]) / degree;
}
double trend(const Vector<3>& v) {
  const double angle = std::atan2(v[0], v[1]) / degree;
  return angle < 0 ? angle + 360 : angle;
}
Vector<3> direction(double plunge_deg, double trend_deg) {
  return {std::cos(plunge_deg * degree) * std::sin(trend_deg * degree),
          std::cos(plunge_deg * degree) * std::cos(trend_deg * degree), -std::sin(plunge_deg * degree)};
}

reference::PlaneAngles plane(double dip, double dip_direction) {
  return {dip * degree, dip_direction * degree};
}

// a slope wedge, its strength and its water
struct Stated {
  SlopeWedge planes;
  double friction_a = 0, friction_b = 0;  // deg
  double cohesion_a = 0, cohesion_b = 0;  // Pa
  double unit_weight = 0;                 // N/m³
  double pressure = 0;                    // Pa, on the joints and in the crack
};

SlopeWedge hoek_and_bray_planes() {
  return {plane(45, 105), plane(70, 235), plane(65, 185), plane(12, 195), 100 * foot, plane(70, 165), 40 * foot};
}
Stated hoek_and_bray() {
  return {hoek_and_bray_planes(), 20, 30, 500 * psf, 1000 * psf, 160 * pcf, 0};
}

std::string vector_text(const reference::Vector3& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v[0], v[1], v[2]);
}

// as overrides of wet_wedge.toml; without a crack the scene's is moved far behind the wedge
std::vector<std::string> overrides_of(const Stated& stated) {
  const SlopeWedge& w = stated.planes;
  SlopeWedge cracked = w;
  if (!w.crack) {
    cracked.crack = plane(70, 165);
    cracked.crack_distance = 3 * w.crest_height;
  }
  const SlopeWedgeSolid solid = solid_of(cracked);
  std::vector<std::string> sets;
  const auto turn = [&](const std::string& table, const reference::PlaneAngles& angles) {
    sets.push_back(fmt::format("{}.dip={:.17g}", table, angles.dip / degree));
    sets.push_back(fmt::format("{}.dip_direction={:.17g}", table, angles.direction / degree));
  };
  turn("joints.A", w.a);
  turn("joints.B", w.b);
  turn("domain.planes.face", w.face);
  turn("domain.planes.upper", w.upper);
  turn("joints.crack", *cracked.crack);
  sets.push_back("domain.planes.upper.point=" + vector_text(solid.crest));
  sets.push_back("joints.crack.point=" + vector_text(solid.crack_point));
  sets.push_back(fmt::format("density={:.17g}", stated.unit_weight / gravity));
  sets.push_back(fmt::format("water.joints.pressure={:.17g}", stated.pressure));
  sets.push_back(fmt::format("joint_properties.A.cohesion={:.17g}", stated.cohesion_a));
  sets.push_back(fmt::format("joint_properties.B.cohesion={:.17g}", stated.cohesion_b));
  sets.push_back(
      fmt::format("stage.safety.friction=[{{ name = \"A\", friction_deg = {:.17g} }}, {{ name = \"B\", friction_deg = "
                  "{:.17g} }}, {{ name = \"crack\", friction_deg = 0 }}]",
                  stated.friction_a, stated.friction_b));
  return sets;
}

// the same by limit equilibrium; in the crack the water pushes along its normal
reference::Wedge wedge_of(const Stated& stated) {
  const SlopeWedge& w = stated.planes;
  const SlopeWedgeSolid solid = solid_of(w);
  reference::Wedge wedge;
  wedge.weight = stated.unit_weight * solid.volume;
  wedge.a = {w.a.dip, w.a.direction, stated.friction_a * degree, stated.cohesion_a * solid.area_a,
             stated.pressure * solid.area_a};
  wedge.b = {w.b.dip, w.b.direction, stated.friction_b * degree, stated.cohesion_b * solid.area_b,
             stated.pressure * solid.area_b};
  if (w.crack) {
    const reference::Vector3 n = reference::upward_normal(w.crack->dip, w.crack->direction);
    for (int k = 0; k < 3; ++k)
      wedge.extra_force[k] = stated.pressure * solid.area_crack * n[k];
  }
  return wedge;
}

struct Judge {
  CaseReport& report;

  void equal(const std::string& quantity, const std::string& unit, double expected, double found) const {
    report.record(
        {quantity, unit, Kind::exact, "limit equilibrium, reference/key_blocks", expected, {0, computed}, rounding},
        found);
  }
  // `relative`: of a printed number
  void print(const std::string& quantity, const std::string& unit, double expected, double found,
             const verification::Tolerance& tolerance, const std::string& because) const {
    report.record({quantity, unit, Kind::published, printed, expected, tolerance, because}, found);
  }
};

const std::string digits = "the printed digits";
const std::string by_hand = "printed coefficients of the hand calculation are rounded to three or four digits";

TEST(HoekAndBrayWedge, HasThePrintedForcesWhenDry) {
  CaseReport report("key_blocks", {"Hoek & Bray dry: factor"});
  const Judge judge{report};
  const Stated stated = hoek_and_bray();
  const Survey<3> survey = judged("wet_wedge.toml", overrides_of(stated));
  const SurveyRow<3>& row = only_block(survey);
  const SlopeWedgeSolid solid = solid_of(stated.planes);
  const reference::WedgeSolution expected = solve_wedge(wedge_of(stated));
  judge.equal("Hoek & Bray: volume", "m3", solid.volume, row.volume);
  judge.equal("Hoek & Bray: area on A", "m2", solid.area_a, face_on(survey, row, "A")->area);
  judge.equal("Hoek & Bray: area on B", "m2", solid.area_b, face_on(survey, row, "B")->area);
  judge.equal("Hoek & Bray: area of the crack", "m2", solid.area_crack, face_on(survey, row, "crack")->area);
  judge.equal("Hoek & Bray dry: factor", "1", expected.factor_of_safety, *row.bolted.factor);
  const double force_a = normal_force_on(survey, row, "A"), force_b = normal_force_on(survey, row, "B");
  judge.equal("Hoek & Bray dry: force on A", "N", expected.normal_force_a, force_a);
  judge.equal("Hoek & Bray dry: force on B", "N", expected.normal_force_b, force_b);
  judge.print("Hoek & Bray dry: printed force on A", "10^6 lb", 22.565, force_a / million_pounds, {0, 5e-4}, by_hand);
  judge.print("Hoek & Bray dry: printed force on B", "10^6 lb", 13.853, force_b / million_pounds, {0, 5e-4}, by_hand);
  judge.print("Hoek & Bray dry: printed driving force", "10^6 lb", 14.644,
              row.bolted.verdict.driving() / million_pounds, {5e-4, 0}, digits);
  judge.print("Hoek & Bray dry: printed factor", "1", 1.736, *row.bolted.factor, {0, 5e-4}, by_hand);
}

TEST(HoekAndBrayWedge, HasThePrintedFactorAndBoltWhenWet) {
  CaseReport report("key_blocks", {"Hoek & Bray wet: printed factor"});
  const Judge judge{report};
  Stated stated = hoek_and_bray();
  stated.pressure = mean_water_pressure(solid_of(stated.planes), true, 62.5 * pcf);
  judge.print("Hoek & Bray wet: printed pressure", "psf", 1084.3, stated.pressure / psf, {0.05, 0}, digits);
  const Survey<3> survey = judged("wet_wedge.toml", overrides_of(stated), {.required = 1.5});
  const SurveyRow<3>& row = only_block(survey);
  const Verdict<3>& verdict = row.bolted.verdict;
  judge.equal("Hoek & Bray wet: factor", "1", solve_wedge(wedge_of(stated)).factor_of_safety, *row.bolted.factor);
  judge.print("Hoek & Bray wet: printed factor", "1", 1.1378, *row.bolted.factor, {5e-5, 0}, digits);
  const std::string of_pressure = "the pressure is rounded to 3e-5, which moves forces by 1e-4";
  judge.print("Hoek & Bray wet: printed force on A", "10^6 lb", 15.171,
              normal_force_on(survey, row, "A") / million_pounds, {0, 2e-4}, of_pressure);
  judge.print("Hoek & Bray wet: printed force on B", "10^6 lb", 5.7892,
              normal_force_on(survey, row, "B") / million_pounds, {0, 2e-4}, of_pressure);
  judge.print("Hoek & Bray wet: printed driving force", "10^6 lb", 15.886, verdict.driving() / million_pounds,
              {5e-4, 0}, digits);
  judge.print("Hoek & Bray wet: printed resistance", "10^6 lb", 18.075,
              (verdict.friction + verdict.cohesion) / million_pounds, {5e-4, 0}, digits);
  judge.print("Hoek & Bray wet: printed least bolt force for 1.5", "10^6 lb", 3.4307,
              row.force->force.norm() / million_pounds, {0, 2e-4}, of_pressure);
  judge.print("Hoek & Bray wet: printed plunge of that bolt", "deg", -6.98, plunge(row.force->force), {0.005, 0},
              digits);
  judge.print("Hoek & Bray wet: printed trend of that bolt", "deg", 349.43, trend(row.force->force), {0.005, 0},
              digits);
  // the force, put on the wedge
  reference::Wedge bolted = wedge_of(stated);
  for (int k = 0; k < 3; ++k)
    bolted.extra_force[k] += row.force->force[k];
  judge.equal("Hoek & Bray wet: factor under the least bolt force", "1", 1.5, solve_wedge(bolted).factor_of_safety);
}

double factor_under(reference::Wedge wedge, const Vector<3>& force) {
  for (int k = 0; k < 3; ++k)
    wedge.extra_force[k] += force[k];
  return solve_wedge(wedge).factor_of_safety;
}

// the horizontal trend in which a force makes the factor least: the best of whole degrees, then thirds
double worst_trend(const reference::Wedge& wedge, double size) {
  const auto factor = [&](double deg) { return factor_under(wedge, size * direction(0, deg)); };
  double best = 0;
  for (int deg = 1; deg < 360; ++deg)
    if (factor(deg) < factor(best)) best = deg;
  double from = best - 1, to = best + 1;
  for (int k = 0; k < 40; ++k) {
    const double left = from + (to - from) / 3, right = to - (to - from) / 3;
    (factor(left) > factor(right) ? from : to) = factor(left) > factor(right) ? left : right;
  }
  return 0.5 * (from + to);
}

TEST(HoekAndBrayWedge, HasTheWorstEarthquakeOfAScanOfTrends) {
  CaseReport report("key_blocks", {"Hoek & Bray in the worst earthquake, k = 0.3: factor"});
  const Judge judge{report};
  const Stated stated = hoek_and_bray();
  const reference::Wedge wedge = wedge_of(stated);
  for (const double k : {0.05, 0.15, 0.3}) {
    const std::string of = fmt::format("Hoek & Bray in the worst earthquake, k = {}: ", k);
    const Survey<3> survey = judged("wet_wedge.toml", overrides_of(stated), {.seismic = SeismicRequest{k}});
    const SurveyRow<3>& row = only_block(survey);
    const double expected = worst_trend(wedge, k * wedge.weight);
    judge.equal(of + "factor", "1", factor_under(wedge, k * wedge.weight * direction(0, expected)), *row.worst.factor);
    report.record({of + "trend",
                   "deg",
                   Kind::exact,
                   "scan of all trends, reference/wedge",
                   expected,
                   {1e-3, 0},
                   "the factor is flat there: rounding of 1e-14 is a millionth of a radian"},
                  trend(row.worst.direction));
    report.report(of + "factor along the line of sliding", "1", *row.factor_own_trend, "not the worst direction");
    judge.equal(of + "factor at the critical coefficient", "1", 1,
                factor_under(wedge, *row.critical_coefficient * wedge.weight *
                                        direction(0, worst_trend(wedge, *row.critical_coefficient * wedge.weight))));
  }
  // a force that the scene states, in the direction that the book calls the worst
  std::vector<std::string> sets = overrides_of(stated);
  const Vector<3> worst = 8 * million_pounds * direction(-1.62, 173.03);
  sets.push_back(fmt::format("stage.safety.force=[{{ name = \"E\", above = [\"A\", \"B\", \"crack\"], force = {} }}]",
                             vector_text({worst[0], worst[1], worst[2]})));
  const Survey<3> forced = judged("wet_wedge.toml", sets);
  judge.print("Hoek & Bray dry: printed factor under 8 10^6 lb", "1", 1.04, *only_block(forced).bolted.factor,
              {5e-3, 0}, digits);
}

TEST(PublishedWedges, OfTwoPlanesWithoutCrack) {
  CaseReport report("key_blocks", {"Low (1997), row 1: factor"});
  const Judge judge{report};
  Stated stated = hoek_and_bray();
  stated.planes.crack.reset();
  stated.planes.crest_height = crest_height_of_line(stated.planes, 130 * foot);
  std::swap(stated.friction_a, stated.friction_b);
  stated.pressure = mean_water_pressure(solid_of(stated.planes), false, 62.5 * pcf);
  const auto factor = [](const Stated& of) {
    return *only_block(judged("wet_wedge.toml", overrides_of(of))).bolted.factor;
  };
  judge.equal("chart's wedge, filled: factor", "1", solve_wedge(wedge_of(stated)).factor_of_safety, factor(stated));
  report.report("chart's wedge, filled: factor printed from the chart", "1", 1.36,
                "angles read to the degree: no target");
  // lythoskinematic (tests/test_validation.py), whose water has the whole height
  Stated equal{stated.planes, 35, 35, 0, 0, 25e3, 0};
  equal.planes.crest_height = 40;
  const auto lythos = [&](const std::string& quantity, double expected) {
    report.record({quantity,
                   "1",
                   Kind::published,
                   "lythoskinematic, closed form of Hoek & Bray (1981)",
                   expected,
                   {0, 1e-9},
                   rounding},
                  factor(equal));
  };
  lythos("lythoskinematic, dry: factor", 1.7407205230520555);
  equal.pressure = mean_water_pressure(solid_of(equal.planes), false, 9810);
  lythos("lythoskinematic, filled: factor", 0.8024581439219098);

  struct Row {
    double beta_1, beta_2, delta_1, delta_2, face, upper, friction_1, friction_2, cohesion_1, cohesion_2, height,
        weight, water;
  };
  int number = 0;
  for (const Row& row : {Row{62, 20, 50, 48, 70, 0, 30, 30, 41.6e3, 41.6e3, 16, 26e3, 0.5},
                         Row{62, 20, 50, 48, 70, 0, 30, 30, 41.6e3, 41.6e3, 16, 26e3, 0},
                         Row{45, 35, 55, 60, 68, 0, 32, 28, 20e3, 15e3, 25, 25.5e3, 0},
                         Row{45, 35, 55, 60, 68, 12, 32, 28, 20e3, 15e3, 25, 25.5e3, 0},
                         Row{45, 35, 55, 60, 68, 12, 32, 28, 20e3, 15e3, 25, 25.5e3, 0.3}}) {
    const reference::LowWedge low{row.beta_1 * degree,
                                  row.beta_2 * degree,
                                  row.delta_1 * degree,
                                  row.delta_2 * degree,
                                  row.face * degree,
                                  row.upper * degree,
                                  row.friction_1 * degree,
                                  row.friction_2 * degree,
                                  row.cohesion_1,
                                  row.cohesion_2,
                                  row.height,
                                  row.weight,
                                  row.water};
    const Stated wedge{planes_of(low),
                       row.friction_1,
                       row.friction_2,
                       row.cohesion_1,
                       row.cohesion_2,
                       row.weight,
                       row.water * 9810 * row.height / 3};
    report.record({fmt::format("Low (1997), row {}: factor", ++number),
                   "1",
                   Kind::exact,
                   "Low (1997), closed form, reference/key_blocks",
                   factor_of_safety(low, 9810),
                   {0, computed},
                   rounding},
                  factor(wedge));
  }
}

// Wyllie & Mah (2004), chapter 6: 12 m, face 60, plane 35, a crack 4 m behind the crest
TEST(PublishedSlopes, PlaneFailureWithATensionCrack) {
  CaseReport report("key_blocks", {"plane failure, 3 m of water: factor"});
  reference::PlaneFailure slope{12, 60 * degree, 35 * degree, 4, 26e3, 0, 25e3, 37 * degree};
  const double back = slope.height / std::tan(slope.face) + slope.crack_distance;
  for (const double water : {0.0, 1.5, 3.0}) {
    slope.water_in_crack = water;
    const double high = back * std::tan(slope.joint) + water;
    const std::string table =
        water == 0 ? "[[0, -90], [1, -90]]" : fmt::format("[[0, 0], [{:.17g}, {:.17g}]]", back, high);
    const Survey<2> survey = judged<2>(
        "../water/slope.toml",
        {"domain.box.max=[28, 12]", fmt::format("joints.crack.point=[{:.17g}, 0]", back),
         "water.crack and joint.table=" + table, "joint_properties.joint.friction_deg=37",
         "joint_properties.joint.cohesion=25e3", "joint_properties.crack.friction_deg=0", "stage.settle.bond=true"});
    const double found = *only_block(survey).bolted.factor;
    report.record({fmt::format("plane failure, {:g} m of water: factor", water),
                   "1",
                   Kind::exact,
                   "Hoek & Bray (1981), plane failure, reference/water",
                   factor_of_safety(slope),
                   {0, 1e-9},
                   rounding},
                  found);
    if (water == 3)
      report.record({"plane failure, 3 m of water: printed factor",
                     "1",
                     Kind::published,
                     "Wyllie & Mah (2004), chapter 6",
                     1.25,
                     {5e-3, 0},
                     digits},
                    found);
  }
}

// a pyramid of planes, above (0) or below (1) each, and whether it is removable from a free surface
bool is_removable_from(const std::vector<Vector<3>>& into_block, const Vector<3>& into_rock) {
  std::vector<Vector<3>> with_surface = into_block;
  with_surface.push_back(into_rock);
  return find_removability(into_block).removable && !find_removability(with_surface).removable;
}

Verdict<3> judge_under_weight(const std::vector<Vector<3>>& into_block) {
  std::vector<StatedFace> faces;
  for (const Vector<3>& normal : into_block)
    faces.push_back({normal});
  const Block<3> block = block_of(faces, 1);
  return voussoir::judge<3>(block, block.stated.force, Vector<3>(0, 0, -gravity));
}

void record_list(CaseReport& report, const std::string& quantity, const std::string& source,
                 const std::string& expected, const std::string& found) {
  report.record(
      {quantity + " (" + expected + ")", "1", Kind::published, source, 1, {0, 0}, "a list: it is equal or not"},
      found == expected);
  EXPECT_EQ(found, expected);
}

TEST(PublishedPyramids, OfGoodman) {
  CaseReport report("key_blocks");
  const std::array<Vector<3>, 3> sets{above(30, 90), above(60, 45), above(20, 330)};
  const auto removable = [&](const Vector<3>& into_rock) {
    std::string found;
    for (int code = 0; code < 8; ++code) {
      std::vector<Vector<3>> normals;
      for (int s = 0; s < 3; ++s)
        normals.push_back(code >> (2 - s) & 1 ? Vector<3>(-sets[s]) : sets[s]);
      if (is_removable_from(normals, into_rock)) found += fmt::format("{:03b}", code);
    }
    return found;
  };
  const std::string source = "Goodman (1989), as in Brady & Brown";
  record_list(report, "pyramids removable from the roof", source, "101", removable({0, 0, 1}));
  record_list(report, "pyramids removable from the south wall", source, "100", removable({0, -1, 0}));
  record_list(report, "pyramids removable from the north wall", source, "011", removable({0, 1, 0}));
}

TEST(PublishedPyramids, OfHarrisonAndHudson) {
  CaseReport report("key_blocks");
  const std::array<Vector<3>, 5> sets{above(54, 58), above(70, 195), above(81, 127), above(32, 160), above(64, 335)};
  std::string falling, along_a_line;
  int removable = 0;
  for (int i = 0; i < 5; ++i)
    for (int j = i + 1; j < 5; ++j)
      for (int k = j + 1; k < 5; ++k)
        for (int code = 0; code < 8; ++code) {
          std::vector<Vector<3>> normals;
          for (int s = 0; s < 3; ++s) {
            const Vector<3>& up = sets[s == 0 ? i : s == 1 ? j : k];
            normals.push_back(code >> s & 1 ? Vector<3>(-up) : up);
          }
          if (!is_removable_from(normals, {0, 0, 1})) continue;
          ++removable;
          const Verdict<3> verdict = judge_under_weight(normals);
          const std::string name = fmt::format("{}{}{} ", i + 1, j + 1, k + 1);
          if (verdict.kind == BlockKind::falls) falling += name;
          if (verdict.loaded == 2) along_a_line += name;
        }
  const std::string source = "Harrison & Hudson (2000), chapter 19";
  record_list(report, "roof blocks that fall", source, "125 145 235 345 ", falling);
  // it names these two, not all of them
  const auto has = [&](const char* name) { return along_a_line.find(name) != std::string::npos; };
  report.record({"roof blocks 124 and 135 slide along a line", "1", Kind::published, source, 2, {0, 0}, "a count"},
                has("124") + has("135"));
  report.record({"removable pyramids of ten triples at the roof",
                 "1",
                 Kind::exact,
                 "Goodman & Shi (1985): one of each triple",
                 10,
                 {0, 0},
                 "a count"},
                removable);
}

}  // namespace
}  // namespace voussoir::cases::published_test
