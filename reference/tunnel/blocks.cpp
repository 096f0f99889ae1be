#include "reference/tunnel/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace voussoir::reference::network {
namespace {

[[noreturn]] void refuse(const std::string& message) {
  throw std::invalid_argument("blocks: " + message);
}

Point along(const Point& a, const Point& b, double fraction) {
  return {a[0] + fraction * (b[0] - a[0]), a[1] + fraction * (b[1] - a[1])};
}
double length(const Point& a) {
  return std::hypot(a[0], a[1]);
}
double length(const Face& face) {
  return length(minus(face.end, face.start));
}
Point unit(const Point& a) {
  const double size = length(a);
  return {a[0] / size, a[1] / size};
}

// The two sides of a line: with normal·x below and above its offset. A side thinner than `thinnest` is empty and the
// other whole.
std::pair<Polygon, Polygon> parted(const Polygon& whole, const Line& line, double thinnest) {
  const double size = length(line.normal);
  std::vector<double> height;
  for (const Point& corner : whole)
    height.push_back((dot(line.normal, corner) - line.offset) / size);
  if (*std::ranges::max_element(height) <= thinnest) return {whole, {}};
  if (*std::ranges::min_element(height) >= -thinnest) return {{}, whole};
  std::pair<Polygon, Polygon> sides;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const std::size_t next = (i + 1) % whole.size();
    const double here = height[i], there = height[next];
    if (here <= 0) sides.first.push_back(whole[i]);
    if (here >= 0) sides.second.push_back(whole[i]);
    if ((here < 0 && there > 0) || (here > 0 && there < 0)) {
      const Point meeting = along(whole[i], whole[next], here / (here - there));
      sides.first.push_back(meeting);
      sides.second.push_back(meeting);
    }
  }
  return sides;
}

Line side_of(const Polygon& outline, std::size_t i) {
  const Point edge = minus(outline[(i + 1) % outline.size()], outline[i]);
  const Point outwards{edge[1], -edge[0]};
  return {outwards, dot(outwards, outline[i])};
}

// ---- edges in contact

struct Edge {
  int block = 0;
  Point start, end, direction;  // unit
  double length = 0;
};

std::vector<Edge> edges_of(const std::vector<Block>& blocks) {
  std::vector<Edge> edges;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (const Polygon& part : blocks[b].parts)
      for (std::size_t i = 0; i < part.size(); ++i) {
        const Point &start = part[i], &end = part[(i + 1) % part.size()];
        const double size = length(minus(end, start));
        if (size > 0) edges.push_back({static_cast<int>(b), start, end, unit(minus(end, start)), size});
      }
  return edges;
}

// pairs of edges whose boxes share a cell of a grid, each once
std::vector<std::pair<int, int>> near_pairs(const std::vector<Edge>& edges, double tolerance) {
  double mean = 0;
  for (const Edge& e : edges)
    mean += e.length / static_cast<double>(edges.size());
  std::vector<std::tuple<int, int, int>> places;  // cell x, cell y, edge
  for (std::size_t i = 0; i < edges.size(); ++i) {
    std::array<int, 2> low, high;
    for (int k = 0; k < 2; ++k) {
      low[k] = static_cast<int>(std::floor((std::min(edges[i].start[k], edges[i].end[k]) - tolerance) / mean));
      high[k] = static_cast<int>(std::floor((std::max(edges[i].start[k], edges[i].end[k]) + tolerance) / mean));
    }
    for (int x = low[0]; x <= high[0]; ++x)
      for (int y = low[1]; y <= high[1]; ++y)
        places.emplace_back(x, y, static_cast<int>(i));
  }
  std::ranges::sort(places);
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t k = i + 1; k < places.size() && std::get<0>(places[k]) == std::get<0>(places[i]) &&
                                std::get<1>(places[k]) == std::get<1>(places[i]);
         ++k) {
      const Edge &a = edges[std::get<2>(places[i])], &b = edges[std::get<2>(places[k])];
      if (dot(a.direction, b.direction) < 0) pairs.emplace_back(std::get<2>(places[i]), std::get<2>(places[k]));
    }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

// the part of `a` that `b` covers; empty if start equals end
std::pair<double, double> shared(const Edge& a, const Edge& b, double tolerance) {
  const Point from = minus(b.start, a.start), to = minus(b.end, a.start);
  const double low = std::max(0.0, dot(a.direction, to)), high = std::min(a.length, dot(a.direction, from));
  if (!(high - low > tolerance)) return {0, 0};
  const double slope = cross(a.direction, b.direction) / dot(a.direction, b.direction);
  const auto apart = [&](double at) { return cross(a.direction, from) + slope * (at - dot(a.direction, from)); };
  if (std::abs(apart(low)) > tolerance || std::abs(apart(high)) > tolerance) return {0, 0};
  return {low, high};
}

std::vector<Face> all_faces(const std::vector<Block>& blocks, double tolerance) {
  const std::vector<Edge> edges = edges_of(blocks);
  std::vector<Face> found;
  if (edges.empty()) return found;
  for (const auto& [i, k] : near_pairs(edges, tolerance)) {
    const bool swapped = edges[k].block < edges[i].block;
    const Edge &a = edges[swapped ? k : i], &b = edges[swapped ? i : k];
    if (a.block == b.block) continue;
    const auto [low, high] = shared(a, b, tolerance);
    if (!(high > low)) continue;
    found.push_back({a.block,
                     b.block,
                     along(a.start, a.end, low / a.length),
                     along(a.start, a.end, high / a.length),
                     {a.direction[1], -a.direction[0]}});
  }
  std::ranges::stable_sort(found, {}, [](const Face& f) { return std::pair(f.first, f.second); });
  return found;
}

bool wholly_held(const Block& block) {
  return block.held[0] && block.held[1] && block.held[2];
}

// connected parts, each group a block
void add_connected(const std::vector<Polygon>& parts, double tolerance, std::vector<Block>& blocks) {
  std::vector<Block> single;
  for (const Polygon& part : parts)
    single.push_back({{part}});
  std::vector<int> group(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
    group[i] = static_cast<int>(i);
  for (const Face& face : all_faces(single, tolerance)) {
    const int kept = group[face.first], gone = group[face.second];
    std::ranges::replace(group, gone, kept);
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Block block;
    for (std::size_t k = 0; k < parts.size(); ++k)
      if (group[k] == static_cast<int>(i)) block.parts.push_back(parts[k]);
    if (!block.parts.empty()) blocks.push_back(std::move(block));
  }
}

// ---- loads

Point pull(const InSitu& stress, const Point& at, const Point& normal) {
  const double vertical = stress.unit_weight * (stress.surface - at[1]);
  return {(stress.k0 * vertical + stress.uniform) * normal[0], (vertical + stress.uniform) * normal[1]};
}

}  // namespace

std::vector<Polygon> cut(const Polygon& whole, const std::vector<Line>& lines, double thinnest) {
  std::vector<Polygon> pieces{whole};
  for (const Line& line : lines) {
    std::vector<Polygon> next;
    for (const Polygon& piece : pieces) {
      auto [below, above] = parted(piece, line, thinnest);
      if (!below.empty()) next.push_back(std::move(below));
      if (!above.empty()) next.push_back(std::move(above));
    }
    pieces = std::move(next);
  }
  return pieces;
}

std::vector<Line> persistent_sets(const std::vector<double>& angles, const std::vector<double>& shifts, double spacing,
                                  double reach) {
  if (angles.size() != shifts.size()) refuse("give as many shifts as sets");
  if (!(spacing > 0) || !(reach > 0)) refuse("spacing and reach must be positive, in m");
  std::vector<Line> lines;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const int last = static_cast<int>(std::ceil(reach / spacing)) + 1;
    for (int k = -last; k <= last; ++k)
      if (const double offset = (k + shifts[i]) * spacing; std::abs(offset) < reach)
        lines.push_back({{std::cos(angles[i]), std::sin(angles[i])}, offset});
  }
  return lines;
}

std::vector<Block> take_out(const std::vector<Polygon>& pieces, const Polygon& outline, double thinnest) {
  std::vector<Block> blocks;
  for (const Polygon& piece : pieces) {
    std::vector<Polygon> outside;
    Polygon rest = piece;
    for (std::size_t i = 0; i < outline.size() && !rest.empty(); ++i) {
      auto [below, above] = parted(rest, side_of(outline, i), thinnest);
      if (!above.empty()) outside.push_back(std::move(above));
      rest = std::move(below);
    }
    if (rest.empty())
      blocks.push_back({{piece}});
    else
      add_connected(outside, thinnest, blocks);
  }
  return blocks;
}

std::vector<Face> faces(const std::vector<Block>& blocks, double tolerance) {
  std::vector<Face> found = all_faces(blocks, tolerance);
  std::erase_if(found, [&](const Face& f) { return wholly_held(blocks[f.first]) && wholly_held(blocks[f.second]); });
  return found;
}

std::vector<Spring> springs(const std::vector<Face>& faces, int cells, double normal_stiffness, double shear_stiffness,
                            bool with_spread) {
  if (cells < 1) refuse("a face needs at least one cell");
  std::vector<Spring> laid;
  for (const Face& face : faces) {
    const double cell = length(face) / cells;
    for (int i = 0; i < cells; ++i)
      laid.push_back({face.first, face.second, along(face.start, face.end, (i + 0.5) / cells), face.normal, cell,
                      normal_stiffness, shear_stiffness, with_spread ? cell * cell / 12 : 0});
  }
  return laid;
}

std::vector<Face> wall(const std::vector<Block>& blocks, const Polygon& outline, double tolerance) {
  std::vector<Block> with_opening = blocks;
  with_opening.push_back({{outline}});
  const int opening = static_cast<int>(blocks.size());
  std::vector<std::pair<double, Face>> found;  // with the place along the outline
  for (Face face : all_faces(with_opening, tolerance)) {
    if (face.second != opening) continue;
    double before = 0, place = 0, least = -1;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Point edge = minus(outline[(i + 1) % outline.size()], outline[i]);
      const double facing = -dot(unit({edge[1], -edge[0]}), face.normal);
      const Point from = minus(face.end, outline[i]);
      if (facing > 0.5 && (least < 0 || std::abs(cross(unit(edge), from)) < least)) {
        least = std::abs(cross(unit(edge), from));
        place = before + dot(unit(edge), from);
      }
      before += length(edge);
    }
    face.second = -1;
    found.emplace_back(place, face);
  }
  std::ranges::stable_sort(found, {}, [](const auto& f) { return f.first; });
  std::vector<Face> sorted;
  for (const auto& [place, face] : found)
    sorted.push_back(face);
  return sorted;
}

void relieve(std::vector<Block>& blocks, const std::vector<Face>& wall, const InSitu& stress, double share) {
  // two points of Gauss: the moment of a stress linear along the face is of second degree
  const double from_middle = 0.5 / std::numbers::sqrt3;
  for (const Face& face : wall)
    for (const double fraction : {0.5 - from_middle, 0.5 + from_middle}) {
      const Point at = along(face.start, face.end, fraction);
      const Point traction = pull(stress, at, face.normal);
      const double part = share * length(face) / 2;
      add_force(blocks[face.first], at, {part * traction[0], part * traction[1]});
    }
}

std::vector<Bolt> bolts_across(const std::vector<Face>& faces, const Point& collar, const Point& toe, double stiffness,
                               double offset, double across, double pretension) {
  const Point way = minus(toe, collar);
  const double whole = length(way);
  if (!(whole > 0)) refuse("a bolt needs a length");
  const Point axis = unit(way);
  std::vector<std::pair<double, const Face*>> crossings;
  for (const Face& face : faces) {
    const double start = cross(axis, minus(face.start, collar)), end = cross(axis, minus(face.end, collar));
    if ((start < 0) == (end < 0)) continue;
    const double place = dot(axis, minus(along(face.start, face.end, start / (start - end)), collar));
    if (place > 0 && place < whole) crossings.emplace_back(place, &face);
  }
  std::ranges::sort(crossings, {}, [](const auto& c) { return c.first; });
  std::vector<Bolt> bolts;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    const auto& [place, face] = crossings[i];
    const double before = (place - (i == 0 ? 0 : crossings[i - 1].first)) / 2;
    const double after = ((i + 1 == crossings.size() ? whole : crossings[i + 1].first) - place) / 2;
    const double back = std::min(offset, before), ahead = std::min(offset, after);
    const bool forwards = dot(face->normal, axis) > 0;
    bolts.push_back({forwards ? face->first : face->second, forwards ? face->second : face->first,
                     along(collar, toe, (place - back) / whole), along(collar, toe, (place + ahead) / whole), axis,
                     stiffness, across, pretension});
  }
  return bolts;
}

void tie_to_wall(Lining& lining, const std::vector<Face>& wall, double normal_stiffness, double shear_stiffness,
                 double tolerance) {
  const int count = static_cast<int>(lining.nodes.size());
  const auto face_at = [&](int node, bool ahead) -> const Face* {
    for (const Face& face : wall) {
      const Point from = minus(lining.nodes[node].at, face.end);  // counter-clockwise about the opening from its end
      const Point direction = unit(minus(face.start, face.end));
      const double place = dot(direction, from);
      if (std::abs(cross(direction, from)) > tolerance) continue;
      if (ahead ? place > -tolerance && place < length(face) - tolerance
                : place > tolerance && place < length(face) + tolerance)
        return &face;
    }
    refuse("node " + std::to_string(node) + " of the lining is not on the wall");
  };
  const auto tie = [&](int node, const Face& face, double share) {
    lining.ties.push_back({node, face.first, face.normal, share, normal_stiffness, shear_stiffness});
  };
  constexpr double same_direction = 1 - 1e-12;
  for (int i = 0; i < count; ++i) {
    double halves[2] = {0, 0};
    for (int side = 0; side < 2; ++side) {
      const int other = side == 0 ? i - 1 : i + 1;
      if (!lining.closed && (other < 0 || other >= count)) continue;
      halves[side] = length(minus(lining.nodes[(other + count) % count].at, lining.nodes[i].at)) / 2;
    }
    const Face* behind = halves[0] > 0 ? face_at(i, false) : nullptr;
    const Face* ahead = halves[1] > 0 ? face_at(i, true) : nullptr;
    if (behind && ahead && behind->first == ahead->first && dot(behind->normal, ahead->normal) > same_direction) {
      tie(i, *ahead, halves[0] + halves[1]);
      continue;
    }
    if (behind) tie(i, *behind, halves[0]);
    if (ahead) tie(i, *ahead, halves[1]);
  }
}

double convergence_at(const Network& network, const Solution& solution, const std::vector<Face>& wall,
                      const Point& centre, double angle) {
  const Point ray{std::cos(angle), std::sin(angle)};
  // the wall's point that is nearest to the ray: no gap of rounding between two faces lets it through
  double least = std::numeric_limits<double>::infinity(), convergence = 0;
  for (const Face& face : wall) {
    const double start = cross(ray, minus(face.start, centre)), end = cross(ray, minus(face.end, centre));
    const Point at = along(face.start, face.end, start == end ? 0 : std::clamp(start / (start - end), 0.0, 1.0));
    const double away = std::abs(cross(ray, minus(at, centre)));
    if (dot(ray, minus(at, centre)) < 0 || !(away < least)) continue;
    least = away;
    convergence = -dot(ray, displacement(network, solution, face.first, at));
  }
  if (std::isinf(least)) refuse("there is no wall in the direction of " + std::to_string(angle) + " rad");
  return convergence;
}

double mean_convergence(const Network& network, const Solution& solution, const std::vector<Face>& wall,
                        const Point& centre) {
  double sum = 0, whole = 0;
  for (const Face& face : wall) {
    // a rigid block's radial displacement, by its middle: the wall's curvature over a face is of second order
    const Point middle = along(face.start, face.end, 0.5);
    sum -= length(face) * dot(unit(minus(middle, centre)), displacement(network, solution, face.first, middle));
    whole += length(face);
  }
  if (!(whole > 0)) refuse("the wall has no length");
  return sum / whole;
}

}  // namespace voussoir::reference::network
