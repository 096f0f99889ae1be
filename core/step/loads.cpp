#include "core/step/loads.hpp"

#include "core/base/on_threads.hpp"
#include "core/load/time_factor.hpp"
#include "core/model/water_surfaces.hpp"
#include "core/step/open_sides.hpp"
#include "core/step/support_table.hpp"

namespace voussoir {
namespace {

// Each computes the loads of its source on the bodies; the loads are zero before.
template <int Dim>
void contact_loads(const Model<Dim>&, int threads, const LoadInputs<Dim>& now, std::vector<Load<Dim>>& loads) {
  each_on_threads(threads, loads.size(), [&](int b) {
    Load<Dim> load;
    for (const int place : contacts_of(now.contacts, b)) {
      const ContactLoad<Dim>& c = now.contacts.loads[place];
      if (c.second == b) {
        load.force += c.force;
        load.moment += c.about_second;
      } else if (c.second >= 0) {
        load.force -= c.force;
        load.moment -= c.about_first;
      }
    }
    loads[b] = load;
  });
}

template <int Dim>
void gravity_loads(const Model<Dim>& model, int threads, const LoadInputs<Dim>& now, std::vector<Load<Dim>>& loads) {
  each_on_threads(threads, loads.size(), [&](int b) { loads[b].force = weight(model, now.schedule, b); });
}

template <int Dim>
void boundary_stress_loads(const Model<Dim>& model, int threads, const LoadInputs<Dim>& now,
                           std::vector<Load<Dim>>& loads) {
  each_on_threads(threads, model.boundary.size(), [&](int i) {
    const BoundaryForces<Dim>& loaded = model.boundary[i];
    for (const DeadLoad<Dim>& load : loaded.forces)
      loads[loaded.body] += load_of(load, now.bodies.poses[loaded.body].axes);
  });
}

// at the time of the positions, N
template <int Dim>
Vector<Dim> force_of(const AppliedForce<Dim>& f, const LoadInputs<Dim>& now) {
  return value_at(f.factor, now.schedule.time - now.schedule.started) * f.force;
}

template <int Dim>
void applied_loads(const Model<Dim>& model, int, const LoadInputs<Dim>& now, std::vector<Load<Dim>>& loads) {
  for (const AppliedForce<Dim>& f : model.applied) {
    const Matrix<Dim>& axes = now.bodies.poses[f.body].axes;
    const Vector<Dim> force = force_of(f, now);
    loads[f.body] += load_of<Dim>({f.place, f.turns_with_body ? Vector<Dim>(axes * force) : force}, axes);
  }
}

// A force of constant direction acts at a point that rotates with the body, like the weight of a pendulum.
template <int Dim>
void applied_stiffness(const Model<Dim>& model, const LoadInputs<Dim>& now, std::vector<BodyStiffness>& stiffness) {
  for (const AppliedForce<Dim>& f : model.applied)
    if (!f.turns_with_body) stiffness[f.body].rotation += force_of(f, now).norm() * f.place.norm();
}

// the present surfaces, of this thread, filled only by it
template <int Dim>
const WaterSurfaces<Dim>& surfaces_of(const Model<Dim>& model, const LoadInputs<Dim>& now) {
  static thread_local WaterSurfaces<Dim> own;
  find_surfaces(model, now.schedule.water, now.schedule.gravity_factor, own);
  return own;
}

template <int Dim>
void water_loads(const Model<Dim>& model, int threads, const LoadInputs<Dim>& now, std::vector<Load<Dim>>& loads) {
  const WaterSurfaces<Dim>& surfaces = surfaces_of(model, now);
  each_on_threads(threads, loads.size(),
                  [&](int b) { loads[b] = water_load<Dim>(model, surfaces, b, standing(now.bodies.poses[b])); });
}

template <int Dim>
void add_water_stiffness(const Model<Dim>& model, const LoadInputs<Dim>& now, std::vector<BodyStiffness>& stiffness) {
  const WaterSurfaces<Dim>& surfaces = surfaces_of(model, now);
  for (std::size_t b = 0; b < stiffness.size(); ++b) {
    const BodyStiffness more =
        water_stiffness<Dim>(model, surfaces, static_cast<int>(b), standing(now.bodies.poses[b]));
    stiffness[b].translation += more.translation;
    stiffness[b].rotation += more.rotation;
  }
}

template <int Dim>
void held_loads(const Model<Dim>&, int, const LoadInputs<Dim>& now, std::vector<Load<Dim>>& loads) {
  for (const ReliefLoad<Dim>& held : now.relief)
    loads[held.body] += {held.share * held.load.force, held.share * held.load.moment};
}

template <int Dim>
bool has_water_by_volume(const Model<Dim>& model, const LoadInputs<Dim>&) {
  return model.water_by_volume;
}
template <int Dim>
bool has_water_by_faces(const Model<Dim>& model, const LoadInputs<Dim>&) {
  return !model.waters.empty() && !model.water_by_volume;
}

template <int Dim>
using Block = typename PairStiffness<Dim>::Block;

// Minus the change of a load as its body rotates: if the force keeps its direction, the moment changes, because its
// point rotates; if it turns with the body, force and moment rotate.
template <int Dim>
void add_turning(const Vector<Dim>& arm, const Vector<Dim>& force, bool with_body, Block<Dim>& stiffness) {
  for (int s = 0; s < spin_freedoms<Dim>; ++s) {
    const Spin<Dim> e = Spin<Dim>::Unit(s);
    Load<Dim> change{Vector<Dim>::Zero(), moment(Vector<Dim>(cross(e, arm)), force)};
    if (with_body) change += {cross(e, force), moment(arm, Vector<Dim>(cross(e, force)))};
    stiffness.template block<Dim, 1>(0, Dim + s) -= change.force;
    stiffness.template block<spin_freedoms<Dim>, 1>(Dim, Dim + s) -= change.moment;
  }
}

template <int Dim>
void boundary_stress_tangent(const Model<Dim>& model, const LoadInputs<Dim>& now, std::vector<Block<Dim>>& stiffness) {
  for (const BoundaryForces<Dim>& loaded : model.boundary)
    for (const DeadLoad<Dim>& load : loaded.forces)
      add_turning<Dim>(now.bodies.poses[loaded.body].axes * load.place, load.force, false, stiffness[loaded.body]);
}

template <int Dim>
void applied_tangent(const Model<Dim>& model, const LoadInputs<Dim>& now, std::vector<Block<Dim>>& stiffness) {
  for (const AppliedForce<Dim>& f : model.applied) {
    const Matrix<Dim>& axes = now.bodies.poses[f.body].axes;
    const Vector<Dim> force = force_of(f, now);
    add_turning<Dim>(axes * f.place, f.turns_with_body ? Vector<Dim>(axes * force) : force, f.turns_with_body,
                     stiffness[f.body]);
  }
}

// loads that are known before the bodies move, in the order of summation; those of supports follow
template <int Dim>
constexpr LoadRow<Dim> load_table[] = {
    {Source::contacts, [](const Model<Dim>&, const LoadInputs<Dim>&) { return true; }, contact_loads<Dim>},
    {Source::gravity, [](const Model<Dim>& m, const LoadInputs<Dim>&) { return !m.gravity.isZero(0); },
     gravity_loads<Dim>},
    {Source::boundary_stress, [](const Model<Dim>& m, const LoadInputs<Dim>&) { return !m.boundary.empty(); },
     boundary_stress_loads<Dim>, nullptr, boundary_stress_tangent<Dim>},
    {Source::boundary_reactions, has_reactions<Dim>, reaction_loads<Dim>},
    {Source::plates, has_plates<Dim>, plate_loads<Dim>, add_plate_stiffness<Dim>},
    {Source::free_field, has_columns<Dim>, column_loads<Dim>},
    {Source::applied_forces, [](const Model<Dim>& m, const LoadInputs<Dim>&) { return !m.applied.empty(); },
     applied_loads<Dim>, applied_stiffness<Dim>, applied_tangent<Dim>},
    {Source::water, has_water_by_volume<Dim>, water_loads<Dim>, add_water_stiffness<Dim>},
    {Source::water_pressure, has_water_by_faces<Dim>, water_loads<Dim>, add_water_stiffness<Dim>},
    {Source::excavation_forces, [](const Model<Dim>&, const LoadInputs<Dim>& now) { return !now.relief.empty(); },
     held_loads<Dim>},
};

}  // namespace

template <int Dim>
void sum_loads(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
               const BodiesState<Dim>& bodies, const ContactsState<Dim>& contacts, const SupportsState<Dim>& supports,
               LoadsState<Dim>& sums) {
  const LoadInputs<Dim> now{schedule, bodies, contacts, supports, sums.relief, sums.open_sides};
  const std::size_t count = model.bodies.size();
  sums.stiffened.clear();
  const auto find = [&](const LoadRow<Dim>& row) {
    const bool acts = row.acts(model, now);
    if (row.find) {
      std::vector<Load<Dim>>& loads = sums.by_source[row.source];
      loads.assign(acts ? count : 0, {});
      if (acts) row.find(model, settings.threads, now, loads);
    }
    if (!acts || !row.stiffen) return;
    sums.stiffened.resize(count);
    row.stiffen(model, now, sums.stiffened);
  };
  for (const LoadRow<Dim>& row : load_table<Dim>)
    find(row);
  for (const StepSupport<Dim>& row : step_supports<Dim>)
    find(row.load);
  each_on_threads(settings.threads, count, [&](int b) {
    sums.total[b] = {};
    const auto add = [&](const LoadRow<Dim>& row) {
      if (const std::vector<Load<Dim>>& loads = sums.by_source[row.source]; row.find && !loads.empty())
        sums.total[b] += loads[b];
    };
    for (const LoadRow<Dim>& row : load_table<Dim>)
      add(row);
    for (const StepSupport<Dim>& row : step_supports<Dim>)
      add(row.load);
  });
}

template <int Dim>
std::vector<typename PairStiffness<Dim>::Block> load_stiffness(const Model<Dim>& model, const State<Dim>& state) {
  const LoadInputs<Dim> now = load_inputs(state);
  std::vector<Block<Dim>> stiffness;
  for (const LoadRow<Dim>& row : load_table<Dim>) {
    if (!row.add_tangent || !row.acts(model, now)) continue;
    stiffness.resize(model.bodies.size(), Block<Dim>::Zero());
    row.add_tangent(model, now, stiffness);
  }
  return stiffness;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                            \
  template std::vector<PairStiffness<Dim>::Block> load_stiffness<Dim>(const Model<Dim>&, const State<Dim>&); \
  template void sum_loads<Dim>(const Model<Dim>&, const Settings&, const Schedule&, const BodiesState<Dim>&, \
                               const ContactsState<Dim>&, const SupportsState<Dim>&, LoadsState<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
