#include "core/output/view.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "core/base/version.hpp"
#include "core/joint_laws/joint_law.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/paraview.hpp"
#include "core/output/support_table.hpp"
#include "core/potential/particle.hpp"
#include "text/angle.hpp"
#include "text/read_file.hpp"

namespace voussoir {
namespace {

static_assert(std::endian::native == std::endian::little,
              "records are little-endian, and written as they are in memory");

constexpr std::string_view view_magic = "VOUSVIE2";  // VOUSVIEW had fewer data of supports
constexpr std::uint32_t head_tag = 1, shape_tag = 2, frame_tag = 3, again_tag = 4, verdicts_tag = 5;

// to single precision; values that it cannot represent are 0
float single(double value) {
  return std::isfinite(value) && std::abs(value) < std::numeric_limits<float>::max() ? static_cast<float>(value) : 0.0F;
}

// To 12 bits, 1 in 4000: bytes that are always 0 cost nothing after compression.
float short_single(double value) {
  constexpr std::uint32_t dropped = 12;
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(single(value)) + (1U << (dropped - 1));
  const float rounded = std::bit_cast<float>(bits >> dropped << dropped);
  return std::isfinite(rounded) ? rounded : 0.0F;
}

// the bytes of a record
class Record {
 public:
  explicit Record(std::uint32_t tag) {
    put(tag);
    put(std::uint32_t{0});
  }

  template <class Number>
  void put(Number number) {
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  void text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
    pad();
  }
  void bytes(const std::string& list) {
    bytes_ += list;
    pad();
  }
  // the first bytes of all, then the second ones …: similar bytes are adjacent and compress better
  template <class Number>
  void list(const std::vector<Number>& numbers) {
    static_assert(sizeof(Number) == 4);
    const std::size_t at = bytes_.size(), n = numbers.size();
    bytes_.resize(at + 4 * n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto four = std::bit_cast<std::array<char, 4>>(numbers[i]);
      for (std::size_t k = 0; k < 4; ++k)
        bytes_[at + k * n + i] = four[k];
    }
  }

  const std::string& finished() {
    const auto size = static_cast<std::uint32_t>(bytes_.size());
    std::memcpy(bytes_.data() + 4, &size, sizeof size);
    return bytes_;
  }

 private:
  void pad() { bytes_.resize((bytes_.size() + 3) / 4 * 4); }
  std::string bytes_;
};

template <int Dim>
std::string head_of(const Prepared<Dim>& scene) {
  const Model<Dim>& model = scene.model;
  nlohmann::json joints = nlohmann::json::array(), properties = nlohmann::json::array(),
                 stages = nlohmann::json::array();
  for (const Joint<Dim>& joint : model.joints)
    joints.push_back(joint.name);
  for (const JointProperties& p : model.properties)
    properties.push_back({{"name", p.name}, {"friction_deg", to_degrees(p.friction)}});
  for (const StagePlan& stage : scene.stages)
    stages.push_back(stage.name);
  const nlohmann::json head = {
      {"program", version()},     {"title", scene.title},
      {"dimension", Dim},         {"origin", std::vector<double>(model.origin.data(), model.origin.data() + Dim)},
      {"joints", joints},         {"sets", scene.joint_sets.names},
      {"properties", properties}, {"default_properties", model.default_properties},
      {"stages", stages}};
  return head.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// Of each joint its set, -1 for none, its properties, and whether it joins its two sides; its upward normal, and the
// plane's distance from the model's origin along it, m.
template <int Dim>
void put_joints(Record& record, const Prepared<Dim>& scene) {
  std::array<std::vector<std::int32_t>, 3> kinds;
  std::array<std::vector<float>, Dim + 1> planes;
  for (std::size_t j = 0; j < scene.model.joints.size(); ++j) {
    const Joint<Dim>& joint = scene.model.joints[j];
    kinds[0].push_back(scene.joint_sets.set_of(static_cast<int>(j)));
    kinds[1].push_back(joint.properties);
    kinds[2].push_back(joint.holds);
    for (int k = 0; k < Dim; ++k)
      planes[k].push_back(single(joint.plane.normal[k]));
    planes[Dim].push_back(single(joint.plane.offset));
  }
  for (const std::vector<std::int32_t>& column : kinds)
    record.list(column);
  for (const std::vector<float>& column : planes)
    record.list(column);
}

// ---- shapes --------------------------------------------------------------------------------------------------------

template <int Dim>
void put_points(Record& record, const std::vector<Vector<Dim>>& points, const Vector<Dim>& shift) {
  record.put(static_cast<std::uint32_t>(points.size()));
  for (const Vector<Dim>& point : points)
    for (int k = 0; k < Dim; ++k)
      record.put(single(point[k] + shift[k]));
}

void put_loop(Record& record, int joint, const std::vector<int>& loop) {
  record.put(joint);
  record.put(static_cast<std::uint32_t>(loop.size()));
  for (const int corner : loop)
    record.put(corner);
}

// Corners, whether they belong to a rounded surface, and faces: the joint that made each, and its corners. In 2-D faces
// are edges, followed by the outline.
template <int Dim>
void put_part(Record& record, const Polytope<Dim>& part) {
  if (is_particle(part)) {
    const PotentialDrawing<Dim>& drawing = part.particle->drawing;
    put_points<Dim>(record, drawing.points, part.centre);
    record.put(std::uint32_t{1});
    record.put(static_cast<std::uint32_t>(drawing.cells.size()));
    for (const std::vector<int>& cell : drawing.cells)
      put_loop(record, no_joint, cell);
    return;
  }
  put_points<Dim>(record, part.vertices, Vector<Dim>::Zero());
  record.put(std::uint32_t{0});
  record.put(static_cast<std::uint32_t>(part.loops.size() + (Dim == 2 ? 1 : 0)));
  for (std::size_t face = 0; face < part.loops.size(); ++face)
    put_loop(record, face < part.joints.size() ? part.joints[face] : no_joint, part.loops[face]);
  if constexpr (Dim == 2) put_loop(record, no_joint, boundary_ring(part));
}

template <int Dim>
std::string shape_of(const Body<Dim>& body, std::size_t id) {
  Record record(shape_tag);
  record.put(static_cast<std::int32_t>(id));
  record.text(body.name);
  for (int k = 0; k < Dim; ++k)
    record.put(single(body.reference[k]));
  record.put(single(volume(body)));
  record.put(single(body.size));
  record.put(static_cast<std::uint32_t>(body.parts.size()));
  for (const Polytope<Dim>& part : body.parts)
    put_part(record, part);
  return record.finished();
}

// the mark of a body that an excavation has changed
template <int Dim>
ShownBody look_of(const Body<Dim>& body) {
  ShownBody look{0, body.mass, body.present && !body.parts.empty()};
  for (const Polytope<Dim>& part : body.parts)
    look.corners += part.vertices.size();
  return look;
}

template <int Dim>
std::string new_shapes(const Model<Dim>& model, std::vector<ShownBody>& shown) {
  std::string bytes;
  shown.resize(model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const ShownBody look = look_of(model.bodies[b]);
    if (look.present && !(look == shown[b])) bytes += shape_of(model.bodies[b], b);
    shown[b] = look;
  }
  return bytes;
}

// ---- contacts ------------------------------------------------------------------------------------------------------

// the resultant of a contact
template <int Dim>
struct ContactResultant {
  Vector<Dim> point, force;  // m from the centroid of the first body; N on the second
  double normal = 0, overlap = 0;
  double friction = 0;  // fraction of the frictional strength; 0 without compression
};

// present tan φ
template <int Dim>
double coefficient(const Model<Dim>& model, const State<Dim>& state, const Contact<Dim>& c, double normal) {
  const JointProperties& p = model.properties[c.properties];
  const double angle = state.schedule.friction[c.properties];
  if (p.laws.friction == FrictionLaw::constant) return std::tan(angle);
  const double factor = state.schedule.strength_factor.empty() ? 1 : state.schedule.strength_factor[c.properties];
  const double stress = c.history.area > 0 ? normal / c.history.area : 0;
  return friction_answer(p, angle, c.history.plastic_slip, stress, factor).coefficient;
}

template <int Dim>
ContactResultant<Dim> carried_by(const Model<Dim>& model, const State<Dim>& state, std::size_t place) {
  const Contact<Dim>& c = state.contacts.list[place];
  ContactResultant<Dim> all{c.geometry.point, c.force, c.force.dot(c.geometry.normal), c.geometry.overlap, 0};

  // point at which the resultant of sub-contacts acts
  Vector<Dim> moment = Vector<Dim>::Zero();
  double pressed = 0;
  for (const SubContact<Dim>& s : subs_of(state.contacts, place)) {
    const double normal = s.area > 0 ? std::max(0.0, s.force.dot(c.geometry.normal)) : 0;
    moment += normal * s.point;
    pressed += normal;
  }
  if (pressed > 0) all.point = moment / pressed;

  const double limit = all.normal > 0 ? all.normal * coefficient(model, state, c, all.normal) : 0;
  const double shear = (c.force - all.normal * c.geometry.normal).norm();
  if (limit > 0 && std::isfinite(shear)) all.friction = shear / limit;
  return all;
}

template <int Dim>
ViewPair pair_of(const Model<Dim>& model, const Contact<Dim>& c) {
  const PartId &a = model.parts[c.part_a], &b = model.parts[c.part_b];
  return {a.body, a.part, c.geometry.face_a, b.body, b.part, c.geometry.face_b, c.joint, c.properties};
}

// The touching pairs, a bit for each pair so far, and their forces, in the order of their numbers.
template <int Dim>
void put_contacts(Record& record, ViewSeries& series, const Model<Dim>& model, const State<Dim>& state) {
  std::vector<std::pair<int, std::size_t>> touching;  // number and index
  std::vector<ViewPair> fresh;
  for (std::size_t i = 0; i < state.contacts.list.size(); ++i) {
    if (!state.contacts.list[i].touching()) continue;
    const ViewPair pair = pair_of(model, state.contacts.list[i]);
    const auto [known, is_new] = series.pairs.try_emplace(pair, static_cast<int>(series.pairs.size()));
    if (is_new) fresh.push_back(pair);
    touching.emplace_back(known->second, i);
  }
  std::sort(touching.begin(), touching.end());

  record.put(static_cast<std::uint32_t>(fresh.size()));
  record.put(static_cast<std::uint32_t>(touching.size()));
  for (std::size_t k = 0; k < std::tuple_size_v<ViewPair>; ++k) {
    std::vector<std::int32_t> column;
    for (const ViewPair& pair : fresh)
      column.push_back(pair[k]);
    record.list(column);
  }
  std::string bits((series.pairs.size() + 7) / 8, '\0');
  for (const auto& [number, place] : touching)
    bits[number / 8] = static_cast<char>(bits[number / 8] | 1 << number % 8);
  record.bytes(bits);

  std::array<std::vector<float>, 2 * Dim + 3> columns;
  for (const auto& [number, place] : touching) {
    const ContactResultant<Dim> c = carried_by(model, state, place);
    for (int k = 0; k < Dim; ++k) {
      columns[k].push_back(short_single(c.point[k]));
      columns[Dim + k].push_back(short_single(c.force[k]));
    }
    columns[2 * Dim].push_back(short_single(c.normal));
    columns[2 * Dim + 1].push_back(short_single(c.friction));
    columns[2 * Dim + 2].push_back(short_single(c.overlap));
  }
  for (const std::vector<float>& column : columns)
    record.list(column);
}

// ---- supports ------------------------------------------------------------------------------------------------------

// Straight pieces: ends from the model's origin, m; the force along them, N, tension positive; utilisation, -1 for
// none; kind: 1 for a lining, otherwise 2 if its first end is a bolt's collar, and 4 if it is broken. Then of linings
// alone, at both ends: thrust, moment and pressure.
template <int Dim>
void put_support(Record& record, const Model<Dim>& model, const State<Dim>& state) {
  std::array<std::vector<float>, 2 * Dim + 3> columns;
  std::array<std::vector<float>, 6> sections;
  const auto add = [&](const PolyData& data, std::size_t cell, const ViewLine& line) {
    for (int end = 0; end < 2; ++end)
      for (int k = 0; k < Dim; ++k)
        columns[Dim * end + k].push_back(single(data.points[data.cells[cell][end]][k] - model.origin[k]));
    columns[2 * Dim].push_back(short_single(line.force));
    columns[2 * Dim + 1].push_back(short_single(line.use.value_or(-1)));
    const int kind = line.section ? 1 : (line.collar ? 2 : 0) | (line.broken ? 4 : 0);
    columns[2 * Dim + 2].push_back(static_cast<float>(kind));
    if (!line.section) return;
    for (std::size_t k = 0; k < sections.size(); ++k)
      sections[k].push_back(short_single((*line.section)[k / 2][k % 2]));
  };
  for (const OutputSupport<Dim>& row : output_supports<Dim>) {
    if (!row.lines || !row.has(model)) continue;
    const PolyData lines = row.lines(model, state, 0);
    for (std::size_t i = 0; i < lines.cells.size(); ++i)
      add(lines, i, row.view(model, lines, i));
  }
  record.put(static_cast<std::uint32_t>(columns[0].size()));
  for (const std::vector<float>& column : columns)
    record.list(column);
  for (const std::vector<float>& column : sections)
    record.list(column);
}

template <int Dim>
void put_bodies(Record& record, const Model<Dim>& model, const State<Dim>& state) {
  std::array<std::vector<float>, freedoms<Dim> + 1> columns;
  std::string flags;
  record.put(static_cast<std::uint32_t>(model.bodies.size()));
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    const Motion<Dim>& motion = state.bodies.motions[b];
    flags.push_back(static_cast<char>((body.present ? 1 : 0) | (body.immobile() ? 2 : 0)));
    const Spin<Dim> turn = rotation_vector(motion.rotation);
    for (int k = 0; k < Dim; ++k)
      columns[k].push_back(single(motion.displacement[k]));
    for (int k = 0; k < spin_freedoms<Dim>; ++k)
      columns[Dim + k].push_back(single(turn[k]));
    columns[freedoms<Dim>].push_back(short_single(motion.velocity.norm()));
  }
  record.bytes(flags);
  for (const std::vector<float>& column : columns)
    record.list(column);
}

template <int Dim>
ViewSeries begun(const std::filesystem::path& file, const Prepared<Dim>& scene) {
  Record head(head_tag);
  head.text(head_of(scene));
  put_joints(head, scene);
  write_file(file, std::string(view_magic) + head.finished());
  return {file};
}

}  // namespace

template <int Dim>
ViewSeries begin_view(const std::filesystem::path& file, const Prepared<Dim>& scene) {
  ViewSeries series = begun(file, scene);
  add_view_frame(series, scene.model, scene.state, {ViewMoment::Kind::start});
  return series;
}

template <int Dim>
ViewSeries continue_view(const std::filesystem::path& file, const Prepared<Dim>& scene, int frames) {
  std::string bytes;
  try {
    bytes = read_file(file, std::numeric_limits<std::uintmax_t>::max());
  } catch (const ReadFault&) {
    return begun(file, scene);
  }
  const ViewExtent kept = view_extent(bytes, frames);
  if (kept.frames < frames) return begun(file, scene);

  // a reader discards the shapes and pairs so far: the following ones are numbered from the start
  bytes.resize(kept.bytes);
  Record again(again_tag);
  write_file(file, bytes + again.finished());
  ViewSeries series{file};
  series.frames = kept.frames;
  return series;
}

template <int Dim>
void add_view_frame(ViewSeries& series, const Model<Dim>& model, const State<Dim>& state, const ViewMoment& moment) {
  const std::string shapes = new_shapes(model, series.shown);
  Record record(frame_tag);
  record.put(static_cast<std::int32_t>(moment.kind));
  record.put(static_cast<std::int32_t>(moment.stage));
  record.put(static_cast<std::int32_t>(moment.trial));
  record.put(std::int32_t{0});
  record.put(moment.time);
  put_bodies(record, model, state);
  put_contacts(record, series, model, state);
  put_support(record, model, state);
  append_to_file(series.file, shapes + record.finished());
  ++series.frames;
}

void add_view_verdicts(const ViewSeries& series, const std::string& moment, const std::vector<ViewVerdict>& verdicts) {
  Record record(verdicts_tag);
  record.text(moment);
  record.put(static_cast<std::uint32_t>(verdicts.size()));
  for (const ViewVerdict& verdict : verdicts) {
    record.put(static_cast<std::int32_t>(verdict.kind));
    record.put(verdict.factor.value_or(std::numeric_limits<double>::quiet_NaN()));
    record.text(verdict.sentence);
  }
  append_to_file(series.file, record.finished());
}

ViewExtent view_extent(std::string_view bytes, int frames) {
  if (!bytes.starts_with(view_magic)) return {};
  ViewExtent extent{view_magic.size(), 0};
  while (extent.frames < frames && bytes.size() - extent.bytes >= 8) {
    std::array<std::uint32_t, 2> head{};
    std::memcpy(head.data(), bytes.data() + extent.bytes, sizeof head);
    const auto [tag, size] = head;
    if (tag < head_tag || tag > verdicts_tag || size < 8 || size % 4 != 0 || size > bytes.size() - extent.bytes) break;
    extent.bytes += size;
    if (tag == frame_tag) ++extent.frames;
  }
  return extent;
}

template ViewSeries begin_view<2>(const std::filesystem::path&, const Prepared<2>&);
template ViewSeries begin_view<3>(const std::filesystem::path&, const Prepared<3>&);
template ViewSeries continue_view<2>(const std::filesystem::path&, const Prepared<2>&, int);
template ViewSeries continue_view<3>(const std::filesystem::path&, const Prepared<3>&, int);
template void add_view_frame<2>(ViewSeries&, const Model<2>&, const State<2>&, const ViewMoment&);
template void add_view_frame<3>(ViewSeries&, const Model<3>&, const State<3>&, const ViewMoment&);

}  // namespace voussoir
