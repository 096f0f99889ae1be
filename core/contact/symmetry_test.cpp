// Changes that must not affect the kernel's result: the order of a block's planes, the unit of length, the axes, which
// block comes first, the batch that it is resolved in, the width of the machine's registers. Row L9 of the catalogue of
// extremes, on the families of certainty_test.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <bit>
#include <iostream>
#include <numeric>
#include <span>

#include "core/base/version.hpp"
#include "core/contact/contact_between.hpp"
#include "core/contact/kernel/kernel.hpp"
#include "core/slicing/block.hpp"
#include "core/testing/contacts.hpp"
#include "core/testing/pair_families.hpp"

namespace voussoir::symmetry_test {
namespace {

using families::Case;
using shapes::integer;
using shapes::Random;

constexpr std::uint64_t seed = 20241;
constexpr double ulp = std::numeric_limits<double>::epsilon();

// the permitted difference of a turned or rescaled pair, in fractions of its size (radius of A + radius of B)
constexpr double turned_rounding = 16 * ulp, other_rounding = 64 * ulp;

// the point is then as exact as its slacks: the comparison is of rounding, not of the stop rule
constexpr ContactSettings reference{.newton_tolerance = 1e-9};

template <int Dim>
struct Posed {
  Polytope<Dim> a, b;
  Matrix<Dim> rotation;
  Vector<Dim> offset;

  double size() const { return a.radius + b.radius; }
};

template <int Dim>
Polytope<Dim> block_of(const HalfSpaces<Dim>& planes) {
  return shapes::block<Dim>(planes);
}

template <int Dim>
Contact<Dim> resolve(const Posed<Dim>& p, const ContactSettings& settings = {}) {
  return contacts::touch<Dim>(p.a, p.b, p.rotation, p.offset, settings).contact;
}

template <int Dim>
Posed<Dim> posed(const Case<Dim>& c) {
  return {block_of<Dim>(c.a.faces), block_of<Dim>(c.b.faces), c.rotation, c.offset};
}

// ---- bits -----------------------------------------------------------------------------------------------------------

using Bits = std::vector<std::uint64_t>;

void add(Bits& bits, double value) {
  bits.push_back(std::bit_cast<std::uint64_t>(value));
}

template <int Dim>
void add(Bits& bits, const Vector<Dim>& v, double factor) {
  for (int k = 0; k < Dim; ++k)
    add(bits, v[k] * factor);
}

// All numbers that the kernel writes, lengths times a power of two. Unset places of lists are not compared.
template <int Dim>
Bits bits_of(const Contact<Dim>& c, double unit = 1) {
  Bits bits{static_cast<std::uint64_t>(c.status), static_cast<std::uint64_t>(c.proof.kind),
            static_cast<std::uint64_t>(c.geometry.face_a), static_cast<std::uint64_t>(c.geometry.face_b),
            static_cast<std::uint64_t>(c.proof.section_size)};
  add<Dim>(bits, c.geometry.point, unit);
  add<Dim>(bits, c.geometry.normal, 1);
  add(bits, c.geometry.overlap * unit);
  add(bits, c.geometry.stiffness_factor);
  add(bits, c.geometry.area * (Dim == 3 ? unit * unit : unit));
  add(bits, c.proof.margin * unit);
  add<Dim>(bits, c.proof.point, unit);
  add<Dim>(bits, c.proof.axis, 1);
  add<Dim>(bits, c.proof.tangent, 1);
  add(bits, c.proof.support * unit);
  if (c.proof.kind == ProofKind::multipliers)
    for (const int plane : c.proof.basis)
      bits.push_back(static_cast<std::uint64_t>(plane));
  for (int k = 0; k < c.proof.section_size; ++k)
    bits.push_back(c.proof.section[k]);
  return bits;
}

// Of faces folded by 1e-10 rad one cuts off just as much as make_block may drop: whether it is dropped depends on their
// order, and in another frame or unit on rounding. Only in that family may a block have lost one.
template <int Dim>
bool as_many_faces(const Posed<Dim>& p, const Posed<Dim>& q, bool folded) {
  const bool same = p.a.faces.size() == q.a.faces.size() && p.b.faces.size() == q.b.faces.size();
  EXPECT_TRUE(same || folded) << "a face was lost";
  return same;
}

template <int Dim>
bool same_faces(const Polytope<Dim>& p, const Polytope<Dim>& q) {
  return std::equal(
      p.faces.begin(), p.faces.end(), q.faces.begin(), q.faces.end(),
      [](const HalfSpace<Dim>& f, const HalfSpace<Dim>& g) { return f.normal == g.normal && f.offset == g.offset; });
}

template <int Dim>
void expect_planes_in_any_order(const Posed<Dim>& p, const Contact<Dim>& answer, bool folded, Random& random) {
  Posed<Dim> shuffled = p;
  for (Polytope<Dim>* part : {&shuffled.a, &shuffled.b}) {
    HalfSpaces<Dim> planes = part->faces;
    shapes::shuffle(planes, random);
    const Polytope<Dim> again = block_of<Dim>(planes);
    if (!same_faces<Dim>(again, *part)) {
      EXPECT_TRUE(folded) << "other faces from planes in another order";
      return;
    }
    *part = again;
  }
  EXPECT_EQ(bits_of<Dim>(resolve<Dim>(shuffled)), bits_of<Dim>(answer)) << "planes in another order";
}

template <int Dim>
void expect_any_power_of_two(const Posed<Dim>& p, const Contact<Dim>& answer, Random& random) {
  const int power = integer(random, -60, 60);
  const double unit = std::ldexp(1.0, power);
  const Posed<Dim> scaled{block_of<Dim>(shapes::scaled<Dim>(p.a.faces, unit)),
                          block_of<Dim>(shapes::scaled<Dim>(p.b.faces, unit)), p.rotation, unit * p.offset};
  EXPECT_EQ(bits_of<Dim>(resolve<Dim>(scaled)), bits_of<Dim>(answer, unit)) << "times 2^" << power;
}

// ---- rounding -------------------------------------------------------------------------------------------------------

// Decisions agree; only within the undecided band may one be given and the other not, and never two that contradict.
// That the overlap has no best direction (no_normal) may depend on rounding; that there is one may not.
bool agree(ContactStatus s, ContactStatus t) {
  for (ContactStatus* status : {&s, &t})
    if (*status == ContactStatus::no_normal) *status = ContactStatus::touching;
  return s == t || ((s == ContactStatus::undecided || t == ContactStatus::undecided) &&
                    std::max(s, t) <= ContactStatus::touching);
}

// The change of the overlap when every plane's offset rounds again by so much, to first order: the centre moves by
// sqrt(Σ (rounding/slack)²) in the metric of the region, and across the region the overlap changes by itself.
template <int Dim>
double first_order(const Posed<Dim>& p, const Contact<Dim>& c, double rounding) {
  HalfSpaces<Dim> planes;
  assemble<Dim>({&p.a, &p.b, Matrix<Dim>::Identity(), p.rotation, p.offset}, Vector<Dim>::Zero(), planes);
  double squares = 0;
  for (const HalfSpace<Dim>& plane : planes) {
    const double slack = -signed_distance<Dim>(plane, c.geometry.point);
    squares += std::pow(rounding / std::max(slack, rounding), 2);
  }
  return rounding + c.geometry.overlap * std::sqrt(squares);
}

// the same contact in another frame or unit
template <int Dim>
void expect_near(const Posed<Dim>& p, const Contact<Dim>& c, const Contact<Dim>& other, double fraction,
                 const std::string& how) {
  EXPECT_TRUE(agree(c.status, other.status))
      << how << ": " << static_cast<int>(c.status) << ", then " << static_cast<int>(other.status);
  if (!c.touching() || !other.touching()) return;
  // deeper than the potential's radius several faces may be equally near, and any of them gives the normal
  const double radius = reference.potential_radius * std::min(p.a.inscribed_radius, p.b.inscribed_radius);
  if (c.geometry.overlap > radius) return;
  EXPECT_NEAR(other.geometry.overlap, c.geometry.overlap, first_order<Dim>(p, c, fraction * p.size())) << how;
}

// a quarter turn about an axis: coordinates change places and signs
Matrix<3> quarter_turn(Random& random, Vector<3>*) {
  const int axis = integer(random, 0, 2), next = (axis + 1) % 3, last = (axis + 2) % 3;
  Matrix<3> q = Matrix<3>::Zero();
  q(axis, axis) = 1;
  q(next, last) = -1;
  q(last, next) = 1;
  return q;
}
Matrix<2> quarter_turn(Random&, Vector<2>*) {
  Matrix<2> q;
  q << 0, -1, 1, 0;
  return q;
}

template <int Dim>
void expect_quarter_turns(const Posed<Dim>& p, const Contact<Dim>& answer, bool folded, Random& random) {
  const Matrix<Dim> q = quarter_turn(random, static_cast<Vector<Dim>*>(nullptr));
  const Posed<Dim> turned{block_of<Dim>(shapes::placed<Dim>(p.a.faces, q, Vector<Dim>::Zero())), p.b, q * p.rotation,
                          q * p.offset};
  if (!as_many_faces<Dim>(p, turned, folded)) return;
  const Contact<Dim> there = resolve<Dim>(turned, reference);
  expect_near<Dim>(p, answer, there, turned_rounding, "turned by 90 degrees");
}

template <int Dim>
void expect_swapped(const Posed<Dim>& p, const Contact<Dim>& answer) {
  const Posed<Dim> swapped{p.b, p.a, p.rotation.transpose(), -(p.rotation.transpose() * p.offset)};
  const Contact<Dim> there = resolve<Dim>(swapped, reference);
  expect_near<Dim>(p, answer, there, other_rounding, "swapped");
}

// (A, B) and (B, A) by contact_between; the first of them, as a contact
template <int Dim>
Contact<Dim> expect_same_bits_swapped(const Posed<Dim>& p, const Pose<Dim>& at_a, const ContactSettings& settings) {
  const Pose<Dim> at_b{at_a.position + at_a.axes * p.offset, at_a.axes * p.rotation};
  const auto contact_of = [](const ContactBetween<Dim>& found) {
    Contact<Dim> contact;
    contact.status = found.status;
    contact.geometry = found.geometry;
    return contact;
  };
  const ContactBetween<Dim> found = contact_between<Dim>(p.a, at_a, p.b, at_b, QueryLevel::area, settings);
  ContactBetween<Dim> swapped = contact_between<Dim>(p.b, at_b, p.a, at_a, QueryLevel::area, settings);
  EXPECT_EQ(found.origin, swapped.origin);
  // only the sign of a zero in it may differ
  EXPECT_EQ(found.geometry.normal, Vector<Dim>(-swapped.geometry.normal));
  swapped.geometry.normal = found.geometry.normal;
  std::swap(swapped.geometry.face_a, swapped.geometry.face_b);
  EXPECT_EQ(bits_of<Dim>(contact_of(found)), bits_of<Dim>(contact_of(swapped))) << "swapped";
  return contact_of(found);
}

template <int Dim>
void expect_either_first(const Posed<Dim>& p, const Contact<Dim>& answer, Random& random) {
  expect_near<Dim>(p, answer, expect_same_bits_swapped<Dim>(p, {}, reference), other_rounding, "in canonical order");
  const Vector<Dim> anywhere = shapes::power_of_ten(random, -3, 6) * shapes::direction<Dim>(random);
  expect_same_bits_swapped<Dim>(p, {anywhere, matrix(shapes::orientation<Dim>(random))}, {});
}

template <int Dim>
void expect_other_units(const Posed<Dim>& p, const Contact<Dim>& answer, bool folded) {
  for (const double unit : {1e-3, 1e4}) {
    const Posed<Dim> scaled{block_of<Dim>(shapes::scaled<Dim>(p.a.faces, unit)),
                            block_of<Dim>(shapes::scaled<Dim>(p.b.faces, unit)), p.rotation, unit * p.offset};
    if (!as_many_faces<Dim>(p, scaled, folded)) continue;
    Contact<Dim> there = resolve<Dim>(scaled, reference);
    there.geometry.overlap /= unit;
    expect_near<Dim>(p, answer, there, other_rounding, fmt::format("times {}", unit));
  }
}

template <int Dim>
void expect_symmetries(long long first, long long last) {
  for (long long number = first; number < last; ++number) {
    SCOPED_TRACE(fmt::format("numbered_case<{}>({}, {})", Dim, seed, number));
    Random random(seed + static_cast<std::uint64_t>(number));
    const Case<Dim> c = families::numbered_case<Dim>(seed, number);
    const Posed<Dim> p = posed<Dim>(c);
    const Contact<Dim> answer = resolve<Dim>(p), exactly = resolve<Dim>(p, reference);
    const bool folded = c.family == "L2 folded";
    expect_planes_in_any_order<Dim>(p, answer, folded, random);
    expect_any_power_of_two<Dim>(p, answer, random);
    expect_quarter_turns<Dim>(p, exactly, folded, random);
    expect_swapped<Dim>(p, exactly);
    expect_either_first<Dim>(p, exactly, random);
    expect_other_units<Dim>(p, exactly, folded);
    if (testing::Test::HasFailure()) return;  // the first pair that fails is enough
  }
}

// Eqs 3.22-3.26
TEST(SamePair, InAnyOrderUnitAndFrame3D) {
  expect_symmetries<3>(0, 3000);
}
TEST(SamePair, InAnyOrderUnitAndFrame2D) {
  expect_symmetries<2>(0, 7000);
}
TEST(SamePairLong, InAnyOrderUnitAndFrameAHundredThousand) {
  expect_symmetries<3>(10'000, 60'000);
  expect_symmetries<2>(10'000, 60'000);
}

constexpr ContactSettings on_central_path{.point = ContactPoint::central_path, .normal = ContactNormal::multipliers};

// ---- batches --------------------------------------------------------------------------------------------------------

// Pairs of every family, new, persistent and separated before, resolved to different levels, to be resolved in batches.
template <int Dim>
struct Queue {
  ContactSettings settings;
  std::vector<Case<Dim>> cases;
  std::vector<Pair<Dim>> pairs;
  std::vector<Contact<Dim>> before, alone;
};

template <int Dim>
Queue<Dim> make_queue(const ContactSettings& settings, long long first, int count, Random& random) {
  Queue<Dim> queue{.settings = settings, .cases = {}, .pairs = {}, .before = {}, .alone = {}};
  for (int i = 0; i < count; ++i)
    queue.cases.push_back(families::numbered_case<Dim>(seed, first + i));
  for (const Case<Dim>& c : queue.cases) {
    const Matrix<Dim> axes = matrix(shapes::orientation<Dim>(random));
    Pair<Dim> cold{&c.a, &c.b, axes, c.rotation, c.offset}, warm{&c.a, &c.b, axes, c.rotation_after, c.offset_after};
    const Contact<Dim> persistent = contacts::resolve<Dim>(cold, settings).contact;
    cold.level = static_cast<QueryLevel>(integer(random, 0, 3));
    warm.level = static_cast<QueryLevel>(integer(random, 0, 3));
    for (const auto& [pair, before] : {std::pair{cold, Contact<Dim>{}}, std::pair{warm, persistent}}) {
      queue.pairs.push_back(pair);
      queue.before.push_back(before);
      queue.alone.push_back(contacts::resolve<Dim>(pair, settings, before).contact);
    }
  }
  return queue;
}

// some of the queue's pairs in one call
template <int Dim>
std::vector<Contact<Dim>> resolve_together(const Queue<Dim>& queue, std::span<const int> numbers) {
  std::vector<Pair<Dim>> pairs;
  std::vector<Contact<Dim>> together;
  std::vector<Contact<Dim>*> slots;
  for (const int i : numbers) {
    pairs.push_back(queue.pairs[i]);
    together.push_back(queue.before[i]);
  }
  for (Contact<Dim>& c : together)
    slots.push_back(&c);
  KernelCounters counters;
  narrow_phase<Dim>(pairs, queue.settings, {}, slots, counters);
  return together;
}

template <int Dim>
std::vector<int> numbers_of(const Queue<Dim>& queue) {
  std::vector<int> numbers(queue.pairs.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

template <int Dim>
void expect_bits_independent_of_batch(const ContactSettings& settings, long long first, int cases) {
  Random random(seed + static_cast<std::uint64_t>(first));
  const Queue<Dim> queue = make_queue<Dim>(settings, first, cases, random);
  std::vector<int> order = numbers_of<Dim>(queue);
  // every pair in batches of every size, in another order each time
  for (int size = 2; size <= 17; ++size) {
    shapes::shuffle(order, random);
    for (std::size_t from = 0; from < order.size(); from += static_cast<std::size_t>(size)) {
      const std::size_t to = std::min(order.size(), from + static_cast<std::size_t>(size));
      const std::vector<Contact<Dim>> together =
          resolve_together<Dim>(queue, std::span(order).subspan(from, to - from));
      for (std::size_t i = from; i < to; ++i)
        ASSERT_EQ(bits_of<Dim>(together[i - from]), bits_of<Dim>(queue.alone[order[i]]))
            << fmt::format("numbered_case<{}>({}, {}), {}, in a batch of {}", Dim, seed, first + order[i] / 2,
                           order[i] % 2 ? "warm" : "cold", size);
    }
  }
}

// fused multiply-adds round differently in the two methods to fill a register
#define SKIP_WITH_FAST_ARITHMETIC() \
  if (fast_arithmetic()) GTEST_SKIP() << "built with VOUSSOIR_FAST_ARITHMETIC: no equal bits"

TEST(SamePair, AloneAndInAnyBatch3D) {
  SKIP_WITH_FAST_ARITHMETIC();
  expect_bits_independent_of_batch<3>({}, 0, 1000);
  expect_bits_independent_of_batch<3>(on_central_path, 0, 1000);
}
TEST(SamePair, AloneAndInAnyBatch2D) {
  SKIP_WITH_FAST_ARITHMETIC();
  expect_bits_independent_of_batch<2>({}, 0, 1000);
  expect_bits_independent_of_batch<2>(on_central_path, 0, 1000);
}
TEST(SamePairLong, AloneAndInAnyBatchFiftyThousand) {
  SKIP_WITH_FAST_ARITHMETIC();
  for (int part = 0; part < 50; ++part) {
    for (const ContactSettings& settings : {ContactSettings{}, on_central_path}) {
      expect_bits_independent_of_batch<3>(settings, 1'000'000 + 1000 * part, 1000);
      expect_bits_independent_of_batch<2>(settings, 1'000'000 + 1000 * part, 1000);
    }
  }
}

// ---- registers ------------------------------------------------------------------------------------------------------

struct Target {
  long long bit;
  const char* name;
  int lanes;  // doubles in a register
};

// The instruction sets for which kernel.cpp is compiled on x86-64. Every one of these processors has the first: Highway
// uses no vector instructions there, with one lane for g++ before 12.3 (SCALAR), else with two (EMU128).
constexpr Target targets[] = {
    {HWY_STATIC_TARGET, "the baseline", HWY_MAX_BYTES / 8}, {HWY_AVX2, "AVX2", 4}, {HWY_AVX3, "AVX3", 8}};

// the kernel runs for this instruction set as long as it lives
class RunningFor {
 public:
  explicit RunningFor(const Target& target) { hwy::SetSupportedTargetsForTest(target.bit); }
  ~RunningFor() { hwy::SetSupportedTargetsForTest(0); }
  RunningFor(const RunningFor&) = delete;
  RunningFor& operator=(const RunningFor&) = delete;
};

template <int Dim>
void expect_same_bits_on(const Target& target, const Queue<Dim>& queue) {
  const RunningFor running(target);
  // registers narrower than stated would be slow, and test nothing here
  EXPECT_EQ(kernel_width(), target.lanes) << target.name;
  const std::vector<int> order = numbers_of<Dim>(queue);
  const std::vector<Contact<Dim>> together = resolve_together<Dim>(queue, order);
  for (const int i : order) {
    ASSERT_EQ(bits_of<Dim>(together[i]), bits_of<Dim>(queue.alone[i])) << target.name << ", in a batch, pair " << i;
    ASSERT_EQ(bits_of<Dim>(contacts::resolve<Dim>(queue.pairs[i], queue.settings, queue.before[i]).contact),
              bits_of<Dim>(queue.alone[i]))
        << target.name << ", alone, pair " << i;
  }
}

// cold and warm pairs, twice as many as the cases, each alone and together
template <int Dim>
void expect_same_bits_on_any_registers(int cases) {
  Random random(seed);
  const Queue<Dim> published = make_queue<Dim>({}, 0, cases, random),
                   smoothed = make_queue<Dim>(on_central_path, 0, cases, random);
  for (const Target& target : targets)
    if (hwy::SupportedTargets() & target.bit) {
      expect_same_bits_on<Dim>(target, published);
      expect_same_bits_on<Dim>(target, smoothed);
    } else
      std::cout << "skipped: this machine has no " << target.name << '\n';
}

TEST(SamePair, OnRegistersOfAnyWidth3D) {
  SKIP_WITH_FAST_ARITHMETIC();
  expect_same_bits_on_any_registers<3>(500);
}
TEST(SamePair, OnRegistersOfAnyWidth2D) {
  SKIP_WITH_FAST_ARITHMETIC();
  expect_same_bits_on_any_registers<2>(500);
}

}  // namespace
}  // namespace voussoir::symmetry_test
