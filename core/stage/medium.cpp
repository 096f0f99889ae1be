#include "core/stage/medium.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/joint_laws/joint_law.hpp"
#include "core/model/body_title.hpp"

namespace voussoir {
namespace {

// stresses and strains as vectors whose products are those of the tensors: xx, yy, √2 xy; xx, yy, zz, √2 yz, …
template <int Dim>
constexpr int tensor_entries = Dim == 2 ? 3 : 6;
template <int Dim>
using TensorVector = Eigen::Matrix<double, tensor_entries<Dim>, 1, int(Eigen::DontAlign)>;
template <int Dim>
using TensorMatrix = Eigen::Matrix<double, tensor_entries<Dim>, tensor_entries<Dim>, int(Eigen::DontAlign)>;

template <int Dim>
std::pair<int, int> entry_of(int k) {
  if (k < Dim) return {k, k};
  if constexpr (Dim == 2) return {0, 1};
  const int axis = k - Dim;
  return {(axis + 1) % 3, (axis + 2) % 3};
}

template <int Dim>
TensorVector<Dim> vector_of(const Matrix<Dim>& tensor) {
  TensorVector<Dim> v;
  for (int k = 0; k < tensor_entries<Dim>; ++k) {
    const auto [i, j] = entry_of<Dim>(k);
    v[k] = i == j ? tensor(i, j) : std::sqrt(2.0) * tensor(i, j);
  }
  return v;
}

// adds the joints of a family with this normal, so many metres of area per volume
template <int Dim>
void add_family(const Vector<Dim>& normal, double per_volume, const JointProperties& p, TensorMatrix<Dim>& compliance) {
  Eigen::Matrix<double, Dim, tensor_entries<Dim>, int(Eigen::DontAlign)> traction;  // of a stress on the joint
  for (int k = 0; k < tensor_entries<Dim>; ++k) {
    const auto [i, j] = entry_of<Dim>(k);
    const double size = i == j ? 1 : std::sqrt(0.5);
    traction.col(k).setZero();
    traction(i, k) += size * normal[j];
    if (i != j) traction(j, k) += size * normal[i];
  }
  const Matrix<Dim> across = normal * normal.transpose();
  const Matrix<Dim> of_joint = across / p.normal_stiffness + (Matrix<Dim>::Identity() - across) / p.shear_stiffness;
  compliance += per_volume * (traction.transpose() * of_joint * traction);
}

template <int Dim>
std::string block_label(const Model<Dim>& model, int body) {
  return model.bodies[body].name.empty() ? fmt::format("block {} ({})", body, title_of(model, body))
                                         : "block '" + model.bodies[body].name + "'";
}

const char* const repair = "state normal_impedance and shear_impedance (Pa s/m, density times the speed of waves)";

template <int Dim>
const JointProperties& properties_of_face(const Model<Dim>& model, const Polytope<Dim>& part, int face) {
  return model.properties[model.joints[part.joints[face]].properties];
}

void demand_one_stiffness(const JointProperties& p, const char* key) {
  if (p.constant_stiffness || p.laws.depends_on_stress())
    throw ClosedSide(
        key, fmt::format("is needed: the stiffness per area of the joints '{}' is not one number; {}", p.name, repair));
  if (!(p.shear_stiffness > 0))
    throw ClosedSide(key, fmt::format("is needed: the joints '{}' have no shear stiffness; {}", p.name, repair));
}

// m: of the block along a direction
template <int Dim>
double width_along(const Polytope<Dim>& part, const Vector<Dim>& direction) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vector<Dim>& v : part.vertices) {
    low = std::min(low, direction.dot(v));
    high = std::max(high, direction.dot(v));
  }
  return high - low;
}

// the face whose joint is most nearly parallel to this one, the opposite one first; -1: no joint made a face
template <int Dim>
int nearest_joint_face(const Model<Dim>& model, const Polytope<Dim>& part, int face) {
  int found = -1;
  double most = -1;
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    const double along = -part.faces[face].normal.dot(part.faces[f].normal);
    const double close = along > 0 ? along : -0.5 * along;
    if (part.joints[f] != no_joint && !model.joints[part.joints[f]].holds && close > most) {
      most = close;
      found = static_cast<int>(f);
    }
  }
  return found;
}

}  // namespace

template <int Dim>
Vector<Dim> outward_of(const std::string& side) {
  const std::vector<std::string> names = side_names<Dim>();
  const auto number = std::ranges::find(names, side) - names.begin();
  return (number % 2 == 0 ? -1.0 : 1.0) * Vector<Dim>::Unit(number / 2);
}

template <int Dim>
std::vector<SideFace> faces_of_side(const Model<Dim>& model, const std::string& side) {
  constexpr double rounding = 1e-9;
  const Vector<Dim> n = outward_of<Dim>(side);
  double outermost = -std::numeric_limits<double>::infinity(), size = 0;
  const auto each = [&](const auto& visit) {
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const Body<Dim>& body = model.bodies[b];
      if (!body.present || body.column) continue;
      for (std::size_t p = 0; p < body.parts.size(); ++p)
        for (std::size_t f = 0; f < body.parts[p].faces.size(); ++f)
          if (body.parts[p].joints[f] == no_joint && body.parts[p].faces[f].normal.dot(n) > 1 - 1e-12 &&
              static_cast<int>(body.parts[p].loops[f].size()) >= Dim)
            visit(SideFace{static_cast<int>(b), static_cast<int>(p), static_cast<int>(f)},
                  n.dot(body.reference + body.parts[p].vertices[body.parts[p].loops[f].front()]));
    }
  };
  each([&](const SideFace& at, double place) {
    outermost = std::max(outermost, place);
    size = std::max(size, model.bodies[at.body].reference.norm() + model.bodies[at.body].radius);
  });
  std::vector<SideFace> faces;
  each([&](const SideFace& at, double place) {
    if (std::abs(place - outermost) <= rounding * size) faces.push_back(at);
  });
  return faces;
}

template <int Dim>
int face_along(const Polytope<Dim>& part, const Vector<Dim>& direction) {
  constexpr double parallel = 1 - 1e-9;
  for (std::size_t f = 0; f < part.faces.size(); ++f)
    if (part.faces[f].normal.dot(direction) > parallel) return static_cast<int>(f);
  return -1;
}

template <int Dim>
WaveStiffness<Dim> wave_stiffness(const Model<Dim>& model, const SideFace& face) {
  const Body<Dim>& body = model.bodies[face.body];
  const Polytope<Dim>& part = body.parts[face.part];
  const Vector<Dim>& n = part.faces[face.face].normal;
  TensorMatrix<Dim> compliance = TensorMatrix<Dim>::Zero();
  WaveStiffness<Dim> found;
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    const int other = face_along<Dim>(part, -part.faces[f].normal);
    found.paired = found.paired && other >= 0;
    if (part.joints[f] == no_joint || model.joints[part.joints[f]].holds) continue;
    const JointProperties& p = properties_of_face(model, part, static_cast<int>(f));
    demand_one_stiffness(p, "normal_impedance");
    const Vector<Dim>& m = part.faces[f].normal;
    // a joint between two blocks counts half for each; of a pair of which one is an outer face, whole
    const bool alone = other >= 0 && part.joints[other] == no_joint;
    const double per_volume = other >= 0 ? (alone ? 1 : 0.5) / width_along(part, m)
                                         : 0.5 * face_area(part, static_cast<int>(f)) / part.mass.volume;
    add_family<Dim>(m, per_volume, p, compliance);
  }
  constexpr int entries = tensor_entries<Dim>;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, entries, entries>> pairs(
      Eigen::Matrix<double, entries, entries>{compliance});
  const double largest = pairs.eigenvalues().maxCoeff();
  constexpr double negligible = 1e-9;
  for (int k = 0; k < Dim; ++k) {
    const Vector<Dim> e = Vector<Dim>::Unit(k);
    const Matrix<Dim> strain = 0.5 * (n * e.transpose() + e * n.transpose());
    const TensorVector<Dim> along = pairs.eigenvectors().transpose() * vector_of<Dim>(strain);
    double modulus = 0, rigid = 0;
    for (int i = 0; i < along.size(); ++i)
      if (pairs.eigenvalues()[i] > negligible * largest)
        modulus += along[i] * along[i] / pairs.eigenvalues()[i];
      else
        rigid += along[i] * along[i];
    if (!(largest > 0) || rigid > negligible)
      throw ClosedSide(std::abs(n[k]) > 0.5 ? "normal_impedance" : "shear_impedance",
                       fmt::format("is needed: no joint of {} yields to such waves along the side's normal; {}",
                                   block_label(model, face.body), repair));
    found.modulus[k] = modulus;
  }
  return found;
}

template <int Dim>
SideMedium<Dim> medium_of(const Model<Dim>& model, const std::string& side, const std::vector<SideFace>& faces,
                          const MediumPlan& plan) {
  const Vector<Dim> n = outward_of<Dim>(side);
  int axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  SideMedium<Dim> found;
  found.medium.stated = plan.normal_impedance && plan.shear_impedance;
  found.medium.regular = true;
  Vector<Dim> impedance = Vector<Dim>::Zero(), first;  // Pa s/m, means over the side
  double area = 0, mass = 0, volumes = 0;
  constexpr double same = 1e-6;
  for (const SideFace& at : faces) {
    const Body<Dim>& body = model.bodies[at.body];
    const double own = face_area(body.parts[at.part], at.face);
    area += own;
    mass += body.mass;
    volumes += volume(body);
    if (found.medium.stated) continue;
    const WaveStiffness<Dim> stiffness = wave_stiffness(model, at);
    const Vector<Dim> z = (body.mass / volume(body) * stiffness.modulus).cwiseSqrt();
    if (&at == &faces.front()) first = z;
    found.medium.regular = found.medium.regular && stiffness.paired && (z - first).norm() <= same * first.norm();
    impedance += own * z;
  }
  impedance /= area;
  for (int k = 0; k < Dim; ++k) {
    const std::optional<double>& stated = k == axis ? plan.normal_impedance : plan.shear_impedance;
    if (stated) impedance[k] = *stated;
  }
  const double density = mass / volumes;
  found.medium.normal_speed = impedance[axis] / density;
  found.medium.shear_speed = std::numeric_limits<double>::infinity();
  for (int k = 0; k < Dim; ++k)
    if (k != axis) found.medium.shear_speed = std::min(found.medium.shear_speed, impedance[k] / density);

  for (const SideFace& at : faces) {
    const Polytope<Dim>& part = model.bodies[at.body].parts[at.part];
    const int joint = nearest_joint_face(model, part, at.face);
    double normal = plan.normal_stiffness.value_or(0), shear = plan.shear_stiffness.value_or(0);
    if (!plan.normal_stiffness || !plan.shear_stiffness) {
      if (joint < 0)
        throw ClosedSide("normal_stiffness", fmt::format("is needed: no joint made a face of {}, whose stiffness it "
                                                         "would be; state normal_stiffness and shear_stiffness",
                                                         block_label(model, at.body)));
      const JointProperties& p = properties_of_face(model, part, joint);
      demand_one_stiffness(p, "normal_stiffness");
      normal = plan.normal_stiffness.value_or(p.normal_stiffness);
      shear = plan.shear_stiffness.value_or(p.shear_stiffness);
    }
    const double own = face_area(part, at.face);
    QuietPlate<Dim> plate;
    plate.impedance = own * impedance;
    plate.stiffness = Vector<Dim>::Constant(2 * shear * own);
    plate.stiffness[axis] = 2 * normal * own;
    found.plates.push_back(plate);
  }
  return found;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                              \
  template Vector<Dim> outward_of<Dim>(const std::string&);                                                    \
  template std::vector<SideFace> faces_of_side<Dim>(const Model<Dim>&, const std::string&);                    \
  template int face_along<Dim>(const Polytope<Dim>&, const Vector<Dim>&);                                      \
  template WaveStiffness<Dim> wave_stiffness<Dim>(const Model<Dim>&, const SideFace&);                         \
  template SideMedium<Dim> medium_of<Dim>(const Model<Dim>&, const std::string&, const std::vector<SideFace>&, \
                                          const MediumPlan&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
