#include "cases/robustness/sweep.hpp"

#include <fmt/format.h>

#include <bit>
#include <stdexcept>

#include "cases/robustness/judges.hpp"

namespace voussoir::atlas {
namespace {

constexpr std::size_t most_reasons = 5;

// the same instance whatever else the grid contains
Random seeded(const Place& place, int instance) {
  std::uint64_t seed = 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(instance);
  for (const std::uint64_t part : {static_cast<std::uint64_t>(place.axis), std::bit_cast<std::uint64_t>(place.value),
                                   std::bit_cast<std::uint64_t>(place.depth)})
    seed = (seed ^ part) * 0xff51afd7ed558ccdu + (seed >> 29);
  return Random(seed);
}

BlockResult<3> made(const HalfSpaces<3>& planes) {
  return make_block<3>(planes, std::vector<int>(planes.size(), no_joint));
}

void refuse_all(Judgements& all, std::initializer_list<Kernel> list) {
  for (const Kernel k : list)
    of(all, k).verdict = Verdict::refused;
}

constexpr int most_kinds = 60;  // a multiple of the number of kinds of meetings and of cuts

// a solid with one plane more, and the same solid cut by that plane
void judge_plane(const Shapes& s, const Place& place, Random& random, Judgements& all) {
  const Matrix<3> straight = Matrix<3>::Identity();
  const HalfSpaces<3> far = shapes::placed<3>(s.a, straight, s.made);
  const BlockResult<3> near = made(s.a);
  if (near.status != BlockStatus::ok) {
    of(all, Kernel::block) = judge_block(far);
    refuse_all(all, {Kernel::cut});
    return;
  }
  const HalfSpaces<3> plane = shapes::placed<3>(
      {cutting_plane(near.part, place, shapes::integer(random, 0, most_kinds - 1), random)}, straight, s.made);
  HalfSpaces<3> planes = far;
  planes.push_back(plane[0]);
  shapes::shuffle(planes, random);
  of(all, Kernel::block) = judge_block(planes);
  const BlockResult<3> block = made(far);
  if (block.status == BlockStatus::ok)
    of(all, Kernel::cut) = judge_cut(block.part, plane[0]);
  else
    refuse_all(all, {Kernel::cut});
}

void judge_pair(const Shapes& s, const Place& place, Random& random, Judgements& all) {
  const BlockResult<3> a = made(shapes::placed<3>(s.a, Matrix<3>::Identity(), s.made)),
                       b = made(shapes::placed<3>(s.b, Matrix<3>::Identity(), s.made));
  if (a.status != BlockStatus::ok || b.status != BlockStatus::ok) {
    refuse_all(all, {Kernel::decision, Kernel::centre, Kernel::normal, Kernel::overlap, Kernel::area});
    return;
  }
  Judgements pair = judge_pair(meet(a.part, b.part, place, shapes::integer(random, 0, most_kinds - 1), random));
  for (const Kernel k : {Kernel::decision, Kernel::centre, Kernel::normal, Kernel::overlap, Kernel::area})
    of(all, k) = of(pair, k);
}

}  // namespace

void Tally::add(const Judgement& judgement, const std::string& where) {
  switch (judgement.verdict) {
    case Verdict::not_asked:
      return;
    case Verdict::correct:
      ++correct;
      worst_fraction = std::max(worst_fraction, judgement.fraction);
      return;
    case Verdict::warned:
      ++warned;
      return;
    case Verdict::refused:
      ++refused;
      return;
    case Verdict::wrong:
      ++wrong;
      if (reasons.size() < most_reasons) reasons.push_back(where + ": " + judgement.reason);
  }
}

Judgements judge_instance(const Place& place, int instance) {
  Random random = seeded(place, instance);
  const Shapes s = random_shapes(place, random);
  Judgements all;
  if (place.axis != Axis::placed) judge_plane(s, place, random, all);
  judge_pair(s, place, random, all);
  return all;
}

Atlas sweep(const Grid& grid) {
  Atlas atlas;
  for (int axis = 0; axis < axes; ++axis)
    for (const double value : grid.values[axis])
      for (const double depth : grid.depths) {
        Cell cell{{static_cast<Axis>(axis), value, depth}, {}};
        for (int i = 0; i < grid.instances; ++i) {
          const Judgements all = judge_instance(cell.place, i);
          const std::string where =
              fmt::format("{} {:.3g}, depth {:.3g}, instance {}", axis_names[axis], value, depth, i);
          for (int k = 0; k < kernels; ++k) {
            cell.worst[k] = worse(cell.worst[k], all[k].verdict);
            atlas.tallies[k].add(all[k], where);
          }
        }
        atlas.cells.push_back(std::move(cell));
      }
  return atlas;
}

}  // namespace voussoir::atlas
