// The contact kernel at its limits: overlaps down to rounding, parts inside each other, warm starts and batches.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "core/testing/contacts.hpp"

namespace voussoir::thin_contact_test {
namespace {

using namespace contacts;
using shapes::Random;

// ---- thin overlaps --------------------------------------------------------------------------------------------------

template <int Dim>
Matrix<Dim> tilt(Random& random, double angle) {
  if constexpr (Dim == 3) {
    const double along = shapes::uniform(random, 0, 2 * std::numbers::pi);
    return (Eigen::AngleAxisd(angle, Vector<3>(std::cos(along), std::sin(along), 0)) *
            Eigen::AngleAxisd(shapes::uniform(random, -3, 3), Vector<3>::UnitZ()))
        .toRotationMatrix();
  } else {
    return matrix(Rotation<2>{angle * (shapes::integer(random, 0, 1) ? 1 : -1)});
  }
}

template <int Dim>
void expect_faces_meet(std::uint64_t seed) {
  Random random(seed);
  const Polytope<Dim> lower = unit_cube<Dim>();
  for (double overlap = 0.1; overlap > 2e-13;
       overlap /= overlap > 2e-12 ? 10 : 3)  // to the last 3e-13, near the tolerance
    for (double angle = 1e-11; angle < 2e-3; angle *= 10)
      for (int i = 0; i < 4; ++i) {
        const Polytope<Dim> upper =
            i % 2 ? unit_cube<Dim>()
                  : shapes::block<Dim>(shapes::box<Dim>(Vector<Dim>::Constant(-0.2), Vector<Dim>::Constant(0.2)));
        const Matrix<Dim> turn = tilt<Dim>(random, angle);
        // the lowest corner is `overlap` below the lower block's top
        Vector<Dim> offset = Vector<Dim>::Constant(0.5 - overlap);
        for (int k = 0; k < Dim - 1; ++k)
          offset[k] = shapes::uniform(random, -0.3, 0.3);
        offset -= lowest_corner<Dim>(upper, turn);
        const Outcome<Dim> r = touch<Dim>(lower, upper, turn, offset);
        ASSERT_EQ(r.contact.status, ContactStatus::touching) << "overlap " << overlap << ", tilt " << angle;
        expect_sound<Dim>(lower, upper, turn, offset, r.contact.geometry);
        if (overlap <= 1e-3) {
          EXPECT_GT(r.contact.geometry.normal[Dim - 1], halfway_to_a_corner);
        }
      }
}

TEST(ThinOverlap, FaceOnFaceAlwaysConverges3D) {
  expect_faces_meet<3>(68);
}
TEST(ThinOverlap, FaceOnFaceAlwaysConverges2D) {
  expect_faces_meet<2>(69);
}

TEST(ThinOverlap, NearlyCollinearEdgesAreDecidedAndConverge) {
  // edges along y that overlap by 1e-11 to 1e-6 in x and in z: a sliver thin in two directions, every third one apart
  Random random(70);
  const Polytope<3> cube = unit_cube<3>();
  int touching = 0;
  for (int i = 0; i < 600; ++i) {
    const double sliver = shapes::power_of_ten(random, -11, -6), angle = shapes::power_of_ten(random, -14, -6);
    const Matrix<3> turn = Eigen::AngleAxisd(i % 10 ? angle : 0, shapes::direction<3>(random)).toRotationMatrix();
    const Vector<3> offset(1 - sliver, shapes::uniform(random, -0.5, 0.5),
                           1 - sliver * shapes::uniform(random, i % 3 ? 0.3 : -3, 3));
    const HalfSpaces<3> planes = planes_of<3>(cube, cube, turn, offset);
    const double value = static_cast<double>(oracle::feasibility<3>(planes));
    if (std::abs(value) < undecided_value) continue;
    const Outcome<3> r = touch<3>(cube, cube, turn, offset);
    ASSERT_EQ(r.contact.status, value < 0 ? ContactStatus::touching : ContactStatus::separated)
        << "sliver " << sliver << ", angle " << angle << ", LP " << value;
    if (value > 0) continue;
    ++touching;
    const auto barrier = oracle::barrier<3>(planes, r.contact.geometry.point.cast<oracle::Real>());
    EXPECT_TRUE(barrier.interior);
    EXPECT_LT(static_cast<double>(barrier.decrement), point_tolerance + 1e-14 / -value);
    EXPECT_GT(r.contact.geometry.normal[0] + r.contact.geometry.normal[2], 0.9);
  }
  EXPECT_GT(touching, 200);
  EXPECT_LT(touching, 590);
}

TEST(ThinOverlap, ThinSlabsTouchAsThickOnes) {
  const double thin = 1e-5;
  const Polytope<3> slab = shapes::block<3>(shapes::box<3>({-1, -1, -thin}, {1, 1, thin}));
  const ContactGeometry<3> g = touch<3>(slab, slab, Vector<3>(0.5, 0, 2 * thin * (1 - 1e-4))).contact.geometry;
  EXPECT_NEAR(g.overlap, 2e-4 * thin, 1e-15);
  EXPECT_NEAR(g.area, 3, area_tolerance);
  EXPECT_LT((g.normal - Vector<3>::UnitZ()).norm(), point_tolerance);
}

// ---- containment ----------------------------------------------------------------------------------------------------

TEST(Containment, IsAContactOrANamedFailure) {
  Random random(71);
  const Polytope<3> large = shapes::block<3>(shapes::cube<3>(1));
  const Polytope<3> small = shapes::block<3>(shapes::platonic_solids(0.1)[2].planes);
  int touching = 0;
  for (int i = 0; i < 100; ++i) {
    const Vector<3> offset = shapes::uniform(random, 0, 0.8) * shapes::direction<3>(random);
    const Outcome<3> r = touch<3>(large, small, matrix(shapes::orientation<3>(random)), offset);
    ASSERT_NE(r.contact.status, ContactStatus::separated);
    if (r.contact.status == ContactStatus::touching) {
      ++touching;
      EXPECT_NEAR(r.contact.geometry.normal.norm(), 1, exact);
      EXPECT_GE(r.contact.geometry.overlap, 0.2);
      EXPECT_GT(r.counters.normal_fallbacks + r.counters.deep_overlaps, 0);  // reported, not hidden
    } else {
      EXPECT_EQ(r.contact.status, ContactStatus::no_normal);
    }
  }
  EXPECT_GT(touching, 50);
  // concentric and equal: no direction is better than another
  EXPECT_EQ(touch<3>(large, large, Vector<3>(0, 0, 0)).contact.status, ContactStatus::no_normal);
}

// ---- memory ---------------------------------------------------------------------------------------------------------

TEST(WarmStart, GivesTheSameContact) {
  Random random(72);
  for (int i = 0; i < 60; ++i) {
    const Polytope<3> a = unit_cube<3>(), b = shapes::centred_block<3>(shapes::random_planes<3>(random, 5, 0.5));
    const double depth = 1e-4;
    Matrix<3> turn = matrix(shapes::orientation<3>(random));
    Vector<3> offset = Vector<3>(0.1, 0.1, 0.5 - depth) - lowest_corner<3>(b, turn);
    Contact<3> persistent = touch<3>(a, b, turn, offset).contact;
    ASSERT_TRUE(persistent.touching());
    for (int step = 0; step < 20; ++step) {
      offset += 0.02 * depth * shapes::direction<3>(random);
      turn = matrix(turned({Eigen::Quaterniond(turn)}, Spin<3>(1e-6 * shapes::direction<3>(random))));
      const Outcome<3> warm = touch<3>(a, b, turn, offset, {}, persistent), cold = touch<3>(a, b, turn, offset);
      ASSERT_TRUE(warm.contact.touching());
      EXPECT_EQ(warm.counters.lp_solves, 0);
      EXPECT_LT((warm.contact.geometry.point - cold.contact.geometry.point).norm(), point_tolerance);
      EXPECT_LT((warm.contact.geometry.normal - cold.contact.geometry.normal).norm(), point_tolerance);
      EXPECT_NEAR(warm.contact.geometry.overlap, cold.contact.geometry.overlap, point_tolerance * depth);
      persistent = warm.contact;
    }
  }
}

// Edges along each other, thin in two directions and too degenerate for the kernel to begin: a contact found by the
// general method must fit its frame, at any orientation of the blocks.
TEST(WarmStart, ContactsOfTheGeneralMethodContinueInTheKernel) {
  Random random(76);
  constexpr int slivers = 200, steps = 20;
  int found_generally = 0, stood = 0;
  for (int i = 0; i < slivers; ++i) {
    const Matrix<3> lie = matrix(shapes::orientation<3>(random));
    const Polytope<3> cube = shapes::block<3>(shapes::placed<3>(shapes::cube<3>(0.5), lie, Vector<3>::Zero()));
    const double thin = shapes::power_of_ten(random, -11, -6), other = shapes::uniform(random, 0.3, 3);
    const Matrix<3> turn = Eigen::AngleAxisd(0.3 * thin, shapes::direction<3>(random)).toRotationMatrix();
    Vector<3> offset(1 - thin, shapes::uniform(random, -0.5, 0.5), 1 - other * thin);
    const auto now = [&](const Contact<3>& before) {
      return touch<3>(cube, cube, turn, Vector<3>(lie * offset), {}, before);
    };
    const Outcome<3> first = now({});
    if (!first.contact.touching() || first.counters.lp_solves < 2) continue;
    ++found_generally;
    Contact<3> persistent = first.contact;
    for (int step = 0; step < steps; ++step) {
      offset += 0.01 * thin * shapes::direction<3>(random);
      const Outcome<3> next = now(persistent);
      stood += static_cast<int>(next.counters.point_hits);
      persistent = next.contact;
    }
  }
  EXPECT_GT(found_generally, slivers / 4);
  EXPECT_GT(stood, found_generally * steps * 9 / 10);
}

TEST(WarmStart, APairHiddenByRoundingStartsAtTheEndOfItsProgram) {
  Random random(77);
  long long pivots_first = 0, pivots_again = 0;
  for (int i = 0; i < 50; ++i) {
    const Matrix<3> lie = matrix(shapes::orientation<3>(random));
    const Polytope<3> cube = shapes::block<3>(shapes::placed<3>(shapes::cube<3>(0.5), lie, Vector<3>::Zero()));
    const auto at = [&](double distance, const Contact<3>& before) {
      return touch<3>(cube, cube, Matrix<3>::Identity(), Vector<3>(lie * Vector<3>(0.3, 0.2, distance)), {}, before);
    };
    const Outcome<3> first = at(1, {}), again = at(1, first.contact);
    ASSERT_EQ(first.contact.status, ContactStatus::undecided);
    EXPECT_EQ(again.contact.status, ContactStatus::undecided);
    pivots_first += first.counters.lp_pivots;
    pivots_again += again.counters.lp_pivots;
    EXPECT_EQ(at(1.1, again.contact).contact.status, ContactStatus::separated);
    const Contact<3> met = at(0.999, again.contact).contact, fresh = at(0.999, {}).contact;
    ASSERT_TRUE(met.touching());
    EXPECT_LT((met.geometry.point - fresh.geometry.point).norm(), point_tolerance);
    EXPECT_NEAR(met.geometry.overlap, fresh.geometry.overlap, exact);
  }
  EXPECT_LT(4 * pivots_again, pivots_first);
}

// each step turns the axis of the step before into its frame: an error of its length would stay forever
TEST(WarmStart, TheNormalStaysUnitOverManySteps) {
  Random random(73);
  for (int i = 0; i < 10; ++i) {
    const Polytope<3> a = unit_cube<3>(), b = shapes::centred_block<3>(shapes::random_planes<3>(random, 5, 0.5));
    const double depth = 1e-4;
    const Matrix<3> turn = matrix(shapes::orientation<3>(random));
    const Vector<3> offset = Vector<3>(0.1, 0.1, 0.5 - depth) - lowest_corner<3>(b, turn);
    Contact<3> persistent = touch<3>(a, b, turn, offset).contact;
    for (int step = 0; step < 2000; ++step) {
      const Vector<3> moved = 0.02 * depth * shapes::direction<3>(random);
      const Outcome<3> warm = touch<3>(a, b, turn, offset + moved, {}, persistent);
      ASSERT_EQ(warm.counters.point_hits, 1);
      persistent = warm.contact;
    }
    // three squares, a sum and a root
    EXPECT_NEAR(persistent.geometry.normal.norm(), 1, 4 * std::numeric_limits<double>::epsilon());
  }
}

TEST(WarmStart, ANewContactDoesNotRememberThatItWasSeparate) {
  Random random(73);
  for (int i = 0; i < 60; ++i) {
    const Polytope<3> a = unit_cube<3>(), b = shapes::centred_block<3>(shapes::random_planes<3>(random, 5, 0.5));
    const Matrix<3> turn = matrix(shapes::orientation<3>(random));
    const Vector<3> corner = lowest_corner<3>(b, turn);
    const Vector<3> apart = Vector<3>(0.1, 0.1, 0.51) - corner, together = Vector<3>(0.1, 0.1, 0.499) - corner;
    const Contact<3> separate = touch<3>(a, b, turn, apart).contact;
    ASSERT_EQ(separate.status, ContactStatus::separated);
    const Contact<3> met = touch<3>(a, b, turn, together, {}, separate).contact,
                     fresh = touch<3>(a, b, turn, together).contact;
    ASSERT_TRUE(met.touching());
    EXPECT_EQ(met.geometry.point, fresh.geometry.point);
    EXPECT_EQ(met.geometry.normal, fresh.geometry.normal);
    EXPECT_EQ(met.geometry.area, fresh.geometry.area);
  }
}

TEST(Batch, ThePairsResultIsBitwiseIndependentOfIt) {
  Random random(74);
  const Polytope<3> a = unit_cube<3>(), b = shapes::centred_block<3>(shapes::random_planes<3>(random, 9, 0.5));
  std::vector<Pair<3>> pairs;
  for (int i = 0; i < 30; ++i)
    pairs.push_back({&a, &b, matrix(shapes::orientation<3>(random)), matrix(shapes::orientation<3>(random)),
                     shapes::uniform(random, 0.8, 1.6) * shapes::direction<3>(random)});
  std::vector<Contact<3>> together(pairs.size());
  std::vector<Contact<3>*> slots;
  for (Contact<3>& c : together)
    slots.push_back(&c);
  KernelCounters counters;
  narrow_phase<3>(pairs, {}, {}, slots, counters);
  int touching = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    Contact<3> alone;
    Contact<3>* slot = &alone;
    narrow_phase<3>(std::span(&pairs[i], 1), {}, {}, std::span(&slot, 1), counters);
    EXPECT_EQ(alone.status, together[i].status);
    EXPECT_EQ(alone.geometry.point, together[i].geometry.point);
    EXPECT_EQ(alone.geometry.normal, together[i].geometry.normal);
    EXPECT_EQ(alone.geometry.overlap, together[i].geometry.overlap);
    EXPECT_EQ(alone.geometry.area, together[i].geometry.area);
    touching += alone.touching();
  }
  EXPECT_GT(touching, 5);
  EXPECT_LT(touching, 30);
}

// Eq. 3.18, of an overlap
TEST(Options, TheChebyshevPointIsTheLargestBallsCentre) {
  const Polytope<3> cube = unit_cube<3>();
  const ContactSettings settings{.point = ContactPoint::chebyshev};
  const ContactGeometry<3> g =
      touch<3>(cube, cube, Matrix<3>::Identity(), Vector<3>(0.2, 0.3, 0.99), settings).contact.geometry;
  // the ball is a hundredth across, and free to roll between the faces
  EXPECT_NEAR(g.point[2], 0.495, exact);
  for (const HalfSpace<3>& p : planes_of<3>(cube, cube, Matrix<3>::Identity(), Vector<3>(0.2, 0.3, 0.99)))
    EXPECT_LE(signed_distance<3>(p, g.point), -0.005 + exact);
}

}  // namespace
}  // namespace voussoir::thin_contact_test
