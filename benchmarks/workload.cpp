#include "benchmarks/workload.hpp"

#include <map>
#include <mutex>
#include <numbers>
#include <stdexcept>

namespace voussoir::benchmarks {

double unit_of(Shape shape) {
  return shape == Shape::slab_20 ? 0.05 : shape == Shape::slab_100 ? 0.01 : 1;
}

namespace {

using Parts = std::vector<Polytope<3>>;
using shapes::uniform;

constexpr int block_count = 60;                    // different joint-cut blocks
constexpr int fewest_faces = 10, most_faces = 30;  // of a joint-cut block
constexpr int most_joints = 12;                    // of a joint-cut polygon
constexpr double small_optimum = 0.5e-4, large_optimum = 0.5e-2, face_overlap = 1e-4, face_tilt = 1e-5;
constexpr std::array<double, 2> moves = {1e-6, 1e-5};
constexpr int bisections = 50;

// a box with random joints at half to five sixths of its half width cut off, scaled to circumradius 0.5
Polytope<3> joint_cut_block(Random& random) {
  while (true) {
    const HalfSpaces<3> planes = shapes::random_planes<3>(random, shapes::integer(random, fewest_faces, 40), 0.5);
    const Polytope<3> block = shapes::centred_block<3>(planes);
    if (block.faces.size() < fewest_faces || block.faces.size() > most_faces) continue;
    return shapes::centred_block<3>(shapes::scaled<3>(block.faces, 0.5 / block.radius));
  }
}

Polytope<3> prism(const HalfSpaces<2>& polygon) {
  HalfSpaces<3> planes = {{Vector<3>::UnitZ(), 0.5}, {-Vector<3>::UnitZ(), 0.5}};
  for (const HalfSpace<2>& side : polygon)
    planes.push_back({{side.normal[0], side.normal[1], 0}, side.offset});
  return shapes::block<3>(planes);
}

// circumradius 0.5 in the plane
Parts make_prisms(Shape shape) {
  if (shape == Shape::cube) return {prism(shapes::cube<2>(0.5 / std::numbers::sqrt2))};
  Random random(4200);
  Parts parts;
  for (int i = 0; i < block_count; ++i) {
    const Polytope<2> polygon =
        shapes::centred_block<2>(shapes::random_planes<2>(random, shapes::integer(random, 2, most_joints), 0.5));
    parts.push_back(prism(shapes::scaled<2>(polygon.faces, 0.5 / polygon.radius)));
  }
  return parts;
}

Parts make_parts(Shape shape, PairState state) {
  if (state == PairState::plane) return make_prisms(shape);
  switch (shape) {
    case Shape::slab_20:
      return {box({0.5, 0.5, 0.025})};
    case Shape::slab_100:
      return {box({0.5, 0.5, 0.005})};
    case Shape::block: {
      Random random(4100);
      Parts parts;
      for (int i = 0; i < block_count; ++i)
        parts.push_back(joint_cut_block(random));
      return parts;
    }
    default:
      return {platonic(static_cast<int>(shape))};
  }
}

// optimum of the feasibility program: negative if the parts overlap
double optimum(const Pair<3>& pair) {
  static HalfSpaces<3> planes;
  assemble<3>(pair, 0.5 * pair.offset, planes);
  const FeasibilityResult<3> result = solve_feasibility<3>(planes, {});
  if (result.status != FeasibilityStatus::optimal) throw std::logic_error("a benchmark pair has no LP optimum");
  return result.value;
}

// moves the second part along a direction until the optimum has a given value; returns the distance
double push_together(Pair<3>& pair, const Vector<3>& along, double value) {
  double near = 0, far = pair.a->radius + pair.b->radius + std::abs(value);
  for (int k = 0; k < bisections; ++k) {
    const double middle = 0.5 * (near + far);
    pair.offset = middle * along;
    (optimum(pair) < value ? near : far) = middle;
  }
  return 0.5 * (near + far);
}

bool boxes_meet(const Pair<3>& pair) {
  Vector<3> low_a = pair.a->vertices[0], high_a = low_a;
  for (const Vector<3>& v : pair.a->vertices)
    low_a = low_a.cwiseMin(v), high_a = high_a.cwiseMax(v);
  Vector<3> low_b = Vector<3>::Constant(1e9), high_b = -low_b;
  for (const Vector<3>& v : pair.b->vertices) {
    const Vector<3> p = pair.rotation * v + pair.offset;
    low_b = low_b.cwiseMin(p), high_b = high_b.cwiseMax(p);
  }
  return (low_a.array() <= high_b.array()).all() && (low_b.array() <= high_a.array()).all();
}

// in 3-D, or in the plane only
Vector<3> random_direction(PairState state, Random& random) {
  if (state != PairState::plane) return shapes::direction<3>(random);
  const Vector<2> d = shapes::direction<2>(random);
  return {d[0], d[1], 0};
}

Matrix<3> random_rotation(PairState state, Random& random) {
  if (state != PairState::plane) return matrix(shapes::orientation<3>(random));
  Matrix<3> turn = Matrix<3>::Identity();
  turn.topLeftCorner<2, 2>() = matrix(shapes::orientation<2>(random));
  return turn;
}

// the largest face of a slab; any face of the others
int contact_face(const Polytope<3>& part, Shape shape, Random& random) {
  if (shape != Shape::slab_20 && shape != Shape::slab_100)
    return shapes::integer(random, 0, static_cast<int>(part.faces.size()) - 1);
  int largest = 0;
  for (int i = 1; i < static_cast<int>(part.faces.size()); ++i)
    if (face_area(part, i) > face_area(part, largest)) largest = i;
  return largest;
}

Vector<3> face_middle(const Polytope<3>& part, int face) {
  Vector<3> sum = Vector<3>::Zero();
  for (const int v : part.loops[face])
    sum += part.vertices[v];
  return sum / static_cast<double>(part.loops[face].size());
}

// B's face against A's with a random spin, moved sideways by up to half an inscribed radius
void lay_face_on_face(Pair<3>& pair, Shape shape, double unit, Random& random) {
  const int on_a = contact_face(*pair.a, shape, random), on_b = contact_face(*pair.b, shape, random);
  const Vector<3> n = pair.a->faces[on_a].normal;
  const Matrix<3> against = matrix(rotation_onto(pair.b->faces[on_b].normal, -n));
  const Matrix<3> spin = Eigen::AngleAxisd(uniform(random, 0, 6), n).toRotationMatrix();
  const double angle = uniform(random, 0, 6);
  const Vector<3> t1 = perpendicular(n), t2 = n.cross(t1), sideways = std::cos(angle) * t1 + std::sin(angle) * t2;
  const Matrix<3> tilt = Eigen::AngleAxisd(face_tilt * unit, sideways).toRotationMatrix();
  pair.rotation = tilt * spin * against;
  pair.offset = face_middle(*pair.a, on_a) - pair.rotation * face_middle(*pair.b, on_b) - face_overlap * unit * n +
                uniform(random, 0, 0.5) * std::min(pair.a->inscribed_radius, pair.b->inscribed_radius) * sideways;
}

void place(Pair<3>& pair, const Workload& work, double unit, Random& random) {
  pair.rotation = random_rotation(work.state, random);
  const Vector<3> along = random_direction(work.state, random);
  switch (work.state) {
    case PairState::separated:
      pair.offset = (push_together(pair, along, 0) + uniform(random, 0.02, 0.30) * unit) * along;
      break;
    case PairState::near:
      push_together(pair, along, small_optimum * unit);
      break;
    case PairState::touch:
    case PairState::plane:
      push_together(pair, along, -small_optimum * unit);
      break;
    case PairState::face:
      lay_face_on_face(pair, work.shape, unit, random);
      break;
    case PairState::deep:
      push_together(pair, along, -large_optimum * unit);
      break;
    case PairState::solid:
      pair.offset.setZero();
      break;
  }
}

Pair<3> moved(Pair<3> pair, PairState state, double distance, Random& random) {
  pair.offset += distance * random_direction(state, random);
  const Vector<3> axis = state == PairState::plane ? Vector<3>(Vector<3>::UnitZ()) : shapes::direction<3>(random);
  pair.rotation = Eigen::AngleAxisd(distance, axis).toRotationMatrix() * pair.rotation;
  return pair;
}

Workload make_workload(Shape shape, PairState state, std::uint64_t seed, std::size_t count) {
  Workload work{shape, state, std::make_shared<const Parts>(make_parts(shape, state)), {}, {}};
  Random random(seed + 100 * static_cast<std::uint64_t>(state) + static_cast<std::uint64_t>(shape));
  const double unit = unit_of(shape);
  const int last = static_cast<int>(work.parts->size()) - 1;
  while (work.pairs.size() < count) {
    Pair<3> pair;
    pair.a = &(*work.parts)[shapes::integer(random, 0, last)];
    pair.b = &(*work.parts)[shapes::integer(random, 0, last)];
    pair.axes.setIdentity();
    place(pair, work, unit, random);
    // pairs whose boxes do not meet are never examined; the sign of the optimum must exceed any method's tolerance
    if (!boxes_meet(pair)) continue;
    const double value = optimum(pair);
    if (work.touching() ? value > -0.2 * small_optimum * unit : value < 0.2 * small_optimum * unit) continue;
    work.pairs.push_back(pair);
    for (std::size_t k = 0; k < moves.size(); ++k)
      work.previous[k].push_back(moved(pair, state, moves[k] * unit, random));
  }
  return work;
}

// a prism's sides
Polytope<2> polygon_of(const Polytope<3>& part) {
  HalfSpaces<2> sides;
  for (const HalfSpace<3>& face : part.faces)
    if (face.normal[2] == 0) sides.push_back({face.normal.head<2>(), face.offset});
  return shapes::block<2>(sides);
}

}  // namespace

bool occurs(Shape shape, PairState state) {
  if (state == PairState::plane) return shape == Shape::cube || shape == Shape::block;
  return state != PairState::solid || shape == Shape::block || static_cast<int>(shape) < platonic_count;
}

std::shared_ptr<const PlaneWorkload> in_the_plane(const Workload& work) {
  auto plane = std::make_shared<PlaneWorkload>();
  for (const Polytope<3>& part : *work.parts)
    plane->parts.push_back(polygon_of(part));
  const auto flat = [&](const std::vector<Pair<3>>& pairs) {
    std::vector<Pair<2>> list;
    for (const Pair<3>& p : pairs)
      list.push_back({&plane->parts[p.a - work.parts->data()], &plane->parts[p.b - work.parts->data()],
                      Matrix<2>::Identity(), p.rotation.topLeftCorner<2, 2>(), p.offset.head<2>()});
    return list;
  };
  plane->pairs = flat(work.pairs);
  for (std::size_t k = 0; k < moves.size(); ++k)
    plane->previous[k] = flat(work.previous[k]);
  return plane;
}

const char* name_of(Shape shape) {
  static const char* const others[] = {"joint-cut block", "slab 1:20", "slab 1:100"};
  const int kind = static_cast<int>(shape);
  return kind < platonic_count ? platonic_name(kind) : others[kind - platonic_count];
}

const char* name_of(PairState state) {
  static const char* const names[pair_state_count] = {"separated", "near", "touch", "face", "deep", "solid", "plane"};
  return names[static_cast<int>(state)];
}

const Workload& workload(Shape shape, PairState state) {
  static std::mutex mutex;
  static std::map<std::pair<Shape, PairState>, Workload> made;
  const std::lock_guard lock(mutex);
  const auto found = made.find({shape, state});
  if (found != made.end()) return found->second;
  return made.emplace(std::pair(shape, state), make_workload(shape, state, workload_seed, pairs_per_workload))
      .first->second;
}

Workload seeded_workload(Shape shape, PairState state, std::uint64_t seed, std::size_t pairs) {
  return make_workload(shape, state, seed, pairs);
}

double mean_planes(const Workload& work) {
  double sum = 0;
  for (const Pair<3>& pair : work.pairs)
    sum += static_cast<double>(pair.a->faces.size() + pair.b->faces.size());
  return sum / static_cast<double>(work.pairs.size());
}

double mean_vertices(const Workload& work) {
  double sum = 0;
  for (const Pair<3>& pair : work.pairs)
    sum += static_cast<double>(pair.b->vertices.size());
  return sum / static_cast<double>(work.pairs.size());
}

Polytope<3> box(const Vector<3>& half) {
  return shapes::centred_block<3>(shapes::box<3>(-half, half));
}

}  // namespace voussoir::benchmarks
