#include "cases/tunnel/openings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <optional>

#include "cases/case_tools.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {
namespace {

using reference::BlockMotion;
using reference::JointSet;
using reference::JointStretch;
using reference::Kind;
using reference::Mechanism;
using reference::Place;

constexpr double inscribed_radius = 5;  // m, of the opening, as the scene states it

// the rock just before the excavation, and during its motion
struct Dug {
  std::optional<Model<2>> before_model, after_model;
  std::optional<State<2>> before, after;
};

Dug simulated(const LoadedScene& scene, Results& results) {
  Dug dug;
  Watcher<2> watcher;
  watcher.frame = [&](const Model<2>& model, const State<2>& state, double) {
    const bool whole = std::ranges::all_of(model.bodies, [](const Body<2>& body) { return body.present; });
    (whole ? dug.before_model : dug.after_model) = model;
    (whole ? dug.before : dug.after) = state;
  };
  const auto& prepared = std::get<Prepared<2>>(scene.prepared);
  Progress<2> progress = initial_progress(prepared);
  simulate(prepared, progress, watcher);
  results = std::move(progress.results);
  if (results.outcome != Outcome::done) throw std::runtime_error(results.message);
  return dug;
}

std::vector<BlockMotion> motions(const Dug& dug) {
  std::vector<BlockMotion> blocks;
  const Model<2>& model = *dug.after_model;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<2>& body = model.bodies[b];
    const Vector<2> at = model.origin + body.reference;
    BlockMotion block{at[0], at[1], volume(body)};
    if (body.present && !body.fixed) {
      const Motion<2>& now = dug.after->bodies.motions[b];
      // a piece that the opening cut from its block has settled with it by some millimetres, which are not counted
      const Motion<2> then = b < dug.before->bodies.motions.size() ? dug.before->bodies.motions[b] : Motion<2>{};
      block.dx = now.displacement[0] - then.displacement[0];
      block.dy = now.displacement[1] - then.displacement[1];
      block.turn = now.rotation.angle - then.rotation.angle;
    }
    if (!body.present) block.area = 0;
    blocks.push_back(block);
  }
  return blocks;
}

int set_of(const std::string& joint) {
  return joint.size() > 2 && joint[1] == '-' && joint[0] >= 'A' && joint[0] <= 'C' ? joint[0] - 'A' : -1;
}

// the joints in contact before the excavation, except those inside the opening
std::vector<JointStretch> stretches(const Dug& dug) {
  const Model<2>& model = *dug.before_model;
  std::vector<JointStretch> joints;
  for (const Contact<2>& c : dug.before->contacts.list) {
    if (!c.touching()) continue;
    const int a = model.parts[c.part_a].body, b = model.parts[c.part_b].body;
    const Vector<2> at =
        model.origin + model.bodies[a].reference + dug.before->bodies.motions[a].displacement + c.geometry.point;
    if (at.norm() < inscribed_radius) continue;
    if (!dug.after_model->bodies[a].present || !dug.after_model->bodies[b].present) continue;
    joints.push_back({a, b, c.geometry.normal[0], c.geometry.normal[1], c.geometry.area,
                      c.joint < 0 ? -1 : set_of(model.joints[c.joint].name)});
  }
  return joints;
}

// the part of a polygon within the picture, m from the centre: gnuplot fills polygons that leave it badly
std::vector<Vector<2>> in_picture(std::vector<Vector<2>> ring) {
  const HalfSpaces<2> sides{{{1, 0}, 14}, {{-1, 0}, 14}, {{0, 1}, 15}, {{0, -1}, 11}};
  for (const HalfSpace<2>& side : sides) {
    std::vector<Vector<2>> kept;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vector<2>&a = ring[k], &b = ring[(k + 1) % ring.size()];
      const double from = signed_distance<2>(side, a), to = signed_distance<2>(side, b);
      if (from <= 0) kept.push_back(a);
      if ((from < 0) != (to < 0) && from != to) kept.push_back(a + from / (from - to) * (b - a));
    }
    ring = std::move(kept);
  }
  return ring;
}

void draw(const Dug& dug, const std::vector<BlockMotion>& blocks, const std::string& file) {
  const reference::MechanismRule rule;  // lost by the criterion
  const Model<2>& model = *dug.after_model;
  std::array<std::ofstream, 2> out;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const char* names[] = {"left", "lost"};
    out[k].open(verification::case_output("tunnel") / fmt::format("{}_{}.csv", file, names[k]));
    out[k] << "x_m,y_m\n";
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<2>& body = model.bodies[b];
    if (!body.present) continue;
    std::ofstream& csv = out[std::hypot(blocks[b].dx, blocks[b].dy) > rule.moved];
    for (const Polytope<2>& part : body.parts) {
      std::vector<Vector<2>> ring;
      for (const int corner : boundary_ring(part))
        ring.push_back(model.origin + body.reference + dug.after->bodies.motions[b].displacement +
                       matrix(dug.after->bodies.motions[b].rotation) * part.vertices[corner]);
      ring = in_picture(std::move(ring));
      if (ring.empty()) continue;
      for (std::size_t k = 0; k <= ring.size(); ++k)
        csv << fmt::format("{:.4f},{:.4f}\n", ring[k % ring.size()][0], ring[k % ring.size()][1]);
      csv << '\n';
    }
  }
  for (std::ofstream& csv : out)
    if (!csv) throw std::runtime_error("cannot write " + file);
}

// places of the sets, the steepest first
std::array<int, 3> by_dip(const Opening& opening) {
  std::array<int, 3> order{0, 1, 2};
  std::ranges::stable_sort(order, [&](int a, int b) { return opening.sets[a].dip > opening.sets[b].dip; });
  return order;
}

// the two sets with the largest acute angle between them
std::array<int, 2> widest_pair(const Opening& opening) {
  const auto angle = [&](int s) { return opening.sets[s].to_right ? -opening.sets[s].dip : opening.sets[s].dip; };
  std::array<int, 2> widest{0, 1};
  double most = -1;
  for (const auto& [a, b] : {std::array{0, 1}, std::array{0, 2}, std::array{1, 2}}) {
    const double apart = std::abs(angle(a) - angle(b)), acute = std::min(apart, std::numbers::pi - apart);
    if (acute > most) {
      most = acute;
      widest = {a, b};
    }
  }
  return widest;
}

std::vector<JointSet> sets_of(const OpeningRow& row) {
  std::vector<JointSet> sets;
  for (const int dip : row.dips)
    sets.push_back({std::abs(dip) * degree, dip > 0});
  return sets;
}

std::string name_of(const JointSet& set) {
  return fmt::format("{:.0f}{}", set.dip / degree, set.to_right ? 'E' : 'W');
}

bool is_wedge_of(const Mechanism& m, const std::array<int, 2>& sets) {
  return m.kind == Kind::wedge && std::minmax(m.first_set, m.second_set) == std::minmax(sets[0], sets[1]);
}

bool is_slide_of(const Mechanism& m, int set) {
  return m.kind == Kind::slide && m.first_set == set;
}

}  // namespace

const std::vector<OpeningRow>& opening_rows() {
  static const std::vector<OpeningRow> rows{
      {1, {60, 40, -80}, 35, 'W', '-'},   {2, {10, -30, -50}, 35, 'W', 't'},  {3, {80, 5, -65}, 35, 'W', 'w'},
      {4, {-20, -60, -80}, 35, 'W', 'r'}, {5, {40, 20, -50}, 35, 'S', 's'},   {6, {5, 25, -45}, 35, 'T', '-'},
      {7, {60, 80, -40}, 35, 'm', 's'},   {8, {75, 55, -65}, 35, 'W', 'b'},   {9, {60, 85, -80}, 25, 'm', '-'},
      {10, {5, 55, -15}, 30, 'S', 't'},   {11, {85, 75, -65}, 25, 'W', '-'},  {12, {85, 75, -65}, 35, 'm', '-'},
      {13, {85, 75, -55}, 30, 'W', 'b'},  {14, {85, 75, -55}, 35, 'm', 's'},  {15, {85, 75, -45}, 30, 'm', 's'},
      {16, {85, 75, -45}, 35, 'm', 's'},  {17, {85, 75, -35}, 35, 'm', 's'},  {18, {75, -25, -75}, 35, 'm', 's'},
      {19, {75, -25, -55}, 35, 'W', 'b'}, {20, {75, -25, -45}, 35, 'S', 's'}, {21, {75, 25, -25}, 35, 'S', 's'},
      {22, {75, 45, -25}, 35, 'S', '2'},  {23, {75, 85, -25}, 35, 'm', 's'},  {24, {85, 70, 45}, 25, 'W', '-'}};
  return rows;
}

double Opening::lost_area() const {
  return std::accumulate(found.begin(), found.end(), 0.0, [](double sum, const Mechanism& m) { return sum + m.area; });
}

LoadedScene opening_scene(const OpeningRow& row, int seed, double seconds, const std::vector<std::string>& more) {
  std::vector<std::string> settings{fmt::format("joint_properties.rock.friction_deg={}", row.friction),
                                    fmt::format("stage.dig.duration_s={}", seconds)};
  for (int s = 0; s < 3; ++s) {
    const std::string set = fmt::format("joint_sets.{}.", static_cast<char>('A' + s));
    settings.push_back(fmt::format("{}dip={}", set, std::abs(row.dips[s])));
    settings.push_back(fmt::format("{}dip_direction={}", set, row.dips[s] > 0 ? 90 : 270));
    settings.push_back(fmt::format("{}seed={}", set, seed));
  }
  settings.insert(settings.end(), more.begin(), more.end());
  return load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / "unsupported.toml", settings);
}

Opening dig(const OpeningRow& row, const LoadedScene& scene, const std::string& file) {
  Opening opening{row, sets_of(row), {}};
  Results results;
  const Dug dug = simulated(scene, results);
  const std::vector<BlockMotion> blocks = motions(dug);
  opening.found = reference::mechanisms(blocks, stretches(dug), opening.sets);
  for (const BlockMotion& block : blocks) {
    const double way = std::hypot(block.dx, block.dy);
    opening.farthest = std::max(opening.farthest, way);
    if (way > reference::MechanismRule{}.moved && block.y > 0) opening.above_springline += block.area;
  }
  opening.evaluations = results.counters.contact_evaluations;
  opening.seconds = results.seconds;
  if (!file.empty()) draw(dug, blocks, file);
  return opening;
}

Opening dig(const OpeningRow& row, int seed, double seconds, const std::string& file,
            const std::vector<std::string>& more) {
  return dig(row, opening_scene(row, seed, seconds, more), file);
}

std::string words(const Opening& opening, Place place) {
  const Mechanism& m = opening.at(place);
  const auto name = [&](int s) { return name_of(opening.sets[s]); };
  switch (m.kind) {
    case Kind::none:
      return "-";
    case Kind::fall:
      return "fall";
    case Kind::topple:
      return "topple";
    case Kind::slide:
      return "slide " + name(m.first_set);
    case Kind::wedge:
      return "wedge " + name(m.first_set) + "/" + name(m.second_set);
  }
  return {};
}

std::string published(const OpeningRow& row) {
  const Opening opening{row, sets_of(row), {}};
  const std::array<int, 3> steep = by_dip(opening);
  const std::array<int, 2> widest = widest_pair(opening);
  const auto name = [&](int s) { return name_of(opening.sets[s]); };
  const auto first = [&]() -> std::string {
    switch (row.first) {
      case 'W':
        return "wedge " + name(widest[0]) + "/" + name(widest[1]);
      case 'S':
        return "slide " + name(steep[0]);
      case 'T':
        return "slide " + name(steep[1]);
      default:
        return "minor fall";
    }
  };
  const auto second = [&]() -> std::string {
    switch (row.second) {
      case 's':
        return "slide " + name(steep[2]);
      case '2':
        return "slide " + name(steep[1]);
      case 'r':
        return "roof, slide " + name(steep[0]);
      case 'w':
        return "other wedge";
      case 't':
        return "topple";
      case 'b':
        return "both sides";
      default:
        return "-";
    }
  };
  return first() + "; " + second();
}

Agreement agreement(const Opening& opening) {
  return agreement(opening, opening.row.first, opening.row.second);
}

Agreement agreement(const Opening& opening, char first, char second) {
  const Mechanism &roof = opening.at(Place::roof), &left = opening.at(Place::left_wall),
                  &right = opening.at(Place::right_wall);
  const std::array<int, 3> steep = by_dip(opening);
  const std::array<int, 2> widest = widest_pair(opening);
  Agreement found;
  switch (first) {
    case 'W':
      found.roof_kind = is_wedge_of(roof, widest);
      break;
    case 'S':
      found.roof_kind = is_slide_of(roof, steep[0]);
      break;
    case 'T':
      found.roof_kind = is_slide_of(roof, steep[1]);
      break;
    default:
      found.roof_kind = roof.kind == Kind::fall;
  }
  const auto fails = [&](const Mechanism& m) { return m.area >= minor_area; };
  const bool wall = fails(left) || fails(right);
  const auto either = [&](const auto& is) { return (fails(left) && is(left)) || (fails(right) && is(right)); };
  switch (second) {
    case '-':
      found.second_place = found.second_kind = !wall;
      break;
    case 'r':
      found.second_place = found.second_kind = !wall && roof.kind != Kind::none;
      break;
    case 'b':
      found.second_place = found.second_kind = fails(left) && fails(right);
      break;
    default:
      found.second_place = wall;
      found.second_kind = either([&](const Mechanism& m) {
        switch (second) {
          case 's':
            return is_slide_of(m, steep[2]);
          case '2':
            return is_slide_of(m, steep[1]);
          case 't':
            return m.kind == Kind::topple;
          default:
            return m.kind == Kind::wedge && !is_wedge_of(m, widest);
        }
      });
  }
  return found;
}

}  // namespace voussoir::cases
