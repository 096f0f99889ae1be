// Three-hinged beam: load against rotation to snap-through and beyond, by prescribed settlement, and under its weight.
#include "reference/hingedbeam/hingedbeam.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/case_tools.hpp"
#ifdef VOUSSOIR_HAS_IPOPT
#include "core/solvers/ipopt.hpp"
#endif
#include "text/angle.hpp"

namespace voussoir::cases {
namespace {

using reference::HingedBeamLoad;
using reference::HingedBeamModel;
using reference::HingePoint;
using verification::Bound;
using verification::CaseReport;
using verification::Check;
using verification::Kind;

// as the scenes state it
const reference::HingedBeam beam;
constexpr double shear_stiffness = 1e9, block_mass = 2000 * 0.138 * 0.046;
const reference::HingeAbutment tall{.below = 0.477, .above = 0.477, .thickness = 0.138}, aligned;
constexpr int push = 2;

// rotations between which static points are judged: below, the push has just begun
constexpr double from = 0.01, to = 0.16;

struct Variant {
  std::string scene, point, name, test, file;
  HingedBeamModel model;
};

void PrintTo(const Variant& v, std::ostream* out) {
  *out << v.name;
}

const Variant variants[] = {
    {"scene.toml", "centroid", "tall, centroid", "TallCentroid", "centroid", {beam, tall, HingePoint::centroid}},
    {"scene.toml",
     "analytic_centre",
     "tall, analytic centre",
     "TallCentre",
     "centre",
     {beam, tall, HingePoint::analytic_centre}},
    {"aligned.toml",
     "centroid",
     "aligned, centroid",
     "AlignedCentroid",
     "aligned_centroid",
     {beam, aligned, HingePoint::centroid}},
    {"aligned.toml",
     "analytic_centre",
     "aligned, analytic centre",
     "AlignedCentre",
     "aligned_centre",
     {beam, aligned, HingePoint::analytic_centre}},
};

// the vertical force that the push needs is the weight of a block; the thrust is the force on the abutment
std::vector<HingedBeamLoad> curve(const SceneRun& run) {
  const std::vector<double> turned = column(run, "block_rotation_deg", push);
  const std::vector<double> weight = column(run, "block_contact_load_y_N", push);
  const std::vector<double> thrust = column(run, "abutment_contact_load_x_N", push);
  std::vector<HingedBeamLoad> curve;
  for (std::size_t i = 0; i < turned.size(); ++i)
    curve.push_back({-turned[i] * degree, weight[i], -thrust[i]});
  return curve;
}

// of a curve with ascending rotations, between its points
HingedBeamLoad at(const std::vector<HingedBeamLoad>& curve, double rotation) {
  const auto after = std::lower_bound(curve.begin() + 1, curve.end() - 1, rotation,
                                      [](const HingedBeamLoad& p, double r) { return p.rotation < r; });
  const HingedBeamLoad &a = after[-1], &b = *after;
  const double fraction = (rotation - a.rotation) / (b.rotation - a.rotation);
  return {rotation, a.weight + fraction * (b.weight - a.weight), a.thrust + fraction * (b.thrust - a.thrust)};
}

// the reference's own curve: the hinge rolls and the joint deforms in shear as in the scene
std::vector<HingedBeamLoad> expected_curve(const HingedBeamModel& model, double stiffness) {
  constexpr double last = 0.22;
  constexpr int steps =
      220;  // the path then has its weight to 1e-4, and linear interpolation over 0.001 rad is off by 1e-5
  std::vector<HingedBeamLoad> curve;
  for (const reference::HingedBeamState& s : reference::hinged_beam_path(model, stiffness, last, steps))
    curve.push_back(s);
  return curve;
}

struct Worst {
  double weight = 0, thrust = 0;  // relative
};

Worst worst(const std::vector<HingedBeamLoad>& found, const std::vector<HingedBeamLoad>& expected) {
  Worst worst;
  for (const HingedBeamLoad& p : found) {
    if (p.rotation < from || p.rotation > to) continue;
    const HingedBeamLoad e = at(expected, p.rotation);
    worst.weight = std::max(worst.weight, std::abs(p.weight / e.weight - 1));
    worst.thrust = std::max(worst.thrust, std::abs(p.thrust / e.thrust - 1));
  }
  return worst;
}

void write_curve(const std::string& name, const std::vector<HingedBeamLoad>& curve) {
  std::vector<double> rotation, weight, thrust;
  for (const HingedBeamLoad& p : curve) {
    rotation.push_back(p.rotation);
    weight.push_back(p.weight / 1e3);
    thrust.push_back(p.thrust / 1e3);
  }
  write_csv("hingedbeam", name + ".csv", {"rotation_rad", "weight_kN", "thrust_kN"}, {rotation, weight, thrust});
}

Check share_check(const std::string& quantity, const std::string& source, double tolerance,
                  const std::string& because) {
  return {quantity, "1", Kind::limit, source, 0, {tolerance, 0, Bound::at_most}, because};
}

const std::string by_reference = "equilibrium with the scene's own normal, arm and abutments, reference/hingedbeam";

#ifdef VOUSSOIR_HAS_IPOPT
// the oracle in place of the program's own solver
SceneRun run_by_ipopt(const std::string& scene) {
  LoadedScene loaded = load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / scene);
  std::get<Prepared<2>>(loaded.prepared).model.solvers.centre = &solve_analytic_centre_ipopt<2>;
  Results results = simulate_scene(loaded);
  if (results.outcome != Outcome::done) throw std::runtime_error(scene + ": " + results.message);
  return {std::move(loaded), std::move(results)};
}
#endif

class HingedBeam : public testing::TestWithParam<Variant> {};

// Pushed down steadily, the beam needs at every rotation the weight that would keep it in equilibrium there.
TEST_P(HingedBeam, CarriesTheWeightOfItsReference) {
  const Variant& v = GetParam();
  CaseReport report("hingedbeam", {"weight, " + v.name, "thrust, " + v.name, "peak weight, " + v.name,
                                   "rotation at peak, " + v.name});
  const SceneRun scene = run(v.scene, {"contact.point=" + v.point});
  const std::vector<HingedBeamLoad> found = curve(scene), expected = expected_curve(v.model, shear_stiffness);
  ASSERT_GT(found.back().rotation, 0.2);

  const Worst error = worst(found, expected);
  const std::string static_points =
      "the push at 0.5 rad/s leaves an oscillation of at most 20 N, 0.4 % of the weight at 0.01 rad; the reference is "
      "right "
      "to "
      "0.01 %";
  report.record(share_check("weight, " + v.name, by_reference, 0.005, static_points), error.weight, cost(scene));
  report.record(share_check("thrust, " + v.name, by_reference, 0.005, static_points), error.thrust, cost(scene));

  const HingedBeamLoad peak = reference::peak_of(found), reference_peak = reference::peak_of(expected);
  report.record({"peak weight, " + v.name,
                 "N",
                 Kind::exact,
                 by_reference,
                 reference_peak.weight,
                 {0, 0.01},
                 "as for static points, and rows 0.001 rad apart"},
                peak.weight, cost(scene));
  report.record({"rotation at peak, " + v.name,
                 "rad",
                 Kind::exact,
                 by_reference,
                 reference_peak.rotation,
                 {0.003, 0},
                 "at a flat peak 0.003 rad are worth 0.1 % of the weight"},
                peak.rotation, cost(scene));
  write_curve(v.file, found);
  write_curve(v.file + "_reference", expected);
}

INSTANTIATE_TEST_SUITE_P(All, HingedBeam, testing::ValuesIn(variants),
                         [](const auto& chosen) { return chosen.param.test; });

// The published values assume that the lower corner stays level with an aligned abutment's edge; rolling lifts it by up
// to 0.1 mm at the peak.
TEST(HingedBeamPeak, IsThatOfALevelCorner) {
  CaseReport report("hingedbeam");
  for (const Variant& v : {variants[0], variants[2]}) {
    const reference::HingedBeamState level = reference::hinged_beam_peak(v.model);
    const HingedBeamLoad own = reference::peak_of(expected_curve(v.model, shear_stiffness));
    if (v.scene == "scene.toml") report.reference("peak_weight", own.weight, "N");
    report.record({"peak weight of the reference, " + v.name,
                   "N",
                   Kind::limit,
                   "equilibrium: 36.895 kN (tall) and 36.588 kN (aligned) with the lower corner kept level",
                   level.weight,
                   {0, 0.01},
                   "rolling lifts the corner by 0.1 mm, each worth 0.6 % if the abutment ends beside it"},
                  own.weight);
  }
  std::vector<HingedBeamLoad> second, first;
  for (double rotation = 0.001; rotation < 0.2205; rotation += 0.001) {
    first.push_back(reference::hinged_beam_first_order(beam, rotation));
    second.push_back(reference::hinged_beam_second_order(beam, rotation));
  }
  write_curve("first_order", first);
  write_curve("second_order", second);
  const HingedBeamLoad peak = reference::hinged_beam_second_order_peak(beam);
  report.report("peak weight of E.2", "N", peak.weight,
                "the lever arm of the weight remains half a block: drawn, not compared");
}

// Under its weight the beam holds 1 % less than the peak and snaps through 1 % above it.
TEST(HingedBeamWeight, IsHeldUpToThePeak) {
  CaseReport report("hingedbeam", {"rotation under 28.841 kN", "weight held", "weight that snaps through"});
  const HingedBeamModel& model = variants[0].model;
  const SceneRun held = run("weight.toml");
  report.record({"rotation under 28.841 kN",
                 "rad",
                 Kind::exact,
                 by_reference,
                 0.06,
                 {2e-5, 0},
                 "the weight is rounded to 0.5 N, worth 2e-6 rad; equilibrium leaves 1e-6 of the contact force, and "
                 "the slip of the hinge does not matter between tall abutments"},
                -value(held, "block_rotation") * degree, cost(held));

  const double peak = reference::hinged_beam_peak(model).weight;
  const auto under = [&](double weight) {
    return run_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / "weight.toml",
                     {"gravity=[0, -" + std::to_string(weight / block_mass) + "]"}, 1);
  };
  const SceneRun below = under(0.99 * peak), above = under(1.01 * peak);
  report.record(
      {"weight held", "1", Kind::exact, "reference/hingedbeam: 0.99 of the peak", 1, {0, 0}, "it reaches equilibrium"},
      below.results.outcome == Outcome::done && -value(below, "block_rotation") * degree < 0.117262, cost(below));
  const std::vector<double> turned = column(above, "block_rotation_deg", push);
  report.record(
      {"weight that snaps through",
       "1",
       Kind::exact,
       "reference/hingedbeam: 1.01 of the peak",
       1,
       {0, 0},
       "it passes Goodman's geometric limit, at which the hinges are level"},
      above.results.outcome == Outcome::incomplete &&
          -*std::min_element(turned.begin(), turned.end()) * degree > reference::hinged_beam_geometric_limit(beam),
      cost(above));
}

// The same push with either solver of the analytic centre: a fast push, since Ipopt is slow.
TEST(HingedBeamSolvers, AgreeOnTheCentre) {
  CaseReport report("hingedbeam");
  const SceneRun own = run("solvers.toml");
  report.report("weight in the fast push, own Newton", "1",
                worst(curve(own), expected_curve(variants[1].model, 1e8)).weight,
                "largest deviation from the reference: the price of speed", cost(own));
  write_curve("newton", curve(own));
#ifdef VOUSSOIR_HAS_IPOPT
  const SceneRun ipopt = run_by_ipopt("solvers.toml");
  const Worst apart = worst(curve(ipopt), curve(own));
  const std::string because =
      "both find the centre to 1e-6 of the overlap; rows are at the same times, and linear interpolation between rows "
      "is off by 1e-4";
  report.record(share_check("weight, Ipopt against own Newton", "Eqs 3.28 and 3.38: the same maximum", 0.001, because),
                apart.weight, cost(ipopt));
  report.record(share_check("thrust, Ipopt against own Newton", "Eqs 3.28 and 3.38: the same maximum", 0.001, because),
                apart.thrust, cost(ipopt));
  write_curve("ipopt", curve(ipopt));
#else
  GTEST_SKIP() << "built without Ipopt";
#endif
}

}  // namespace
}  // namespace voussoir::cases
