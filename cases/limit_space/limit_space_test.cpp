// Limit analysis in space against closed forms: wedges, blocks on inclines, walls, columns and a toppling slope, on
// joints that dilate and on joints that slip without opening.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "app/limit/limit_analysis.hpp"
#include "cases/case_tools.hpp"
#include "reference/limit_space/limit_space.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::limit_space_test {
namespace {

using verification::CaseReport;
using verification::Kind;

const std::filesystem::path folder = VOUSSOIR_CASE_DIR;
const char* const without_dilation = ", joints that do not dilate";
const char* const because_bracket = "bracket of 1e-6 degrees, and joints written with nine decimals";
const char* const because_settled =
    "fixed points settle to 1e-6 of a factor, which is some 5e-5 degrees or less; found to 1e-6 and better";
const char* const because_rounding = "bounds from forces and from the mechanism meet to 1e-9";
const char* const because_ends =
    "the ends of the interval are taken from slips 1e-3 and 1e-4 off: 1e-6, quadratic in them";

LimitAnalysis<3> analyse(const std::filesystem::path& scene, const std::vector<std::string>& overrides,
                         const LimitRequest& request) {
  return analyse_limit<3>(load_scene(scene, overrides), request);
}

double value_of(const LimitAnswer& answer, const std::string& name) {
  for (const auto& [known, value] : answer.values)
    if (known == name) return value.value;
  throw std::runtime_error("no " + name + ": " + answer.message);
}

LimitRequest load(const std::optional<LimitLoad>& direction, bool dilates) {
  LimitRequest request;
  request.load = direction;
  request.with_dilation = dilates;
  return request;
}

struct Shape {
  double dip_a, direction_a, dip_b, direction_b, face_dip, face_direction;
};

std::vector<std::string> overrides(const Shape& s) {
  return {"joints.A.dip=" + text(s.dip_a),
          "joints.A.dip_direction=" + text(s.direction_a),
          "joints.B.dip=" + text(s.dip_b),
          "joints.B.dip_direction=" + text(s.direction_b),
          "domain.planes.slope face.dip=" + text(s.face_dip),
          "domain.planes.slope face.dip_direction=" + text(s.face_direction)};
}

reference::Wedge wedge_of(const Shape& s) {
  reference::Wedge wedge;
  wedge.a = {s.dip_a * degree, s.direction_a * degree};
  wedge.b = {s.dip_b * degree, s.direction_b * degree};
  return wedge;
}

std::string name_of(const Shape& s) {
  return fmt::format("{:.0f}/{:.0f}, {:.0f}/{:.0f}", s.dip_a, s.direction_a, s.dip_b, s.direction_b);
}

const Shape symmetric[] = {{56.137086019, 58.380993463, 56.137086019, 301.619006537, 70, 0},
                           {63.053785110, 76.287829823, 63.053785110, 283.712170177, 60, 0},
                           {56.174154826, 37.004502146, 56.174154826, 322.995497854, 75, 0}};
const Shape others[] = {
    {40, 130, 60, 220, 70, 182}, {55, 110, 45, 215, 75, 170}, {65, 95, 50, 200, 75, 150}, {35, 150, 70, 260, 70, 185}};

TEST(LimitSpace, WedgesNeedTheFrictionOfTheirClosedForms) {
  CaseReport report("limit_space");
  for (const auto* list : {&symmetric[0], &others[0]})
    for (int k = 0; k < (list == &symmetric[0] ? 3 : 4); ++k) {
      const Shape& shape = list[k];
      LimitRequest request;
      const LimitAnalysis<3> found = analyse(folder / "scene.toml", overrides(shape), request);
      const reference::Wedge wedge = wedge_of(shape);
      const auto normal = [](const reference::WedgePlane& p) {
        return reference::upward_normal(p.dip, p.dip_direction);
      };
      report.record({"critical friction, wedge " + name_of(shape),
                     "deg",
                     Kind::exact,
                     "closed form in reference/limit_space: the distance of the normals' hull",
                     reference::dilating_friction(normal(wedge.a), normal(wedge.b), {0, 0, -1}) / degree,
                     {3e-6, 0},
                     because_bracket},
                    value_of(found, "critical_friction_lower_bound"));
      for (const char* end : {"least", "largest"})
        report.record({fmt::format("critical friction, wedge {}{}, {}", name_of(shape), without_dilation, end),
                       "deg",
                       Kind::exact,
                       "Hoek & Bray (1974)",
                       *reference::critical_friction(wedge) / degree,
                       {2e-5, 0},
                       because_settled},
                      value_of(found, fmt::format("critical_friction_{}", end)));
    }
}

TEST(LimitSpace, WedgesArePushedOut) {
  CaseReport report("limit_space");
  const reference::Vector3 north{0, 1, 0};
  const double friction[] = {35, 27, 48};
  for (int k = 0; k < 3; ++k) {
    std::vector<std::string> sets = overrides(symmetric[k]);
    sets.push_back("joint_properties.rock.friction_deg=" + text(friction[k]));
    const LimitAnalysis<3> found = analyse(folder / "scene.toml", sets, load(limit_load("north"), false));
    const reference::Wedge wedge = wedge_of(symmetric[k]);
    const std::string name =
        fmt::format("push to the north, wedge {} at {:g} degrees", name_of(symmetric[k]), friction[k]);
    report.record({name,
                   "1",
                   Kind::exact,
                   "closed form in reference/limit_space: the distance of the normals' hull",
                   *reference::dilating_push(wedge, north, friction[k] * degree),
                   {1e-8, 0},
                   because_rounding},
                  value_of(found, "collapse_factor_upper_bound"));
    report.record({name + without_dilation,
                   "1",
                   Kind::exact,
                   "Hoek & Bray (1974)",
                   *reference::plain_push(wedge, north, friction[k] * degree),
                   {1e-6, 0},
                   because_ends},
                  value_of(found, "collapse_factor_least"));
  }
}

TEST(LimitSpace, BlocksOnInclinesSlideOrTopple) {
  CaseReport report("limit_space");
  struct Push {
    reference::BlockPushedOnIncline block;
    double azimuth;
  };
  for (const Push& push : {Push{{1, 1, 0.5, 20 * degree, 35 * degree}, 0},
                           {{1, 1, 0.5, 20 * degree, 35 * degree}, 60},
                           {{1, 1, 0.5, 20 * degree, 35 * degree}, 180},
                           {{1, 1, 2, 10 * degree, 40 * degree}, 0},
                           {{1, 0.6, 2, 10 * degree, 40 * degree}, 90},
                           {{1, 1, 2, 10 * degree, 40 * degree}, 180},
                           {{1, 0.8, 1.2, 15 * degree, 45 * degree}, 135}}) {
    const auto& [along, across, height, dip, friction] = push.block;
    const double s = std::sin(dip), c = std::cos(dip), azimuth = push.azimuth * degree, g = 9.81,
                 weight = along * across * height * 2000 * g;
    const LimitAnalysis<3> found =
        analyse(folder / "incline.toml",
                {fmt::format("gravity=[{:.17g}, 0, {:.17g}]", g * s, -g * c),
                 fmt::format("blocks.block.box.min=[{:.17g}, {:.17g}, 0]", -along / 2, -across / 2),
                 fmt::format("blocks.block.box.max=[{:.17g}, {:.17g}, {:.17g}]", along / 2, across / 2, height),
                 "joint_properties.rock.friction_deg=" + text(friction / degree),
                 fmt::format("stage.push.force.push.force=[{:.17g}, {:.17g}, {:.17g}]", weight * c * std::cos(azimuth),
                             weight * std::sin(azimuth), weight * s * std::cos(azimuth))},
                load(limit_load("applied"), false));
    const std::string name = fmt::format("push of {:g} x {:g} x {:g} m on a dip of {:g} degrees towards {:g}", along,
                                         across, height, dip / degree, push.azimuth);
    const double exact = reference::push_on_incline(push.block, azimuth);
    report.record(
        {name, "1", Kind::exact, "equilibrium of the block in closed form", exact, {1e-8, 0}, because_rounding},
        value_of(found, "collapse_factor_upper_bound"));
    report.record({name + without_dilation,
                   "1",
                   Kind::exact,
                   "equilibrium of the block in closed form",
                   exact,
                   {2e-6, 0},
                   because_ends},
                  value_of(found, "collapse_factor_least"));
  }
}

// ---- blocks written by the test -----------------------------------------------------------------------------------

class SceneWriter {
 public:
  SceneWriter(const std::string& name, double friction_deg)
      : file_(verification::case_output("limit_space") / name), out_(file_) {
    out_.precision(17);
    out_ << "dimension = 3\ngravity = [0, 0, -9.81]\ndensity = 2000\n"
         << "joint_properties = [{ name = \"rock\", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = "
         << friction_deg << " }]\nstage = [{ name = \"settle\", kind = \"settle\" }]\n";
  }
  // an outline in the plane x, z, from y = 0 to `depth`
  void prism(const std::string& name, const std::vector<std::array<double, 2>>& outline, double depth,
             bool fixed = false) {
    out_ << "[[blocks]]\nname = \"" << name << "\"\n" << (fixed ? "fixed = true\n" : "") << "vertices = [";
    for (const double y : {0.0, depth})
      for (const auto& [x, z] : outline)
        out_ << '[' << x << ", " << y << ", " << z << "], ";
    out_ << "]\n";
  }
  std::filesystem::path finish() {
    out_.close();
    if (!out_) throw std::runtime_error("cannot write " + file_.string());
    return file_;
  }

 private:
  std::filesystem::path file_;
  std::ofstream out_;
};

std::vector<std::array<double, 2>> rectangle(double x0, double z0, double x1, double z1) {
  return {{x0, z0}, {x1, z0}, {x1, z1}, {x0, z1}};
}

std::filesystem::path write_wall(const reference::RunningBond& wall, double thickness, double friction_deg) {
  SceneWriter scene(fmt::format("wall_{}_{}_{:g}.toml", wall.courses, wall.bricks, friction_deg), friction_deg);
  const double whole = wall.bricks * wall.length;
  scene.prism("floor", rectangle(-1, -1, whole + 1, 0), thickness, true);
  for (int course = 0; course < wall.courses; ++course)
    for (int brick = 0; brick <= wall.bricks; ++brick) {
      const double shift = course % 2 == 0 ? 0 : -0.5 * wall.length, begin = std::max(0.0, brick * wall.length + shift),
                   end = std::min(whole, (brick + 1) * wall.length + shift);
      if (end > begin)
        scene.prism(fmt::format("brick {} {}", course, brick),
                    rectangle(begin, course * wall.height, end, (course + 1) * wall.height), thickness);
    }
  return scene.finish();
}

TEST(LimitSpace, WallsComeDownInTheirPlaneAndAcross) {
  CaseReport report("limit_space");
  struct Trial {
    reference::RunningBond wall;
    double thickness, friction, dilating;
  };
  // with dilation as the plane's linear program, by the simplex method, finds it (to nine digits)
  for (const Trial& t : {Trial{{4, 3, 1, 0.5}, 0.4, 35, 0.663710961}, {{6, 4, 0.5, 0.25}, 0.3, 35, 0.615635676}}) {
    const std::filesystem::path scene = write_wall(t.wall, t.thickness, t.friction);
    const LimitAnalysis<3> found = analyse(scene, {}, load(limit_load("east"), false));
    const std::string name = fmt::format("push of a wall of {} courses in its plane", t.wall.courses);
    report.record({name,
                   "1",
                   Kind::exact,
                   "limit analysis of the same wall in the plane by linear programs",
                   t.dilating,
                   {2e-9, 0},
                   "nine digits printed"},
                  value_of(found, "collapse_factor_upper_bound"));
    report.record({name + without_dilation,
                   "1",
                   Kind::exact,
                   "equilibrium of the bricks that turn about the last one's toe",
                   reference::push_on_wall(t.wall, t.friction * degree),
                   {1e-6, 0},
                   because_ends},
                  value_of(found, "collapse_factor_least"));
    report.record({fmt::format("push of a wall of {} courses across", t.wall.courses),
                   "1",
                   Kind::exact,
                   "equilibrium of the whole wall about its toe",
                   t.thickness / (t.wall.courses * t.wall.height),
                   {1e-8, 0},
                   because_rounding},
                  value_of(analyse(scene, {}, load(limit_load("north"), true)), "collapse_factor_upper_bound"));
  }
}

TEST(LimitSpace, AColumnTopplesBetweenItsNeighbours) {
  CaseReport report("limit_space");
  const LimitAnalysis<3> found = analyse(folder / "column.toml", {}, load(limit_load("east"), false));
  report.record({std::string("push of a column between two blocks") + without_dilation,
                 "1",
                 Kind::exact,
                 "equilibrium about its toe: b/h, as its sides carry nothing",
                 0.25,
                 {1e-6, 0},
                 because_ends},
                value_of(found, "collapse_factor_least"));
  report.report("push of a column between two blocks, largest", "1", value_of(found, "collapse_factor_largest"),
                "by forces on its sides that nothing asks for");
  report.report("push of a column between two blocks, joints that dilate", "1",
                value_of(found, "collapse_factor_upper_bound"), "dilation makes those forces");
  EXPECT_FALSE(found.answered) << "an interval is no answer";
}

// columns extruded by 10 m
TEST(LimitSpace, GoodmanAndBraysSlopeHasTheirAngle) {
  CaseReport report("limit_space");
  const reference::TopplingSlope slope;
  SceneWriter scene("toppling.toml", 30);
  const auto turned = [&](std::vector<std::array<double, 2>> outline) {
    const double s = std::sin(slope.dip), c = std::cos(slope.dip);
    for (auto& [x, z] : outline) {
      const double before = x;
      x = c * before - s * z;
      z = s * before + c * z;
    }
    return outline;
  };
  for (int n = 1; n <= slope.columns; ++n) {
    const double left = (n - 1) * slope.thickness, right = n * slope.thickness, bottom = n * slope.step;
    scene.prism(fmt::format("column {}", n), turned(rectangle(left, bottom, right, bottom + slope.height(n))), 10);
    // its riser is inclined backwards, so that it supports no column from behind
    scene.prism(fmt::format("step {}", n), turned({{left + 1, -5}, {right + 1, -5}, {right, bottom}, {left, bottom}}),
                10, true);
  }
  LimitRequest request;
  const LimitAnalysis<3> found = analyse(scene.finish(), {}, request);
  const double exact = reference::toppling_friction(slope) / degree;
  for (const char* end : {"least", "largest"})
    report.record({fmt::format("critical friction, toppling slope{}, {}", without_dilation, end),
                   "deg",
                   Kind::exact,
                   "Goodman & Bray (1976), their recursion",
                   exact,
                   {2e-5, 0},
                   because_settled},
                  value_of(found, fmt::format("critical_friction_{}", end)));
  report.record({"critical friction, toppling slope",
                 "deg",
                 Kind::exact,
                 "limit analysis of the same slope in the plane by linear programs",
                 33.445414603,
                 {3e-6, 0},
                 because_bracket},
                value_of(found, "critical_friction_lower_bound"));
}

}  // namespace
}  // namespace voussoir::cases::limit_space_test
