// The slumping slope with other dips, layers and spacings: the angle and the mechanism at which each fails, by limit
// analysis, by blocks that slip without opening and by distinct elements.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

#include "app/limit/limit_analysis.hpp"
#include "cases/case_tools.hpp"
#include "cases/slump/collapse.hpp"
#include "cases/slump/layered_scene.hpp"
#include "reference/slump/elastoplastic.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::variants_test {
namespace {

using verification::CaseReport;
using verification::Kind;

constexpr double reference_bracket = 0.005;  // deg
constexpr double moves = 0.1;   // of the farthest corner's displacement: as the reference's blocks are distinguished
constexpr double turns = 1e-3;  // fraction of rotation in the kinetic energy: more than settling and rounding leave

struct Variant {
  double dip, base_dip;       // deg
  double thickness, spacing;  // m
  int layers;
  std::string label;  // differences from S0

  reference::LayeredSlope slope() const {
    return {dip * degree, base_dip * degree, thickness, spacing, 50, layers, 2500, 9.81, 10e9, 10e9};
  }

  std::string name() const {
    return fmt::format("dip {}, base {}, {} x {} m, spacing {} m", dip, base_dip, layers, thickness, spacing);
  }
};

// S0 first; then one parameter varied at a time. One base dips out of the slope
const std::vector<Variant> variants{{60, 5, 4, 8, 3, "S0"},
                                    {50, 5, 4, 8, 3, "dip 50°"},
                                    {55, 5, 4, 8, 3, "dip 55°"},
                                    {65, 5, 4, 8, 3, "dip 65°"},
                                    {70, 5, 4, 8, 3, "dip 70°"},
                                    {60, -10, 4, 8, 3, "base −10°"},
                                    {60, 0, 4, 8, 3, "base 0°"},
                                    {60, 8, 4, 8, 3, "base 8°"},
                                    {60, 5, 2, 8, 3, "layers of 2 m"},
                                    {60, 5, 6, 8, 3, "layers of 6 m"},
                                    {60, 5, 4, 5, 3, "spacing 5 m"},
                                    {60, 5, 4, 16, 3, "spacing 16 m"},
                                    {60, 5, 4, 8, 1, "1 layer"},
                                    {60, 5, 4, 8, 5, "5 layers"}};

// in the case's output folder
std::filesystem::path write_scene(const Variant& v) {
  const std::filesystem::path file =
      verification::case_output("slump") /
      fmt::format("variant_{}_{}_{}_{}_{}.toml", v.dip, v.base_dip, v.thickness, v.spacing, v.layers);
  write_layered_scene(v.slope(), v.name(), file);
  return file;
}

// The failure of a slope: its layers, and whether by rotation.
struct Manner {
  double friction = 0;           // deg
  double rotation_fraction = 0;  // of the kinetic energy
  int moving = 0;                // blocks
  std::vector<int> of_layers;    // those of each layer, from the face

  bool rotates() const { return rotation_fraction > turns; }
};

int layer_of(const Variant& v, const Model<2>& model, int body) {
  const Vector<2> place = model.origin + model.bodies[body].reference;
  const double dip = v.dip * degree;
  return static_cast<int>((place[0] * std::sin(dip) - place[1] * std::cos(dip)) / v.thickness);
}

// blocks of each layer from the base upwards, as the reference numbers them
std::vector<std::vector<int>> layered_blocks(const Variant& v, const Model<2>& model) {
  std::vector<std::vector<int>> layers(v.layers);
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed) layers.at(layer_of(v, model, static_cast<int>(b))).push_back(static_cast<int>(b));
  for (std::vector<int>& layer : layers)
    std::sort(layer.begin(), layer.end(),
              [&](int a, int b) { return model.bodies[a].reference[1] < model.bodies[b].reference[1]; });
  return layers;
}

double farthest_corner(const Body<2>& body, const BodyVelocity<2>& motion) {
  double largest = 0;
  for (const Vector<2>& corner : body.parts.front().vertices)
    largest = std::max(largest, (motion.velocity + cross(motion.spin, corner)).norm());
  return largest;
}

Manner manner_of(const Variant& v, const Model<2>& model, double friction,
                 const std::vector<BodyVelocity<2>>& motions) {
  Manner manner{friction, describe_mechanism(model, motions).rotation_fraction, 0, std::vector<int>(v.layers)};
  double most = 0;
  for (std::size_t b = 0; b < motions.size(); ++b)
    most = std::max(most, farthest_corner(model.bodies[b], motions[b]));
  for (std::size_t b = 0; b < motions.size(); ++b)
    if (farthest_corner(model.bodies[b], motions[b]) > moves * most) {
      ++manner.moving;
      ++manner.of_layers.at(layer_of(v, model, static_cast<int>(b)));
    }
  return manner;
}

Manner by_limit_analysis(const Variant& v, const std::filesystem::path& scene) {
  const LimitAnalysis<2> analysis = analyse_limit<2>(load_scene(scene), {.with_dilation = true});
  if (analysis.status != LimitStatus::found) throw std::runtime_error(v.name() + ": " + analysis.message);
  return manner_of(v, analysis.model, analysis.values.front().second.value, analysis.state.velocities);
}

Manner without_dilation(const Variant& v, const Model<2>& model) {
  const reference::SlopeCollapse collapse = reference::elastoplastic_collapse(v.slope(), reference_bracket * degree);
  const std::vector<std::vector<int>> layers = layered_blocks(v, model);
  std::vector<BodyVelocity<2>> motions(model.bodies.size());
  for (const reference::SlopeBlockMotion& block : collapse.motion)
    motions[layers.at(block.layer).at(block.row)] = {{block.x, block.y}, Spin<2>(block.turn)};
  return manner_of(v, model, 0.5 * (collapse.stands + collapse.collapses) / degree, motions);
}

Manner by_distinct_elements(const Variant& v, const Collapse<2>& collapse) {
  std::vector<BodyVelocity<2>> motions(collapse.model().bodies.size());
  for (const CollapsedBlock& block : motions_at_collapse(collapse))
    motions[block.body] = {collapse.failed.bodies.motions[block.body].displacement -
                               collapse.settled.bodies.motions[block.body].displacement,
                           Spin<2>(block.turn)};
  return manner_of(v, collapse.model(), value(collapse.run, "critical_friction"), motions);
}

std::string words(const Manner& m) {
  std::string layers;
  for (const int count : m.of_layers)
    layers += fmt::format("{}{}", layers.empty() ? "" : "+", count);
  return fmt::format("{}: blocks of each layer {}; {:.3g} % of the kinetic energy in rotation",
                     m.rotates() ? "rotation" : "translation", layers, 100 * m.rotation_fraction);
}

// failure of a variant by each method; only limit analysis is cheap enough for all of them in every build
struct Answers {
  Manner limit;
  std::optional<Manner> plastic, dem;
};

std::string number(const std::optional<Manner>& manner) {
  return manner ? fmt::format("{}", manner->friction) : "";
}

void write_table(const std::vector<Answers>& all) {
  std::ofstream out(verification::case_output("slump") / "variants.csv");
  out << "variant,limit_deg,plastic_deg,dem_deg\n";
  for (std::size_t i = 0; i < all.size(); ++i)
    out << variants[i].label << ',' << all[i].limit.friction << ',' << number(all[i].plastic) << ','
        << number(all[i].dem) << '\n';
  if (!out) throw std::runtime_error("cannot write variants.csv");
}

void judge(CaseReport& report, const Variant& v, const Answers& found) {
  const std::string name = ", " + v.label,
                    source = "elastic, perfectly plastic blocks without dilation, reference/slump";
  const Manner& limit = found.limit;
  EXPECT_TRUE(limit.rotates()) << v.label;
  if (!found.plastic) {
    report.report("critical friction, limit analysis" + name, "deg", limit.friction, words(limit));
    return;
  }
  const Manner& plastic = *found.plastic;
  report.report("critical friction, without dilation" + name, "deg", plastic.friction, words(plastic));
  report.record({"critical friction, limit analysis" + name,
                 "deg",
                 Kind::limit,
                 source,
                 plastic.friction,
                 {0.0026, 0},
                 "half the reference's bracket, 0.0025, and the unbalanced force of its trials. " + words(limit)},
                limit.friction);
  EXPECT_EQ(limit.of_layers, plastic.of_layers) << v.label;
  EXPECT_TRUE(plastic.rotates()) << v.label;
  if (!found.dem) return;
  report.record({"critical friction, DEM" + name,
                 "deg",
                 Kind::limit,
                 source,
                 plastic.friction,
                 {0.2, 0},
                 "elastic corners deform before they carry the force of rigid ones: 0.1 for S0 at this stiffness "
                 "(README), twice that for larger blocks. " +
                     words(*found.dem)},
                found.dem->friction);
  // the second layer is as weak as the first one and may follow it
  EXPECT_EQ(found.dem->of_layers.front(), plastic.of_layers.front()) << v.label;
  EXPECT_TRUE(found.dem->rotates()) << v.label;
}

enum class Methods { limit_only, two, three };

template <class Choice>
void try_variants(CaseReport& report, const Choice& methods_of) {
  std::vector<Answers> all;
  for (const Variant& v : variants) {
    const std::filesystem::path scene = write_scene(v);
    const Methods methods = methods_of(v);
    Answers found{by_limit_analysis(v, scene), {}, {}};
    if (methods != Methods::limit_only) {
      const LoadedScene loaded = load_scene(scene);
      found.plastic = without_dilation(v, std::get<Prepared<2>>(loaded.prepared).model);
    }
    if (methods == Methods::three) found.dem = by_distinct_elements(v, run_to_collapse<2>(scene));
    judge(report, v, found);
    all.push_back(found);
  }
  write_table(all);
}

TEST(SlumpVariants, FailAsBlocksThatDoNotDilate) {
  CaseReport report("slump", {"critical friction, limit analysis, dip 70°", "critical friction, DEM, 1 layer"});
  try_variants(report, [](const Variant& v) {
    if (v.layers == 1) return Methods::three;
    return v.dip == 70 || v.base_dip == 0 || v.spacing == 16 ? Methods::two : Methods::limit_only;
  });
}

TEST(SlumpVariantsLong, FailByDistinctElements) {
  CaseReport report("slump");
  try_variants(report, [](const Variant&) { return Methods::three; });
}

}  // namespace
}  // namespace voussoir::cases::variants_test
