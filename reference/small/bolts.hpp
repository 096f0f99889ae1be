#pragma once

// Rock bolts over joints, closed forms (Boon 2013, sections 5.1 and 5.2). Forces in N, tension positive.
namespace voussoir::reference {

// The force of a spring of stiffness K (N/m) and length (m, > 0) with a pretension, its anchors on both sides of a
// joint that it crossed at a right angle and that has since opened and slipped (m).
double bolt_over_joint(double stiffness, double length, double pretension, double opening, double slip);

// The remaining pretension when the joint under it (normal stiffness, Pa/m, over an area, m²) has closed.
double pretension_left(double pretension, double stiffness, double joint_stiffness, double area);

// Friction angle (rad) at which a block of a weight on a plane of a dip (rad) slides if its bolt yields at a force and
// pulls it up and into the plane at an angle to it (rad): (W sin - F cos)/(W cos + F sin).
double bolted_block_friction(double weight, double dip, double force, double angle);

// A bar of axial stiffness EA (N) in a bond of stiffness k (N/m² of bar length and slip): EA u" = k u.
// Stiffness (N/m) of a length (m) of it, free at its end, against being pulled out of rock: √(EA k) tanh(l √(k/EA)).
double pull_out_stiffness(double axial_stiffness, double bond_stiffness, double length);

// Force of a bar that is long on both sides of a joint that has opened (m), under a bond of strength S (N/m): ½ √(EA k)
// w, and for w > 2S/k, as both sides slip, √(EA S (w - S/k)): over a slipping length a, behind it the bond at its
// strength, N = √(EA/k) S + S a and w/2 = S/k + √(EA/k) S a/EA + S a²/2EA. A rigid bond has √(EA S w).
double bar_over_opening(double axial_stiffness, double bond_stiffness, double bond_strength, double opening);

}  // namespace voussoir::reference
