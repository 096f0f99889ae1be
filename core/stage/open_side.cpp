#include "core/stage/open_side.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/model/body_title.hpp"
#include "core/stage/free_field_column.hpp"

namespace voussoir {
namespace {

template <int Dim>
bool is_open(const Model<Dim>& model, const std::string& side) {
  return std::ranges::any_of(model.open_sides, [&](const OpenSide<Dim>& s) { return s.name == side; });
}

template <int Dim>
EnteringWave<Dim> wave_of(const QuietPlan& plan) {
  EnteringWave<Dim> wave;
  if (!plan.velocity.empty()) wave.velocity = Eigen::Map<const Vector<Dim>>(plan.velocity.data());
  wave.factor = plan.factor;
  wave.upgoing = plan.upgoing;
  for (const RecordedMotion& record : plan.records)
    wave.records.push_back({Eigen::Map<const Vector<Dim>>(record.direction.data()), record.motion});
  return wave;
}

// A fixed block of the side is released, unless it also ends the model below, where nothing else would carry it.
template <int Dim>
void release_supported(Model<Dim>& model, const std::string& side, const std::vector<SideFace>& faces) {
  std::vector<int> base;
  if (side != "bottom" && !is_open<Dim>(model, "bottom"))
    for (const SideFace& at : faces_of_side(model, "bottom"))
      base.push_back(at.body);
  for (const SideFace& at : faces) {
    Body<Dim>& body = model.bodies[at.body];
    if (!body.fixed || body.prescribed || std::ranges::binary_search(base, at.body)) continue;
    body.fixed = false;
    model.unsupported.push_back(at.body);
  }
}

// the stress that earlier stages put on these faces becomes a constant load (core/run/begin_open_sides.hpp)
template <int Dim>
void take_stress(Model<Dim>& model, const std::vector<SideFace>& faces) {
  constexpr double rounding = 1e-9;
  for (const SideFace& at : faces) {
    const Body<Dim>& body = model.bodies[at.body];
    const Polytope<Dim>& part = body.parts[at.part];
    const HalfSpace<Dim>& plane = part.faces[at.face];
    for (BoundaryForces<Dim>& loaded : model.boundary) {
      if (loaded.body != at.body) continue;
      const auto on_face = [&](const DeadLoad<Dim>& load) {
        return std::abs(signed_distance<Dim>(plane, load.place)) <= rounding * body.radius;
      };
      if (std::erase_if(loaded.forces, on_face) > 0) model.unsupported.push_back(at.body);
    }
  }
  std::erase_if(model.boundary, [](const BoundaryForces<Dim>& loaded) { return loaded.forces.empty(); });
}

// m: the largest extent along the other axes
template <int Dim>
double width_across(const Body<Dim>& body, int axis) {
  double width = 0;
  for (int k = 0; k < Dim; ++k) {
    if (k == axis) continue;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Polytope<Dim>& part : body.parts)
      for (const Vector<Dim>& v : part.vertices) {
        low = std::min(low, v[k]);
        high = std::max(high, v[k]);
      }
    width = std::max(width, high - low);
  }
  return width;
}

// A side that is one fixed block would move as a whole: no wave passes it.
template <int Dim>
void demand_blocks(const Model<Dim>& model, const std::string& side, const std::vector<SideFace>& faces) {
  if (faces.empty())
    throw ClosedSide("side",
                     fmt::format("no face that ends the model there is in {}; choose a side of blocks with flat "
                                 "outer faces along the axes",
                                 side));
  if (is_open(model, side))
    throw ClosedSide("side", fmt::format("{} is open already, by an earlier statement; state each side once", side));
  const Body<Dim>& first = model.bodies[faces.front().body];
  const bool one = std::ranges::all_of(faces, [&](const SideFace& at) { return at.body == faces.front().body; });
  if (!one || !first.fixed) return;
  const Vector<Dim> n = outward_of<Dim>(side);
  int axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  // a layer over others that are as wide is a block like them
  const double width = width_across(first, axis);
  if (std::ranges::none_of(model.bodies, [&](const Body<Dim>& body) {
        return body.present && !body.column && !body.parts.empty() && width_across(body, axis) < 0.5 * width;
      }))
    return;
  double inner = n.dot(first.reference);
  for (const Polytope<Dim>& part : first.parts)
    for (const Vector<Dim>& v : part.vertices)
      inner = std::min(inner, n.dot(first.reference + v));
  throw ClosedSide(
      "side",
      fmt::format("{0} is one fixed block ({1}), which would move as a whole and pass no wave; end domain.box at {2} = "
                  "{3:g} so that the blocks beyond it are the side, and write fix = [{{ side = [\"{0}\"] }}] until "
                  "this stage",
                  side, title_of(model, faces.front().body), "xyz"[axis], n[axis] * inner + model.origin[axis]));
}

}  // namespace

template <int Dim>
void open_side(Model<Dim>& model, const BoundaryPlan& plan) {
  const std::string& side = plan.bodies.sides.front();
  const std::vector<SideFace> faces = faces_of_side(model, side);
  demand_blocks(model, side, faces);
  const SideMedium<Dim> found =
      medium_of(model, side, faces, plan.quiet ? plan.quiet->medium : plan.free_field.value());
  OpenSide<Dim> open{.name = side, .free_field = plan.free_field.has_value(), .medium = found.medium};
  if (plan.quiet) open.wave = wave_of<Dim>(*plan.quiet);
  const int number = static_cast<int>(model.open_sides.size());
  model.open_sides.push_back(open);
  std::vector<int> columns(faces.size(), -1);
  release_supported(model, side, faces);
  if (open.free_field) {
    take_stress(model, faces);
    columns = add_columns(model, number, faces);
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Polytope<Dim>& part = model.bodies[faces[i].body].parts[faces[i].part];
    const int f = faces[i].face;
    model.open_faces.push_back({faces[i].body, number,
                                face_centroid<Dim>(part.vertices, part.loops[f], part.faces[f].normal), found.plates[i],
                                columns[i]});
  }
}

template <int Dim>
void open_sides(Model<Dim>& model, const std::vector<BoundaryPlan>& plans) {
  model.unsupported.clear();
  for (OpenSide<Dim>& side : model.open_sides)  // waves enter while their stage lasts
    side.wave = {};
  for (const BoundaryPlan& plan : plans)
    if (plan.quiet) open_side(model, plan);
  for (const BoundaryPlan& plan : plans)
    if (plan.free_field) open_side(model, plan);
  std::ranges::sort(model.unsupported);
  model.unsupported.erase(std::unique(model.unsupported.begin(), model.unsupported.end()), model.unsupported.end());
}

template <int Dim>
void prescribe_columns(Model<Dim>& model) {
  const auto add = [&](PrescribedMotion<Dim> p, int b) {
    Body<Dim>& body = model.bodies[b];
    p.body = b;
    p.free_translation = body.free_translation;
    p.free_rotation = body.free_rotation;
    for (int k = 0; k < Dim; ++k)
      if (p.translation[k]) body.free_translation[k] = false;
    if (p.rotation) body.free_rotation.fill(false);
    body.prescribed = true;
    model.prescribed.push_back(std::move(p));
  };
  for (const ColumnBody<Dim>& column : model.column_bodies) {
    const auto moved = std::ranges::find(model.prescribed, column.of_side, &PrescribedMotion<Dim>::body);
    if (moved != model.prescribed.end()) add(PrescribedMotion<Dim>(*moved), column.body);
  }
  for (const ColumnImage<Dim>& image : model.column_images) {
    PrescribedMotion<Dim> p;
    p.repeats = image.of_column;
    p.translation.fill(true);
    p.rotation = true;
    add(std::move(p), image.body);
  }
}

#define VOUSSOIR_INSTANTIATE(Dim)                                               \
  template void open_side<Dim>(Model<Dim>&, const BoundaryPlan&);               \
  template void open_sides<Dim>(Model<Dim>&, const std::vector<BoundaryPlan>&); \
  template void prescribe_columns<Dim>(Model<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
