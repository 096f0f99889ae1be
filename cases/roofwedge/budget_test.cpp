// Whether error budgets enclose the truth: random roof wedges against joint relaxation, by the program itself.
#include <gtest/gtest.h>

#include <array>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <optional>
#include <stdexcept>

#include "cases/budget_trial.hpp"
#include "reference/roofwedge/roofwedge.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::budget_test {
namespace {

using verification::CaseReport;

using Space = Vector<3>;

constexpr double half_width = 4;            // m, of the model
constexpr double least_width = 0.3;         // m, of the wedge's sides in the roof
constexpr double settles = 50, falls = 12;  // deg: the search goes from 60 to 10
constexpr double duration = 0.02;           // s, of scene.toml's stage stress

Space vector(const reference::Vector3& v) {
  return {v[0], v[1], v[2]};
}

std::string numbers(const Space& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v[0], v[1], v[2]);
}

// in the roof, each opposite to the plane of its number
std::array<Space, 3> corners(const reference::RoofWedge& wedge, const reference::RoofWedgeFaces& faces) {
  std::array<Space, 3> corner;
  for (int i = 0; i < 3; ++i) {
    const Space line = vector(faces.normal[(i + 1) % 3]).cross(vector(faces.normal[(i + 2) % 3]));
    corner[i] = Space(0, 0, wedge.height) - wedge.height / line[2] * line;
  }
  return corner;
}

bool fits(const std::array<Space, 3>& corner) {
  for (int i = 0; i < 3; ++i)
    if (corner[i].cwiseAbs().maxCoeff() > 0.95 * half_width || (corner[i] - corner[(i + 1) % 3]).norm() < least_width)
      return false;
  return true;
}

// deg, if the reference applies: no joint opens or slips before friction falls, and the search covers it
std::optional<double> collapse_of(const reference::RoofWedge& wedge) {
  try {
    if (!fits(corners(wedge, reference::roof_wedge_faces(wedge)))) return {};
    if (reference::first_slip(wedge).friction > settles * degree) return {};
    const reference::RoofWedgeState state = reference::collapse(wedge);
    if (state.friction < falls * degree || state.step_error > 1e-3 * degree) return {};
    return state.friction / degree;
  } catch (const std::invalid_argument&) {  // no wedge
    return {};
  } catch (const std::domain_error&) {  // a joint opens
    return {};
  }
}

// As in scene.toml: the rock behind each joint closes in until the joint transfers the traction of the stress.
std::vector<std::string> overrides(const reference::RoofWedge& wedge) {
  const reference::RoofWedgeFaces faces = reference::roof_wedge_faces(wedge);
  const std::array<Space, 3> corner = corners(wedge, faces);
  const double tall = 2 * wedge.height;
  std::vector<std::string> sets{
      fmt::format("domain.box={{ min = [{0}, {0}, 0], max = [{1}, {1}, {2}] }}", -half_width, half_width, tall),
      "joint_properties.rock.measured=true",
      fmt::format("joint_properties.rock.normal_stiffness={:.17g}", wedge.normal_stiffness),
      fmt::format("joint_properties.rock.shear_stiffness={:.17g}", wedge.shear_stiffness),
      "stage.critical.tolerance_deg=0.01"};
  for (int i = 0; i < 3; ++i) {
    const char joint = static_cast<char>('A' + i);
    const Space n = vector(faces.normal[i]);
    const Space traction = Space(wedge.stress[0], wedge.stress[1], wedge.stress[2]).cwiseProduct(n);
    const Space normal = n.dot(traction) * n;
    const Space way = normal / wedge.normal_stiffness + (traction - normal) / wedge.shear_stiffness;
    const Space middle = (Space(0, 0, wedge.height) + corner[(i + 1) % 3] + corner[(i + 2) % 3]) / 3;
    sets.push_back(fmt::format("joints.{}.dip={:.17g}", joint, wedge.planes[i].dip / degree));
    sets.push_back(fmt::format("joints.{}.dip_direction={:.17g}", joint, wedge.planes[i].dip_direction / degree));
    sets.push_back(fmt::format("stage.stress.move.{}.inside={}", joint, numbers(middle - 0.01 * n)));
    sets.push_back(fmt::format("stage.stress.move.{}.velocity={}", joint, numbers(way / duration)));
  }
  return sets;
}

// Wedges 1 m high, every other one with a vertical plane of symmetry; horizontal stress of 0.03 to 0.15 MPa, that over
// the vertical K0 = 0.8 to 4.
std::vector<BudgetScene> draw(unsigned seed, std::size_t count) {
  boost::random::mt19937_64 random(seed);
  const auto between = [&](double low, double high) {
    return boost::random::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<BudgetScene> scenes;
  while (scenes.size() < count) {
    const bool symmetric = scenes.size() % 2 == 0;
    std::array<double, 3> dip{}, off{};
    for (int i = 0; i < 3; ++i) {
      dip[i] = between(45, 75);
      off[i] = between(-30, 30);
    }
    if (symmetric) {
      dip[2] = dip[1];
      off[0] = 0;
      off[2] = -off[1];
    }
    const double turned = between(0, 360), horizontal = between(0.03e6, 0.15e6), k0 = between(0.8, 4);
    reference::RoofWedge wedge;
    for (int i = 0; i < 3; ++i) {
      wedge.planes[i].dip = dip[i] * degree;
      wedge.planes[i].dip_direction = std::fmod(turned + 120 * i + off[i] + 360, 360) * degree;
    }
    wedge.stress = {horizontal, horizontal, horizontal / k0, 0, 0, 0};
    wedge.normal_stiffness = 3e9 * std::pow(10, between(0, 1));
    wedge.shear_stiffness = wedge.normal_stiffness * std::pow(10, between(-0.7, 0.3));
    const std::optional<double> truth = collapse_of(wedge);
    if (!truth) continue;
    scenes.push_back({fmt::format("roof wedge {}, {}symmetric, K0 {:.2f}, {:.2g} and {:.2g} Pa/m", scenes.size(),
                                  symmetric ? "" : "a", k0, wedge.normal_stiffness, wedge.shear_stiffness),
                      std::filesystem::path(VOUSSOIR_CASE_DIR) / "scene.toml", overrides(wedge), *truth});
  }
  return scenes;
}

TEST(RoofWedge, BudgetsEncloseJointRelaxation) {
  CaseReport report("roofwedge");
  judge_budgets(report, "roofwedge", "random roof wedges", "Goodman, Shi & Boyle (1982)", draw(30511, 6));
}

TEST(RoofWedgeLong, BudgetsEncloseJointRelaxation) {
  CaseReport report("roofwedge");
  judge_budgets(report, "roofwedge", "random roof wedges", "Goodman, Shi & Boyle (1982)", draw(30512, 60));
}

}  // namespace
}  // namespace voussoir::cases::budget_test
