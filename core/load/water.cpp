#include "core/load/water.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

// a corner of the piece being cut, seen from the body's centroid, and its depth
template <int Dim>
struct Corner {
  Vector<Dim> place;
  double depth;
};

template <int Dim>
double depth_at(const WaterStretch<Dim>& stretch, const Vector<Dim>& centroid, const Vector<Dim>& place) {
  return stretch.rise.dot(Vector<Dim>(stretch.point - centroid) - place);
}

// the point at which the edge from one corner to another crosses zero of a height over a cut: the same point from
// either side
template <int Dim>
Corner<Dim> crossing(const Corner<Dim>& a, double height_a, const Corner<Dim>& b, double height_b) {
  if (height_a > height_b) return crossing(b, height_b, a, height_a);
  const double fraction = height_a / (height_a - height_b);
  return {a.place + fraction * (b.place - a.place), a.depth + fraction * (b.depth - a.depth)};
}

// The part of a polygon on which a height is positive (Sutherland & Hodgman 1974). Each corner's height is evaluated
// once.
template <class Height>
void clip(std::vector<Corner<3>>& polygon, std::vector<Corner<3>>& cut, const Height& height) {
  cut.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner<3>&a = polygon[i], &b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const double of_a = height(a), of_b = height(b);
    if (of_a >= 0) cut.push_back(a);
    if ((of_a < 0 && of_b > 0) || (of_a > 0 && of_b < 0)) cut.push_back(crossing(a, of_a, b, of_b));
  }
  std::swap(polygon, cut);
}

// the buffers of this thread: no step allocates memory once they have grown
template <int Dim>
struct Buffers {
  std::vector<Corner<Dim>> polygon, cut, corners;
};
template <int Dim>
Buffers<Dim>& buffers() {
  static thread_local Buffers<Dim> own;
  return own;
}

bool reaches(const WaterStretch<2>& stretch, double x, double radius) {
  return stretch.to >= x - radius && stretch.from <= x + radius;
}
bool reaches(const WaterStretch<3>&, double, double) {
  return true;
}

// a piece of this volume and first moment, all below one stretch
template <int Dim>
void add_piece(double volume, const Vector<Dim>& first_moment, const WaterStretch<Dim>& stretch,
               const Vector<Dim>& centroid, Submerged<Dim>& sum) {
  sum.volume += volume;
  sum.first_moment += first_moment;
  sum.potential += stretch.rise.dot(volume * Vector<Dim>(stretch.point - centroid) - first_moment);
  sum.load.force += volume * stretch.rise;
  sum.load.moment += moment(first_moment, stretch.rise);
}

template <int Dim>
void add_whole(const Polytope<Dim>& part, const WaterStretch<Dim>& stretch, const Standing<Dim>& at,
               Submerged<Dim>& sum) {
  const Vector<Dim> first_moment = at.axes * (part.mass.volume * part.mass.centroid);
  add_piece<Dim>(part.mass.volume, first_moment, stretch, at.centroid, sum);
}

// its corners, and whether all of them are below the surface or all above it: 1 or -1; else 0
template <int Dim>
int list_corners(const Polytope<Dim>& part, const WaterStretch<Dim>& stretch, const Standing<Dim>& at,
                 std::vector<Corner<Dim>>& corners) {
  bool wet = true, dry = true;
  corners.clear();
  for (const Vector<Dim>& v : part.vertices) {
    const Vector<Dim> place = at.axes * v;
    const double depth = depth_at(stretch, at.centroid, place);
    corners.push_back({place, depth});
    wet = wet && depth >= 0;
    dry = dry && depth <= 0;
  }
  return wet ? 1 : dry ? -1 : 0;
}

// Tetrahedra from a point of the surface to the faces below it: the cut face itself lies in the plane of their apex and
// adds nothing.
void add_part(const Polytope<3>& part, const WaterStretch<3>& stretch, bool, const Standing<3>& at, Submerged<3>& sum) {
  auto& [polygon, cut, corners] = buffers<3>();
  const int side = list_corners(part, stretch, at, corners);
  if (side < 0) return;
  if (side > 0) return add_whole(part, stretch, at, sum);
  const Vector<3> middle = at.axes * part.centre;
  const Vector<3> apex = middle + depth_at(stretch, at.centroid, middle) / stretch.rise.squaredNorm() * stretch.rise;
  double volume = 0;
  Vector<3> first_moment = Vector<3>::Zero();
  for (const std::vector<int>& loop : part.loops) {
    polygon.clear();
    for (const int v : loop)
      polygon.push_back(corners[v]);
    clip(polygon, cut, [](const Corner<3>& c) { return c.depth; });
    if (polygon.size() < 3) continue;
    const Vector<3> a = polygon.front().place - apex;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      const Vector<3> b = polygon[i].place - apex, c = polygon[i + 1].place - apex;
      const double piece = a.dot(b.cross(c)) / 6;
      volume += piece;
      first_moment += piece / 4 * (a + b + c);
    }
  }
  add_piece<3>(volume, first_moment + volume * apex, stretch, at.centroid, sum);
}

// the pressure over a polygon between three of its corners, as depths
void add_triangle(const Corner<3>& a, const Corner<3>& b, const Corner<3>& c, Load<3>& load) {
  const Vector<3> area = 0.5 * (b.place - a.place).cross(c.place - a.place);
  const double depths = a.depth + b.depth + c.depth;
  load.force -= depths / 3 * area;
  const Vector<3> weighted =
      (a.depth * a.place + b.depth * b.place + c.depth * c.place + depths * (a.place + b.place + c.place)) /
      12;  // ∫ p r dA over the area
  load.moment -= moment(weighted, area);
}

void add_face(const std::vector<Corner<3>>& polygon, const Vector<3>&, Load<3>& load) {
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    add_triangle(polygon[0], polygon[i], polygon[i + 1], load);
}

// an edge in the plane, `normal` pointing out of the part
void add_face(const std::vector<Corner<2>>& edge, const Vector<2>& normal, Load<2>& load) {
  if (edge.size() < 2) return;
  const Corner<2>&a = edge[0], &b = edge[1];
  Vector<2> length(b.place[1] - a.place[1], a.place[0] - b.place[0]);
  if (length.dot(normal) < 0) length = -length;
  load.force -= 0.5 * (a.depth + b.depth) * length;
  const Vector<2> weighted = (2 * (a.depth * a.place + b.depth * b.place) + a.depth * b.place + b.depth * a.place) / 6;
  load.moment -= moment(weighted, length);
}

// The part of an edge, two corners, on which a height is positive. An edge on which it is zero throughout is left out,
// or kept if `with_border`.
template <class Height>
void clip_edge(std::vector<Corner<2>>& edge, const Height& height, bool with_border = false) {
  if (edge.size() < 2) return;
  const double of_a = height(edge[0]), of_b = height(edge[1]);
  if (with_border && of_a == 0 && of_b == 0) return;
  if (of_a <= 0 && of_b <= 0) return edge.clear();
  if (of_a >= 0 && of_b >= 0) return;
  const Corner<2> middle = crossing(edge[0], of_a, edge[1], of_b);
  edge[of_a < 0 ? 0 : 1] = middle;
}

// A vertical edge exactly at a bend belongs only to the stretch that ends there: both neighbours have the
// same depth at the bend.
void clip_face(std::vector<Corner<2>>& edge, std::vector<Corner<2>>&, const WaterStretch<2>& stretch,
               const Vector<2>& centroid) {
  const double from = stretch.from - centroid[0], to = stretch.to - centroid[0];
  if (std::isfinite(from)) clip_edge(edge, [&](const Corner<2>& c) { return c.place[0] - from; });
  if (std::isfinite(to))
    clip_edge(
        edge, [&](const Corner<2>& c) { return to - c.place[0]; }, true);
  clip_edge(edge, [](const Corner<2>& c) { return c.depth; });
}

void clip_face(std::vector<Corner<3>>& polygon, std::vector<Corner<3>>& cut, const WaterStretch<3>&, const Vector<3>&) {
  clip(polygon, cut, [](const Corner<3>& c) { return c.depth; });
}

// Each edge below the surface adds the region between it and the surface straight above, with the sign of its direction
// along x: regions outside the part cancel, and no edge is needed at the end of the stretch. `alone`: the body is
// within one stretch.
void add_part(const Polytope<2>& part, const WaterStretch<2>& stretch, bool alone, const Standing<2>& at,
              Submerged<2>& sum) {
  auto& [edge, cut, corners] = buffers<2>();
  const int side = list_corners(part, stretch, at, corners);
  if (side < 0) return;
  if (side > 0 && alone) return add_whole(part, stretch, at, sum);
  double area = 0;
  Vector<2> first_moment = Vector<2>::Zero();
  for (const std::vector<int>& ends : part.loops) {
    if (ends.size() < 2) continue;
    edge = {corners[ends[0]], corners[ends[1]]};
    clip_face(edge, cut, stretch, at.centroid);
    if (edge.size() < 2) continue;
    const auto& [a, p] = edge[0];  // places and depths
    const auto& [b, q] = edge[1];
    const double width = b[0] - a[0];
    area += 0.5 * width * (p + q);
    first_moment += width / 6 * ((2 * p + q) * a + (p + 2 * q) * b + Vector<2>(0, p * p + p * q + q * q));
  }
  add_piece<2>(area, first_moment, stretch, at.centroid, sum);
}

}  // namespace

template <>
void list_stretches(std::span<const double> numbers, std::vector<WaterStretch<2>>& stretches) {
  stretches.clear();
  const std::size_t points = numbers.size() / 2;
  stretches.push_back({.point = {numbers[0], numbers[1]}});
  for (std::size_t k = 0; k < points; ++k) {
    const double x = numbers[2 * k], h = numbers[2 * k + 1];
    Vector<2> rise(0, 1);
    if (k + 1 < points) rise[0] = -(numbers[2 * k + 3] - h) / (numbers[2 * k + 2] - x);
    if (rise == stretches.back().rise) continue;  // no bend: a block across this point is not cut there
    stretches.back().to = x;
    stretches.push_back({.from = x, .point = {x, h}, .rise = rise});
  }
}

template <>
void list_stretches(std::span<const double> numbers, std::vector<WaterStretch<3>>& stretches) {
  stretches.clear();
  stretches.push_back({.point = {0, 0, numbers[0]}, .rise = {-numbers[1], -numbers[2], 1}});
}

// below a level the load is Eq. 6.8
template <int Dim>
Submerged<Dim> submerged(const std::vector<Polytope<Dim>>& parts, double radius, const Standing<Dim>& standing,
                         std::span<const WaterStretch<Dim>> surface) {
  Submerged<Dim> sum;
  const double x = standing.centroid[0];
  const bool alone =
      surface.size() == 1 || std::ranges::count_if(surface, [&](const auto& s) { return reaches(s, x, radius); }) == 1;
  for (const WaterStretch<Dim>& stretch : surface) {
    if (!reaches(stretch, x, radius)) continue;
    const double depth = depth_at<Dim>(stretch, standing.centroid, Vector<Dim>::Zero());
    const double reach = radius * stretch.rise.norm();
    if (depth <= -reach) continue;
    if (alone && depth >= reach) {  // the first moment of a body about its centroid is zero
      double volume = 0;
      for (const Polytope<Dim>& part : parts)
        volume += part.mass.volume;
      add_piece<Dim>(volume, Vector<Dim>::Zero(), stretch, standing.centroid, sum);
    } else {
      for (const Polytope<Dim>& part : parts)
        add_part(part, stretch, alone, standing, sum);
    }
  }
  return sum;
}

template <int Dim>
Load<Dim> pressure_on_face(const Polytope<Dim>& part, std::size_t face, const Standing<Dim>& standing,
                           std::span<const WaterStretch<Dim>> surface) {
  Load<Dim> load;
  auto& [polygon, cut, corners] = buffers<Dim>();
  const std::vector<int>& loop = part.loops[face];
  if (static_cast<int>(loop.size()) < Dim) return load;
  const Vector<Dim> normal = standing.axes * part.faces[face].normal;
  for (const WaterStretch<Dim>& stretch : surface) {
    if (!reaches(stretch, standing.centroid[0], part.radius)) continue;
    polygon.clear();
    for (const int v : loop) {
      const Vector<Dim> place = standing.axes * part.vertices[v];
      polygon.push_back({place, depth_at(stretch, standing.centroid, place)});
    }
    clip_face(polygon, cut, stretch, standing.centroid);
    add_face(polygon, normal, load);
  }
  return load;
}

template <int Dim>
Load<Dim> uniform_pressure_on_face(const Polytope<Dim>& part, std::size_t face, const Matrix<Dim>& axes) {
  Load<Dim> load;
  auto& [polygon, cut, corners] = buffers<Dim>();
  const std::vector<int>& loop = part.loops[face];
  if (static_cast<int>(loop.size()) < Dim) return load;
  polygon.clear();
  for (const int v : loop)
    polygon.push_back({axes * part.vertices[v], 1});
  add_face(polygon, Vector<Dim>(axes * part.faces[face].normal), load);
  return load;
}

template <int Dim>
double greatest_depth(const Vector<Dim>& centroid, double radius, std::span<const WaterStretch<Dim>> surface) {
  double greatest = -std::numeric_limits<double>::infinity();
  for (const WaterStretch<Dim>& stretch : surface)
    if (reaches(stretch, centroid[0], radius))
      greatest =
          std::max(greatest, depth_at<Dim>(stretch, centroid, Vector<Dim>::Zero()) + radius * stretch.rise.norm());
  return greatest;
}

template <int Dim>
double steepness(std::span<const WaterStretch<Dim>> surface) {
  double greatest = 0, bends = 0;
  for (std::size_t k = 0; k < surface.size(); ++k) {
    greatest = std::max(greatest, surface[k].rise.norm());
    if (k > 0) bends += (surface[k].rise - surface[k - 1].rise).norm();
  }
  return greatest + bends;
}

template <int Dim>
double surface_area(const std::vector<Polytope<Dim>>& parts) {
  double area = 0;
  for (const Polytope<Dim>& part : parts)
    for (std::size_t f = 0; f < part.faces.size(); ++f)
      if (static_cast<int>(part.loops[f].size()) >= Dim) area += face_area<Dim>(part, static_cast<int>(f));
  return area;
}

template <int Dim>
BodyStiffness greatest_water_stiffness(const std::vector<Polytope<Dim>>& parts, double radius) {
  const double section = 0.5 * surface_area(parts);
  double volume = 0;
  for (const Polytope<Dim>& part : parts)
    volume += part.mass.volume;
  return {section, (section * radius + volume) * radius};
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                          \
  template Submerged<Dim> submerged<Dim>(const std::vector<Polytope<Dim>>&, double, const Standing<Dim>&,  \
                                         std::span<const WaterStretch<Dim>>);                              \
  template Load<Dim> pressure_on_face<Dim>(const Polytope<Dim>&, std::size_t, const Standing<Dim>&,        \
                                           std::span<const WaterStretch<Dim>>);                            \
  template Load<Dim> uniform_pressure_on_face<Dim>(const Polytope<Dim>&, std::size_t, const Matrix<Dim>&); \
  template double greatest_depth<Dim>(const Vector<Dim>&, double, std::span<const WaterStretch<Dim>>);     \
  template double steepness<Dim>(std::span<const WaterStretch<Dim>>);                                      \
  template double surface_area<Dim>(const std::vector<Polytope<Dim>>&);                                    \
  template BodyStiffness greatest_water_stiffness<Dim>(const std::vector<Polytope<Dim>>&, double);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
