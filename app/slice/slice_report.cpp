#include "app/slice/slice_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "app/base/orientation.hpp"
#include "app/base/svg_figure.hpp"
#include "core/exchange/tables.hpp"
#include "core/joint_sets/statistics.hpp"
#include "core/output/atomic_file.hpp"
#include "core/scene/bodies.hpp"
#include "core/scene/draw_joint_sets.hpp"
#include "core/scene/joint_outline.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

// joints that the scene states one by one, in its file or a table, with the name of a set
template <int Dim>
struct MeasuredSet {
  std::string name;
  std::vector<DrawnJoint<Dim>> joints;
  MeanOrientation mean;
  SetStatistics<Dim> statistics;  // the quantities that a joint set states are 0
};

// the data of all parts of the report
template <int Dim>
struct Sample {
  const Scene& scene;
  Vector<Dim> origin;
  Polytope<Dim> domain;
  Ball<Dim> ball;
  std::vector<DrawnSet<Dim>> sets;
  std::vector<SetStatistics<Dim>> statistics;
  std::vector<MeasuredSet<Dim>> measured;
  std::vector<Vector<Dim>> single;  // normals of joints without a set
};

// in the order of the scene
template <int Dim>
void add_measured(Sample<Dim>& sample) {
  std::map<std::string, std::size_t> places;
  for (const JointSpec& spec : sample.scene.joints) {
    const HalfSpace<Dim> plane = to_half_space<Dim>(spec.plane, sample.origin);
    if (spec.set.empty()) {
      sample.single.push_back(plane.normal);
      continue;
    }
    const auto [at, first] = places.try_emplace(spec.set, sample.measured.size());
    if (first) sample.measured.push_back({spec.set, {}, {}, {}});
    Outline<Dim> outline = outline_of<Dim>(spec, plane.normal, sample.origin);
    outline.centre += sample.origin;
    sample.measured[at->second].joints.push_back(
        {plane.normal, to_vector<Dim>(spec.plane.point), 0, std::move(outline)});
  }
  for (MeasuredSet<Dim>& set : sample.measured) {
    std::vector<Vector<Dim>> normals;
    for (const DrawnJoint<Dim>& joint : set.joints)
      normals.push_back(joint.normal);
    set.mean = mean_orientation<Dim>(normals);
    JointSet along;  // its mean normal is that of the scanlines
    along.dip = set.mean.angles.dip * degree;
    along.dip_direction = set.mean.angles.direction * degree;
    along.intensity = 0;
    set.statistics = measure<Dim>(along, set.joints, sample.ball, sample.domain, sample.origin);
  }
}

template <int Dim>
Sample<Dim> sample_of(const Scene& scene) {
  if (!scene.domain)
    refuse({scene.tree.get(), ""}, "domain",
           "joints are measured in a domain; add for example domain = { box = { min = …, max = … } }");
  const Vector<Dim> origin = find_origin<Dim>(scene);
  Sample<Dim> sample{scene, origin, make_domain<Dim>(scene, origin), {}, {}, {}, {}, {}};
  sample.ball = ball_around<Dim>(sample.domain, origin);
  sample.sets = draw_joint_sets<Dim>(scene, sample.domain, origin);
  for (const DrawnSet<Dim>& drawn : sample.sets)
    sample.statistics.push_back(measure<Dim>(drawn.spec->set, drawn.joints, sample.ball, drawn.solid, origin));
  add_measured(sample);
  return sample;
}

// ---- joints.csv

template <int Dim>
std::vector<double> numbers_of(const Vector<Dim>& v) {
  return {v.data(), v.data() + Dim};
}

template <int Dim>
JointRow row_of(const Vector<Dim>& normal, const Vector<Dim>& point, const Outline<Dim>& outline, double inside) {
  JointRow row;
  const DipAndDirection angles = angles_of(normal);
  row.dip_deg = angles.dip;
  row.dip_direction_deg = angles.direction;
  row.normal = numbers_of<Dim>(normal);
  row.point = numbers_of<Dim>(point);
  row.shape = outline.shape;
  if (outline.shape == OutlineForm::ellipse || outline.shape == OutlineForm::rectangle)
    for (const double half : outline.half_sizes)
      row.extents.push_back(2 * half);
  row.inside = inside;
  return row;
}

template <int Dim>
std::string joints_csv(const Sample<Dim>& sample) {
  std::vector<JointRow> rows;
  for (const JointSpec& spec : sample.scene.joints) {
    const HalfSpace<Dim> plane = to_half_space<Dim>(spec.plane, sample.origin);
    const Outline<Dim> outline = outline_of<Dim>(spec, plane.normal, sample.origin);
    rows.push_back(row_of<Dim>(plane.normal, to_vector<Dim>(spec.plane.point), outline,
                               measure_inside(plane, outline, sample.domain)));
    rows.back().name = spec.name;
    rows.back().set = spec.set;
    rows.back().properties = spec.properties.value_or("");
    rows.back().corners = spec.outline.corners;
  }
  for (std::size_t s = 0; s < sample.sets.size(); ++s)
    for (std::size_t j = 0; j < sample.sets[s].joints.size(); ++j) {
      const DrawnJoint<Dim>& joint = sample.sets[s].joints[j];
      JointRow row = row_of<Dim>(joint.normal, joint.point, joint.outline, sample.statistics[s].measures[j]);
      row.name = sample.sets[s].name_of(j);
      row.set = sample.sets[s].spec->set.name;
      row.properties = sample.sets[s].spec->properties.value_or("");
      rows.push_back(std::move(row));
    }
  return joint_table(rows, Dim);
}

// ---- report.md

std::string row(const std::string& quantity, const std::string& unit, const std::string& stated,
                const std::string& found, double error) {
  return fmt::format("| {} | {} | {} | {} | {} |\n", quantity, unit, stated, found,
                     error > 0 ? fmt::format("{:.2g}", error) : "");
}

std::string row(const std::string& quantity, const std::string& unit, double stated, const Estimate& found) {
  return row(quantity, unit, fmt::format("{:.5g}", stated), fmt::format("{:.5g}", found.value), found.error);
}

template <int Dim>
std::string orientation_rows(const JointSet& set, const SetStatistics<Dim>& found) {
  if (Dim == 2 || found.fisher_constant.value == 0) return "";
  if (set.scatter == Scatter::fisher) return row("Fisher's constant", "1", set.fisher_constant, found.fisher_constant);
  return row("Fisher's constant", "1", "", fmt::format("{:.5g}", found.fisher_constant.value),
             found.fisher_constant.error);
}

template <int Dim>
std::string size_rows(const JointSet& set, const SetStatistics<Dim>& found) {
  if (set.size_law == SizeLaw::persistent) return "";
  const double deviation = set.size_law == SizeLaw::lognormal     ? set.size_deviation
                           : set.size_law == SizeLaw::exponential ? set.size_mean
                                                                  : 0;
  return row("joints centred in the domain", "1", "", fmt::format("{}", found.centred), 0) +
         row("mean size of these", "m", set.size_mean, found.size) +
         row("deviation of these", "m", fmt::format("{:.5g}", deviation), fmt::format("{:.5g}", found.size_deviation),
             0);
}

template <int Dim>
std::string set_text(const JointSet& set, const SetStatistics<Dim>& found) {
  std::string text = fmt::format(
      "## {}\n\n| quantity | unit | stated | measured | standard error |\n|---|---|---|---|---|\n", set.name);
  text += row("joints that meet the domain", "1", "", fmt::format("{}", found.inside), 0);
  text +=
      row(Dim == 3 ? "P32, area per volume" : "P21, length per area", "1/m", found.stated_intensity, found.intensity);
  text += row("P10 along the mean normal", "1/m", found.stated_frequency, found.frequency);
  for (std::size_t k = 0; k < found.traces.size(); ++k)
    text +=
        row(fmt::format("P21 on the section normal to {}", "xyz"[k]), "1/m", found.stated_traces[k], found.traces[k]);
  const Moments spacing = moments_of(found.spacings);
  if (!found.spacings.empty())
    text += row("spacing along the mean normal", "m", 1 / found.stated_frequency,
                {spacing.mean.value, 0}) +  // several lines cross one joint: their spacings are not independent
            row("its deviation over its mean", "1",
                set.size_law == SizeLaw::persistent && set.arrangement == Arrangement::equal ? "0" : "1",
                fmt::format("{:.4g}", spacing.deviation / spacing.mean.value), 0);
  return text + orientation_rows<Dim>(set, found) + size_rows<Dim>(set, found) + "\n";
}

template <int Dim>
std::string measured_text(const MeasuredSet<Dim>& set) {
  const SetStatistics<Dim>& found = set.statistics;
  std::string text =
      fmt::format("## {} (stated)\n\n| quantity | unit | measured | standard error |\n|---|---|---|---|\n", set.name);
  const auto add = [&](const char* quantity, const char* unit, const std::string& value, double error = 0) {
    text +=
        fmt::format("| {} | {} | {} | {} |\n", quantity, unit, value, error > 0 ? fmt::format("{:.2g}", error) : "");
  };
  const auto add_estimate = [&](const char* quantity, const Estimate& value) {
    add(quantity, "1/m", fmt::format("{:.5g}", value.value), value.error);
  };
  add("joints", "1", fmt::format("{}", set.joints.size()));
  add("joints that meet the domain", "1", fmt::format("{}", found.inside));
  add("mean dip", "deg", fmt::format("{:.1f}", set.mean.angles.dip));
  add("mean dip direction", "deg", fmt::format("{:.1f}", set.mean.angles.direction));
  if (set.mean.fisher_constant) add("Fisher's constant", "1", fmt::format("{:.4g}", *set.mean.fisher_constant));
  add_estimate(Dim == 3 ? "P32, area per volume" : "P21, length per area", found.intensity);
  add_estimate("P10 along the mean normal", found.frequency);
  if (!found.spacings.empty())
    add("spacing along the mean normal", "m", fmt::format("{:.5g}", moments_of(found.spacings).mean.value));
  return text + "\n";
}

std::string block_text(const BlockSizes& blocks, int dimension) {
  const std::vector<double>& v = blocks.volumes;
  const char* unit = dimension == 3 ? "m³" : "m²";
  const double total = std::accumulate(v.begin(), v.end(), 0.0);
  std::string text =
      fmt::format("## Blocks\n\n{} blocks, {:.6g} {} in total.\n\n| blocks up to this size make up | {} |\n|---|---|\n",
                  v.size(), total, unit, unit);
  for (const int fraction : {10, 25, 50, 75, 90})
    text += fmt::format("| {} % of the whole | {:.4g} |\n", fraction, size_at_fraction(v, fraction / 100.0));
  return text + fmt::format("| smallest block | {:.4g} |\n| largest block | {:.4g} |\n", v.front(), v.back());
}

template <int Dim>
std::string report_text(const Sample<Dim>& sample, const BlockSizes& blocks) {
  const char* const cubic = Dim == 3 ? "m³" : "m²";
  std::string text =
      fmt::format("# Joints of {}\n\n", sample.scene.title.empty() ? sample.scene.file : sample.scene.title);
  if (!sample.sets.empty())
    text += fmt::format(
        "Drawn in unbounded rock and measured inside the domain ({:.6g} {}). A standard error is that of a Poisson "
        "process: the scatter between seeds. Scanlines are no longer than the domain: they miss wide "
        "spacings.\n\n",
        sample.domain.mass.volume, cubic);
  if (!sample.measured.empty())
    text += fmt::format(
        "Sets marked as stated were not drawn at random: they are the joints that the scene lists, by their `set`, "
        "in "
        "the domain ({:.6g} {}). The mean orientation is that of all joints of a set; the standard error is that of a "
        "Poisson process of such joints.\n\n",
        sample.domain.mass.volume, cubic);
  if (!sample.single.empty())
    text += fmt::format("{} stated without a set.\n\n",
                        sample.single.size() == 1 ? "1 joint is" : fmt::format("{} joints are", sample.single.size()));
  const auto confined = std::ranges::count_if(
      sample.scene.joints, [](const JointSpec& spec) { return spec.within || !spec.ends_at.empty(); });
  if (confined > 0)
    text += fmt::format(
        "`within` and `ends_at` of {} stated joints are not counted here: intensities are too high by that.\n\n",
        confined);
  for (const MeasuredSet<Dim>& set : sample.measured)
    text += measured_text<Dim>(set);
  for (std::size_t s = 0; s < sample.sets.size(); ++s)
    text += set_text<Dim>(sample.sets[s].spec->set, sample.statistics[s]);
  text += block_text(blocks, Dim);
  return text;
}

// ---- figures

// at most about a hundred points of a cumulative distribution
Points cumulative(const std::vector<double>& ascending, const std::vector<double>& weights) {
  constexpr std::size_t most_points = 400;
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const std::size_t stride = std::max<std::size_t>(1, ascending.size() / most_points);
  Points points;
  double sum = 0;
  for (std::size_t i = 0; i < ascending.size(); ++i) {
    sum += weights[i];
    if (i % stride == stride - 1 || i + 1 == ascending.size()) points.emplace_back(ascending[i], 100 * sum / total);
  }
  return points;
}

Curve spacing_curve(const std::string& name, const std::vector<double>& spacings) {
  return {Curve::Kind::line, name, cumulative(spacings, std::vector<double>(spacings.size(), 1.0))};
}

template <int Dim>
std::string spacing_figure(const Sample<Dim>& sample) {
  Diagram diagram{"Spacing along the mean normals", "spacing (m)", "spacings up to this (%)", false, {}};
  for (const MeasuredSet<Dim>& set : sample.measured)
    diagram.curves.push_back(spacing_curve(set.name + ", stated", set.statistics.spacings));
  for (std::size_t s = 0; s < sample.sets.size(); ++s)
    diagram.curves.push_back(spacing_curve(sample.sets[s].spec->set.name, sample.statistics[s].spacings));
  // the distribution of a Poisson process along a line, for the widest set
  double rarest = 0, widest = 0;
  for (const SetStatistics<Dim>& found : sample.statistics) {
    if (found.spacings.empty()) continue;
    widest = std::max(widest, found.spacings.back());
    rarest = rarest == 0 ? found.stated_frequency : std::min(rarest, found.stated_frequency);
  }
  if (sample.sets.empty()) return svg(diagram);
  Curve exponential{Curve::Kind::line, fmt::format("exponential, {:.3g} /m", rarest), {}};
  constexpr int steps = 100;
  for (int k = 0; k <= steps && rarest > 0; ++k)
    exponential.points.emplace_back(widest * k / steps, 100 * (1 - std::exp(-rarest * widest * k / steps)));
  diagram.curves.push_back(std::move(exponential));
  return svg(diagram);
}

std::string block_figure(const BlockSizes& blocks, int dimension) {
  const std::vector<double>& v = blocks.volumes;
  return svg({"Block sizes",
              dimension == 3 ? "volume (m³)" : "area (m²)",
              "in blocks up to this (%)",
              true,
              {{Curve::Kind::line, "of their number", cumulative(v, std::vector<double>(v.size(), 1.0))},
               {Curve::Kind::line, "of the whole", cumulative(v, v)}}});
}

std::string stereonet(const Sample<3>& sample) {
  std::vector<PoleSet> sets;
  const auto add = [&](const std::string& name, std::size_t count) -> PoleSet& {
    return sets.emplace_back(PoleSet{fmt::format("{} ({})", name, count), {}});
  };
  for (const MeasuredSet<3>& measured : sample.measured) {
    PoleSet& set = add(measured.name + ", stated", measured.joints.size());
    for (const DrawnJoint<3>& joint : measured.joints)
      set.poles.push_back(pole_of(joint.normal));
  }
  if (!sample.single.empty()) {
    PoleSet& set = add("without a set", sample.single.size());
    for (const Vector<3>& normal : sample.single)
      set.poles.push_back(pole_of(normal));
  }
  for (const DrawnSet<3>& drawn : sample.sets) {
    PoleSet& set = add(drawn.spec->set.name, drawn.joints.size());
    for (const DrawnJoint<3>& joint : drawn.joints)
      set.poles.push_back(pole_of(joint.normal));
  }
  return stereonet_svg("Poles of the joints", sets);
}

template <int Dim>
std::string write_report(const Scene& scene, const BlockSizes& blocks, const fs::path& folder) {
  const Sample<Dim> sample = sample_of<Dim>(scene);
  const std::string text = report_text<Dim>(sample, blocks);
  write_file(folder / "joints.csv", joints_csv<Dim>(sample));
  write_file(folder / "report.md", text);
  if constexpr (Dim == 3) write_file(folder / "stereonet.svg", stereonet(sample));
  write_file(folder / "spacing.svg", spacing_figure<Dim>(sample));
  write_file(folder / "block_sizes.svg", block_figure(blocks, Dim));
  return text;
}

}  // namespace

template <int Dim>
BlockSizes block_sizes(const Model<Dim>& model) {
  BlockSizes sizes;
  for (const Body<Dim>& body : model.bodies)
    sizes.volumes.push_back(volume(body));
  std::sort(sizes.volumes.begin(), sizes.volumes.end());
  return sizes;
}

std::string write_slice_report(const Scene& scene, const BlockSizes& blocks, const fs::path& folder) {
  return scene.dimension == 2 ? write_report<2>(scene, blocks, folder) : write_report<3>(scene, blocks, folder);
}

template BlockSizes block_sizes<2>(const Model<2>&);
template BlockSizes block_sizes<3>(const Model<3>&);

}  // namespace voussoir
