#pragma once

// A wedge in a symmetric groove: what its friction law decides. SI units, radians.
//
// Each plane of the groove is at the angle a from the groove's plane of symmetry, its line dips by p, the weight is W.
// With N the normal force and t the friction across the groove of each plane, pressing the wedge in,
//   N = W cos p/(2 (sin a - t/N cos a)),
// and the friction along the groove has to carry W sin p/2 on each plane.
namespace voussoir::reference {

struct Groove {
  double half_angle = 0.78539816339744831;  // a, 0 < a <= pi/2
  double plunge = 0;                        // p, 0 < p < pi/2
};

// Nothing acts across, as when it slides: tan phi = sin a tan p.
double sliding_friction(const Groove& groove);

// The least friction angle at which an equilibrium exists, friction acting in any direction (limit analysis; joints
// that dilate): tan phi = sin a tan p/(1 + tan^2 p cos^2 a)^1/2.
double least_groove_friction(const Groove& groove);

}  // namespace voussoir::reference
