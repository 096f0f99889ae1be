#include "core/limit/corner_cones.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/key_blocks/rock_contacts.hpp"

namespace voussoir {
namespace {

template <int Dim>
using CornerCone = ForceCone<freedoms<Dim>, Dim>;

// The row of blocks of every body that is free to move; -1: held.
template <int Dim>
std::vector<int> rows_of(const CornerAssembly<Dim>& assembly) {
  std::vector<int> rows;
  int count = 0;
  for (const CornerBody<Dim>& body : assembly.bodies)
    rows.push_back(body.moves() ? count++ : -1);
  return rows;
}

// N: the unit of forces between two bodies, of a face or a tie, is the lighter one's weight, so that no coefficient
// exceeds 1
template <int Dim, template <int> class Between>
double unit_of(const CornerAssembly<Dim>& assembly, const Between<Dim>& between) {
  const auto weight = [&](int b) {
    return assembly.bodies[b].moves() ? assembly.bodies[b].weight : std::numeric_limits<double>::infinity();
  };
  return std::min(weight(between.body_a), weight(between.body_b));
}

// normal and tangents
Matrix<2> axes_of(const Vector<2>& normal) {
  Matrix<2> axes;
  axes << normal, Vector<2>(-normal[1], normal[0]);
  return axes;
}

Matrix<3> axes_of(const Vector<3>& normal) {
  const Vector<3> first = normal.unitOrthogonal();
  Matrix<3> axes;
  axes << normal, first, normal.cross(first);
  return axes;
}

// what forces of these directions at a point do to a body, in its units
template <int Dim>
FixedMatrix<freedoms<Dim>, Dim> on_body(const CornerBody<Dim>& body, const Vector<Dim>& place,
                                        const Matrix<Dim>& forces) {
  FixedMatrix<freedoms<Dim>, Dim> rows;
  for (int k = 0; k < Dim; ++k) {
    rows.col(k).template head<Dim>() = forces.col(k) / body.weight;
    rows.col(k).template tail<spin_freedoms<Dim>>() =
        moment(Vector<Dim>(place - body.centroid), Vector<Dim>(forces.col(k))) / (body.weight * body.radius);
  }
  for (int k = 0; k < freedoms<Dim>; ++k)
    if (!body.free[k]) rows.row(k).setZero();
  return rows;
}

// of forces along these directions between the bodies of a face or a tie
template <int Dim, template <int> class Between>
CornerCone<Dim> cone_of(const CornerAssembly<Dim>& assembly, const std::vector<int>& rows, const Between<Dim>& between,
                        const Vector<Dim>& place, const Matrix<Dim>& on_b) {
  CornerCone<Dim> cone;
  cone.body_a = rows[between.body_a];
  cone.body_b = rows[between.body_b];
  if (cone.body_a >= 0) cone.on_a = on_body<Dim>(assembly.bodies[between.body_a], place, -on_b);
  if (cone.body_b >= 0) cone.on_b = on_body<Dim>(assembly.bodies[between.body_b], place, on_b);
  return cone;
}

// Of N/cos φ and T/sin φ, whose cone is |T| <= N tan φ with coefficients below 1 at any friction; `normal` and `shear`:
// those two factors.
template <int Dim>
CornerCone<Dim> cone_at(const CornerAssembly<Dim>& assembly, const std::vector<int>& rows, const CornerFace<Dim>& face,
                        const Vector<Dim>& place, double normal, double shear) {
  Matrix<Dim> forces = unit_of(assembly, face) * axes_of(face.normal);
  forces.col(0) *= normal;
  forces.template rightCols<Dim - 1>() *= shear;
  return cone_of(assembly, rows, face, place, forces);
}

// A tie's mean tension is a dead load; what differs from it has a size that is given, as its dowel's force has.
template <int Dim>
void add_ties(const CornerAssembly<Dim>& assembly, const std::vector<int>& rows, CornerProgram<Dim>& program) {
  for (const CornerTie<Dim>& tie : assembly.ties) {
    const double unit = unit_of(assembly, tie);
    const Matrix<Dim> axes = axes_of(tie.axis);
    Matrix<Dim> pull = Matrix<Dim>::Zero(), across = Matrix<Dim>::Zero();
    pull.col(1) = -unit * axes.col(0);
    across.template rightCols<Dim - 1>() = unit * axes.template rightCols<Dim - 1>();
    CornerCone<Dim> tension = cone_of(assembly, rows, tie, tie.place, pull),
                    dowel = cone_of(assembly, rows, tie, tie.place, across);
    constexpr int count = freedoms<Dim>;
    if (tension.body_a >= 0)
      program.right_side.template segment<count>(count * tension.body_a) -= tie.mean() / unit * tension.on_a.col(1);
    if (tension.body_b >= 0)
      program.right_side.template segment<count>(count * tension.body_b) -= tie.mean() / unit * tension.on_b.col(1);
    tension.head = tie.half() / unit;
    program.cones.push_back(tension);
    dowel.head = tie.dowel / unit;
    if (tie.dowel > 0) program.cones.push_back(dowel);
  }
}

// Calls act(face, corner, share of the area) for every corner.
template <int Dim, class Act>
void for_corners(const CornerAssembly<Dim>& assembly, const Act& act) {
  for (std::size_t f = 0; f < assembly.faces.size(); ++f) {
    const std::vector<double> shares = assembly.faces[f].shares();
    for (std::size_t k = 0; k < shares.size(); ++k)
      act(static_cast<int>(f), static_cast<int>(k), shares[k]);
  }
}

template <int Dim>
void add_loads(const CornerAssembly<Dim>& assembly, const std::vector<int>& rows, const std::vector<Load<Dim>>& loads,
               double factor, Eigen::VectorXd& sum) {
  for (std::size_t b = 0; b < loads.size(); ++b) {
    if (rows[b] < 0) continue;
    const CornerBody<Dim>& body = assembly.bodies[b];
    Vector<freedoms<Dim>> all;
    all << loads[b].force / body.weight, loads[b].moment / (body.weight * body.radius);
    for (int k = 0; k < freedoms<Dim>; ++k)
      if (body.free[k]) sum[freedoms<Dim> * rows[b] + k] += factor * all[k];
  }
}

double area_of(const std::vector<Vector<2>>& ends) {
  return (ends[1] - ends[0]).norm();
}

double area_of(const std::vector<Vector<3>>& corners) {
  Vector<3> twice = Vector<3>::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    twice += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
  return 0.5 * twice.norm();
}

std::vector<double> shares_of(const std::vector<Vector<2>>&) {
  return {0.5, 0.5};
}

std::vector<double> shares_of(const std::vector<Vector<3>>& corners) {
  const std::size_t count = corners.size();
  Vector<3> mean = Vector<3>::Zero();
  for (const Vector<3>& corner : corners)
    mean += corner / static_cast<double>(count);
  // of the triangles of each edge and the centroid
  Vector<3> centroid = Vector<3>::Zero();
  double whole = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Vector<3>&p = corners[k], &q = corners[(k + 1) % count];
    const double part = 0.5 * (p - mean).cross(q - mean).norm();
    whole += part;
    centroid += part * (mean + p + q) / 3;
  }
  centroid /= whole;
  std::vector<double> shares(count, 0);
  double all = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t next = (k + 1) % count;
    const double part = 0.5 * (corners[k] - centroid).cross(corners[next] - centroid).norm();
    shares[k] += part;
    shares[next] += part;
    all += 2 * part;
  }
  for (double& share : shares)
    share /= all;
  return shares;
}

}  // namespace

template <int Dim>
bool CornerBody<Dim>::moves() const {
  return std::ranges::any_of(free, std::identity());
}

template <int Dim>
double CornerFace<Dim>::area() const {
  return area_of(corners);
}

template <int Dim>
std::vector<double> CornerFace<Dim>::shares() const {
  return shares_of(corners);
}

template <int Dim>
CornerAssembly<Dim> corner_assembly(const Model<Dim>& model, double acceleration, bool bonded) {
  CornerAssembly<Dim> assembly;
  for (const Body<Dim>& body : model.bodies) {
    CornerBody<Dim> of{body.reference, body.mass * acceleration, body.radius, {}};
    if (body.present && !body.fixed) {
      std::ranges::copy(body.free_translation, of.free.begin());
      std::ranges::copy(body.free_rotation, of.free.begin() + Dim);
    }
    assembly.bodies.push_back(of);
  }
  assembly.properties = model.properties;
  const RockContacts<Dim> contacts = find_rock_contacts<Dim>(model);
  for (const RockContact<Dim>& contact : contacts.list) {
    if (!assembly.bodies[contact.body_a].moves() && !assembly.bodies[contact.body_b].moves()) continue;
    const JointProperties& p = model.properties[contact.properties];
    const bool cohesive = bonded || (contact.one_joint && contact.joint != no_joint && p.bonds == BondsMade::as_sliced);
    const auto corners = contacts.corners_of(contact);
    assembly.faces.push_back({contact.body_a,
                              contact.body_b,
                              contact.normal,
                              {corners.begin(), corners.end()},
                              contact.properties,
                              p.friction,
                              cohesive ? p.cohesion : 0});
  }
  return assembly;
}

template <int Dim>
CornerProgram<Dim> corner_program(const CornerAssembly<Dim>& assembly, const std::vector<Load<Dim>>& dead,
                                  const std::vector<Load<Dim>>& live) {
  const std::vector<int> rows = rows_of(assembly);
  CornerProgram<Dim> program;
  program.right_side = program.live =
      Eigen::VectorXd::Zero(freedoms<Dim> * std::ranges::count_if(assembly.bodies, &CornerBody<Dim>::moves));
  add_loads(assembly, rows, dead, -1, program.right_side);
  add_loads(assembly, rows, live, 1, program.live);
  for_corners(assembly, [&](int f, int k, double share) {
    const CornerFace<Dim>& face = assembly.faces[f];
    program.cones.push_back(
        cone_at(assembly, rows, face, face.corners[k], std::cos(face.friction), std::sin(face.friction)));
    if (!(face.cohesion > 0)) return;
    program.cones.push_back(cone_at(assembly, rows, face, face.corners[k], 0, 1));
    program.cones.back().head = share * face.cohesion * face.area() / unit_of(assembly, face);
  });
  add_ties(assembly, rows, program);
  return program;
}

template <int Dim>
std::vector<double> sines_of_cones(const CornerAssembly<Dim>& assembly) {
  std::vector<double> sines;
  for_corners(assembly, [&](int f, int, double) {
    sines.push_back(std::sin(assembly.faces[f].friction));
    if (assembly.faces[f].cohesion > 0) sines.push_back(0);
  });
  for (const CornerTie<Dim>& tie : assembly.ties)
    sines.insert(sines.end(), tie.dowel > 0 ? 2 : 1, 0);
  return sines;
}

template <int Dim>
void add_missing_forces(const CornerAssembly<Dim>& assembly, CornerProgram<Dim>& program) {
  const std::vector<int> rows = rows_of(assembly);
  constexpr int of_a_cone = Dim - 1, cones = freedoms<Dim> / of_a_cone;
  for (std::size_t b = 0; b < rows.size(); ++b)
    for (int first = 0; rows[b] >= 0 && first < cones * of_a_cone; first += of_a_cone) {
      CornerCone<Dim> cone;
      cone.body_b = rows[b];
      cone.cost = 1;
      for (int k = 0; k < of_a_cone; ++k)
        cone.on_b(first + k, 1 + k) = assembly.bodies[b].free[first + k];
      program.cones.push_back(cone);
    }
}

template <int Dim>
void add_free_forces(const CornerAssembly<Dim>& assembly, const std::vector<std::vector<bool>>& corners,
                     const std::vector<bool>& gains, double cost, CornerProgram<Dim>& program) {
  const std::vector<int> rows = rows_of(assembly);
  for_corners(assembly, [&](int f, int k, double) {
    if (!corners[f][k]) return;
    const CornerFace<Dim>& face = assembly.faces[f];
    CornerCone<Dim> normal = cone_at(assembly, rows, face, face.corners[k], 1, 0),
                    shear = cone_at(assembly, rows, face, face.corners[k], 0, 1);
    normal.cost = shear.cost = cost;
    for (auto* on : {&normal.on_a, &normal.on_b})
      on->col(0).swap(on->col(1));
    program.cones.push_back(normal);
    if (gains[f]) program.cones.push_back(shear);
  });
}

template <int Dim>
CornerForces<Dim> corner_forces(const CornerAssembly<Dim>& assembly, const Eigen::VectorXd& x) {
  CornerForces<Dim> forces(assembly.faces.size());
  Eigen::Index at = 0;
  for_corners(assembly, [&](int f, int, double) {
    const CornerFace<Dim>& face = assembly.faces[f];
    const Matrix<Dim> axes = unit_of(assembly, face) * axes_of(face.normal);
    Vector<Dim> numbers = x.template segment<Dim>(at);
    at += Dim;
    numbers[0] *= std::cos(face.friction);
    numbers.template tail<Dim - 1>() *= std::sin(face.friction);
    if (face.cohesion > 0) {
      numbers.template tail<Dim - 1>() += x.template segment<Dim - 1>(at + 1);
      at += Dim;
    }
    forces[f].push_back(axes * numbers);
  });
  return forces;
}

template <int Dim>
std::vector<double> tensions(const CornerAssembly<Dim>& assembly, const Eigen::VectorXd& x) {
  std::vector<double> all;
  Eigen::Index at = 0;
  for_corners(assembly, [&](int f, int, double) { at += assembly.faces[f].cohesion > 0 ? 2 * Dim : Dim; });
  for (const CornerTie<Dim>& tie : assembly.ties) {
    all.push_back(tie.mean() + unit_of(assembly, tie) * x[at + 1]);
    at += tie.dowel > 0 ? 2 * Dim : Dim;
  }
  return all;
}

template <int Dim>
double out_of_balance(const CornerProgram<Dim>& program, const Eigen::VectorXd& x, double factor) {
  constexpr int rows = freedoms<Dim>;
  Eigen::VectorXd left = program.right_side - factor * program.live;
  Eigen::Index at = 0;
  for (const CornerCone<Dim>& cone : program.cones) {
    const auto numbers = x.segment<Dim>(Dim * at++);
    if (cone.body_a >= 0) left.segment<rows>(rows * cone.body_a) -= cone.on_a * numbers;
    if (cone.body_b >= 0) left.segment<rows>(rows * cone.body_b) -= cone.on_b * numbers;
  }
  return left.size() ? left.cwiseAbs().maxCoeff() : 0;
}

template <int Dim>
std::vector<BodyVelocity<Dim>> mechanism_of(const CornerAssembly<Dim>& assembly, const Eigen::VectorXd& y) {
  const std::vector<int> rows = rows_of(assembly);
  std::vector<BodyVelocity<Dim>> motions(rows.size());
  double fastest = 0;
  for (std::size_t b = 0; b < rows.size(); ++b) {
    if (rows[b] < 0) continue;
    const CornerBody<Dim>& body = assembly.bodies[b];
    const auto own = y.template segment<freedoms<Dim>>(freedoms<Dim> * rows[b]);
    for (int k = 0; k < Dim; ++k)
      if (body.free[k]) motions[b].velocity[k] = -own[k] / body.weight;
    for (int k = 0; k < spin_freedoms<Dim>; ++k)
      if (body.free[Dim + k]) motions[b].spin[k] = -own[Dim + k] / (body.weight * body.radius);
    fastest = std::max(fastest, motions[b].velocity.norm() + body.radius * motions[b].spin.norm());
  }
  for (BodyVelocity<Dim>& motion : motions)
    if (fastest > 0) {
      motion.velocity /= fastest;
      motion.spin /= fastest;
    }
  return motions;
}

template <int Dim>
std::vector<Sensitivity> sensitivity_of(const CornerAssembly<Dim>& assembly, const ConeProgramAnswer& answer) {
  const std::vector<int> rows = rows_of(assembly);
  std::vector<Sensitivity> all(assembly.faces.size());
  Eigen::Index at = 0;
  for_corners(assembly, [&](int f, int k, double share) {
    const CornerFace<Dim>& face = assembly.faces[f];
    const CornerCone<Dim> change =
        cone_at(assembly, rows, face, face.corners[k], -std::sin(face.friction), std::cos(face.friction));
    const Vector<Dim> x = answer.x.template segment<Dim>(Dim * at++);
    constexpr int rows_of_a_body = freedoms<Dim>;
    const auto power = [&](int body, const FixedMatrix<rows_of_a_body, Dim>& on) {
      return body < 0 ? 0.0 : (on * x).dot(answer.y.template segment<rows_of_a_body>(rows_of_a_body * body));
    };
    all[f].friction -= power(change.body_a, change.on_a) + power(change.body_b, change.on_b);
    if (!(face.cohesion > 0)) return;
    all[f].cohesion += answer.heads[at++] * share * face.cohesion * face.area() / unit_of(assembly, face);
  });
  return all;
}

template <int Dim>
Vector<Dim> opening_at(const CornerAssembly<Dim>& assembly, const CornerFace<Dim>& face, const Vector<Dim>& place,
                       const std::vector<BodyVelocity<Dim>>& velocities) {
  const auto velocity = [&](int body) -> Vector<Dim> {
    const BodyVelocity<Dim>& v = velocities[body];
    return v.velocity + cross(v.spin, Vector<Dim>(place - assembly.bodies[body].centroid));
  };
  return velocity(face.body_b) - velocity(face.body_a);
}

template struct CornerBody<2>;
template struct CornerFace<2>;
template CornerAssembly<2> corner_assembly(const Model<2>&, double, bool);
template CornerProgram<2> corner_program(const CornerAssembly<2>&, const std::vector<Load<2>>&,
                                         const std::vector<Load<2>>&);
template std::vector<double> sines_of_cones(const CornerAssembly<2>&);
template void add_missing_forces(const CornerAssembly<2>&, CornerProgram<2>&);
template void add_free_forces(const CornerAssembly<2>&, const std::vector<std::vector<bool>>&, const std::vector<bool>&,
                              double, CornerProgram<2>&);
template CornerForces<2> corner_forces(const CornerAssembly<2>&, const Eigen::VectorXd&);
template std::vector<double> tensions(const CornerAssembly<2>&, const Eigen::VectorXd&);
template double out_of_balance<2>(const CornerProgram<2>&, const Eigen::VectorXd&, double);
template std::vector<BodyVelocity<2>> mechanism_of(const CornerAssembly<2>&, const Eigen::VectorXd&);
template Vector<2> opening_at(const CornerAssembly<2>&, const CornerFace<2>&, const Vector<2>&,
                              const std::vector<BodyVelocity<2>>&);
template std::vector<Sensitivity> sensitivity_of(const CornerAssembly<2>&, const ConeProgramAnswer&);
template struct CornerBody<3>;
template struct CornerFace<3>;
template CornerAssembly<3> corner_assembly(const Model<3>&, double, bool);
template CornerProgram<3> corner_program(const CornerAssembly<3>&, const std::vector<Load<3>>&,
                                         const std::vector<Load<3>>&);
template std::vector<double> sines_of_cones(const CornerAssembly<3>&);
template void add_missing_forces(const CornerAssembly<3>&, CornerProgram<3>&);
template void add_free_forces(const CornerAssembly<3>&, const std::vector<std::vector<bool>>&, const std::vector<bool>&,
                              double, CornerProgram<3>&);
template CornerForces<3> corner_forces(const CornerAssembly<3>&, const Eigen::VectorXd&);
template std::vector<double> tensions(const CornerAssembly<3>&, const Eigen::VectorXd&);
template double out_of_balance<3>(const CornerProgram<3>&, const Eigen::VectorXd&, double);
template std::vector<BodyVelocity<3>> mechanism_of(const CornerAssembly<3>&, const Eigen::VectorXd&);
template Vector<3> opening_at(const CornerAssembly<3>&, const CornerFace<3>&, const Vector<3>&,
                              const std::vector<BodyVelocity<3>>&);
template std::vector<Sensitivity> sensitivity_of(const CornerAssembly<3>&, const ConeProgramAnswer&);

}  // namespace voussoir
