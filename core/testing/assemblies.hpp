// Random bodies with random contacts between them, and the frequency of the stiffest of their modes.
#pragma once

#include "core/model/state.hpp"
#include "core/testing/dense.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::shapes {

// the range of an assembly's properties, in decades
struct Spread {
  double edges = 1.5;    // of a block's edges
  double density = 0;    // of the blocks' densities
  double stiffness = 0;  // of normal over shear stiffness; 0: 5 : 2 and 1 : 3
};

// a box with random edges and principal axes, as in the step: without faces
template <int Dim>
Body<Dim> random_body(Random& random, const Spread& spread) {
  Vector<Dim> half;
  for (int k = 0; k < Dim; ++k)
    half[k] = power_of_ten(random, 0.5 - spread.edges, 0.5);
  Body<Dim> body;
  body.parts.resize(1);
  const double density = 2500 * std::pow(10, spread.density * uniform(random, -0.5, 0.5));
  body.mass = density * half.prod() * (1 << Dim);
  const Vector<Dim> squares = half.cwiseAbs2();
  for (int k = 0; k < spin_freedoms<Dim>; ++k)
    body.inertia[k] = body.mass / 3 * (squares.sum() - (Dim == 3 ? squares[k] : 0));
  body.principal_axes = matrix(orientation<Dim>(random));
  body.reference = 3 * normal_vector<Dim>(random);
  body.radius = half.norm();
  body.free_translation.fill(true);
  body.free_rotation.fill(true);
  return body;
}

// relative velocity at a contact: columns of one body's degrees of freedom, expanded from the cross product
template <int Dim>
auto velocity_at(const Vector<Dim>& arm) {
  Eigen::Matrix<double, Dim, Dim + spin_freedoms<Dim>> j;
  for (int k = 0; k < Dim; ++k)
    j.col(k) = Vector<Dim>::Unit(k);
  for (int k = 0; k < spin_freedoms<Dim>; ++k)
    j.col(Dim + k) = cross(Spin<Dim>(Spin<Dim>::Unit(k)), arm);
  return j;
}

// as the step would have computed them
template <int Dim>
void set_contacts(const Model<Dim>& model, const std::vector<Contact<Dim>>& contacts, State<Dim>& state) {
  state.contacts.list = contacts;
  cache_poses(model, 1, state.bodies);
  list_by_body(model, state.contacts);
}

// random bodies, the last of them fixed, with random contacts between them; every free body has one
template <int Dim>
struct RandomAssembly {
  Model<Dim> model;
  State<Dim> state;
  int free;

  RandomAssembly(Random& random, int free_bodies, int fixed, int contacts, const Spread& spread = {})
      : free(free_bodies) {
    for (int b = 0; b < free + fixed; ++b) {
      model.bodies.push_back(random_body<Dim>(random, spread));
      model.bodies.back().fixed = b >= free;
    }
    list_parts(model);
    model.properties = {{"hard", 5e9, 2e9, 0.5, false}, {"soft", 1e8, 3e8, 0.5, true}};
    if (spread.stiffness > 0)
      for (JointProperties& p : model.properties)
        p.shear_stiffness = p.normal_stiffness * power_of_ten(random, -spread.stiffness, 0);
    state = initial_state(model);
    for (Motion<Dim>& m : state.bodies.motions) {
      m.rotation = orientation<Dim>(random);
      m.displacement = 0.01 * normal_vector<Dim>(random);
    }
    std::vector<Contact<Dim>> made;
    while (static_cast<int>(made.size()) < contacts) {
      const int place = static_cast<int>(made.size());
      const int a = place < free ? place : integer(random, 0, free - 1);
      Contact<Dim> c;
      c.part_a = a;
      c.part_b = integer(random, a + 1, free + fixed - 1);
      c.status = ContactStatus::touching;
      c.properties = integer(random, 0, 1);
      c.geometry.point = uniform(random, 0.2, 1) * model.bodies[a].radius * direction<Dim>(random);
      c.geometry.normal = direction<Dim>(random);
      c.geometry.area = power_of_ten(random, -2, 0);
      made.push_back(c);
    }
    set_contacts(model, made, state);
  }

  // stiffest square frequency of all free bodies together, every coupling included
  double largest_eigenvalue() const {
    constexpr int size = Dim + spin_freedoms<Dim>;
    Eigen::MatrixXd scaled = Eigen::MatrixXd::Zero(free * size, free * size);
    for (const Contact<Dim>& c : state.contacts.list) {
      const JointProperties& p = model.properties[c.properties];
      const Matrix<Dim> nn = c.geometry.normal * c.geometry.normal.transpose();
      const Matrix<Dim> k = (p.constant_stiffness ? 1 : c.geometry.area) *
                            (p.normal_stiffness * nn + p.shear_stiffness * (Matrix<Dim>::Identity() - nn));
      const auto centroid = [&](int b) -> Vector<Dim> {
        return model.bodies[b].reference + state.bodies.motions[b].displacement;
      };
      Eigen::MatrixXd j = Eigen::MatrixXd::Zero(Dim, free * size);
      j.middleCols<size>(c.part_a * size) = -velocity_at<Dim>(c.geometry.point) * root_of_inverse_mass(c.part_a);
      if (c.part_b < free)
        j.middleCols<size>(c.part_b * size) =
            velocity_at<Dim>(c.geometry.point + centroid(c.part_a) - centroid(c.part_b)) *
            root_of_inverse_mass(c.part_b);
      scaled += j.transpose() * k * j;
    }
    return oracle::largest_eigenvalue(scaled);
  }

 private:
  auto root_of_inverse_mass(int b) const {
    constexpr int size = Dim + spin_freedoms<Dim>;
    const Body<Dim>& body = model.bodies[b];
    Eigen::Matrix<double, size, size> root = Eigen::Matrix<double, size, size>::Zero();
    root.template topLeftCorner<Dim, Dim>() = Matrix<Dim>::Identity() / std::sqrt(body.mass);
    if constexpr (Dim == 3) {
      const Matrix<3> axes = matrix(state.bodies.motions[b].rotation) * body.principal_axes;
      root.template bottomRightCorner<3, 3>() =
          axes * body.inertia.cwiseSqrt().cwiseInverse().asDiagonal() * axes.transpose();
    } else {
      root(2, 2) = 1 / std::sqrt(body.inertia[0]);
    }
    return root;
  }
};

}  // namespace voussoir::shapes
