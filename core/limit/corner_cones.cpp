#include "core/limit/corner_cones.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/key_blocks/rock_contacts.hpp"
#include "core/limit/interfaces.hpp"

namespace voussoir {
namespace {

using CornerCone = ForceCone<6, 3>;

bool any_free(const CornerBody& body) {
  return std::ranges::any_of(body.free, [](bool free) { return free; });
}

// The row of blocks of every body that is free to move; -1: held.
std::vector<int> rows_of(const CornerAssembly& assembly) {
  std::vector<int> rows;
  int count = 0;
  for (const CornerBody& body : assembly.bodies)
    rows.push_back(any_free(body) ? count++ : -1);
  return rows;
}

int count_free(const CornerAssembly& assembly) {
  return static_cast<int>(std::ranges::count_if(assembly.bodies, any_free));
}

// N: the unit of forces between two bodies is the lighter one's weight, so that no coefficient exceeds 1
double unit_of(const CornerAssembly& assembly, const CornerFace& face) {
  const auto weight = [&](int b) {
    return any_free(assembly.bodies[b]) ? assembly.bodies[b].weight : std::numeric_limits<double>::infinity();
  };
  return std::min(weight(face.body_a), weight(face.body_b));
}

// normal and two tangents
Matrix<3> axes_of(const CornerFace& face) {
  const Vector<3> first = face.normal.unitOrthogonal();
  Matrix<3> axes;
  axes << face.normal, first, face.normal.cross(first);
  return axes;
}

// what forces of these directions at a point do to a body, in its units
FixedMatrix<6, 3> on_body(const CornerBody& body, const Vector<3>& place, const Matrix<3>& forces) {
  FixedMatrix<6, 3> rows;
  for (int k = 0; k < 3; ++k) {
    rows.col(k).head<3>() = forces.col(k) / body.weight;
    rows.col(k).tail<3>() = (place - body.centroid).cross(forces.col(k)) / (body.weight * body.radius);
  }
  for (int k = 0; k < 6; ++k)
    if (!body.free[k]) rows.row(k).setZero();
  return rows;
}

// Of N/cos φ and T/sin φ, whose cone is |T| <= N tan φ with coefficients below 1 at any friction; `normal` and `shear`:
// those two factors.
CornerCone cone_at(const CornerAssembly& assembly, const std::vector<int>& rows, const CornerFace& face,
                   const Vector<3>& place, double normal, double shear) {
  CornerCone cone;
  cone.body_a = rows[face.body_a];
  cone.body_b = rows[face.body_b];
  Matrix<3> forces = unit_of(assembly, face) * axes_of(face);
  forces.col(0) *= normal;
  forces.rightCols<2>() *= shear;
  if (cone.body_a >= 0) cone.on_a = on_body(assembly.bodies[face.body_a], place, -forces);
  if (cone.body_b >= 0) cone.on_b = on_body(assembly.bodies[face.body_b], place, forces);
  return cone;
}

// Calls act(face, corner, share of the area) for every corner.
template <class Act>
void for_corners(const CornerAssembly& assembly, const Act& act) {
  for (std::size_t f = 0; f < assembly.faces.size(); ++f) {
    const std::vector<double> shares = assembly.faces[f].shares();
    for (std::size_t k = 0; k < shares.size(); ++k)
      act(static_cast<int>(f), static_cast<int>(k), shares[k]);
  }
}

void add_loads(const CornerAssembly& assembly, const std::vector<int>& rows, const std::vector<Load<3>>& loads,
               double factor, Eigen::VectorXd& sum) {
  for (std::size_t b = 0; b < loads.size(); ++b) {
    if (rows[b] < 0) continue;
    const CornerBody& body = assembly.bodies[b];
    for (int k = 0; k < 3; ++k) {
      if (body.free[k]) sum[6 * rows[b] + k] += factor * loads[b].force[k] / body.weight;
      if (body.free[3 + k]) sum[6 * rows[b] + 3 + k] += factor * loads[b].moment[k] / (body.weight * body.radius);
    }
  }
}

}  // namespace

double CornerFace::area() const {
  Vector<3> twice = Vector<3>::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    twice += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
  return 0.5 * twice.norm();
}

std::vector<double> CornerFace::shares() const {
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

CornerAssembly corner_assembly(const Model<3>& model, double acceleration, bool bonded) {
  CornerAssembly assembly;
  for (const Body<3>& body : model.bodies) {
    CornerBody of{body.reference, body.mass * acceleration, body.radius, {}};
    if (body.present && !body.fixed)
      for (int k = 0; k < 3; ++k) {
        of.free[k] = body.free_translation[k];
        of.free[3 + k] = body.free_rotation[k];
      }
    assembly.bodies.push_back(of);
  }
  assembly.properties = model.properties;
  const RockContacts<3> contacts = find_rock_contacts<3>(model);
  for (const RockContact<3>& contact : contacts.list) {
    if (!any_free(assembly.bodies[contact.body_a]) && !any_free(assembly.bodies[contact.body_b])) continue;
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

CornerProgram corner_program(const CornerAssembly& assembly, const std::vector<Load<3>>& dead,
                             const std::vector<Load<3>>& live) {
  const std::vector<int> rows = rows_of(assembly);
  CornerProgram program;
  program.right_side = program.live = Eigen::VectorXd::Zero(6 * count_free(assembly));
  add_loads(assembly, rows, dead, -1, program.right_side);
  add_loads(assembly, rows, live, 1, program.live);
  for_corners(assembly, [&](int f, int k, double share) {
    const CornerFace& face = assembly.faces[f];
    program.cones.push_back(
        cone_at(assembly, rows, face, face.corners[k], std::cos(face.friction), std::sin(face.friction)));
    if (!(face.cohesion > 0)) return;
    program.cones.push_back(cone_at(assembly, rows, face, face.corners[k], 0, 1));
    program.cones.back().head = share * face.cohesion * face.area() / unit_of(assembly, face);
  });
  return program;
}

std::vector<double> sines_of_cones(const CornerAssembly& assembly) {
  std::vector<double> sines;
  for_corners(assembly, [&](int f, int, double) {
    sines.push_back(std::sin(assembly.faces[f].friction));
    if (assembly.faces[f].cohesion > 0) sines.push_back(0);
  });
  return sines;
}

void add_missing_forces(const CornerAssembly& assembly, CornerProgram& program) {
  const std::vector<int> rows = rows_of(assembly);
  for (std::size_t b = 0; b < rows.size(); ++b)
    for (int pair = 0; rows[b] >= 0 && pair < 3; ++pair) {
      CornerCone cone;
      cone.body_b = rows[b];
      cone.cost = 1;
      for (int k = 0; k < 2; ++k)
        cone.on_b(2 * pair + k, 1 + k) = assembly.bodies[b].free[2 * pair + k];
      program.cones.push_back(cone);
    }
}

CornerForces corner_forces(const CornerAssembly& assembly, const Eigen::VectorXd& x) {
  CornerForces forces(assembly.faces.size());
  Eigen::Index at = 0;
  for_corners(assembly, [&](int f, int, double) {
    const CornerFace& face = assembly.faces[f];
    const Matrix<3> axes = unit_of(assembly, face) * axes_of(face);
    Vector<3> numbers = x.segment<3>(at);
    at += 3;
    numbers[0] *= std::cos(face.friction);
    numbers.tail<2>() *= std::sin(face.friction);
    if (face.cohesion > 0) {
      numbers.tail<2>() += x.segment<2>(at + 1);
      at += 3;
    }
    forces[f].push_back(axes * numbers);
  });
  return forces;
}

std::vector<MotionInSpace> mechanism_of(const CornerAssembly& assembly, const Eigen::VectorXd& y) {
  const std::vector<int> rows = rows_of(assembly);
  std::vector<MotionInSpace> motions(rows.size());
  double fastest = 0;
  for (std::size_t b = 0; b < rows.size(); ++b) {
    if (rows[b] < 0) continue;
    const CornerBody& body = assembly.bodies[b];
    for (int k = 0; k < 3; ++k) {
      if (body.free[k]) motions[b].velocity[k] = -y[6 * rows[b] + k] / body.weight;
      if (body.free[3 + k]) motions[b].spin[k] = -y[6 * rows[b] + 3 + k] / (body.weight * body.radius);
    }
    fastest = std::max(fastest, motions[b].velocity.norm() + body.radius * motions[b].spin.norm());
  }
  for (MotionInSpace& motion : motions)
    if (fastest > 0) {
      motion.velocity /= fastest;
      motion.spin /= fastest;
    }
  return motions;
}

std::vector<Sensitivity> sensitivity_of(const CornerAssembly& assembly, const ConeProgramAnswer& answer) {
  const std::vector<int> rows = rows_of(assembly);
  std::vector<Sensitivity> all(assembly.faces.size());
  Eigen::Index at = 0;
  for_corners(assembly, [&](int f, int k, double share) {
    const CornerFace& face = assembly.faces[f];
    const CornerCone change =
        cone_at(assembly, rows, face, face.corners[k], -std::sin(face.friction), std::cos(face.friction));
    const Vector<3> x = answer.x.segment<3>(3 * at++);
    if (change.body_a >= 0) all[f].friction -= (change.on_a * x).dot(answer.y.segment<6>(6 * change.body_a));
    if (change.body_b >= 0) all[f].friction -= (change.on_b * x).dot(answer.y.segment<6>(6 * change.body_b));
    if (!(face.cohesion > 0)) return;
    all[f].cohesion += answer.heads[at++] * share * face.cohesion * face.area() / unit_of(assembly, face);
  });
  return all;
}

}  // namespace voussoir
