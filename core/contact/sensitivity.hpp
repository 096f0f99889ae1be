// How a contact's point, normal, overlap and area change as the second body moves against the first: the derivatives of
// the kernel's results, in closed form.
//
// If the second body moves by v(x) = t + w × (x - c), its planes b·x <= e turn by w × b and their slacks at x grow
// by b·v(x). The analytic centre keeps Σ a/s = 0, so that with the barrier's Hessian H = Σ a aᵀ/s²
//
//   H dx = Σ_B ( b (b·v)/s² - (w × b)/s ),
//
// and normal, overlap and section follow from dx by the chain rule over Eqs 3.31-3.36 and appendix D. When the planes
// that take part change (a face leaves the potential particle's radius, the searches end on another face, the section
// gains a corner) the derivative is that of the present planes.
#pragma once

#include "core/base/settings.hpp"
#include "core/contact/contact.hpp"
#include "core/contact/pair.hpp"

namespace voussoir {

// By motion of the second body: translations along, then turns about, the world's axes through its centroid; m and rad.
// Point and normal in the first body's frame.
template <int Dim>
struct ContactSensitivity {
  FixedMatrix<Dim, freedoms<Dim>> point, normal;  // m/m and m/rad; 1/m and 1/rad
  FixedMatrix<1, freedoms<Dim>> overlap, area;    // the area's: m²/m and m²/rad (2-D: m/m and m/rad)
};

// Whether these settings' point, normal and overlap have one: analytic centre, potential particles, closed form.
bool has_sensitivity(const ContactSettings& settings);

// Of a touching pair that is resolved to QueryLevel::area; needs contact.geometry and contact.proof of this pose. False
// if it has none: a region too thin for its Hessian, or a number that is not finite.
template <int Dim>
bool find_sensitivity(const Pair<Dim>& pair, const ContactSettings& settings, const Contact<Dim>& contact,
                      ContactSensitivity<Dim>& sensitivity);

}  // namespace voussoir
