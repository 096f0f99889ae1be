#pragma once

#include <utility>
#include <vector>

#include "reference/wedge/wedge.hpp"

// Block theory on the blocks of a mass by enumeration: contacts by clipping face against face, motions by trying every
// face and every pair of faces and taking the one along which the load's component is largest (Goodman & Shi 1985).
namespace voussoir::reference {

struct MassFace {
  int joint = -1;                // faces of one joint are matched with each other; -1: with all others
  Vector3 outward{};             // unit normal
  std::vector<Vector3> corners;  // m, in order around the face
};

struct MassBlock {
  std::vector<MassFace> faces;  // of all its convex parts
  double volume = 0;            // m^3
  bool fixed = false;
};

struct BlockMass {
  std::vector<MassBlock> blocks;
  Vector3 load{};           // N/m^3: density times gravity
  double tan_friction = 0;  // of every joint
};

struct MassContact {
  int a = 0, b = 0;  // blocks; not both fixed
  Vector3 normal{};  // from a to b
  double area = 0;   // m^2
};

enum class MassVerdict { enclosed, tapered, stable, one_face, two_faces, falls };

struct JudgedBlock {
  MassVerdict verdict = MassVerdict::enclosed;
  Vector3 direction{};  // unit, of blocks that move without friction
  double factor = 0;    // of these; the least, if several faces share the direction

  bool moves() const { return verdict >= MassVerdict::one_face; }
};

class JudgedMass {
 public:
  explicit JudgedMass(BlockMass mass);

  const std::vector<MassContact>& contacts() const { return contacts_; }
  // free blocks that touch, each pair once
  std::vector<std::pair<int, int>> pairs() const;
  // blocks that move as one body while all others are held; `gone` by block: those removed before
  JudgedBlock judge(const std::vector<int>& blocks, const std::vector<char>& gone = {}) const;
  // Successive failure: every round removes all free blocks that move with a factor below this one.
  std::vector<std::vector<int>> rounds(double factor) const;

 private:
  BlockMass mass_;
  std::vector<MassContact> contacts_;
  std::vector<std::vector<int>> of_block_;  // contacts
  std::vector<double> surface_;             // m^2, outer faces
};

}  // namespace voussoir::reference
