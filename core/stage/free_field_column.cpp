#include "core/stage/free_field_column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/model/body_title.hpp"

namespace voussoir {
namespace {

constexpr double same_place = 1e-6;  // of a block's size: coordinates are written with this many digits

// a direction in which a column repeats, with its period
template <int Dim>
struct Period {
  Vector<Dim> direction;
  double width = 0;  // m
};

// Whether two opposite faces of a part are one moved along its normal, and by how much, m; 0: they are not.
template <int Dim>
double period_between(const Polytope<Dim>& part, int face, int opposite) {
  const Vector<Dim>& n = part.faces[face].normal;
  const std::vector<int>&corners = part.loops[face], &others = part.loops[opposite];
  if (corners.size() != others.size() || corners.empty()) return 0;
  const double width = part.faces[face].offset + part.faces[opposite].offset;
  const auto has_corner = [&](const Vector<Dim>& at) {
    return std::ranges::any_of(
        others, [&](int v) { return (part.vertices[v] - at).norm() <= same_place * part.inscribed_radius; });
  };
  const bool repeats =
      std::ranges::all_of(corners, [&](int v) { return has_corner(Vector<Dim>(part.vertices[v] - width * n)); });
  return repeats ? width : 0;
}

template <int Dim>
[[noreturn]] void refuse_column(const Model<Dim>& model, const std::string& side, int body, const std::string& why) {
  throw ClosedSide("free_field",
                   fmt::format("the column of blocks along {} does not repeat: {} {}; a free field needs joint sets "
                               "parallel to the side whose blocks are alike, else write quiet = {{}}",
                               side, title_of(model, body), why));
}

// The directions in which the block repeats: outwards, and in space along the side.
template <int Dim>
std::vector<Period<Dim>> periods_of(const Model<Dim>& model, const std::string& side, const SideFace& at) {
  const Body<Dim>& body = model.bodies[at.body];
  if (body.parts.size() != 1) refuse_column(model, side, at.body, "has several parts");
  const Polytope<Dim>& part = body.parts.front();
  const Vector<Dim> n = outward_of<Dim>(side);
  std::vector<Period<Dim>> periods{{n, 0}};
  if constexpr (Dim == 3) periods.push_back({std::abs(n[0]) > 0.5 ? Vector<3>::UnitY() : Vector<3>::UnitX(), 0});
  for (Period<Dim>& period : periods) {
    const int face = face_along<Dim>(part, period.direction), other = face_along<Dim>(part, -period.direction);
    if (face < 0 || other < 0)
      refuse_column(model, side, at.body,
                    fmt::format("has no two opposite faces along {}", std::abs(period.direction[0]) > 0.5 ? "x" : "y"));
    period.width = period_between(part, face, other);
    if (!(period.width > 0))
      refuse_column(model, side, at.body,
                    fmt::format("has two different faces along {}", std::abs(period.direction[0]) > 0.5 ? "x" : "y"));
  }
  return periods;
}

template <int Dim>
int body_at(const Model<Dim>& model, const Vector<Dim>& place, double size) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].present && !model.bodies[b].column &&
        (model.bodies[b].reference - place).norm() <= same_place * size)
      return static_cast<int>(b);
  return -1;
}

// The body once more: its sides towards its images have the joint of the face opposite, or the other way round.
template <int Dim>
Body<Dim> repeated(const Body<Dim>& body, const std::vector<Period<Dim>>& periods, const std::string& name) {
  Body<Dim> copy = body;
  copy.name = name;
  copy.column = true;
  Polytope<Dim>& part = copy.parts.front();
  for (const Period<Dim>& period : periods) {
    const int face = face_along<Dim>(part, period.direction), other = face_along<Dim>(part, -period.direction);
    const int joint = part.joints[face] != no_joint ? part.joints[face] : part.joints[other];
    part.joints[face] = part.joints[other] = joint;
  }
  return copy;
}

// the forces that stress puts on faces which are not towards the images
template <int Dim>
void copy_stress(Model<Dim>& model, int from, int to, const std::vector<Period<Dim>>& periods) {
  constexpr double rounding = 1e-9;
  const auto loaded = std::ranges::find(model.boundary, from, &BoundaryForces<Dim>::body);
  if (loaded == model.boundary.end()) return;
  BoundaryForces<Dim> copy = *loaded;
  copy.body = to;
  const Body<Dim>& body = model.bodies[to];
  const Polytope<Dim>& part = body.parts.front();
  std::erase_if(copy.forces, [&](const DeadLoad<Dim>& load) {
    return std::ranges::any_of(periods, [&](const Period<Dim>& period) {
      for (const double sign : {1.0, -1.0}) {
        const int face = face_along<Dim>(part, sign * period.direction);
        if (std::abs(signed_distance<Dim>(part.faces[face], load.place)) <= rounding * body.radius) return true;
      }
      return false;
    });
  });
  if (!copy.forces.empty()) model.boundary.push_back(std::move(copy));
}

// a body of a column to be added: the repeated one, or an image of it along a period
template <int Dim>
struct Planned {
  std::size_t face;  // of the side's
  int period = -1;   // -1: the column's own
  double sign = 0;
  Vector<Dim> reference;
};

}  // namespace

template <int Dim>
std::vector<int> add_columns(Model<Dim>& model, int side, const std::vector<SideFace>& faces) {
  const std::string name = model.open_sides[side].name;
  const Vector<Dim> n = outward_of<Dim>(name);
  std::vector<std::vector<Period<Dim>>> periods;
  std::vector<double> piles;  // m: places along the side of the piles
  std::vector<Planned<Dim>> planned;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Body<Dim>& body = model.bodies[faces[i].body];
    periods.push_back(periods_of(model, name, faces[i]));
    const double width = periods[i].front().width,
                 along = Dim == 3 ? body.reference.dot(periods[i].back().direction) : 0;
    if (std::abs(width - periods[0].front().width) > same_place * body.size)
      refuse_column(model, name, faces[i].body,
                    fmt::format("is {:.6g} m wide, others {:.6g} m", width, periods[0].front().width));
    auto pile = std::ranges::find_if(piles, [&](double p) { return std::abs(p - along) <= same_place * body.size; });
    if (pile == piles.end()) pile = piles.insert(piles.end(), along);
    // beside the model, so far that no image touches it
    const Vector<Dim> place = body.reference + (3 + 4 * static_cast<double>(pile - piles.begin())) * width * n;
    planned.push_back({i, -1, 0, place});
    for (std::size_t k = 0; k < periods[i].size(); ++k)
      for (const double sign : {1.0, -1.0})
        planned.push_back({i, static_cast<int>(k), sign, place + sign * periods[i][k].width * periods[i][k].direction});
  }
  // in the order in which the bodies of the model are numbered, so that a pair has its first body on the same side
  std::ranges::stable_sort(planned, [](const Planned<Dim>& a, const Planned<Dim>& b) {
    return std::lexicographical_compare(a.reference.begin(), a.reference.end(), b.reference.begin(), b.reference.end());
  });
  std::vector<int> columns(faces.size(), -1);
  const int first = static_cast<int>(model.bodies.size());
  for (const Planned<Dim>& p : planned) {
    const int number = static_cast<int>(model.bodies.size()), of_side = faces[p.face].body;
    Body<Dim> body =
        repeated(model.bodies[of_side], periods[p.face], fmt::format("free field {} {}", name, number - first + 1));
    body.reference = p.reference;
    body.prescribed = false;
    body.image = p.period >= 0;
    body.fixed = body.fixed || body.image;
    model.bodies.push_back(std::move(body));
    if (p.period < 0) columns[p.face] = number;
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    model.column_bodies.push_back({side, columns[i], faces[i].body});
    copy_stress(model, faces[i].body, columns[i], periods[i]);
    for (const OpenFace<Dim>& face : std::vector<OpenFace<Dim>>(model.open_faces))
      if (face.body == faces[i].body && !model.open_sides[face.side].free_field) {
        model.open_faces.push_back(face);
        model.open_faces.back().body = columns[i];
      }
  }
  for (std::size_t j = 0; j < planned.size(); ++j) {
    const Planned<Dim>& p = planned[j];
    if (p.period < 0) continue;
    const Body<Dim>& body = model.bodies[faces[p.face].body];
    const Period<Dim>& period = periods[p.face][p.period];
    ColumnImage<Dim> image{first + static_cast<int>(j), columns[p.face]};
    image.outside = p.period == 0 && p.sign > 0;
    const Vector<Dim> way = p.sign * period.width * period.direction;
    image.of_model = body_at<Dim>(model, body.reference + way, body.size);
    if (image.of_model < 0) {
      image.of_model = body_at<Dim>(model, body.reference - way, body.size);
      image.mirrored = image.of_model >= 0;
    }
    model.column_images.push_back(image);
  }
  list_parts(model);
  bound_water_stiffness(model);
  return columns;
}

template std::vector<int> add_columns<2>(Model<2>&, int, const std::vector<SideFace>&);
template std::vector<int> add_columns<3>(Model<3>&, int, const std::vector<SideFace>&);

}  // namespace voussoir
