#include "reference/key_blocks/judged_mass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "reference/key_blocks/eigen_vectors.hpp"
#include "reference/require.hpp"

namespace voussoir::reference {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr Require mass_requires{"judged mass: "};

constexpr double parallel = 1e-9;      // sine: faces of one direction, and of none between them
constexpr double in_plane = 1e-7;      // m: distance of faces that touch
constexpr double no_area = 1e-9;       // of the smaller face
constexpr double closed_share = 1e-9;  // of its surface that an enclosed block may leave free
constexpr double no_force = 1e-9;      // of the load

// a face in the plane's coordinates, counter-clockwise
using Outline = std::vector<Vector2d>;

double area_of(const Outline& outline) {
  double twice = 0;
  for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
    const Vector2d a = outline[k] - outline[0], b = outline[k + 1] - outline[0];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

struct Frame {
  Vector3d first, second;

  explicit Frame(const Vector3d& normal) {
    const Vector3d helper = std::abs(normal.x()) < 0.7 ? Vector3d::UnitX() : Vector3d::UnitY();
    first = normal.cross(helper).normalized();
    second = normal.cross(first);
  }
  Outline outline(const MassFace& face, const Vector3d& origin) const {
    Outline flat;
    for (const Vector3& corner : face.corners) {
      const Vector3d p = to_eigen(corner) - origin;
      flat.emplace_back(first.dot(p), second.dot(p));
    }
    if (area_of(flat) < 0) std::reverse(flat.begin(), flat.end());
    return flat;
  }
};

// Sutherland & Hodgman
Outline clip(Outline outline, const Outline& by) {
  for (std::size_t e = 0; e < by.size() && !outline.empty(); ++e) {
    const Vector2d from = by[e], along = by[(e + 1) % by.size()] - from;
    const auto left = [&](const Vector2d& p) { return along.x() * (p - from).y() - along.y() * (p - from).x(); };
    Outline kept;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const Vector2d &p = outline[k], &q = outline[(k + 1) % outline.size()];
      const double at_p = left(p), at_q = left(q);
      if (at_p >= 0) kept.push_back(p);
      if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) kept.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    outline = std::move(kept);
  }
  return outline;
}

struct Placed {
  const MassFace* face;
  int block;
  Vector3d outward, low, high;
  double offset, area;
};

Placed place(const MassFace& face, int block) {
  mass_requires(face.corners.size() >= 3, "a face has at least three corners");
  Placed placed{&face, block, to_eigen(face.outward), to_eigen(face.corners[0]), to_eigen(face.corners[0]), 0, 0};
  for (const Vector3& corner : face.corners) {
    placed.low = placed.low.cwiseMin(to_eigen(corner));
    placed.high = placed.high.cwiseMax(to_eigen(corner));
  }
  placed.offset = placed.outward.dot(to_eigen(face.corners[0]));
  placed.area = area_of(Frame(placed.outward).outline(face, to_eigen(face.corners[0])));
  return placed;
}

double shared_area(const Placed& a, const Placed& b) {
  if ((a.outward + b.outward).norm() > parallel || std::abs(a.offset + b.offset) > in_plane) return 0;
  if (((a.low - b.high).array() > in_plane).any() || ((b.low - a.high).array() > in_plane).any()) return 0;
  const Frame frame(a.outward);
  const Vector3d origin = to_eigen(a.face->corners[0]);
  const double area = area_of(clip(frame.outline(*a.face, origin), frame.outline(*b.face, origin)));
  return area > no_area * std::min(a.area, b.area) ? area : 0;
}

bool opens_all(const std::vector<Vector3d>& normals, const Vector3d& unit) {
  return std::all_of(normals.begin(), normals.end(), [&](const Vector3d& n) { return n.dot(unit) >= -parallel; });
}

bool is_open(const std::vector<Vector3d>& normals) {
  bool spans = false;
  for (std::size_t i = 0; i < normals.size(); ++i)
    for (std::size_t j = i + 1; j < normals.size(); ++j) {
      Vector3d line = normals[i].cross(normals[j]);
      if (line.norm() < parallel) continue;
      line.normalize();
      if (opens_all(normals, line) || opens_all(normals, -line)) return true;
      for (const Vector3d& n : normals)
        spans |= std::abs(n.dot(line)) > parallel;
    }
  return !spans;
}

struct Candidate {
  Vector3d unit;
  double along, pressing;  // components of the load: along it, and the sum of normal forces
  MassVerdict verdict;
};

// every direction in which the load can push the block, with normal forces that press
std::vector<Candidate> candidates(const std::vector<Vector3d>& normals, const Vector3d& load) {
  std::vector<Candidate> found;
  const double smallest = no_force * load.norm();
  const auto attempt = [&](const Vector3d& motion, double pressing, MassVerdict verdict) {
    if (motion.norm() <= smallest) return;
    const Vector3d unit = motion.normalized();
    if (opens_all(normals, unit)) found.push_back({unit, load.dot(unit), pressing, verdict});
  };
  attempt(load, 0, MassVerdict::falls);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const double force = -normals[i].dot(load);
    if (force > smallest) attempt(load + force * normals[i], force, MassVerdict::one_face);
    for (std::size_t j = i + 1; j < normals.size(); ++j) {
      const double cosine = normals[i].dot(normals[j]), sine_squared = normals[i].cross(normals[j]).squaredNorm();
      if (sine_squared < parallel * parallel) continue;
      const double a = -normals[i].dot(load), b = -normals[j].dot(load);
      const double force_i = (a - cosine * b) / sine_squared, force_j = (b - cosine * a) / sine_squared;
      if (force_i > smallest && force_j > smallest)
        attempt(load + force_i * normals[i] + force_j * normals[j], force_i + force_j, MassVerdict::two_faces);
    }
  }
  return found;
}

}  // namespace

JudgedMass::JudgedMass(BlockMass mass) : mass_(std::move(mass)), of_block_(mass_.blocks.size()) {
  mass_requires(to_eigen(mass_.load).norm() > 0 && std::isfinite(mass_.tan_friction),
                "a load and a friction are needed");
  std::map<int, std::vector<Placed>> by_joint;
  for (int b = 0; b < static_cast<int>(mass_.blocks.size()); ++b) {
    surface_.push_back(0);
    for (const MassFace& face : mass_.blocks[b].faces) {
      by_joint[face.joint].push_back(place(face, b));
      surface_[b] += by_joint[face.joint].back().area;
    }
  }
  const auto compare = [&](const Placed& first, const Placed& second) {
    if (mass_.blocks[first.block].fixed && mass_.blocks[second.block].fixed) return;
    const double area = shared_area(first, second);
    if (area == 0) return;
    if (first.block == second.block) {
      surface_[first.block] -= 2 * area;
      return;
    }
    of_block_[first.block].push_back(static_cast<int>(contacts_.size()));
    of_block_[second.block].push_back(static_cast<int>(contacts_.size()));
    contacts_.push_back({first.block, second.block, first.face->outward, area});
  };
  const std::vector<Placed> without = by_joint[-1];
  for (const auto& [joint, faces] : by_joint)
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (std::size_t j = i + 1; j < faces.size(); ++j)
        compare(faces[i], faces[j]);
      if (joint != -1)
        for (const Placed& other : without)
          compare(faces[i], other);
    }
}

std::vector<std::pair<int, int>> JudgedMass::pairs() const {
  std::vector<std::pair<int, int>> found;
  for (const MassContact& contact : contacts_)
    if (!mass_.blocks[contact.a].fixed && !mass_.blocks[contact.b].fixed)
      found.push_back(std::minmax({contact.a, contact.b}));
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

JudgedBlock JudgedMass::judge(const std::vector<int>& blocks, const std::vector<char>& gone) const {
  const auto inside = [&](int block) { return std::find(blocks.begin(), blocks.end(), block) != blocks.end(); };
  std::vector<Vector3d> normals;
  double surface = 0, touching = 0, volume = 0;
  for (const int block : blocks) {
    surface += surface_[block];
    volume += mass_.blocks[block].volume;
    for (const int place : of_block_[block]) {
      const MassContact& contact = contacts_[place];
      const int other = contact.a == block ? contact.b : contact.a;
      if (inside(other)) {
        surface -= contact.area;  // seen from both blocks
        continue;
      }
      if (!gone.empty() && gone[other]) continue;
      touching += contact.area;
      const Vector3d n = (contact.a == block ? -1 : 1) * to_eigen(contact.normal);
      if (std::none_of(normals.begin(), normals.end(), [&](const Vector3d& m) { return (m - n).norm() <= parallel; }))
        normals.push_back(n);
    }
  }
  JudgedBlock judged;
  if (surface - touching < closed_share * surface) return judged;
  const Vector3d load = volume * to_eigen(mass_.load);
  const std::vector<Candidate> tried = candidates(normals, load);
  if (tried.empty()) {
    judged.verdict = is_open(normals) ? MassVerdict::stable : MassVerdict::tapered;
    return judged;
  }
  const Candidate& best = *std::max_element(tried.begin(), tried.end(),
                                            [](const Candidate& a, const Candidate& b) { return a.along < b.along; });
  judged.verdict = best.verdict;
  judged.direction = {best.unit.x(), best.unit.y(), best.unit.z()};
  judged.factor = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : tried)
    if ((candidate.unit - best.unit).norm() <= 100 * parallel) {
      const double factor = candidate.pressing * mass_.tan_friction / candidate.along;
      if (factor >= judged.factor) continue;
      judged.factor = factor;
      judged.verdict = candidate.verdict;
    }
  return judged;
}

std::vector<std::vector<int>> JudgedMass::rounds(double factor) const {
  std::vector<std::vector<int>> all;
  std::vector<char> gone(mass_.blocks.size(), 0);
  std::vector<int> waiting;
  for (int b = 0; b < static_cast<int>(mass_.blocks.size()); ++b)
    if (!mass_.blocks[b].fixed) waiting.push_back(b);
  while (true) {
    std::vector<int> failed;
    for (const int block : waiting) {
      const JudgedBlock judged = judge({block}, gone);
      if (judged.moves() && judged.factor < factor) failed.push_back(block);
    }
    if (failed.empty()) return all;
    for (const int block : failed)
      gone[block] = 1;
    std::vector<int> next;
    for (const int block : failed)
      for (const int place : of_block_[block])
        for (const int other : {contacts_[place].a, contacts_[place].b})
          if (!gone[other] && !mass_.blocks[other].fixed) next.push_back(other);
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    waiting = std::move(next);
    all.push_back(std::move(failed));
  }
}

}  // namespace voussoir::reference
