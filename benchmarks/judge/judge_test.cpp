#include "benchmarks/judge/judge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>

#include "benchmarks/judge/exact_pairs.hpp"
#include "benchmarks/judge/judge_tables.hpp"
#include "benchmarks/judge/text_out.hpp"
#include "core/base/floating_point_traps.hpp"

namespace voussoir::benchmarks::judge_test {
namespace {

HalfSpaces<3> moved(const HalfSpaces<3>& planes, const Vector<3>& shift) {
  return shapes::placed<3>(planes, Matrix<3>::Identity(), shift);
}

const PairFile& two_of_each() {
  static const PairFile file = all_exact_pairs(workload_seed, 2);
  return file;
}

// ---- exact answers --------------------------------------------------------------------------------------------------

TEST(ExactPairs, CubesSideBySideMatchTheClosedForm) {
  const HalfSpaces<3> cube = shapes::cube<3>(0.5);
  const ExactPair pair = exact_answer(cube, moved(cube, {0.875, 0.25, 0}));
  EXPECT_TRUE(pair.touch);
  EXPECT_EQ(pair.lp_optimum, -0.0625);
  EXPECT_EQ(pair.smallest_translation, 0.125);
  ASSERT_EQ(pair.normals.size(), 1u);
  EXPECT_EQ(pair.normals[0], Vector<3>(1, 0, 0));
  EXPECT_EQ(pair.volume, 0.125 * 0.75);
  EXPECT_EQ(pair.area, 0.75);
  EXPECT_EQ(pair.centroid, Vector<3>(0.4375, 0.125, 0));
  EXPECT_EQ(pair.faces_a.size() + pair.faces_b.size(), 8u);  // z: a face of both on each side
}

// a corner of depth h in a face: a pyramid of three right angles
TEST(ExactPairs, CornerInAFaceMatchesTheClosedForm) {
  const double h = 1e-4;
  const HalfSpaces<3> cube = shapes::cube<3>(0.5);
  const Vector<3> diagonal = Vector<3>(1, 1, 1).normalized();
  const Matrix<3> turn = matrix(rotation_onto(diagonal, -Vector<3>::UnitZ()));
  const double half_diagonal = 0.5 * std::numbers::sqrt3;
  const ExactPair pair = exact_answer(cube, shapes::placed<3>(cube, turn, Vector<3>(0, 0, 0.5 + half_diagonal - h)));
  EXPECT_TRUE(pair.touch);
  // offsets are rounded at 1, the depth is 1e-4
  EXPECT_NEAR(pair.smallest_translation, h, 1e-15);
  EXPECT_NEAR(pair.volume / (std::numbers::sqrt3 / 2 * h * h * h), 1, 1e-10);
  EXPECT_NEAR(pair.centroid[2], 0.5 - h / 4, 1e-15);
  const double from_corner = 0.75 * h;
  EXPECT_NEAR(pair.area / (1.5 * std::numbers::sqrt3 * from_corner * from_corner), 1, 1e-10);
  EXPECT_EQ(pair.faces_a.size(), 1u);
  EXPECT_EQ(pair.faces_b.size(), 3u);
}

TEST(ExactPairs, OneUlpDecides) {
  const HalfSpaces<3> cube = shapes::cube<3>(0.5);
  EXPECT_FALSE(exact_answer(cube, moved(cube, {1, 0, 0})).touch);
  HalfSpaces<3> nearer = moved(cube, {1, 0, 0});
  for (HalfSpace<3>& p : nearer)
    if (p.normal[0] < 0) p.offset = std::nextafter(p.offset, 0.0);
  EXPECT_TRUE(exact_answer(cube, nearer).touch);
}

TEST(ExactPairs, AreTheBenchmarksOwn) {
  const ExactPair pair = exact_pairs(Shape::cube, PairState::touch, workload_seed, 1)[0];
  const Pair<3>& own = workload(Shape::cube, PairState::touch).pairs[0];
  EXPECT_EQ(pair.b[0].normal, own.rotation * own.b->faces[0].normal);
  EXPECT_NE(exact_pairs(Shape::cube, PairState::touch, 7, 1)[0].b[0].normal, pair.b[0].normal);
}

// ---- the file -------------------------------------------------------------------------------------------------------

TEST(PairFile, IsReadAsWritten) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "judge" / "pairs.json";
  const std::string text = pair_file_text(two_of_each());
  write_text(path, text);
  EXPECT_EQ(pair_file_text(read_pair_file(path)), text);
  EXPECT_LT(text.size(), 200000u);  // so twenty of each are below 3 MB
}

TEST(PairFile, FaultNamesFileAndPair) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "judge" / "fault.json";
  std::string text = pair_file_text(two_of_each());
  const std::string key = "\"touch\":true";
  text.replace(text.find(key), key.size(), "\"touch\":\"yes\"");
  write_text(path, text);
  try {
    read_pair_file(path);
    FAIL();
  } catch (const std::runtime_error& fault) {
    const std::string line = fault.what();
    EXPECT_NE(line.find("fault.json: pair tetrahedron/touch/0"), std::string::npos) << line;
    EXPECT_NE(line.find("voussoir_pairs"), std::string::npos) << line;
  }
  EXPECT_THROW(read_pair_file(path / "none"), std::runtime_error);
}

// ---- the judge ------------------------------------------------------------------------------------------------------

TEST(Judge, AngleToACone) {
  const Vector<3> x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), all = Vector<3>(1, 1, 1).normalized();
  EXPECT_NEAR(angle_outside({x, y}, z), std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(angle_outside({x, y}, all), std::asin(1 / std::numbers::sqrt3), 1e-15);
  EXPECT_NEAR(angle_outside({x, y}, (x + y).normalized()), 0, 1e-7);
  EXPECT_EQ(angle_outside({x, y, z}, all), 0);
  EXPECT_NEAR(angle_outside({x}, -x), std::numbers::pi, 1e-15);
}

TEST(Judge, FindsNoErrorInOurKernel) {
  const Verdict sum = sum_of(judge_kernel(own_kernel(), two_of_each()));
  EXPECT_EQ(sum.errors(), 0) << sum.first_error;
  EXPECT_EQ(sum.contacts, 2 * (8 * 3 + 2));  // touch, face, deep of all shapes; plane of two
}

// our kernel with a fault
using Fault = void (*)(voussoir_answer& answer);
Fault fault_now = nullptr;

std::int32_t faulty_contact(const void* first, const void* second, const voussoir_pose* pose, std::int32_t asked,
                            voussoir_answer* answer) {
  static const Kernel own = own_kernel();
  const std::int32_t failed = own.contact(first, second, pose, asked, answer);
  fault_now(*answer);
  return failed;
}

Verdict judged_with(Fault fault) {
  Kernel kernel = own_kernel();
  kernel.contact = faulty_contact;
  fault_now = fault;
  return sum_of(judge_kernel(kernel, two_of_each()));
}

TEST(Judge, FindsEachFault) {
  const WithoutTraps none;
  const int contacts = 2 * (8 * 3 + 2), pairs = static_cast<int>(two_of_each().pairs.size());
  EXPECT_EQ(judged_with([](voussoir_answer& a) { a.touch = 1 - a.touch; }).decisions, pairs);
  EXPECT_EQ(judged_with([](voussoir_answer& a) { a.touch = 7; }).unusable, pairs);
  EXPECT_EQ(judged_with([](voussoir_answer& a) { a.point[1] = std::numeric_limits<double>::quiet_NaN(); }).unusable,
            contacts);
  EXPECT_EQ(judged_with([](voussoir_answer& a) { a.point[2] += 1; }).points, contacts);
  EXPECT_EQ(judged_with([](voussoir_answer& a) {
              for (double& n : a.normal)
                n = -n;
            }).normals,
            contacts);
  EXPECT_EQ(judged_with([](voussoir_answer& a) { a.overlap *= 1.05; }).overlaps, contacts);
  EXPECT_EQ(judged_with([](voussoir_answer& a) { a.overlap_kind = 9; }).overlaps, contacts);
  EXPECT_EQ(judged_with([](voussoir_answer& a) { a.overlap_kind = VOUSSOIR_NO_OVERLAP; }).errors(), 0);
}

TEST(Judge, TimesAKernelBesideOthers) {
  TimingPlan plan;
  plan.repetitions = 1;
  plan.seconds = 1e-5;
  plan.shapes = {Shape::cube};
  plan.states = {PairState::near, PairState::touch};
  const std::vector<KernelTime> times = time_kernel(own_kernel(), {}, plan);
  ASSERT_EQ(times.size(), 3u);  // decisions of both states, contacts of one
  for (const KernelTime& t : times) {
    EXPECT_EQ(t.wrong, 0);
    EXPECT_GE(t.pairs, 10);
  }
  EXPECT_NE(time_table(times).find("voussoir, contact"), std::string::npos);
}

// ---- shared libraries -----------------------------------------------------------------------------------------------

std::string refusal(const std::string& path) {
  try {
    load_kernel(path);
  } catch (const std::runtime_error& fault) {
    return fault.what();
  }
  return "none";
}

TEST(SharedKernel, RefusalSaysWhy) {
  EXPECT_NE(refusal("/no/such.so").find("no such file"), std::string::npos);
  EXPECT_NE(refusal(__FILE__).find("no shared library"), std::string::npos);
  EXPECT_NE(refusal(KERNEL_OF_ANOTHER_VERSION).find("version 2"), std::string::npos);
  EXPECT_NE(refusal(KERNEL_WITHOUT_CONTACTS).find("no function voussoir_contact"), std::string::npos);
}

TEST(SharedKernel, ExampleHasNoError) {
  const Kernel kernel = load_kernel(EXAMPLE_KERNEL);
  const std::vector<Verdict> verdicts = judge_kernel(kernel, two_of_each());
  EXPECT_EQ(sum_of(verdicts).errors(), 0) << verdict_sentence(kernel.name, verdicts);
  EXPECT_EQ(sum_of(verdicts).contacts, 2 * (8 * 3 + 2));
}

#ifdef CCD_KERNEL
// Its decisions are right. Its point is a mean of the polytope's vertices and no point of the contact: where a corner
// or an edge touches it is outside of a block. And the expanding polytope stops at a face that is nearly the nearest:
// overlaps of nearly parallel faces are off by some per cent.
TEST(SharedKernel, KnownErrorsOfLibccdAreFound) {
  const WithoutTraps none;  // it divides as it likes
  const std::vector<Verdict> verdicts = judge_kernel(load_kernel(CCD_KERNEL), two_of_each());
  const Verdict all = sum_of(verdicts), touch = sum_of(verdicts, "touch"), face = sum_of(verdicts, "face");
  EXPECT_EQ(all.decisions, 0);
  EXPECT_EQ(all.unusable, 0);
  EXPECT_EQ(touch.contacts, 2 * 8);
  EXPECT_GT(touch.points, touch.contacts / 2);
  EXPECT_GT(face.overlaps, face.contacts / 2);
  EXPECT_EQ(sum_of(verdicts, "near").errors() + sum_of(verdicts, "separated").errors(), 0);
}
#endif

}  // namespace
}  // namespace voussoir::benchmarks::judge_test
