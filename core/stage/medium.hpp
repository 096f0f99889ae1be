// The rock beyond a side as waves see it: a mass of rigid blocks whose joints give it its stiffness.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "core/model/model.hpp"

namespace voussoir {

// why a side cannot be opened, as a clause with the repair, and the key of its plan that it concerns
struct ClosedSide : std::runtime_error {
  std::string key;
  ClosedSide(std::string of_key, const std::string& why) : std::runtime_error(why), key(std::move(of_key)) {}
};

// an outer face of a body on a side of the model
struct SideFace {
  int body = 0, part = 0, face = 0;
};

// the outward normal of a side of the model, an axis
template <int Dim>
Vector<Dim> outward_of(const std::string& side);

// the outer faces on a side, by body
template <int Dim>
std::vector<SideFace> faces_of_side(const Model<Dim>& model, const std::string& side);

// the part's face with this outward normal, unit; -1: none
template <int Dim>
int face_along(const Polytope<Dim>& part, const Vector<Dim>& direction);

// Pa along the columns of the identity: n·C·n of the mass of which a block with a face on a side is a sample, for waves
// along the side's normal n. The compliances of the joint families add up, each by 1/(k a) of its spacing a (Gerrard
// 1982, Amadei & Goodman 1981), for oblique families too; the coupling of compression and shear is left out. Square
// grid: kn a, and ks a/2 because the joints of both families shear. `paired`: every face has an opposite one.
// Throws ClosedSide if some of these waves would meet no joint.
template <int Dim>
struct WaveStiffness {
  Vector<Dim> modulus;
  bool paired = true;
};
template <int Dim>
WaveStiffness<Dim> wave_stiffness(const Model<Dim>& model, const SideFace& face);

// The medium beyond a side with these faces, and the plate of each.
template <int Dim>
struct SideMedium {
  Medium medium;
  std::vector<QuietPlate<Dim>> plates;
};
template <int Dim>
SideMedium<Dim> medium_of(const Model<Dim>& model, const std::string& side, const std::vector<SideFace>& faces,
                          const MediumPlan& plan);

}  // namespace voussoir
