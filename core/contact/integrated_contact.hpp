// An integrated face contact: the overlap of two parts as a spring with stiffness per area, in place of the force at
// one point. If two faces rest on each other, exactly over their contact polygon (face_integral.hpp); otherwise by the
// depth of the overlap (region_integral.hpp). Between both energies, E_f and E_r, r = E_r / E_f,
//
//   E = E_f g(r),   g = 1 within 7 % of r = 1, g = r beyond 20 %, a cubic without a kink between,
//
// so that a face that rocks onto its edge, and further onto its corner, has a single energy, whose derivative the force
// is: F = (g - r g') F_f + g' F_r, and the moment likewise.
#pragma once

#include <span>

#include "core/contact/contact.hpp"
#include "core/contact/face_sensitivity.hpp"
#include "core/contact/pair.hpp"
#include "core/joint_laws/face_friction.hpp"

namespace voussoir {

// Forces and moments over the normal stiffness k, Pa/m. World axes; places relative to the first body's centroid.
template <int Dim>
struct IntegratedContact {
  bool flat = false;                         // two faces press: shear acts on their polygon, and twist with it
  Vector<Dim> normal = Vector<Dim>::Zero();  // of the plane that shear acts in, from the first to the second, unit
  Vector<Dim> centre = Vector<Dim>::Zero();  // point of action: centre of the polygon, else of the pressure, m
  Vector<Dim> force = Vector<Dim>::Zero();   // on the second part, at the contact's point, m³
  Spin<Dim> couple = Spin<Dim>::Zero();      // and the moment besides, m⁴
  double square = 0;                         // 2 E / k, m⁴
  double polar = 0;                          // twisting stiffness over the shear stiffness, m⁴; 0: none
  double gyration2 = 0;                      // m²: bound of the contact's part in rocking and spin about its point
  PressedPolygon polygon;                    // flat, in space
};

// The faces of a touching pair that may rest on each other: of each part the one nearest to a point in the overlap, its
// analytic centre (contact.proof.point), into contact.geometry. `planes`: of both parts as seen from there, the first
// part's first.
template <int Dim>
void find_nearest_faces(const Pair<Dim>& pair, Contact<Dim>& contact, HalfSpaces<Dim>& planes);

// Needs the result of that. The geometry becomes that of the integrated contact: the centre of pressure, the force's
// direction, the area, and the mean overlap, which times k and the area is the force; the faces are kept. Without
// pressure, area, overlap and force are zero. False: more planes bound the overlap than integrate_region takes.
template <int Dim>
bool integrate_contact(const Pair<Dim>& pair, const HalfSpaces<Dim>& planes, Contact<Dim>& contact,
                       IntegratedContact<Dim>& face);

// The same without the kernel, of a contact that was pressed before: if its faces still rest on each other, wide
// compared with their overlap, no others can. False, without a result, if that is not so. Its proof is then the centre
// of the polygon, inside of all planes by more than rounding.
template <int Dim>
bool integrate_as_before(const Pair<Dim>& pair, Contact<Dim>& contact, IntegratedContact<Dim>& face);

// A contact after each of a few small motions, to first order in them: `moved` are the pair after them, `contacts` and
// `faces` the results.
template <int Dim>
void integrate_moved(const Pair<Dim>& pair, const Contact<Dim>& contact, const IntegratedContact<Dim>& face,
                     std::span<const Pair<Dim>> moved, std::span<Contact<Dim>> contacts,
                     std::span<IntegratedContact<Dim>> faces);

// How it changes as the second body moves, m and rad, world axes through that body's centroid; directions in world
// axes, the moment about contact.proof.point. False, without a result, if not faces alone press, wide compared with
// their overlap.
template <int Dim>
bool find_sensitivity(const Pair<Dim>& pair, const Contact<Dim>& contact, FaceSensitivity<Dim>& sensitivity);

// the contact after the second body has moved by `step` along a degree of freedom, to first order; `contact` and `face`
// are those from which it moves, or moved from there
template <int Dim>
void move_by(const Pair<Dim>& pair, const FaceSensitivity<Dim>& sensitivity, int freedom, double step,
             Contact<Dim>& contact, IntegratedContact<Dim>& face);

}  // namespace voussoir
