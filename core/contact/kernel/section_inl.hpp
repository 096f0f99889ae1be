// The section of the overlap region by the contact plane: the polygon {y : q·y <= 1}, given by scaled planes q. Its
// corners lie on consecutive planes of a cyclic list, which is kept from step to step; if it is no longer valid, the
// list is found again.
#if defined(VOUSSOIR_SECTION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOUSSOIR_SECTION_INL
#undef VOUSSOIR_SECTION_INL
#else
#define VOUSSOIR_SECTION_INL
#endif

#include <algorithm>

#include "core/contact/kernel/lanes_inl.hpp"
#include "core/contact/kernel/workspace.hpp"

HWY_BEFORE_NAMESPACE();
namespace voussoir {
namespace HWY_NAMESPACE {

// the planes q, slot by slot: first components, and behind them the second
template <class L>
struct SectionPlanes {
  const double* first;
  int apart;  // doubles from one slot to the next

  HWY_INLINE typename L::Wide q0(int slot) const { return L::load(first + slot * apart); }
  HWY_INLINE typename L::Wide q1(int slot) const { return L::load(first + slot * apart + L::step); }
  HWY_INLINE const double* place(int plane, int lane = 0) const {
    return first + L::slot_of(plane) * apart + L::place_of(plane, lane);
  }
  HWY_INLINE double q0_of(int plane, int lane = 0) const { return *place(plane, lane); }
  HWY_INLINE double q1_of(int plane, int lane = 0) const { return place(plane, lane)[L::step]; }
};

// Areas from the lists of each pair; `known` if the list is still valid: each corner is between its planes and inside
// all the others.
template <class L>
HWY_INLINE void section_area_of(const SectionPlanes<L>& planes, const Slots (&parts)[2], const SectionList* lists,
                                const typename L::Bool& good, typename L::Real& area, typename L::Bool& known) {
  using Real = typename L::Real;
  using Wide = typename L::Wide;
  constexpr int most = SectionList::most;
  const Real zero = L::real(0), one = L::real(1);
  int longest = 0;
  for (int lane = 0; lane < L::width; ++lane)
    longest = std::max(longest, lists[lane].size);
  area = zero;
  const Real size = L::collect([&](int lane) { return static_cast<double>(lists[lane].size); });
  known = both(good, size > L::real(2));
  if (none(known)) return;

  Real a0[most + 1], a1[most + 1];
  for (int k = 0; k <= longest; ++k) {
    const double* places[L::width];
    for (int lane = 0; lane < L::width; ++lane)
      places[lane] = planes.place(lists[lane].planes[k], lane);
    a0[k] = L::collect([&](int lane) { return places[lane][0]; });
    a1[k] = L::collect([&](int lane) { return places[lane][L::step]; });
  }

  Real c0[most + 1], c1[most + 1];
  for (int k = 0; k < longest; ++k) {
    // through the difference: planes that are nearly parallel keep the corner on both of them
    const Real d0 = a0[k + 1] - a0[k], d1 = a1[k + 1] - a1[k];
    const Real turn = a0[k] * d1 - a1[k] * d0;
    const auto here = size > L::real(k);
    const auto convex = turn > zero;
    known = but_not(known, but_not(here, convex));
    const Real inverse = one / select(convex, turn, one);
    c0[k] = select(here, d1 * inverse, c0[0]);
    c1[k] = select(here, -d0 * inverse, c1[0]);
  }
  c0[longest] = c0[0];
  c1[longest] = c1[0];
  if (none(known)) return;

  Wide highest = L::wide(0.0);
  for (int k = 0; k < longest; ++k) {
    const Wide x = L::wide(c0[k]), y = L::wide(c1[k]);
    for_slots<L>(parts,
                 [&](int slot) HWY_ATTR { highest = larger(highest, planes.q0(slot) * x + planes.q1(slot) * y); });
  }
  known = both(known, L::most(highest) < L::real(1 + corner_tolerance));
  for (int k = 0; k < longest; ++k)
    area = area + (c0[k] * c1[k + 1] - c1[k] * c0[k + 1]);
  area = L::real(0.5) * area;
}

// the plane with the largest q·y
HWY_INLINE void highest_plane(const SectionPlanes<OnePair>& planes, int quads, double y0, double y1, double& value,
                              int& plane) {
  using L = OnePair;
  const L::Wide x = L::wide(y0), y = L::wide(y1);
  const auto height = [&](int slot) HWY_ATTR { return planes.q0(slot) * x + planes.q1(slot) * y; };
  L::find_largest({0, quads}, -std::numeric_limits<double>::max(), height, value, plane);
}

// Finds the cyclic list without a start: four extreme planes, then at each corner the plane that cuts it off, until
// none does. False when there are more than most_corners, or rounding hides which planes bound the section.
HWY_INLINE bool find_section(const SectionPlanes<OnePair>& planes, int quads, int (&list)[most_corners], int& size,
                             double& area) {
  const double directions[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  size = 0;
  double value;
  int plane;
  for (const auto& d : directions) {
    highest_plane(planes, quads, d[0], d[1], value, plane);
    if (std::find(list, list + size, plane) == list + size) list[size++] = plane;
  }
  double c0[most_corners], c1[most_corners];
  for (int k = 0; k < size;) {
    const int a = list[k], b = list[k + 1 == size ? 0 : k + 1];
    const double a0 = planes.q0_of(a), a1 = planes.q1_of(a);
    const double d0 = planes.q0_of(b) - a0, d1 = planes.q1_of(b) - a1, turn = a0 * d1 - a1 * d0;
    bool cut;
    if (turn > 0) {
      const double inverse = 1 / turn;
      c0[k] = d1 * inverse;
      c1[k] = -d0 * inverse;
      highest_plane(planes, quads, c0[k], c1[k], value, plane);
      cut = value >= 1 + corner_tolerance;
    } else {
      // half a turn or more between the two: some plane lies there, or the section is open
      highest_plane(planes, quads, -a1, a0, value, plane);
      if (!(value > 0)) return false;
      cut = true;
    }
    if (!cut) {
      ++k;
      continue;
    }
    if (size == most_corners || std::find(list, list + size, plane) != list + size) return false;
    std::copy_backward(list + k + 1, list + size, list + size + 1);
    list[k + 1] = plane;
    ++size;
  }
  if (size < 3) return false;
  // the same list from any search: it begins with its smallest number
  const int first = static_cast<int>(std::min_element(list, list + size) - list);
  std::rotate(list, list + first, list + size);
  std::rotate(c0, c0 + first, c0 + size);
  std::rotate(c1, c1 + first, c1 + size);
  area = 0;
  for (int k = 0; k < size; ++k) {
    const int next = k + 1 == size ? 0 : k + 1;
    area = area + (c0[k] * c1[next] - c1[k] * c0[next]);
  }
  area = 0.5 * area;
  return true;
}

// New lists for the pairs in `wanted`, one at a time; `scratch` has room for two numbers of each plane.
template <class L>
HWY_INLINE void rebuild_sections(const SectionPlanes<L>& planes, const Slots (&parts)[2], int quads, double* scratch,
                                 SectionList* lists, const typename L::Bool& wanted, typename L::Real& area,
                                 typename L::Bool& good) {
  if (none(wanted)) return;
  double found[L::width], areas[L::width], failed[L::width];
  L::put(area, areas);
  L::put(select(wanted, L::real(1), L::real(0)), found);
  for (int lane = 0; lane < L::width; ++lane) {
    failed[lane] = 0;
    if (found[lane] == 0) continue;
    SectionPlanes<OnePair> alone{planes.first, planes.apart};
    if constexpr (!L::one_pair) {
      alone = {scratch, 2 * planes_per_quad};
      std::fill_n(scratch, 2 * quads * planes_per_quad, 0.0);
      for_slots<L>(parts, [&](int plane) {
        double* place = scratch + OnePair::slot_of(plane) * alone.apart + OnePair::place_of(plane, 0);
        place[0] = planes.q0_of(plane, lane);
        place[OnePair::step] = planes.q1_of(plane, lane);
      });
    }
    int list[most_corners], size;
    lists[lane].size = 0;
    lists[lane].found_again = true;
    if (!find_section(alone, quads, list, size, areas[lane])) {
      failed[lane] = 1;
      areas[lane] = 0;
    } else if (size <= SectionList::most) {
      std::copy(list, list + size, lists[lane].planes.begin());
      lists[lane].size = size;
    }
  }
  area = L::pick(areas);
  good = but_not(good, L::picked(failed));
}

}  // namespace HWY_NAMESPACE
}  // namespace voussoir
HWY_AFTER_NAMESPACE();
#endif
