#include "core/scene/wall_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/potential/particle.hpp"
#include "core/scene/bodies.hpp"
#include "core/scene/bolts.hpp"
#include "core/scene/region.hpp"
#include "core/stage/excavation.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// of a part's radius: a ray that cuts less off a corner does not meet the part
constexpr double grazing = 1e-9;

const ExcavationSpec& opening_of(const Scene& scene, const MonitorSpec& spec) {
  std::vector<std::string> names;
  for (const ExcavationSpec& e : scene.excavations) {
    if (e.name == spec.excavation) return e;
    names.push_back(e.name);
  }
  refuse(spec.body.subject, "excavation", "no excavation of this name; " + suggestion(spec.excavation, names));
}

// the centre from which a wall is seen, in model coordinates, and the axes of its angles, from the first towards the
// second
template <int Dim>
struct View {
  Vector<Dim> centre, right, up;
};

// perpendicular to the axis of its cylinder, at the middle; in 2-D also from the middle of its box
template <int Dim>
View<Dim> view_of(const ExcavationSpec& opening, const Vector<Dim>& origin, const MonitorSpec& spec) {
  const RegionSpec& region = opening.region;
  if (!region.cylinder && (Dim == 3 || !region.box))
    refuse(spec.body.subject, "excavation",
           Dim == 3
               ? "has no axis; in 3-D state it by a cylinder, with planes if needed"
               : "is stated by planes only and has no centre; state it by a cylinder or a box, with planes if needed");
  const auto middle = [](const std::vector<double>& a, const std::vector<double>& b) {
    return Vector<Dim>(0.5 * (to_vector<Dim>(a) + to_vector<Dim>(b)));
  };
  View<Dim> view;
  std::vector<double> axis;
  if (!region.cylinder) {
    view.centre = middle(region.box->min, region.box->max);
  } else if (Dim == 2) {
    view.centre = to_vector<Dim>(region.cylinder->from);
  } else {
    view.centre = middle(region.cylinder->from, region.cylinder->to);
    for (int k = 0; k < Dim; ++k)
      axis.push_back(region.cylinder->to[k] - region.cylinder->from[k]);
  }
  view.centre -= origin;
  if (!lies_inside<Dim>(region_planes<Dim>(region, origin), view.centre))
    refuse(spec.body.subject, "excavation",
           "does not contain the centre of its own cylinder or box, from which the points of its wall are found; state "
           "the region around "
           "its centre");
  const auto [right, up] = ray_axes<Dim>(axis);
  view.right = right;
  view.up = up;
  return view;
}

// the distance along a ray to a part; infinite if the ray misses it
template <int Dim>
double begins_at(const Polytope<Dim>& part, const Vector<Dim>& from, const Vector<Dim>& along) {
  double first = 0, last = std::numeric_limits<double>::infinity();
  for (const HalfSpace<Dim>& face : part.faces) {
    const double gap = -signed_distance<Dim>(face, from), speed = face.normal.dot(along);
    if (speed > 0)
      last = std::min(last, gap / speed);
    else if (speed < 0)
      first = std::max(first, gap / speed);
    else if (gap < 0)
      last = first;
  }
  return last - first > grazing * part.radius ? first : std::numeric_limits<double>::infinity();
}

template <int Dim>
std::array<double, 3> numbers_of(const Vector<Dim>& v) {
  std::array<double, 3> numbers{};
  for (int k = 0; k < Dim; ++k)
    numbers[k] = v[k];
  return numbers;
}

template <int Dim>
WallPoint wall_at(const Model<Dim>& model, const View<Dim>& view, double angle, const Subject& monitor) {
  const Vector<Dim> along = std::cos(angle) * view.right + std::sin(angle) * view.up;
  double nearest = std::numeric_limits<double>::infinity();
  WallPoint wall;
  for (const Body<Dim>& body : model.bodies) {
    if (!body.present) continue;
    for (const Polytope<Dim>& part : body.parts) {
      if (is_particle(part)) continue;  // particles are not part of the wall
      const double distance = begins_at<Dim>(part, view.centre - body.reference, along);
      if (distance >= nearest) continue;
      nearest = distance;
      wall.rock = numbers_of<Dim>(body.reference + part.mass.centroid);
    }
  }
  if (!std::isfinite(nearest))
    refuse(monitor, "angles_deg",
           fmt::format("the ray at {:g} deg meets no rock; choose another angle", to_degrees(angle)));
  wall.point = numbers_of<Dim>(view.centre + nearest * along);
  wall.inwards = numbers_of<Dim>(-along);
  return wall;
}

// a stage after that of the opening may excavate the monitored rock
template <int Dim>
void require_rock(const Model<Dim>& model, const std::vector<WallPoint>& walls, const std::vector<double>& angles,
                  const std::string& stage, const Subject& monitor) {
  for (std::size_t k = 0; k < walls.size(); ++k)
    if (body_around<Dim>(model, Eigen::Map<const Vector<Dim>>(walls[k].rock.data())) < 0)
      refuse(monitor, "angles_deg",
             fmt::format("the rock at {:g} deg is excavated by stage '{}'; choose another angle, or monitor the wall "
                         "of that excavation",
                         angles[k], stage));
}

}  // namespace

template <int Dim>
std::vector<WallPoint> wall_points(const Scene& scene, const Prepared<Dim>& prepared, const MonitorSpec& spec) {
  const Subject& monitor = spec.body.subject;
  const View<Dim> view = view_of<Dim>(opening_of(scene, spec), prepared.model.origin, spec);
  const auto digs = [&](const StagePlan& s) { return std::ranges::count(s.change.excavate, spec.excavation) > 0; };
  const bool from_start = std::ranges::none_of(prepared.stages, digs);
  Model<Dim> model = prepared.model;
  std::vector<WallPoint> walls;
  const auto look = [&] {
    for (const double angle : spec.angles)
      walls.push_back(wall_at(model, view, angle * degree, monitor));
  };
  if (from_start) look();
  for (const StagePlan& stage : prepared.stages) {
    model = apply(std::move(model), stage.change);
    if (walls.empty() && digs(stage)) look();
    require_rock(model, walls, spec.angles, stage.name, monitor);
  }
  return walls;
}

template std::vector<WallPoint> wall_points<2>(const Scene&, const Prepared<2>&, const MonitorSpec&);
template std::vector<WallPoint> wall_points<3>(const Scene&, const Prepared<3>&, const MonitorSpec&);

}  // namespace voussoir
