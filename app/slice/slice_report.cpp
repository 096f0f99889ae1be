#include "app/slice/slice_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "app/base/orientation.hpp"
#include "app/report/joints_data.hpp"
#include "core/exchange/tables.hpp"
#include "core/joint_sets/statistics.hpp"
#include "core/output/atomic_file.hpp"
#include "core/run/checkpoint.hpp"
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

// ---- the tables

// a quantity of a set: as the scene states it, as measured, and the standard error; nothing: an empty cell
struct QuantityRow {
  std::string quantity, unit;
  std::optional<double> stated;
  double measured = 0;
  std::optional<double> error;
};

struct SetReport {
  std::string name;    // empty: joints without a set
  bool drawn = false;  // from a [[joint_sets]] of the scene, else listed one by one
  std::vector<QuantityRow> rows;
  std::vector<std::vector<double>> normals;
  std::vector<double> spacings;  // m, ascending, along the mean normal
  double frequency = 0;          // 1/m, as stated
};

template <int Dim, class Joints>
std::vector<std::vector<double>> normals_of(const Joints& joints) {
  std::vector<std::vector<double>> normals;
  for (const auto& joint : joints)
    normals.push_back(numbers_of<Dim>(joint.normal));
  return normals;
}

std::optional<double> known(double error) {
  return error > 0 ? std::optional<double>(error) : std::nullopt;
}

QuantityRow estimated(const std::string& quantity, const std::string& unit, std::optional<double> stated,
                      const Estimate& found) {
  return {quantity, unit, stated, found.value, known(found.error)};
}

template <int Dim>
constexpr const char* intensity_name = Dim == 3 ? "P32, area per volume" : "P21, length per area";

template <int Dim>
std::vector<QuantityRow> size_rows(const JointSet& set, const SetStatistics<Dim>& found) {
  if (set.size_law == SizeLaw::persistent) return {};
  const double deviation = set.size_law == SizeLaw::lognormal     ? set.size_deviation
                           : set.size_law == SizeLaw::exponential ? set.size_mean
                                                                  : 0;
  return {{"joints centred in the domain", "1", {}, static_cast<double>(found.centred), {}},
          estimated("mean size of these", "m", set.size_mean, found.size),
          {"deviation of these", "m", deviation, found.size_deviation, {}}};
}

template <int Dim>
SetReport report_on(const DrawnSet<Dim>& drawn, const SetStatistics<Dim>& found) {
  const JointSet& set = drawn.spec->set;
  SetReport report{set.name, true, {}, normals_of<Dim>(drawn.joints), found.spacings, found.stated_frequency};
  std::vector<QuantityRow>& rows = report.rows;
  rows.push_back({"joints that meet the domain", "1", {}, static_cast<double>(found.inside), {}});
  rows.push_back(estimated(intensity_name<Dim>, "1/m", found.stated_intensity, found.intensity));
  rows.push_back(estimated("P10 along the mean normal", "1/m", found.stated_frequency, found.frequency));
  for (std::size_t k = 0; k < found.traces.size(); ++k)
    rows.push_back(estimated(fmt::format("P21 on the section normal to {}", "xyz"[k]), "1/m", found.stated_traces[k],
                             found.traces[k]));
  if (!found.spacings.empty()) {
    // without an error: several lines cross one joint, so that their spacings are not independent
    const Moments spacing = moments_of(found.spacings);
    const bool equal = set.size_law == SizeLaw::persistent && set.arrangement == Arrangement::equal;
    rows.push_back({"spacing along the mean normal", "m", 1 / found.stated_frequency, spacing.mean.value, {}});
    rows.push_back({"its deviation over its mean", "1", equal ? 0.0 : 1.0, spacing.deviation / spacing.mean.value, {}});
  }
  if (Dim == 3 && found.fisher_constant.value != 0)
    rows.push_back(estimated("Fisher's constant", "1",
                             set.scatter == Scatter::fisher ? std::optional(set.fisher_constant) : std::nullopt,
                             found.fisher_constant));
  for (QuantityRow& row : size_rows<Dim>(set, found))
    rows.push_back(std::move(row));
  return report;
}

template <int Dim>
SetReport report_on(const MeasuredSet<Dim>& set) {
  const SetStatistics<Dim>& found = set.statistics;
  SetReport report{set.name, false, {}, normals_of<Dim>(set.joints), found.spacings, 0};
  std::vector<QuantityRow>& rows = report.rows;
  rows.push_back({"joints", "1", {}, static_cast<double>(set.joints.size()), {}});
  rows.push_back({"joints that meet the domain", "1", {}, static_cast<double>(found.inside), {}});
  rows.push_back({"mean dip", "deg", {}, set.mean.angles.dip, {}});
  rows.push_back({"mean dip direction", "deg", {}, set.mean.angles.direction, {}});
  if (set.mean.fisher_constant) rows.push_back({"Fisher's constant", "1", {}, *set.mean.fisher_constant, {}});
  rows.push_back(estimated(intensity_name<Dim>, "1/m", {}, found.intensity));
  rows.push_back(estimated("P10 along the mean normal", "1/m", {}, found.frequency));
  if (!found.spacings.empty())
    rows.push_back({"spacing along the mean normal", "m", {}, moments_of(found.spacings).mean.value, {}});
  return report;
}

template <int Dim>
std::vector<SetReport> reports_on(const Sample<Dim>& sample) {
  std::vector<SetReport> reports;
  for (const MeasuredSet<Dim>& set : sample.measured)
    reports.push_back(report_on<Dim>(set));
  for (std::size_t s = 0; s < sample.sets.size(); ++s)
    reports.push_back(report_on<Dim>(sample.sets[s], sample.statistics[s]));
  if (sample.single.empty()) return reports;
  SetReport& single = reports.emplace_back();
  for (const Vector<Dim>& normal : sample.single)
    single.normals.push_back(numbers_of<Dim>(normal));
  return reports;
}

// remarks on how sets were measured
template <int Dim>
std::vector<std::string> notes_on(const Sample<Dim>& sample) {
  const std::string domain = fmt::format("{:.6g} {}", sample.domain.mass.volume, Dim == 3 ? "m³" : "m²");
  std::vector<std::string> notes;
  if (!sample.sets.empty())
    notes.push_back(
        fmt::format("Drawn in unbounded rock and measured inside the domain ({}). A standard error is that of a "
                    "Poisson process: the scatter between seeds. Scanlines are no longer than the domain: they miss "
                    "wide spacings.",
                    domain));
  if (!sample.measured.empty())
    notes.push_back(
        fmt::format("Sets marked as stated were not drawn at random: they are the joints that the scene lists, by "
                    "their `set`, in the domain ({}). The mean orientation is that of all joints of a set; the "
                    "standard error is that of a Poisson process of such joints.",
                    domain));
  if (!sample.single.empty())
    notes.push_back(fmt::format("{} stated without a set.", sample.single.size() == 1
                                                                ? "1 joint is"
                                                                : fmt::format("{} joints are", sample.single.size())));
  const auto confined = std::ranges::count_if(
      sample.scene.joints, [](const JointSpec& spec) { return spec.within || !spec.ends_at.empty(); });
  if (confined > 0)
    notes.push_back(fmt::format(
        "`within` and `ends_at` of {} stated joints are not counted here: intensities are too high by that.",
        confined));
  return notes;
}

// ---- as text

constexpr int block_shares[] = {10, 25, 50, 75, 90};  // %

// counts in full, other numbers to five digits
std::string cell(std::optional<double> number) {
  if (!number) return "";
  return std::round(*number) == *number ? fmt::format("{:.0f}", *number) : fmt::format("{:.5g}", *number);
}

std::string set_text(const SetReport& set) {
  std::string text =
      fmt::format("## {}{}\n\n| quantity | unit |{} measured | standard error |\n|---|---|{}---|---|\n", set.name,
                  set.drawn ? "" : " (stated)", set.drawn ? " stated |" : "", set.drawn ? "---|" : "");
  for (const QuantityRow& row : set.rows)
    text += fmt::format("| {} | {} |{} {} | {} |\n", row.quantity, row.unit,
                        set.drawn ? fmt::format(" {} |", cell(row.stated)) : "", cell(row.measured),
                        row.error ? fmt::format("{:.2g}", *row.error) : "");
  return text + "\n";
}

std::string block_text(const BlockSizes& blocks, int dimension) {
  const std::vector<double>& v = blocks.volumes;
  const char* unit = dimension == 3 ? "m³" : "m²";
  const double total = std::accumulate(v.begin(), v.end(), 0.0);
  std::string text =
      fmt::format("## Blocks\n\n{} blocks, {:.6g} {} in total.\n\n| blocks up to this size make up | {} |\n|---|---|\n",
                  v.size(), total, unit, unit);
  for (const int share : block_shares)
    text += fmt::format("| {} % of the whole | {:.4g} |\n", share, size_at_fraction(v, share / 100.0));
  return text + fmt::format("| smallest block | {:.4g} |\n| largest block | {:.4g} |\n", v.front(), v.back());
}

std::string title_of(const Scene& scene) {
  return "Joints of " + (scene.title.empty() ? scene.file : scene.title);
}

// ---- as data of the page

// of at most some hundred points of a cumulative distribution: a value and the share of the whole up to it, %
nlohmann::ordered_json cumulative(const std::vector<double>& ascending, const std::vector<double>& weights) {
  constexpr std::size_t most_points = 400;
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const std::size_t stride = std::max<std::size_t>(1, ascending.size() / most_points);
  auto points = nlohmann::ordered_json::array();
  double sum = 0;
  for (std::size_t i = 0; i < ascending.size(); ++i) {
    sum += weights[i];
    if (i % stride == stride - 1 || i + 1 == ascending.size()) points.push_back({ascending[i], 100 * sum / total});
  }
  return points;
}

nlohmann::ordered_json by_number(const std::vector<double>& ascending) {
  return cumulative(ascending, std::vector<double>(ascending.size(), 1.0));
}

nlohmann::ordered_json or_null(std::optional<double> number) {
  return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json set_json(const SetReport& set) {
  nlohmann::ordered_json json = {{"name", set.name}, {"drawn", set.drawn}, {"rows", nlohmann::ordered_json::array()}};
  for (const QuantityRow& row : set.rows)
    json["rows"].push_back({{"quantity", row.quantity},
                            {"unit", row.unit},
                            {"stated", or_null(row.stated)},
                            {"measured", row.measured},
                            {"error", or_null(row.error)}});
  json["frequency_per_m"] = set.frequency;
  json["spacings_m"] = by_number(set.spacings);
  json["normals"] = short_normals(set.normals);
  return json;
}

nlohmann::ordered_json block_json(const std::vector<double>& volumes) {
  nlohmann::ordered_json json = {{"count", volumes.size()},
                                 {"total", std::accumulate(volumes.begin(), volumes.end(), 0.0)},
                                 {"smallest", volumes.front()},
                                 {"largest", volumes.back()}};
  for (const int share : block_shares)
    json["shares"].push_back({share, size_at_fraction(volumes, share / 100.0)});
  json["by_number"] = by_number(volumes);
  json["by_size"] = cumulative(volumes, volumes);
  return json;
}

template <int Dim>
std::string write_report(const Scene& scene, const BlockSizes& blocks, const fs::path& folder) {
  const Sample<Dim> sample = sample_of<Dim>(scene);
  const std::vector<SetReport> sets = reports_on<Dim>(sample);
  const std::vector<std::string> notes = notes_on<Dim>(sample);
  std::string text = fmt::format("# {}\n\n", title_of(scene));
  for (const std::string& note : notes)
    text += note + "\n\n";
  nlohmann::ordered_json json = {{"schema", joints_schema},
                                 {"schema_version", 1},
                                 {"title", title_of(scene)},
                                 {"program", build_name()},
                                 {"input_hash", input_hash(scene)},
                                 {"dimension", Dim},
                                 {"domain", sample.domain.mass.volume},
                                 {"notes", notes},
                                 {"sets", nlohmann::ordered_json::array()}};
  for (const SetReport& set : sets) {
    if (!set.name.empty()) text += set_text(set);
    json["sets"].push_back(set_json(set));
  }
  json["blocks"] = block_json(blocks.volumes);
  write_file(folder / "joints.csv", joints_csv<Dim>(sample));
  write_file(folder / joints_data_file, json_text(json) + "\n");
  return text + block_text(blocks, Dim);
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
