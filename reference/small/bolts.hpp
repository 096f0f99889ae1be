#pragma once

// Rock bolts over joints, closed forms (Boon 2013, sections 5.1 and 5.2). Forces in N, tension positive.
namespace voussoir::reference {

// The force of a spring of stiffness K (N/m) and length (m, > 0) with a pretension, its anchors on both sides of a
// joint that it crossed at a right angle and that has since opened and slipped (m).
double bolt_over_joint(double stiffness, double length, double pretension, double opening, double slip);

// What is left of a pretension when the joint under it (normal stiffness, Pa/m, over an area, m²) has given way.
double pretension_left(double pretension, double stiffness, double joint_stiffness, double area);

// Friction angle (rad) at which a block of a weight on a plane of a dip (rad) slides whose bolt yields at a force and
// pulls it up and into the plane at an angle to it (rad): (W sin - F cos)/(W cos + F sin).
double bolted_block_friction(double weight, double dip, double force, double angle);

}  // namespace voussoir::reference
