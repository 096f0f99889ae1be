// kernel_answers: the contact kernel's results for the overlapping pairs of the contact benchmark, warm 1 %, all with
// area: shape/state/way/number status x y z overlap area, lengths in m with all their digits, one line per pair.
// price_of_reproducible_kernel.sh compares two builds by it.
#include <cstdio>
#include <string>

#include "benchmarks/method.hpp"

namespace {

using namespace voussoir;
using namespace voussoir::benchmarks;

std::vector<Contact<3>> resolve(const std::vector<Pair<3>>& pairs, std::vector<Contact<3>> contacts, bool batched) {
  std::vector<Contact<3>*> slots;
  for (Contact<3>& c : contacts)
    slots.push_back(&c);
  const std::span<const Pair<3>> all(pairs);
  const std::span<Contact<3>* const> places(slots);
  const std::size_t together = batched ? pairs.size() : 1;
  KernelCounters counters;
  for (std::size_t i = 0; i < pairs.size(); i += together)
    narrow_phase<3>(all.subspan(i, together), {}, {}, places.subspan(i, together), counters);
  return contacts;
}

void print(const std::string& name, const std::vector<Contact<3>>& contacts) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactGeometry<3>& g = contacts[i].geometry;
    std::printf("%s/%zu %d %.17g %.17g %.17g %.17g %.17g\n", name.c_str(), i, static_cast<int>(contacts[i].status),
                g.point[0], g.point[1], g.point[2], g.overlap, g.area);
  }
}

}  // namespace

int main() {
  for (int s = 0; s < shape_count; ++s)
    for (const PairState state : {PairState::touch, PairState::face, PairState::deep})
      for (const bool batched : {false, true}) {
        const auto shape = static_cast<Shape>(s);
        const Workload& work = workload(shape, state);
        std::vector<Contact<3>> before = resolve(work.previous[0], std::vector<Contact<3>>(pairs_per_workload), true);
        std::string name = std::string(name_of(shape)) + "/" + name_of(state) + (batched ? "/batched" : "/single");
        for (char& c : name)
          if (c == ' ') c = '-';  // a line's fields are separated by blanks
        print(name, resolve(work.pairs, std::move(before), batched));
      }
}
