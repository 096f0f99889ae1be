// Every result of the contact kernel against exact arithmetic: decisions, their proofs, overlaps, faces, areas.
// Rows L1, L2, L4-L7, L10 of the catalogue of extremes (L3 is below, L8 is slicing_test's MakeBlock.NamesTheFault,
// L9 symmetry_test).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <vector>

#include "core/testing/contacts.hpp"
#include "core/testing/pair_judge.hpp"

namespace voussoir::certainty_test {
namespace {

using families::Tally;
using shapes::Random;

// cddlib works in processes of its own; the machine that checks changes has two cores
constexpr int processes = 2;

constexpr std::uint64_t seed = 20240;

void print(const Tally& tally) {
  for (const auto& [what, count] : tally.counts)
    fmt::print("  {:9} {}\n", count, what);
  for (const auto& [what, fraction] : tally.worst)
    fmt::print("  {:9.3g} of the promise: {}\n", fraction, what);
}

template <int Dim>
void expect_no_promise_broken(long long first, long long last) {
  Tally tally;
  const std::string broken = families::judge_all<Dim>(seed, first, last, processes, tally);
  if (!broken.empty()) ADD_FAILURE() << broken;
  if (!broken.empty() || last - first > 100'000) print(tally);
  // every kind of result has occurred, cold and warm
  const long long cases = last - first;
  for (const char* start : {"cold, ", "warm, ", "central path, cold, ", "central path, warm, "}) {
    EXPECT_EQ(tally.counts[std::string(start) + "decisions"], cases);
    EXPECT_GT(tally.counts[std::string(start) + "touching"], cases / 4);
    EXPECT_GT(tally.counts[std::string(start) + "separated"], cases / 4);
  }
  EXPECT_GT(tally.counts["cold, values"], cases / 4);
  EXPECT_GT(tally.counts["warm, values"], cases / 4);
  EXPECT_GT(tally.counts["central path, cold, pressed"], cases / 50);
  EXPECT_GT(tally.counts["central path, warm, pressed"], cases / 50);
}

template <int Dim>
void expect_no_promise_broken(const std::vector<long long>& numbers) {
  Tally tally;
  for (const long long number : numbers)
    for (const families::Finding& f : families::judge(families::numbered_case<Dim>(seed, number), tally))
      ADD_FAILURE() << fmt::format("numbered_case<{}>({}, {}): {}, {}", Dim, seed, number, f.promise, f.figures);
}

// the others of 20,000, and a million more, are Long
constexpr long long few_in_space = 3'000, few_in_the_plane = 1'500;

TEST(Certainty, NoResultIsWrongAndEveryProofHolds3D) {
  expect_no_promise_broken<3>(0, few_in_space);
}
TEST(Certainty, NoResultIsWrongAndEveryProofHolds2D) {
  expect_no_promise_broken<2>(0, few_in_the_plane);
}
TEST(CertaintyLong, NoResultIsWrongAndEveryProofHolds) {
  expect_no_promise_broken<3>(few_in_space, 14'000);
  expect_no_promise_broken<2>(few_in_the_plane, 6'000);
}

// ---- findings of a million pairs ------------------------------------------------------------------------------------

// the program in double had a value beyond 64 ulp or none, and so the pair was undecided or without a result
TEST(Certainty, ProgramsThatDoubleDoesNotDecideAreDecided) {
  expect_no_promise_broken<3>({126834, 131767, 162027, 220194, 236073, 258353, 282734, 310253, 360366,
                               408152, 418094, 437974, 445973, 446372, 450714, 456112, 486567, 540294,
                               571232, 575512, 592933, 594612, 649274, 759892, 760007, 760647});
}

// a face that the normal grazes ends the overlap
TEST(Certainty, OverlapsThatEndOnGrazingFacesAreExact) {
  expect_no_promise_broken<3>({289973, 364434, 387692, 413453, 436414, 624014, 757374});
  expect_no_promise_broken<2>({22874, 187672});
}

// rotations and axes are unit but for rounding
TEST(Certainty, NormalsAreUnit) {
  expect_no_promise_broken<3>({25697, 65591, 135417, 153749, 214972, 229089, 348573, 458892, 513414, 571990});
}

// with one plane a millionth as near as the others, the decrement must not cancel: Newton would stop beside the centre
TEST(Certainty, CentresAreReachedFromNextToAPlane) {
  expect_no_promise_broken<3>({376981, 484610});
}

// in eight parts, so that one that was interrupted need not begin again: --gtest_filter=*AMillionPairsLong*/3
class AMillionPairsLong : public testing::TestWithParam<int> {};

TEST_P(AMillionPairsLong, HaveNoWrongResult) {
  constexpr long long part = 125'000, begin = 20'000;
  const int number = GetParam();
  if (number < 6)
    expect_no_promise_broken<3>(begin + number * part, begin + (number + 1) * part);
  else
    expect_no_promise_broken<2>(begin + (number - 6) * part, begin + (number - 5) * part);
}

INSTANTIATE_TEST_SUITE_P(Parts, AMillionPairsLong, testing::Range(0, 8));

}  // namespace
}  // namespace voussoir::certainty_test
