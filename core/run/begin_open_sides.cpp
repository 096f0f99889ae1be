#include "core/run/begin_open_sides.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/stage/medium.hpp"
#include "core/step.hpp"
#include "core/step/open_sides.hpp"

namespace voussoir {
namespace {

// the rotation that takes the first frame to the second, in the first; or the other way round
Rotation<2> offset_of(const Rotation<2>& from, const Rotation<2>& to) {
  return {to.angle - from.angle};
}
Rotation<3> offset_of(const Rotation<3>& from, const Rotation<3>& to) {
  Rotation<3> offset{from.quaternion.conjugate() * to.quaternion};
  offset.quaternion.normalize();
  return offset;
}

template <int Dim>
int of_side(const Model<Dim>& model, int column) {
  return std::ranges::find(model.column_bodies, column, &ColumnBody<Dim>::body)->of_side;
}

// An image stands to its column's body as the block of the model does to the side's.
template <int Dim>
ImageOffset<Dim> begin_of(const Model<Dim>& model, const ColumnImage<Dim>& image,
                          const std::vector<Motion<Dim>>& motions) {
  ImageOffset<Dim> offset;
  if (image.of_model < 0) return offset;
  const Motion<Dim>&side = motions[of_side(model, image.of_column)], &beside = motions[image.of_model];
  offset.displacement = beside.displacement - side.displacement;
  offset.rotation = offset_of(side.rotation, beside.rotation);
  if (!image.mirrored) return offset;
  offset.displacement = -offset.displacement;
  offset.rotation = offset_of(beside.rotation, side.rotation);
  return offset;
}

// a contact of the column, whose bodies play those of a contact of the model
struct CopiedContact {
  std::size_t from;
  int first, second;  // bodies, in the order of that contact
};

// the direction from a column's body to its image, as a key: periods are alike along a side
template <int Dim>
bool same_direction(const Model<Dim>& model, const ColumnImage<Dim>& a, const ColumnImage<Dim>& b) {
  const Vector<Dim> x = model.bodies[a.body].reference - model.bodies[a.of_column].reference,
                    y = model.bodies[b.body].reference - model.bodies[b.of_column].reference;
  constexpr double near = 0.999;
  return x.dot(y) > near * x.norm() * y.norm();
}

// the columns' contacts, from those of the side with itself and with the blocks beside it
template <int Dim>
std::vector<CopiedContact> contacts_of_columns(const Model<Dim>& model, const ContactsState<Dim>& contacts,
                                               std::size_t first_column, std::size_t first_image) {
  std::vector<CopiedContact> copies;
  const auto bodies_of = [&](std::size_t i) {
    return std::pair(model.parts[contacts.list[i].part_a].body, model.parts[contacts.list[i].part_b].body);
  };
  // calls add(place, other body, whether `body` is the first) for the contacts of a body of the model
  const auto each = [&](int body, const auto& add) {
    for (const int place : contacts_of(contacts, body)) {
      const auto ends = bodies_of(place);
      add(static_cast<std::size_t>(place), ends.first == body ? ends.second : ends.first, ends.first == body);
    }
  };
  const auto column_of = [&](int body, int side) {
    for (std::size_t k = first_column; k < model.column_bodies.size(); ++k)
      if (model.column_bodies[k].of_side == body && model.column_bodies[k].side == side)
        return model.column_bodies[k].body;
    return -1;
  };
  for (std::size_t k = first_column; k < model.column_bodies.size(); ++k) {
    const ColumnBody<Dim>& column = model.column_bodies[k];
    each(column.of_side, [&](std::size_t place, int other, bool is_first) {
      const int second = is_first ? column_of(other, column.side) : -1;
      if (second >= 0) copies.push_back({place, column.body, second});
    });
  }
  for (std::size_t j = first_image; j < model.column_images.size(); ++j) {
    const ColumnImage<Dim>& image = model.column_images[j];
    if (image.of_model < 0) continue;
    const auto own = std::ranges::find(model.column_bodies, image.of_column, &ColumnBody<Dim>::body);
    // the image plays the block beside the side; or, mirrored, the side's block, and a column's body the one beside it
    each(image.mirrored ? own->of_side : image.of_model, [&](std::size_t place, int other, bool is_first) {
      int column = -1;
      if (!image.mirrored) column = column_of(other, own->side);
      for (std::size_t l = first_image; image.mirrored && l < model.column_images.size(); ++l)
        if (const ColumnImage<Dim>& i = model.column_images[l];
            i.mirrored && i.of_model == other && same_direction(model, i, image) &&
            std::ranges::find(model.column_bodies, i.of_column, &ColumnBody<Dim>::body)->side == own->side)
          column = i.of_column;
      if (column < 0) return;
      copies.push_back(is_first ? CopiedContact{place, image.body, column} : CopiedContact{place, column, image.body});
    });
  }
  return copies;
}

template <int Dim>
int only_part(const Model<Dim>& model, int body) {
  const auto found = std::ranges::find(model.parts, body, &PartId::body);
  return static_cast<int>(found - model.parts.begin());
}

// the face of another part that looks the same way; -1: none
template <int Dim>
int face_like(const Polytope<Dim>& of, int face, const Polytope<Dim>& part) {
  return face < 0 ? -1 : face_along<Dim>(part, of.faces[face].normal);
}

// the contact's faces, which its new parts may list in another order
template <int Dim>
void take_faces(const Model<Dim>& model, const Contact<Dim>& from, Contact<Dim>& c) {
  const Polytope<Dim>&a = model.polytope(from.part_a), &b = model.polytope(from.part_b);
  const Polytope<Dim>&own_a = model.polytope(c.part_a), &own_b = model.polytope(c.part_b);
  const int count = static_cast<int>(a.faces.size()), own_count = static_cast<int>(own_a.faces.size());
  c.geometry.face_a = face_like(a, from.geometry.face_a, own_a);
  c.geometry.face_b = face_like(b, from.geometry.face_b, own_b);
  if (from.divided_face < 0) return;
  const bool of_first = from.divided_face < count;
  const int face = of_first ? face_like(a, from.divided_face, own_a) : face_like(b, from.divided_face - count, own_b);
  c.divided_face = face < 0 || of_first ? face : own_count + face;
}

// adds them with the histories of their joints, in the order of the list
template <int Dim>
void add_contacts(const Model<Dim>& model, const std::vector<CopiedContact>& copies,
                  const std::vector<CachedPose<Dim>>& poses, ContactsState<Dim>& contacts) {
  const std::size_t stride = sub_stride(contacts),
                    places = contacts.list.empty() ? 0 : contacts.rises.size() / contacts.list.size();
  std::vector<Contact<Dim>> list = contacts.list;
  std::vector<SubContact<Dim>> subs = contacts.subs;
  std::vector<JointRise<Dim>> rises = contacts.rises;
  for (const CopiedContact& copy : copies) {
    Contact<Dim> c = contacts.list[copy.from];
    const auto copied = [&](const auto& from, std::size_t count, auto& to) {
      const std::size_t at = to.size();
      to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(copy.from * count),
                from.begin() + static_cast<std::ptrdiff_t>((copy.from + 1) * count));
      return std::span(to).subspan(at);
    };
    const auto own_subs = copied(contacts.subs, stride, subs);
    const auto own_rises = copied(contacts.rises, places, rises);
    c.part_a = only_part(model, copy.first);
    c.part_b = only_part(model, copy.second);
    take_faces(model, contacts.list[copy.from], c);
    if (c.part_a > c.part_b) {
      const Vector<Dim> shift = between(poses[copy.first], poses[copy.second]);
      turn_round(model, c, own_subs, own_rises);
      c.geometry.point -= shift;
      c.history.point -= shift;
      for (SubContact<Dim>& s : own_subs) {
        s.point -= shift;
        s.history.point -= shift;
      }
    }
    c.proof = {};
    c.area_rated = -1;
    c.near_until = c.free_until = 0;
    list.push_back(c);
  }
  std::vector<std::size_t> order(list.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return std::pair(list[i].part_a, list[i].part_b); });
  contacts.list.clear();
  contacts.subs.clear();
  contacts.rises.clear();
  for (const std::size_t i : order) {
    contacts.list.push_back(list[i]);
    const auto add = [&](const auto& from, std::size_t count, auto& to) {
      to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(i * count),
                from.begin() + static_cast<std::ptrdiff_t>((i + 1) * count));
    };
    add(subs, stride, contacts.subs);
    add(rises, places, contacts.rises);
  }
  contacts.kept.clear();
  contacts.loads.clear();
  contacts.by_body = {};
}

template <int Dim>
void begin_columns(const Model<Dim>& model, State<Dim>& state) {
  OpenSidesState<Dim>& open = state.loads.open_sides;
  const std::size_t first_column = open.columns.size(), first_image = open.images.size();
  std::vector<Motion<Dim>>& motions = state.bodies.motions;
  for (std::size_t k = first_column; k < model.column_bodies.size(); ++k)
    motions[model.column_bodies[k].body] = motions[model.column_bodies[k].of_side];
  for (std::size_t j = first_image; j < model.column_images.size(); ++j) {
    const ColumnImage<Dim>& image = model.column_images[j];
    open.images.push_back(begin_of(model, image, motions));
    place_image(model.bodies[image.body], motions[image.of_column], open.images.back(), motions[image.body]);
  }
  open.columns.resize(model.column_bodies.size());
  cache_poses(model, 1, state.bodies);
  list_by_body(model, state.contacts);
  add_contacts(model, contacts_of_columns(model, state.contacts, first_column, first_image), state.bodies.poses,
               state.contacts);
}

}  // namespace

template <int Dim>
void begin_open_sides(const StageInForce<Dim>& stage, State<Dim>& state) {
  const Model<Dim>& model = stage.model;
  OpenSidesState<Dim>& open = state.loads.open_sides;
  if (open.plates.size() == model.open_faces.size()) return;
  const std::size_t first_column = open.columns.size();
  if (first_column < model.column_bodies.size()) begin_columns(model, state);
  cache_poses(model, stage.settings.threads, state.bodies);
  open.time = state.schedule.time;
  for (std::size_t i = open.plates.size(); i < model.open_faces.size(); ++i) {
    const OpenFace<Dim>& face = model.open_faces[i];
    PlateState<Dim> plate;
    plate.face_origin = displacement_of(face, state.bodies.poses[face.body]);
    if (face.column >= 0) plate.column_origin = displacement_of(face, state.bodies.poses[face.column]);
    open.plates.push_back(plate);
  }

  // what acts without the supports that are gone, and on columns beside their own joints
  const State<Dim> now = with_forces(stage, state, false);
  std::vector<Load<Dim>> total = now.loads.total;
  for (std::size_t k = 0; k < open.columns.size(); ++k) {
    const Load<Dim>&beyond = now.loads.open_sides.columns[k].now, &before = open.columns[k].at_begin;
    Load<Dim>& of_side = total[model.column_bodies[k].of_side];
    of_side.force -= beyond.force - before.force;
    of_side.moment -= beyond.moment - before.moment;
    if (k >= first_column) open.columns[k].at_begin = open.columns[k].now = beyond;
  }
  const auto balance = [&](int b) {
    if (!model.bodies[b].fixed) open.reactions.push_back({b, {-total[b].force, -total[b].moment}});
  };
  for (const int b : model.unsupported)
    balance(b);
  for (std::size_t k = first_column; k < model.column_bodies.size(); ++k)
    balance(model.column_bodies[k].body);
}

template <int Dim>
std::vector<std::string> creep_of(const StageInForce<Dim>& stage, const State<Dim>& state) {
  constexpr double of_block = 1e-3, of_wave = 0.05;
  const Model<Dim>& model = stage.model;
  const OpenSidesState<Dim>& open = state.loads.open_sides;
  Vector<Dim> momentum = Vector<Dim>::Zero();  // of waves that are still within
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed && !model.bodies[b].column)
      momentum += model.bodies[b].mass * state.bodies.motions[b].velocity;
  std::vector<std::string> lines;
  for (std::size_t s = 0; s < model.open_sides.size(); ++s) {
    if (model.open_sides[s].free_field) continue;
    Vector<Dim> impulse = momentum, impedance = Vector<Dim>::Zero();  // N s, N s/m
    double entered = 0, size = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < open.plates.size(); ++i) {
      const OpenFace<Dim>& face = model.open_faces[i];
      if (face.side != static_cast<int>(s) || model.bodies[face.body].column) continue;
      impulse += face.plate.impedance.cwiseProduct(open.plates[i].plate - open.plates[i].face_of_column);
      impedance += face.plate.impedance;
      entered = std::max(entered, open.plates[i].face_of_column.norm());
      size = std::min(size, model.bodies[face.body].size);
    }
    const Vector<Dim> creep = impulse.cwiseQuotient(impedance);
    if (!(creep.norm() > std::max(of_block * size, of_wave * entered))) continue;
    lines.push_back(
        fmt::format("stage {}: the quiet side {} has crept by ({:.3g}) m: it has no spring against loads that change "
                    "after it opens, or that joints which slip no longer carry; change loads before, or hold the side",
                    stage.plan().name, model.open_sides[s].name, fmt::join(creep, ", ")));
  }
  return lines;
}

template <int Dim>
std::vector<std::string> estimated_media(const StageInForce<Dim>& stage) {
  std::vector<std::string> lines;
  for (const BoundaryPlan& plan : stage.plan().change.boundary) {
    if (!plan.lets_waves_leave()) continue;
    const auto side = std::ranges::find(stage.model.open_sides, plan.bodies.sides.front(), &OpenSide<Dim>::name);
    if (side == stage.model.open_sides.end() || side->medium.stated || side->medium.regular) continue;
    lines.push_back(fmt::format(
        "stage {}: the blocks along {} are not those of regular joint sets: its impedances are means over them, by "
        "waves of {:.4g} m/s along its normal and {:.4g} m/s across; state normal_impedance and shear_impedance if "
        "others are known",
        stage.plan().name, side->name, side->medium.normal_speed, side->medium.shear_speed));
  }
  return lines;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                               \
  template void begin_open_sides<Dim>(const StageInForce<Dim>&, State<Dim>&);                   \
  template std::vector<std::string> creep_of<Dim>(const StageInForce<Dim>&, const State<Dim>&); \
  template std::vector<std::string> estimated_media<Dim>(const StageInForce<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
