#include "core/step/open_sides.hpp"

#include <algorithm>

#include "core/load/ground_motion.hpp"
#include "core/load/time_factor.hpp"

namespace voussoir {
namespace {

// images are listed by ascending body
template <int Dim>
bool is_outer_image(const Model<Dim>& model, int body) {
  if (!model.bodies[body].image) return false;
  return std::ranges::lower_bound(model.column_images, body, {}, &ColumnImage<Dim>::body)->outside;
}

// the relative displacement of a face and its plate, world axes; that of the column's face beside it
template <int Dim>
struct FaceNow {
  Vector<Dim> face, of_column = Vector<Dim>::Zero();
};

template <int Dim>
FaceNow<Dim> face_now(const OpenFace<Dim>& face, const BodiesState<Dim>& bodies, const PlateState<Dim>& plate) {
  FaceNow<Dim> now{displacement_of(face, bodies.poses[face.body]) - plate.face_origin};
  if (face.column < 0) return now;
  now.of_column = displacement_of(face, bodies.poses[face.column]) - plate.column_origin;
  now.face -= now.of_column;
  return now;
}

// the rotation before the given one
Rotation<2> after(const Rotation<2>& first, const Rotation<2>& offset) {
  return {first.angle + offset.angle};
}
Rotation<3> after(const Rotation<3>& first, const Rotation<3>& offset) {
  Rotation<3> both{first.quaternion * offset.quaternion};
  return both;
}

}  // namespace

template <int Dim>
Vector<Dim> upgoing_between(const EnteringWave<Dim>& wave, double from, double to) {
  Vector<Dim> velocity = Vector<Dim>::Zero();
  if (!wave.velocity.isZero(0)) velocity = mean_of(wave.factor, from, to) * wave.velocity;
  for (const RecordedAxis<Dim>& record : wave.records)
    velocity += path_between(*record.motion, from, to) / (to - from) * record.direction;
  return wave.upgoing * velocity;
}

template <int Dim>
Vector<Dim> displacement_of(const OpenFace<Dim>& face, const CachedPose<Dim>& pose) {
  return pose.displacement + (pose.axes * face.place - face.place);
}

template <int Dim>
Load<Dim> load_from_outside(const Model<Dim>& model, const ContactsState<Dim>& contacts,
                            const ColumnBody<Dim>& column) {
  Load<Dim> sum;
  for (const int place : contacts_of(contacts, column.body)) {
    const ContactLoad<Dim>& c = contacts.loads[place];
    if (c.second < 0) continue;
    const bool is_second = c.second == column.body;
    const int other = is_second ? model.parts[contacts.list[place].part_a].body : c.second;
    if (!is_outer_image(model, other)) continue;
    if (is_second)
      sum += {c.force, c.about_second};
    else
      sum += {-c.force, -c.about_first};
  }
  return sum;
}

template <int Dim>
void find_open_sides(const Model<Dim>& model, const Schedule& schedule, const BodiesState<Dim>& bodies,
                     const ContactsState<Dim>& contacts, LoadsState<Dim>& loads, Ledger& ledger) {
  OpenSidesState<Dim>& open = loads.open_sides;
  const std::size_t columns = std::min(open.columns.size(), model.column_bodies.size());
  for (std::size_t i = 0; i < columns; ++i)
    open.columns[i].now = load_from_outside(model, contacts, model.column_bodies[i]);
  if (open.plates.empty()) return;

  const double h = schedule.time - open.time, from = open.time - schedule.started,
               to = schedule.time - schedule.started;
  std::vector<Vector<Dim>> upgoing;
  for (const OpenSide<Dim>& side : model.open_sides)
    upgoing.push_back(h > 0 ? upgoing_between(side.wave, from, to) : Vector<Dim>::Zero());
  EnergyFlows& flows = ledger.energy.flows;
  for (std::size_t i = 0; i < open.plates.size(); ++i) {
    const OpenFace<Dim>& face = model.open_faces[i];
    PlateState<Dim>& p = open.plates[i];
    const FaceNow<Dim> now = face_now(face, bodies, p);
    if (h > 0) {
      const Vector<Dim> velocity = (now.face - p.face) / h;
      const PlateStep<Dim> step = step_of<Dim>(face.plate, p.face, p.plate, velocity, upgoing[face.side], h);
      p.plate = step.plate;
      flows[Source::incoming_waves] += step.came_in;
      if (face.column >= 0)
        flows[Source::incoming_waves] += step.mean_force.dot(now.of_column - p.face_of_column);
      else
        p.face_of_column += 2 * h * upgoing[face.side];
      flows[Source::outgoing_waves] += step.went_out;
    }
    p.face = now.face;
    if (face.column >= 0) p.face_of_column = now.of_column;
    p.force = force_of<Dim>(face.plate, p.face, p.plate);
    ledger.energy.elastic += energy_of<Dim>(face.plate, p.face, p.plate);
  }
  open.time = schedule.time;
}

template <int Dim>
bool has_reactions(const Model<Dim>&, const LoadInputs<Dim>& now) {
  return !now.open_sides.reactions.empty();
}

template <int Dim>
void reaction_loads(const Model<Dim>&, int, const LoadInputs<Dim>& now, std::vector<Load<Dim>>& loads) {
  for (const ConstantLoad<Dim>& reaction : now.open_sides.reactions)
    loads[reaction.body] += reaction.load;
}

template <int Dim>
bool has_plates(const Model<Dim>&, const LoadInputs<Dim>& now) {
  return !now.open_sides.plates.empty();
}

template <int Dim>
void plate_loads(const Model<Dim>& model, int, const LoadInputs<Dim>& now, std::vector<Load<Dim>>& loads) {
  for (std::size_t i = 0; i < now.open_sides.plates.size(); ++i) {
    const OpenFace<Dim>& face = model.open_faces[i];
    const Vector<Dim>& force = now.open_sides.plates[i].force;
    loads[face.body] += {force, moment(Vector<Dim>(now.bodies.poses[face.body].axes * face.place), force)};
  }
}

// The spring's λ as if its plate were held, as part of the translation: at most what the joint to a further block would
// add. A column's body, which moves too, is not loaded by it.
template <int Dim>
void add_plate_stiffness(const Model<Dim>& model, const LoadInputs<Dim>& now, std::vector<BodyStiffness>& stiffness) {
  for (std::size_t i = 0; i < now.open_sides.plates.size(); ++i) {
    const OpenFace<Dim>& face = model.open_faces[i];
    const Body<Dim>& body = model.bodies[face.body];
    const bool turns = std::ranges::any_of(body.free_rotation, [](bool free) { return free; });
    double most = 0;
    for (int k = 0; k < Dim; ++k) {
      const Vector<Dim> axis = face.plate.axes.col(k);
      const double lever = moment(face.place, axis).norm(),
                   turning = turns ? lever * lever / body.inertia.minCoeff() : 0;
      most = std::max(most, face.plate.stiffness[k] * (1 + body.mass * turning));
    }
    stiffness[face.body].translation += most;
  }
}

template <int Dim>
bool has_columns(const Model<Dim>& model, const LoadInputs<Dim>& now) {
  return !model.column_bodies.empty() && !now.open_sides.columns.empty();
}

template <int Dim>
void column_loads(const Model<Dim>& model, int, const LoadInputs<Dim>& now, std::vector<Load<Dim>>& loads) {
  for (std::size_t i = 0; i < now.open_sides.columns.size(); ++i) {
    const ColumnLoad<Dim>& c = now.open_sides.columns[i];
    loads[model.column_bodies[i].of_side] += {c.now.force - c.at_begin.force, c.now.moment - c.at_begin.moment};
  }
}

template <int Dim>
void place_image(const Body<Dim>& body, const Motion<Dim>& of_column, const ImageOffset<Dim>& offset,
                 Motion<Dim>& motion) {
  const Spin<Dim> spin = angular_velocity(body, of_column);
  motion.displacement = of_column.displacement + offset.displacement;
  motion.rotation = after(of_column.rotation, offset.rotation);
  motion.velocity = of_column.velocity;
  motion.angular_momentum = angular_momentum(body, motion.rotation, spin);
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                  \
  template Vector<Dim> upgoing_between<Dim>(const EnteringWave<Dim>&, double, double);                             \
  template Vector<Dim> displacement_of<Dim>(const OpenFace<Dim>&, const CachedPose<Dim>&);                         \
  template Load<Dim> load_from_outside<Dim>(const Model<Dim>&, const ContactsState<Dim>&, const ColumnBody<Dim>&); \
  template void find_open_sides<Dim>(const Model<Dim>&, const Schedule&, const BodiesState<Dim>&,                  \
                                     const ContactsState<Dim>&, LoadsState<Dim>&, Ledger&);                        \
  template bool has_reactions<Dim>(const Model<Dim>&, const LoadInputs<Dim>&);                                     \
  template void reaction_loads<Dim>(const Model<Dim>&, int, const LoadInputs<Dim>&, std::vector<Load<Dim>>&);      \
  template bool has_plates<Dim>(const Model<Dim>&, const LoadInputs<Dim>&);                                        \
  template void plate_loads<Dim>(const Model<Dim>&, int, const LoadInputs<Dim>&, std::vector<Load<Dim>>&);         \
  template void add_plate_stiffness<Dim>(const Model<Dim>&, const LoadInputs<Dim>&, std::vector<BodyStiffness>&);  \
  template bool has_columns<Dim>(const Model<Dim>&, const LoadInputs<Dim>&);                                       \
  template void column_loads<Dim>(const Model<Dim>&, int, const LoadInputs<Dim>&, std::vector<Load<Dim>>&);        \
  template void place_image<Dim>(const Body<Dim>&, const Motion<Dim>&, const ImageOffset<Dim>&, Motion<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
