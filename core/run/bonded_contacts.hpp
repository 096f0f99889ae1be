// The largest number of bonds that each contact has had, from which the remaining fraction of the bonded area follows.
#pragma once

#include <vector>

#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/stage/excavation.hpp"

namespace voussoir {

struct BondedContact {
  int part_a = 0, part_b = 0;
  int joint = 0;  // of Model::joints, or no_joint
  long long bonds = 0;
  double area = 0;  // m², of these bonds when none was lost; for a constant stiffness, whose area is never computed, 1
};

// by (part a, part b)
struct BondedContacts {
  std::vector<BondedContact> contacts;
  long long made = 0;  // BondTally::made at the last update
};

// Updates all contacts: new bonds are recorded, areas renewed.
template <int Dim>
void remember_bonds(const Model<Dim>& model, const State<Dim>& state, BondedContacts& bonded);

// the contacts' new parts after an excavation; excavated ones are removed
template <int Dim>
void carry(const Excavated<Dim>& moved, BondedContacts& bonded);

struct JointBonds {
  int joint = 0;  // of Model::joints, or no_joint
  long long whole = 0, slipped = 0, made = 0;
  double held_area = 0, made_area = 0;  // as in BondedContact; held: not lost
};

// by joint, ascending, of present bodies; `bonded` has the bonds of this state
template <int Dim>
std::vector<JointBonds> bonds_by_joint(const Model<Dim>& model, const State<Dim>& state, const BondedContacts& bonded);

}  // namespace voussoir
