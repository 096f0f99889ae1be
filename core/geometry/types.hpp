// Vectors, spins and rotations for Dim = 2 and 3. Lengths in m, angles in rad.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace voussoir {

// Without the alignment that Eigen gives fixed sizes by a compiler's flags (-mavx2): a struct with such a member has
// the same layout for the library and for its users.
template <int Rows, int Columns>
using FixedMatrix =
    Eigen::Matrix<double, Rows, Columns,
                  int(Eigen::DontAlign) | int(Rows == 1 && Columns != 1 ? Eigen::RowMajor : Eigen::ColMajor)>;
using Quaternion = Eigen::Quaternion<double, Eigen::DontAlign>;

template <int Dim>
using Vector = FixedMatrix<Dim, 1>;
template <int Dim>
using Matrix = FixedMatrix<Dim, Dim>;

// one rotation in the plane, three in space
template <int Dim>
inline constexpr int spin_freedoms = Dim == 3 ? 3 : 1;

// of a rigid body: translations, then rotations
template <int Dim>
inline constexpr int freedoms = Dim + spin_freedoms<Dim>;

// rotation vector, angular velocity, angular momentum or moment
template <int Dim>
using Spin = FixedMatrix<spin_freedoms<Dim>, 1>;

// an orientation relative to the reference configuration
template <int Dim>
struct Rotation;
template <>
struct Rotation<2> {
  double angle = 0;  // rad, counter-clockwise
};
template <>
struct Rotation<3> {
  Quaternion quaternion = Quaternion::Identity();
};

// velocity of a point at lever arm r of a body that spins at w: w × r
Vector<2> cross(const Spin<2>& w, const Vector<2>& r);
Vector<3> cross(const Spin<3>& w, const Vector<3>& r);

// moment of a force at lever arm r: r × f
Spin<2> moment(const Vector<2>& r, const Vector<2>& f);
Spin<3> moment(const Vector<3>& r, const Vector<3>& f);

// the matrix that takes body axes to world axes (Eq. 3.21)
Matrix<2> matrix(const Rotation<2>& rotation);
Matrix<3> matrix(const Rotation<3>& rotation);

// the rotation followed by a turn about the given rotation vector (world axes)
Rotation<2> turned(const Rotation<2>& rotation, const Spin<2>& turn);
Rotation<3> turned(const Rotation<3>& rotation, const Spin<3>& turn);

// rotation vector of an orientation; in 3-D the short way round, length 0..pi
Spin<2> rotation_vector(const Rotation<2>& rotation);
Spin<3> rotation_vector(const Rotation<3>& rotation);

// The shortest rotation that takes the direction `from` to the direction `to`, of any lengths; of opposite directions,
// a half turn about perpendicular(from). As Eigen's FromTwoVectors, whose singular values take 5 s of each source to
// compile.
Rotation<3> rotation_onto(const Vector<3>& from, const Vector<3>& to);

// a unit vector perpendicular to a unit vector n; the axis least aligned with n seeds it, so it never vanishes
Vector<2> perpendicular(const Vector<2>& n);
Vector<3> perpendicular(const Vector<3>& n);

}  // namespace voussoir
