// The exact referee's planes, sections and solids.
#include "core/testing/exact_referee.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace voussoir::exact {

Rational dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Point point_of(const Vector<3>& v) {
  return {Rational(v[0]), Rational(v[1]), Rational(v[2])};
}

Point point_of(const Vector<2>& v) {
  return {Rational(v[0]), Rational(v[1]), Rational(0)};
}

namespace {

QuadVector cross(const QuadVector& a, const QuadVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// ---- a convex polygon from lines, exactly ---------------------------------------------------------------------------

// α u + β v <= γ in a plane, with rounded copies that decide most questions
struct Line {
  Rational alpha, beta, gamma;
  double a = 0, b = 0, c = 0;

  Line(Rational alpha_, Rational beta_, Rational gamma_)
      : alpha(std::move(alpha_)), beta(std::move(beta_)), gamma(std::move(gamma_)) {
    a = alpha.get_d();
    b = beta.get_d();
    c = gamma.get_d();
  }
};

// where two lines meet: (u, v)/w, w > 0
struct Corner {
  int first, second;  // the lines before and after it, counter-clockwise
  Rational u, v, w;
  double x = 0, y = 0;
};

Corner meet(const std::vector<Line>& lines, int first, int second) {
  const Line &p = lines[first], &q = lines[second];
  Corner c{first, second, p.gamma * q.beta - q.gamma * p.beta, p.alpha * q.gamma - q.alpha * p.gamma,
           p.alpha * q.beta - q.alpha * p.beta};
  if (sgn(c.w) == 0) throw std::logic_error("parallel lines do not meet");
  if (sgn(c.w) < 0) {
    c.u = -c.u;
    c.v = -c.v;
    c.w = -c.w;
  }
  c.x = Rational(c.u / c.w).get_d();
  c.y = Rational(c.v / c.w).get_d();
  return c;
}

// a sum of a few terms whose value exceeds this fraction of the terms has the right sign in double: some 64 roundings
constexpr double decided = 1e-14;

// sign of the corner's distance beyond the line; in double if that decides, else exactly
int side(const Line& line, const Corner& corner) {
  const double au = line.a * corner.x, bv = line.b * corner.y, value = au + bv - line.c;
  if (std::abs(value) > decided * (std::abs(au) + std::abs(bv) + std::abs(line.c))) return value > 0 ? 1 : -1;
  return sgn(Rational(line.alpha * corner.u + line.beta * corner.v - line.gamma * corner.w));
}

using Polygon = std::vector<Corner>;

// cuts off the part beyond the line; the polygon keeps its corners in order
void clip(Polygon& polygon, const std::vector<Line>& lines, int number) {
  const std::size_t n = polygon.size();
  std::vector<int> sides(n);
  bool any_out = false, any_in = false;
  for (std::size_t k = 0; k < n; ++k) {
    sides[k] = side(lines[number], polygon[k]);
    any_out = any_out || sides[k] > 0;
    any_in = any_in || sides[k] < 0;
  }
  if (!any_out) return;
  if (!any_in) {
    polygon.clear();  // a touching point or edge has no area
    return;
  }
  Polygon clipped;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    const int edge = polygon[k].second;  // the line from this corner to the next
    if (sides[k] < 0) clipped.push_back(polygon[k]);
    if (sides[k] == 0) {
      // the cut passes through the corner, which is now between the cut and the edge that remains
      Corner c = polygon[k];
      const bool stays_behind = sides[(k + n - 1) % n] < 0, stays_ahead = sides[next] < 0;
      if (!stays_behind && stays_ahead) c.first = number;
      if (stays_behind && !stays_ahead) c.second = number;
      if (stays_behind || stays_ahead) clipped.push_back(std::move(c));
    }
    if (sides[k] < 0 && sides[next] > 0) clipped.push_back(meet(lines, edge, number));
    if (sides[k] > 0 && sides[next] < 0) clipped.push_back(meet(lines, number, edge));
  }
  polygon = std::move(clipped);
}

// ---- the section of a solid by a plane ------------------------------------------------------------------------------

// a plane's numbers in double
struct Rounded {
  std::array<double, 3> n;
  double d;
  explicit Rounded(const Plane& p)
      : n{p.normal[0].get_d(), p.normal[1].get_d(), p.normal[2].get_d()}, d(p.offset.get_d()) {}
};

std::vector<Rounded> rounded_planes(const Planes& planes) {
  return {planes.begin(), planes.end()};
}

// the plane's points by two of their coordinates: x[k] = (offset - n[i] x[i] - n[j] x[j]) / n[k]
struct Chart {
  Plane plane;
  Rounded rounded;
  int i, j, k;

  explicit Chart(const Plane& p) : plane(p), rounded(p), k(0) {
    for (int axis = 1; axis < 3; ++axis)
      if (abs(p.normal[axis]) > abs(p.normal[k])) k = axis;
    i = (k + 1) % 3;
    j = (k + 2) % 3;
  }

  Line line(const Plane& p) const {
    const Point &n = plane.normal, &a = p.normal;
    const int sign = sgn(n[k]);
    return {sign * (a[i] * n[k] - a[k] * n[i]), sign * (a[j] * n[k] - a[k] * n[j]),
            sign * (p.offset * n[k] - a[k] * plane.offset)};
  }

  // true when doubles suffice to show that no corner is beyond the plane: most planes of a large solid
  bool surely_inside(const Rounded& p, const Polygon& polygon) const {
    const double sign = rounded.n[k] > 0 ? 1 : -1;
    const Minor alpha = minor(p.n[i], rounded.n[k], p.n[k], rounded.n[i]);
    const Minor beta = minor(p.n[j], rounded.n[k], p.n[k], rounded.n[j]);
    const Minor gamma = minor(p.d, rounded.n[k], p.n[k], rounded.d);
    return std::all_of(polygon.begin(), polygon.end(), [&](const Corner& c) {
      const double terms = alpha.terms * std::abs(c.x) + beta.terms * std::abs(c.y) + gamma.terms;
      return sign * (alpha.value * c.x + beta.value * c.y - gamma.value) < -decided * terms;
    });
  }

  // a b - c d, and the size of its terms
  struct Minor {
    double value = 0, terms = 0;
  };
  static Minor minor(double a, double b, double c, double d) {
    return {a * b - c * d, std::abs(a * b) + std::abs(c * d)};
  }

  Point lift(const Corner& c) const {
    Point x;
    x[i] = c.u / c.w;
    x[j] = c.v / c.w;
    x[k] = (plane.offset - plane.normal[i] * x[i] - plane.normal[j] * x[j]) / plane.normal[k];
    return x;
  }
};

// far beyond any coordinate of a solid whose numbers are doubles of ordinary size; exact arithmetic is not affected
const Rational beyond_everything = Rational(1e60);

// The section's corners, counter-clockwise in (x_i, x_j). `own` is the place of the plane itself among the solid's, or
// -1: of coincident planes only the first has a facet.
// Corners name their lines.
Polygon clipped_section(const Chart& chart, const Planes& planes, const std::vector<Rounded>& rounded, int own,
                        std::vector<Line>& lines) {
  lines = {
      {1, 0, beyond_everything}, {0, 1, beyond_everything}, {-1, 0, beyond_everything}, {0, -1, beyond_everything}};
  Polygon polygon{meet(lines, 0, 1), meet(lines, 1, 2), meet(lines, 2, 3), meet(lines, 3, 0)};
  for (int p = 0; p < static_cast<int>(planes.size()) && !polygon.empty(); ++p) {
    if (p == own || chart.surely_inside(rounded[p], polygon)) continue;
    Line line = chart.line(planes[p]);
    if (sgn(line.alpha) == 0 && sgn(line.beta) == 0) {
      const bool coincident = sgn(line.gamma) == 0 && dot(planes[p].normal, chart.plane.normal) > 0;
      if (sgn(line.gamma) < 0 || (own >= 0 && coincident && p < own)) return {};
      continue;
    }
    lines.push_back(std::move(line));
    clip(polygon, lines, static_cast<int>(lines.size()) - 1);
  }
  for (const Corner& c : polygon)
    if (c.first < 4 || c.second < 4) throw std::logic_error("the solid is not closed");
  return polygon;
}

}  // namespace

Planes planes_of(const HalfSpaces<3>& planes) {
  Planes result;
  for (const HalfSpace<3>& p : planes)
    result.push_back({point_of(p.normal), Rational(p.offset)});
  return result;
}

Planes planes_of(const Pair<3>& pair) {
  return planes_of(pair, point_of(pair.offset));
}

Planes planes_of(const Pair<3>& pair, const Point& offset) {
  Planes result = planes_of(pair.a->faces);
  for (const HalfSpace<3>& f : pair.b->faces) {
    const Point own = point_of(f.normal);
    Plane p;
    for (int row = 0; row < 3; ++row)
      p.normal[row] = dot(point_of(Vector<3>(pair.rotation.row(row))), own);
    p.offset = Rational(f.offset) + dot(p.normal, offset);
    result.push_back(std::move(p));
  }
  return result;
}

double lid_height(const Pair<2>& pair) {
  return 4 * (pair.a->radius + pair.b->radius);
}

Planes planes_of(const Pair<2>& pair) {
  Planes result;
  for (const HalfSpace<2>& f : pair.a->faces)
    result.push_back({point_of(f.normal), Rational(f.offset)});
  for (const HalfSpace<2>& f : pair.b->faces) {
    Plane p{{0, 0, 0}, Rational(f.offset)};
    for (int row = 0; row < 2; ++row)
      for (int k = 0; k < 2; ++k)
        p.normal[row] += Rational(pair.rotation(row, k)) * Rational(f.normal[k]);
    p.offset += dot(p.normal, point_of(pair.offset));
    result.push_back(std::move(p));
  }
  const Rational height = lid_height(pair);
  result.push_back({{0, 0, 1}, height});
  result.push_back({{0, 0, -1}, height});
  return result;
}

Rational least_slack(const Planes& planes, const Point& point) {
  Rational least = planes.front().offset - dot(planes.front().normal, point);
  for (const Plane& p : planes)
    least = std::min(least, Rational(p.offset - dot(p.normal, point)));
  return least;
}

Planes grown(Planes planes, double distance) {
  for (Plane& p : planes)
    p.offset += Rational(distance);
  return planes;
}

Section section(const Planes& planes, const Point& point, const Point& n) {
  const Chart chart({n, dot(n, point)});
  std::vector<Line> lines;
  const Polygon polygon = clipped_section(chart, planes, rounded_planes(planes), -1, lines);
  if (polygon.size() < 3) return {};
  std::vector<std::array<Quad, 2>> corner;
  for (const Corner& c : polygon)
    corner.push_back(
        {to_quad(c.u / c.w - polygon[0].u / polygon[0].w), to_quad(c.v / c.w - polygon[0].v / polygon[0].w)});
  Quad twice = 0;
  for (std::size_t k = 1; k + 1 < corner.size(); ++k)
    twice += corner[k][0] * corner[k + 1][1] - corner[k][1] * corner[k + 1][0];
  const Quad length = root(to_quad(dot(n, n)));
  Section result{(twice < 0 ? -twice : twice) / 2 * length / to_quad(abs(n[chart.k])), 0};
  // in the chart an edge moves by |n_k|/|(α, β)| when its plane moves by 1, and areas are stretched by |n|/|n_k|
  for (std::size_t k = 0; k < corner.size(); ++k) {
    const Line& line = lines[polygon[k].second];
    const auto &here = corner[k], &next = corner[(k + 1) % corner.size()];
    const Quad u = next[0] - here[0], v = next[1] - here[1];
    const Quad slope = to_quad(line.alpha * line.alpha + line.beta * line.beta);
    result.sensitivity += root((u * u + v * v) / slope) * length;
  }
  return result;
}

IntegratedContact pressed_face(const Planes& planes, int face_a, int face_b) {
  const Plane &a = planes[face_a], &b = planes[face_b];
  Plane mean{{}, a.offset - b.offset}, open{{}, a.offset + b.offset};
  for (int k = 0; k < 3; ++k) {
    mean.normal[k] = a.normal[k] - b.normal[k];
    open.normal[k] = a.normal[k] + b.normal[k];
  }
  // on the mean plane the two faces end at u = 0; parallel ones nowhere
  Planes sides;
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (static_cast<int>(i) != face_a && static_cast<int>(i) != face_b) sides.push_back(planes[i]);
  sides.push_back(open);
  const Chart chart(mean);
  std::vector<Line> lines;
  const Polygon polygon = clipped_section(chart, sides, rounded_planes(sides), -1, lines);
  if (polygon.size() < 3) return {};

  const Quad length = root(to_quad(dot(mean.normal, mean.normal)));
  std::vector<QuadVector> corner;  // from the first
  std::vector<Quad> overlap;
  const Point first = chart.lift(polygon[0]);
  const Line pressed_edge = chart.line(open);
  IntegratedContact face;
  for (const Corner& c : polygon) {
    const Point x = chart.lift(c);
    overlap.push_back(to_quad(open.offset - dot(open.normal, x)) / (length / 2));
    corner.push_back({to_quad(x[0] - first[0]), to_quad(x[1] - first[1]), to_quad(x[2] - first[2])});
    face.extent = std::max(face.extent, root(dot(corner.back(), corner.back())));
    // a line of the chart has two components of the cross product of both planes' normals
    const Line& line = lines[c.second];
    if (line.alpha == pressed_edge.alpha && line.beta == pressed_edge.beta) continue;
    const Point& n = mean.normal;
    const Rational third = (n[chart.i] * line.beta - n[chart.j] * line.alpha) / n[chart.k];
    const Quad sine = root(to_quad(line.alpha * line.alpha + line.beta * line.beta + third * third)) / length;
    face.least_sine = std::min(face.least_sine, sine);
  }
  QuadVector moment{}, pressed{};
  Quad second = 0;  // ∫ |y|² from the first corner
  for (std::size_t k = 1; k + 1 < corner.size(); ++k) {
    const QuadVector &v = corner[k], &w = corner[k + 1], normal = cross(v, w);
    const Quad area = root(dot(normal, normal)) / 2, p = overlap[0], q = overlap[k], r = overlap[k + 1];
    face.area += area;
    face.volume += area / 3 * (p + q + r);
    face.square += area / 6 * (p * p + q * q + r * r + p * q + q * r + r * p);
    second += area / 6 * (dot(v, v) + dot(w, w) + dot(v, w));
    for (int i = 0; i < 3; ++i) {
      moment[i] += area / 3 * (v[i] + w[i]);
      pressed[i] += area / 12 * ((p + 2 * q + r) * v[i] + (p + q + 2 * r) * w[i]);
    }
  }
  if (!(face.area > 0) || !(face.volume > 0)) return {};
  face.polar = second - dot(moment, moment) / face.area;
  for (int i = 0; i < 3; ++i) {
    face.centre[i] = to_quad(first[i]) + moment[i] / face.area;
    face.pressure[i] = to_quad(first[i]) + pressed[i] / face.volume;
  }
  return face;
}

Quad section_area(const Planes& planes, const Vector<3>& point, const Vector<3>& normal) {
  return section(planes, point_of(point), point_of(normal)).area;
}

Solid solid(const Planes& planes) {
  Solid result;
  std::vector<std::vector<Point>> facets;
  Point middle{0, 0, 0};
  const std::vector<Rounded> rounded = rounded_planes(planes);
  for (int f = 0; f < static_cast<int>(planes.size()); ++f) {
    const Chart chart(planes[f]);
    std::vector<Line> lines;
    const Polygon polygon = clipped_section(chart, planes, rounded, f, lines);
    if (polygon.size() < 3) continue;
    facets.emplace_back();
    for (const Corner& c : polygon)
      facets.back().push_back(chart.lift(c));
    // counter-clockwise in the chart is so from outside when the normal's k is positive: (i, j, k) is cyclic
    if (sgn(planes[f].normal[chart.k]) < 0) std::reverse(facets.back().begin(), facets.back().end());
    result.edges += static_cast<int>(polygon.size());
  }
  result.facets = static_cast<int>(facets.size());
  result.vertices = result.edges;
  result.edges /= 2;
  if (facets.empty()) return result;

  // any point near the solid is good: the sums run in coordinates relative to it
  for (int k = 0; k < 3; ++k)
    middle[k] = Rational(facets[0][0][k].get_d());
  std::array<QuadVector, 3> about_middle{};
  QuadVector first{};
  for (const std::vector<Point>& facet : facets) {
    std::vector<QuadVector> v;
    for (const Point& p : facet) {
      v.push_back({to_quad(p[0] - middle[0]), to_quad(p[1] - middle[1]), to_quad(p[2] - middle[2])});
      result.corners.push_back({p[0].get_d(), p[1].get_d(), p[2].get_d()});
    }
    for (std::size_t t = 1; t + 1 < v.size(); ++t) {
      const Quad volume = dot(v[0], cross(v[t], v[t + 1])) / 6;
      const QuadVector sum{v[0][0] + v[t][0] + v[t + 1][0], v[0][1] + v[t][1] + v[t + 1][1],
                           v[0][2] + v[t][2] + v[t + 1][2]};
      result.volume += volume;
      for (int i = 0; i < 3; ++i) {
        first[i] += volume * sum[i] / 4;
        for (int j = 0; j < 3; ++j)
          about_middle[i][j] +=
              volume / 20 * (sum[i] * sum[j] + v[0][i] * v[0][j] + v[t][i] * v[t][j] + v[t + 1][i] * v[t + 1][j]);
      }
    }
  }
  if (!(result.volume > 0)) return result;
  for (int i = 0; i < 3; ++i) {
    result.centroid[i] = to_quad(middle[i]) + first[i] / result.volume;
    for (int j = 0; j < 3; ++j)
      result.second_moment[i][j] = about_middle[i][j] - first[i] * first[j] / result.volume;
  }
  return result;
}

}  // namespace voussoir::exact
