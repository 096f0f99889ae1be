#include "core/key_blocks/elastic_shear.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

template <int Dim>
bool carries(const Verdict<Dim>& verdict, int face) {
  return std::find(verdict.faces.begin(), verdict.faces.begin() + verdict.loaded, face) !=
         verdict.faces.begin() + verdict.loaded;
}

}  // namespace

template <int Dim>
std::optional<Vector<Dim>> elastic_displacement(const Assembly<Dim>& assembly, const Block<Dim>& block,
                                                const BoltedVerdict<Dim>& bolted) {
  const Verdict<Dim>& verdict = bolted.verdict;
  if (verdict.kind != BlockKind::slides) return {};
  Matrix<Dim> stiffness = Matrix<Dim>::Zero();
  for (int k = 0; k < verdict.loaded; ++k) {
    const RockFace<Dim>& face = block.faces[verdict.faces[k]];
    const JointProperties& joint = assembly.model.properties[face.properties];
    if (joint.laws.depends_on_stress() || joint.constant_stiffness || !(joint.shear_stiffness > 0)) return {};
    const Matrix<Dim> along_normal = face.normal * face.normal.transpose();
    stiffness += face.area * (joint.normal_stiffness * along_normal +
                              joint.shear_stiffness * (Matrix<Dim>::Identity() - along_normal));
  }
  return Vector<Dim>(stiffness.inverse() * bolted.load);
}

template <int Dim>
std::vector<int> closed_by_elastic_shear(const Assembly<Dim>& assembly, const Block<Dim>& block,
                                         const BoltedVerdict<Dim>& bolted) {
  std::vector<int> closed;
  const std::optional<Vector<Dim>> displacement = elastic_displacement(assembly, block, bolted);
  if (!displacement) return closed;
  for (int f = 0; f < static_cast<int>(block.faces.size()); ++f)
    if (!carries(bolted.verdict, f) &&
        block.faces[f].normal.dot(*displacement) < -closing_tolerance * displacement->norm())
      closed.push_back(f);
  return closed;
}

template <int Dim>
Opening opening_angle(const Block<Dim>& block, const Verdict<Dim>& verdict) {
  Opening least;
  if (!moves(verdict.kind)) return least;
  const Vector<Dim> along = verdict.direction();
  for (int f = 0; f < static_cast<int>(block.faces.size()); ++f) {
    if (carries(verdict, f)) continue;
    const double angle = std::asin(std::clamp(block.faces[f].normal.dot(along), 0.0, 1.0));
    if (least.face < 0 || angle < least.angle) least = {f, angle};
  }
  return least;
}

template std::optional<Vector<2>> elastic_displacement<2>(const Assembly<2>&, const Block<2>&, const BoltedVerdict<2>&);
template std::optional<Vector<3>> elastic_displacement<3>(const Assembly<3>&, const Block<3>&, const BoltedVerdict<3>&);
template std::vector<int> closed_by_elastic_shear<2>(const Assembly<2>&, const Block<2>&, const BoltedVerdict<2>&);
template std::vector<int> closed_by_elastic_shear<3>(const Assembly<3>&, const Block<3>&, const BoltedVerdict<3>&);
template Opening opening_angle<2>(const Block<2>&, const Verdict<2>&);
template Opening opening_angle<3>(const Block<3>&, const Verdict<3>&);

}  // namespace voussoir
