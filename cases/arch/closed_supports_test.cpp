// Masonry arch whose supports move towards each other: it opens at four hinges and may sway on them, a motion softer
// than its joints by eight powers of ten. It reaches equilibrium, by relaxation and by Newton's method, with the thrust
// of the reference.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cases/arch/arch_trial.hpp"
#include "reference/arch/arch.hpp"

namespace voussoir::cases::closed_supports_test {
namespace {

using verification::CaseReport;
using verification::Kind;

// as closed_supports.toml states it
const reference::Arch stated{20, 5, 2000 * 9.81};
constexpr double stated_thickness = 0.75, stated_closing = 0.02, closing_time = 0.2;  // m, s

// Of the thrust, over the weight: a hundredth of the increase by closing. Sway hardly changes the thrust.
constexpr double allowed = 2e-4;

struct Setting {
  reference::Arch arch = stated;
  double thickness = stated_thickness, closing = stated_closing, stiffness = 1e11;  // m, Pa/m
  std::string statics = "adaptive";
  std::vector<std::string> more = {};
};

std::vector<std::string> overrides_of(const Setting& s) {
  std::vector<std::string> overrides = on_joints(s.stiffness);
  std::string corners;
  for (const reference::Corner& c : voussoir_corners(s.arch, s.thickness, 0))
    corners += (corners.empty() ? "[" : ", [") + text(c.x) + ", " + text(c.y) + "]";
  overrides.push_back("blocks.voussoir.vertices=[" + corners + "]");
  overrides.push_back("repeat.1.count=" + std::to_string(s.arch.voussoirs));
  overrides.push_back("repeat.1.turn_deg=" + text(-180.0 / s.arch.voussoirs));
  overrides.push_back("stage.close.move.1.velocity=[" + text(-s.closing / closing_time) + ", 0]");
  overrides.push_back("statics=" + s.statics);
  overrides.insert(overrides.end(), s.more.begin(), s.more.end());
  return overrides;
}

std::string name_of(const Setting& s) {
  std::string name = s.statics + ", " + text(s.stiffness / 1e9) + " GPa/m, " + text(s.arch.voussoirs) + " stones of " +
                     text(s.thickness) + " m, " + text(1e3 * s.closing) + " mm";
  for (const std::string& more : s.more)
    name += ", " + more;
  return name;
}

// Runs it and requires equilibrium within the scene's 100 000 steps; the thrust over the weight, against the reference.
struct Thrust {
  double found = 0, expected = 0;
  verification::Cost cost;
};
Thrust thrust_of(const Setting& s) {
  const reference::ClosedArch expected = closed_arch(s.arch, {s.stiffness, s.stiffness}, s.thickness, s.closing);
  const SceneRun ended = run("closed_supports.toml", overrides_of(s));
  return {std::abs(value(ended, "left_contact_load_x")) / expected.weight, expected.thrust / expected.weight,
          cost(ended)};
}

void judge(const Setting& s) {
  try {
    const Thrust thrust = thrust_of(s);
    EXPECT_NEAR(thrust.found, thrust.expected, allowed) << name_of(s);
  } catch (const std::runtime_error& no_rest) {
    ADD_FAILURE() << name_of(s) << ": " << no_rest.what();
  }
}

TEST(ClosedSupports, ReachEquilibriumOnFourHinges) {
  const auto row = [](const Setting& s) {
    return "thrust between closed supports, " + text(s.stiffness / 1e9) + " GPa/m, " + s.statics;
  };
  std::vector<Setting> settings;
  for (const double stiffness : {1e10, 1e11, 1e12})
    settings.push_back({.stiffness = stiffness, .statics = "newton"});
  settings.push_back({.stiffness = 1e11, .statics = "adaptive"});
  std::vector<std::string> rows;
  for (const Setting& s : settings)
    rows.push_back(row(s));
  CaseReport report("arch", rows);
  for (const Setting& s : settings) {
    const Thrust thrust = thrust_of(s);
    report.record(
        {row(s),
         "of the weight",
         Kind::exact,
         "equilibria of rigid voussoirs on elastic joints, reference/arch",
         thrust.expected,
         {allowed, 0},
         "a hundredth of the increase of the thrust by closing; neighbouring equilibria are swayed on the same hinges"},
        thrust.found, thrust.cost);
  }
}

TEST(ClosedSupportsLong, ReachEquilibriumByEverySetting) {
  const std::vector<std::vector<std::string>> more{
      {},
      {"stage.close.duration_s=1", "stage.close.move.1.velocity=[-0.02, 0]"},
      {"stage.close.damping.local=0.3"},
      {"joint_properties.dry.friction_deg=40"},
      {"contact.face=point", "joint_properties.dry.sub_contacts=4",
       "contact.potential_radius=0.002"}};  // as scene.toml
  for (const double stiffness : {1e10, 1e11, 1e12})
    for (const char* statics : {"adaptive", "newton"})
      for (const std::vector<std::string>& each : more)
        judge({.stiffness = stiffness, .statics = statics, .more = each});
}

// arches of any number of stones and thickness, whose supports close or separate
TEST(ClosedSupportsLong, ReachEquilibriumForEveryArch) {
  std::mt19937_64 random(1);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (int i = 0; i < 20; ++i) {
    Setting s;
    s.arch.voussoirs = static_cast<int>(uniform(8, 30));
    s.thickness = uniform(0.65, 1);
    s.closing = uniform(-0.02, 0.03);
    s.stiffness = std::pow(10, uniform(10, 12));
    for (const char* statics : {"adaptive", "newton"}) {
      s.statics = statics;
      judge(s);
    }
  }
}

}  // namespace
}  // namespace voussoir::cases::closed_supports_test
