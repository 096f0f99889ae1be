#include "core/output/monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/base/multiples.hpp"
#include "core/output/support_table.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr std::size_t rows_kept = 400;
const char* const axis_names[] = {"x", "y", "z"};

template <int Dim>
void append_vector(std::vector<Column>& columns, const std::string& name, const std::string& unit) {
  for (int k = 0; k < Dim; ++k)
    columns.push_back({name + "_" + axis_names[k], unit});
}

// the load from the sources of a word on a body; nothing if the scene does not use them
template <int Dim>
Vector<Dim> load_of(std::string_view word, int body, const State<Dim>& state) {
  Vector<Dim> sum = Vector<Dim>::Zero();
  bool first = true;  // a sum of one term is that term, to the sign of its zeros
  for (const SourceRow& row : std::span(source_table).first(load_count)) {
    const std::vector<Load<Dim>>& loads = state.loads.by_source[row.source];
    if (row.monitored != word || loads.empty()) continue;
    sum = first ? loads[body].force : Vector<Dim>(sum + loads[body].force);
    first = false;
  }
  return sum;
}

// the sum of all touching contacts of a joint
template <int Dim>
void append_joint(std::vector<double>& values, int joint, const Model<Dim>& model, const State<Dim>& state) {
  double normal = 0, shear = 0, area = 0, count = 0, mobilised = 0, tilt = 0, most = 0;
  for (const Contact<Dim>& c : state.contacts.list) {
    if (!c.touching() || c.joint != joint) continue;
    const double n = c.force.dot(c.geometry.normal), s = c.history.shear_force.norm();
    normal += n;
    shear += s;
    area += c.geometry.area;
    count += 1;
    if (n > 0) mobilised = std::max(mobilised, to_degrees(std::atan2(s, n)));
    if (n <= most) continue;
    most = n;
    const Vector<Dim>& upward = model.joints[joint].plane.normal;
    const double along = c.geometry.normal.dot(upward);
    tilt = to_degrees(std::atan2((c.geometry.normal - along * upward).norm(), std::abs(along)));
  }
  values.insert(values.end(), {normal, shear, area, count, mobilised, tilt});
}

template <int Dim>
long long whole_bonds_of(int joint, const State<Dim>& state) {
  long long whole = 0;
  for (std::size_t i = 0; i < state.contacts.list.size(); ++i)
    if (state.contacts.list[i].joint == joint) whole += bonds_of(state.contacts, i).whole;
  return whole;
}

Rotation<2> back(const Rotation<2>& rotation) {
  return {-rotation.angle};
}
Rotation<3> back(const Rotation<3>& rotation) {
  return {rotation.quaternion.conjugate()};
}
Rotation<2> after(const Rotation<2>& second, const Rotation<2>& first) {
  return {second.angle + first.angle};
}
Rotation<3> after(const Rotation<3>& second, const Rotation<3>& first) {
  return {second.quaternion * first.quaternion};
}

// the body's pose from which its motion is measured; a body that is installed later is measured from its own start
template <int Dim>
Placement<Dim> counted_from(int since, int body, const State<Dim>& state, const std::vector<StageEnd<Dim>>& ends) {
  const Motion<Dim>& now = state.bodies.motions[body];
  const Placement<Dim> start{Vector<Dim>::Zero(), {}};
  if (since < 0) return start;
  const auto end = std::ranges::find(ends, since, &StageEnd<Dim>::stage);
  if (end == ends.end()) return {now.displacement, now.rotation};
  return static_cast<std::size_t>(body) < end->bodies.size() ? end->bodies[body] : start;
}

// one number, or those of a vector; allocates no memory
using Components = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 3, 1>;

// of one body
template <int Dim>
Components value_of(const Monitor& monitor, int body, const Model<Dim>& model, const State<Dim>& state,
                    const std::vector<StageEnd<Dim>>& ends) {
  const Monitored& followed = monitor.followed;
  const Motion<Dim>& motion = state.bodies.motions[body];
  switch (followed.quantity) {
    case Quantity::displacement:
      if (monitor.since < 0) return motion.displacement;
      return motion.displacement - counted_from(monitor.since, body, state, ends).displacement;
    case Quantity::velocity:
      return motion.velocity;
    case Quantity::rotation: {
      Rotation<Dim> turn = motion.rotation;
      if (monitor.since >= 0) turn = after(turn, back(counted_from(monitor.since, body, state, ends).rotation));
      return rotation_vector(turn).unaryExpr(&to_degrees);
    }
    case Quantity::angular_velocity:
      return angular_velocity(model.bodies[body], motion);
    default:
      return load_of(followed.word, body, state);
  }
}

// of one body, or over several; excavated ones do not count
template <int Dim>
void append_bodies(std::vector<double>& values, const Monitor& monitor, const Model<Dim>& model,
                   const State<Dim>& state, const std::vector<StageEnd<Dim>>& ends) {
  Components sum = value_of(monitor, monitor.subject, model, state, ends);
  if (monitor.over != Aggregate::one) {
    sum.setZero();
    double count = 0;
    for (const int body : monitor.group) {
      if (!model.bodies[body].present) continue;
      sum += value_of(monitor, body, model, state, ends);
      ++count;
    }
    if (monitor.over == Aggregate::mean && count > 0) sum /= count;
  }
  values.insert(values.end(), sum.data(), sum.data() + sum.size());
}

// m: inward displacement of a point of a wall with its block; not a number if its block is excavated
template <int Dim>
double convergence(const WallPoint& wall, int since, const Model<Dim>& model, const State<Dim>& state,
                   const std::vector<StageEnd<Dim>>& ends) {
  const auto vector = [](const std::array<double, 3>& x) {
    return Vector<Dim>(Eigen::Map<const Vector<Dim>>(x.data()));
  };
  const int b = body_around<Dim>(model, vector(wall.rock));
  if (b < 0) return std::numeric_limits<double>::quiet_NaN();
  const Vector<Dim> place = vector(wall.point) - model.bodies[b].reference;
  const Placement<Dim> then = counted_from(since, b, state, ends);
  const Motion<Dim>& now = state.bodies.motions[b];
  const Vector<Dim> moved =
      (now.displacement - then.displacement) + (matrix(now.rotation) - matrix(then.rotation)) * place;
  return moved.dot(vector(wall.inwards));
}

// of each point, or their sum or mean
template <int Dim>
void append_convergence(std::vector<double>& values, const Monitor& monitor, const Model<Dim>& model,
                        const State<Dim>& state, const std::vector<StageEnd<Dim>>& ends) {
  double sum = 0;
  for (const WallPoint& wall : monitor.wall) {
    const double value = convergence(wall, monitor.since, model, state, ends);
    if (monitor.over == Aggregate::one) values.push_back(value);
    sum += value;
  }
  if (monitor.over == Aggregate::one) return;
  values.push_back(monitor.over == Aggregate::mean ? sum / static_cast<double>(monitor.wall.size()) : sum);
}

// elevations of the file; of a plane that above the model's origin
template <int Dim>
void append_water(std::vector<double>& values, const Monitor& monitor, const Model<Dim>& model,
                  const State<Dim>& state) {
  const std::vector<double>& numbers = state.schedule.water[monitor.subject];
  if (monitor.points == 0) return values.push_back(numbers.front());
  for (int k = 0; k < monitor.points; ++k)
    values.push_back(numbers[Dim == 2 ? 2 * k + 1 : 0] + model.origin[Dim - 1]);
}

}  // namespace

template <int Dim>
StageEnd<Dim> stage_end(int stage, const State<Dim>& state) {
  StageEnd<Dim> end{stage, {}};
  note_placements(state.bodies, end.bodies);
  return end;
}

template <int Dim>
void carry(const Excavated<Dim>& moved, StageEnd<Dim>& end) {
  std::vector<Placement<Dim>> bodies;
  for (std::size_t b = 0; b < moved.origin.size(); ++b) {
    const bool stood = static_cast<std::size_t>(moved.origin[b]) < end.bodies.size();
    Placement<Dim> place = stood ? end.bodies[moved.origin[b]] : Placement<Dim>{Vector<Dim>::Zero(), {}};
    place.displacement += matrix(place.rotation) * moved.shift[b] - moved.shift[b];
    bodies.push_back(place);
  }
  end.bodies = std::move(bodies);
}

std::string Column::header() const {
  if (unit == "1") return name;
  const auto slash = unit.find('/');
  return name + "_" + (slash == std::string::npos ? unit : unit.substr(0, slash) + "_per_" + unit.substr(slash + 1));
}

template <int Dim>
std::vector<Column> monitor_columns(const std::vector<Monitor>& monitors) {
  std::vector<Column> columns;
  for (Monitor m : monitors) {
    if (m.over != Aggregate::one) m.name += m.over == Aggregate::sum ? "_sum" : "_mean";
    switch (m.followed.quantity) {
      case Quantity::displacement:
        append_vector<Dim>(columns, m.name + "_displacement", "m");
        break;
      case Quantity::velocity:
        append_vector<Dim>(columns, m.name + "_velocity", "m/s");
        break;
      case Quantity::rotation:
        if (Dim == 2)
          columns.push_back({m.name + "_rotation", "deg"});
        else
          append_vector<Dim>(columns, m.name + "_rotation", "deg");
        break;
      case Quantity::angular_velocity:
        if (Dim == 2)
          columns.push_back({m.name + "_angular_velocity", "rad/s"});
        else
          append_vector<Dim>(columns, m.name + "_angular_velocity", "rad/s");
        break;
      case Quantity::load:
        append_vector<Dim>(columns, fmt::format("{}_{}", m.name, m.followed.word), "N");
        break;
      case Quantity::contact_force:
        columns.push_back({m.name + "_normal_force", "N"});
        columns.push_back({m.name + "_shear_force", "N"});
        columns.push_back({m.name + "_area", Dim == 2 ? "m" : "m2"});
        columns.push_back({m.name + "_contacts", "1"});
        columns.push_back({m.name + "_mobilised_friction", "deg"});
        columns.push_back({m.name + "_normal_tilt", "deg"});
        break;
      case Quantity::whole_bonds:
        columns.push_back({m.name + "_whole_bonds", "1"});
        break;
      case Quantity::level:
        if (m.points == 0) columns.push_back({m.name + "_pressure", "Pa"});
        for (int k = 1; k <= m.points; ++k)
          columns.push_back({m.name + "_level" + (m.points > 1 ? fmt::format("_{}", k) : ""), "m"});
        break;
      case Quantity::convergence:
        if (m.wall.size() < 2 || m.over != Aggregate::one) columns.push_back({m.name + "_convergence", "m"});
        for (std::size_t k = 1; m.over == Aggregate::one && m.wall.size() > 1 && k <= m.wall.size(); ++k)
          columns.push_back({fmt::format("{}_convergence_{}", m.name, k), "m"});
        break;
      default:
        for (const OutputSupport<Dim>& row : output_supports<Dim>)
          if (row.quantity == m.followed.quantity)
            row.add_columns(m, [&](std::string name, std::string unit) {
              columns.push_back({std::move(name), std::move(unit)});
            });
    }
  }
  return columns;
}

template <int Dim>
std::vector<double> monitor_values(const std::vector<Monitor>& monitors, const Model<Dim>& model,
                                   const State<Dim>& state, const std::vector<StageEnd<Dim>>& ends) {
  std::vector<double> values;
  for (const Monitor& m : monitors) {
    switch (m.followed.quantity) {
      case Quantity::displacement:
      case Quantity::velocity:
      case Quantity::rotation:
      case Quantity::angular_velocity:
      case Quantity::load:
        append_bodies(values, m, model, state, ends);
        break;
      case Quantity::contact_force:
        append_joint(values, m.subject, model, state);
        break;
      case Quantity::whole_bonds:
        values.push_back(static_cast<double>(whole_bonds_of(m.subject, state)));
        break;
      case Quantity::level:
        append_water(values, m, model, state);
        break;
      case Quantity::convergence:
        append_convergence(values, m, model, state, ends);
        break;
      default:
        for (const OutputSupport<Dim>& row : output_supports<Dim>)
          if (row.quantity == m.followed.quantity) row.add_values(m, model, state, values);
    }
  }
  return values;
}

bool StageRecord::due(double time) {
  if (interval > 0) {
    if (!is_reached(time, next, interval)) return false;
    next = next_multiple(time, interval);
    return true;
  }
  return step++ % spacing == 0;
}

void StageRecord::add(std::vector<double> row) {
  rows.push_back(std::move(row));
  if (interval > 0 || rows.size() < rows_kept) return;
  for (std::size_t i = 1; 2 * i < rows.size(); ++i)
    rows[i] = std::move(rows[2 * i]);
  rows.resize((rows.size() + 1) / 2);
  spacing *= 2;
}

template std::vector<Column> monitor_columns<2>(const std::vector<Monitor>&);
template std::vector<Column> monitor_columns<3>(const std::vector<Monitor>&);
template std::vector<double> monitor_values<2>(const std::vector<Monitor>&, const Model<2>&, const State<2>&,
                                               const std::vector<StageEnd<2>>&);
template std::vector<double> monitor_values<3>(const std::vector<Monitor>&, const Model<3>&, const State<3>&,
                                               const std::vector<StageEnd<3>>&);

template StageEnd<2> stage_end<2>(int, const State<2>&);
template StageEnd<3> stage_end<3>(int, const State<3>&);
template void carry<2>(const Excavated<2>&, StageEnd<2>&);
template void carry<3>(const Excavated<3>&, StageEnd<3>&);

}  // namespace voussoir
