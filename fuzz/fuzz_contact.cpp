// Bytes to the planes of two parts, these to blocks, these to a contact: every status known, every number finite, and
// all geometric invariants fulfilled.
#include <fuzzer/FuzzedDataProvider.h>

#include <algorithm>
#include <cmath>

#include "core/testing/one_pair.hpp"
#include "core/testing/shapes.hpp"
#include "fuzz/require.hpp"

namespace voussoir::fuzz {
namespace {

using contacts::Outcome;
using contacts::touch;

constexpr int most_planes = 16;  // of one part

// Normals and offsets on a coarse grid give coinciding, parallel and concurrent planes; on a fine one general position
// and near misses.
double number(FuzzedDataProvider& bytes, bool fine) {
  if (!fine) return bytes.ConsumeIntegralInRange<int>(-8, 8) / 4.0;
  return bytes.ConsumeIntegral<std::int16_t>() / 8192.0;
}

template <int Dim>
Vector<Dim> vector(FuzzedDataProvider& bytes, bool fine) {
  Vector<Dim> v;
  for (int k = 0; k < Dim; ++k)
    v[k] = number(bytes, fine);
  return v;
}

template <int Dim>
HalfSpaces<Dim> planes(FuzzedDataProvider& bytes) {
  HalfSpaces<Dim> all;
  if (bytes.ConsumeBool()) {  // a box first, so that most inputs close
    const double size = 0.25 * bytes.ConsumeIntegralInRange<int>(1, 8);
    for (int k = 0; k < Dim; ++k)
      for (const double sign : {-1.0, 1.0})
        all.push_back({sign * Vector<Dim>::Unit(k), size});
  }
  const int count = bytes.ConsumeIntegralInRange<int>(0, most_planes - static_cast<int>(all.size()));
  const bool fine = bytes.ConsumeBool();
  for (int i = 0; i < count; ++i)
    all.push_back({vector<Dim>(bytes, fine), number(bytes, fine)});
  return all;
}

// arbitrary doubles: the block must be refused, or have finite numbers
template <int Dim>
HalfSpaces<Dim> wild_planes(FuzzedDataProvider& bytes) {
  HalfSpaces<Dim> all(bytes.ConsumeIntegralInRange<int>(0, most_planes));
  for (HalfSpace<Dim>& plane : all) {
    for (int k = 0; k < Dim; ++k)
      plane.normal[k] = bytes.ConsumeFloatingPoint<double>();
    plane.offset = bytes.ConsumeFloatingPoint<double>();
  }
  return all;
}

// to turn a finding into a unit test
template <int Dim>
void print(const HalfSpaces<Dim>& planes) {
  if (!std::getenv("VOUSSOIR_FUZZ_PRINT")) return;
  for (const HalfSpace<Dim>& p : planes) {
    for (int k = 0; k < Dim; ++k)
      std::fprintf(stderr, "%.17g, ", p.normal[k]);
    std::fprintf(stderr, "offset %.17g\n", p.offset);
  }
  std::fprintf(stderr, "end of part\n");
}

template <int Dim>
BlockResult<Dim> made(const HalfSpaces<Dim>& planes) {
  return make_block<Dim>(planes, std::vector<int>(planes.size(), no_joint));
}

template <int Dim>
void require_finite(const Polytope<Dim>& part) {
  require(std::isfinite(part.mass.volume) && part.mass.volume > 0, "a block has a finite volume");
  require(part.mass.centroid.allFinite() && part.mass.second_moment.allFinite(), "a block has finite moments");
  require(std::isfinite(part.inscribed_radius) && part.inscribed_radius > 0, "a block has an inscribed radius");
  require(std::isfinite(part.radius) && part.centre.allFinite(), "a block has a finite size");
  for (const HalfSpace<Dim>& f : part.faces)
    require(f.normal.allFinite() && std::isfinite(f.offset), "faces are finite");
  for (const Vector<Dim>& v : part.vertices)
    require(v.allFinite(), "vertices are finite");
}

template <int Dim>
void require_sound(const Polytope<Dim>& part) {
  require_finite(part);
  require(part.faces.size() > Dim && part.vertices.size() > Dim, "a block is closed");
  require(part.joints.size() == part.faces.size() && part.loops.size() == part.faces.size(), "lists belong together");
  constexpr double rounding = 1e-9;  // of the extent: find_vertices merges within 1e-10 of it
  for (const HalfSpace<Dim>& f : part.faces) {
    require(std::abs(f.normal.norm() - 1) < 1e-12, "face normals are unit");
    require(-signed_distance(f, part.centre) >= (1 - rounding) * part.inscribed_radius - rounding * part.radius,
            "the inscribed ball is inside");
    for (const Vector<Dim>& v : part.vertices)
      require(signed_distance(f, v) <= rounding * part.radius, "vertices are inside");
  }
}

// the same planes at twice the size: powers of two cause no rounding
template <int Dim>
void require_scaling(const HalfSpaces<Dim>& planes, const BlockResult<Dim>& block) {
  const BlockResult<Dim> twice = made<Dim>(shapes::scaled<Dim>(planes, 2));
  require(twice.status == block.status, "scaling a block keeps its status");
  if (block.status != BlockStatus::ok) return;
  require(twice.part.inscribed_radius == 2 * block.part.inscribed_radius, "the inscribed radius scales");
  require(twice.part.mass.volume == std::pow(2, Dim) * block.part.mass.volume, "the volume scales");
}

template <int Dim>
void require_sound(const Polytope<Dim>& a, const Polytope<Dim>& b, const Matrix<Dim>& rotation,
                   const Vector<Dim>& offset, const Contact<Dim>& contact) {
  const ContactStatus status = contact.status;
  require(status == ContactStatus::separated || status == ContactStatus::undecided ||
              status == ContactStatus::touching || status == ContactStatus::no_normal,
          "every pair converges");
  if (!contact.touching()) return;
  const ContactGeometry<Dim>& g = contact.geometry;
  require(g.point.allFinite() && g.normal.allFinite() && std::isfinite(g.overlap) && std::isfinite(g.area),
          "a contact is finite");
  require(std::abs(g.normal.norm() - 1) < 1e-12, "the normal is unit");
  require(g.overlap > 0, "the overlap is positive");
  require(g.area >= 0, "the area is not negative");
  require(g.face_a >= 0 && g.face_a < static_cast<int>(a.faces.size()), "face a exists");
  require(g.face_b >= 0 && g.face_b < static_cast<int>(b.faces.size()), "face b exists");
  // the point is given in another frame than that of its computation: a few rounding errors of the coordinates
  const double rounding = 1e-14 * (a.radius + b.radius + offset.norm());
  for (const HalfSpace<Dim>& f : a.faces)
    require(signed_distance(f, g.point) < rounding, "the point is inside a");
  const Vector<Dim> seen_by_b = rotation.transpose() * (g.point - offset);
  for (const HalfSpace<Dim>& f : b.faces)
    require(signed_distance(f, seen_by_b) < rounding, "the point is inside b");
}

// gap or overlap that only rounding decides, as a fraction of the smaller inscribed radius
constexpr double undecided = 1e-9;

template <int Dim>
void require_symmetry(const Polytope<Dim>& a, const Polytope<Dim>& b, const Matrix<Dim>& rotation,
                      const Vector<Dim>& offset, const Outcome<Dim>& outcome) {
  const Matrix<Dim> back = rotation.transpose();
  const Outcome<Dim> other = touch<Dim>(b, a, back, -(back * offset));
  const ContactGeometry<Dim>&g = outcome.contact.geometry, &h = other.contact.geometry;
  const double size = std::min(a.inscribed_radius, b.inscribed_radius);
  if (std::max(g.overlap, h.overlap) < undecided * size) return;
  const bool no_direction =
      outcome.contact.status == ContactStatus::no_normal || other.contact.status == ContactStatus::no_normal;
  if (no_direction) return;  // one part deep inside the other: a tie that rounding breaks
  // the other pose is rounded again: a case that only rounding decides may have the other result
  if (other.contact.status == ContactStatus::undecided || outcome.contact.status == ContactStatus::undecided) return;
  require(other.contact.status == outcome.contact.status, "swapping the parts keeps the status");
  if (!outcome.contact.touching()) return;
  // Newton ends within 1e-5 of the local norm, whose unit ball has at most the smaller part's extent
  const double reach = std::min(a.radius + a.centre.norm(), b.radius + b.centre.norm());
  const Vector<Dim> seen_by_a = rotation * h.point + offset;
  require((seen_by_a - g.point).norm() < 1e-4 * reach, "swapping the parts keeps the point");
}

template <int Dim>
void require_scaling(const Polytope<Dim>& a, const Polytope<Dim>& b, const Matrix<Dim>& rotation,
                     const Vector<Dim>& offset, const Outcome<Dim>& outcome) {
  const Outcome<Dim> other =
      touch<Dim>(shapes::scaled_block<Dim>(a, 2), shapes::scaled_block<Dim>(b, 2), rotation, 2 * offset);
  const ContactGeometry<Dim>&g = outcome.contact.geometry, &h = other.contact.geometry;
  require(other.contact.status == outcome.contact.status, "scaling keeps the status");
  require(h.overlap == 2 * g.overlap && h.point == 2 * g.point && h.normal == g.normal, "scaling scales the contact");
  require(h.area == std::pow(2, Dim - 1) * g.area, "scaling scales the area");
}

Matrix<2> orientation(FuzzedDataProvider& bytes, Vector<2>) {
  return matrix(Rotation<2>{bytes.ConsumeIntegralInRange<int>(0, 255) * (3.14159265358979323846 / 128)});
}
Matrix<3> orientation(FuzzedDataProvider& bytes, Vector<3>) {
  Eigen::Quaterniond q(number(bytes, false), number(bytes, false), number(bytes, false), number(bytes, false));
  if (q.norm() == 0) return Matrix<3>::Identity();
  return matrix(Rotation<3>{q.normalized()});
}

// as in a body: the origin is the centroid
template <int Dim>
Polytope<Dim> centred(const Polytope<Dim>& part) {
  return moved_origin<Dim>(part, part.mass.centroid);
}

template <int Dim>
void run(FuzzedDataProvider& bytes) {
  if (bytes.ConsumeIntegralInRange<int>(0, 7) == 0) {
    const HalfSpaces<Dim> stated = wild_planes<Dim>(bytes);
    print<Dim>(stated);
    const BlockResult<Dim> block = made<Dim>(stated);
    if (block.status == BlockStatus::ok) require_finite(block.part);
    return;
  }
  std::array<Polytope<Dim>, 2> parts;
  for (Polytope<Dim>& part : parts) {
    const HalfSpaces<Dim> stated = planes<Dim>(bytes);
    print<Dim>(stated);
    const BlockResult<Dim> block = made<Dim>(stated);
    require_scaling<Dim>(stated, block);
    if (block.status != BlockStatus::ok) return;
    require_sound(block.part);
    part = centred(block.part);
  }
  const Matrix<Dim> rotation = bytes.ConsumeBool() ? orientation(bytes, Vector<Dim>()) : Matrix<Dim>::Identity();
  const Vector<Dim> offset = vector<Dim>(bytes, bytes.ConsumeBool());
  const Outcome<Dim> outcome = touch<Dim>(parts[0], parts[1], rotation, offset);
  require_sound<Dim>(parts[0], parts[1], rotation, offset, outcome.contact);
  require_scaling<Dim>(parts[0], parts[1], rotation, offset, outcome);
  require_symmetry<Dim>(parts[0], parts[1], rotation, offset, outcome);

  // one step on, from the warm start
  const Vector<Dim> moved = offset + 1e-3 * vector<Dim>(bytes, false);
  const Outcome<Dim> next = touch<Dim>(parts[0], parts[1], rotation, moved, {}, outcome.contact);
  require_sound<Dim>(parts[0], parts[1], rotation, moved, next.contact);
}

}  // namespace
}  // namespace voussoir::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace voussoir::fuzz;
  const Stopwatch stopwatch;
  FuzzedDataProvider bytes(data, size);
  if (bytes.ConsumeBool())
    run<2>(bytes);
  else
    run<3>(bytes);
  return 0;
}
