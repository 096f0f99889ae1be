#include "core/step/bodies_of_step.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace voussoir {
namespace {

// Few are one of so many, in a model of at least the second number of free bodies, that make up this share of the
// residual's square; as many again may join them whose part is that many times the mean of the rest.
constexpr std::size_t few_are_one_of = 50, enough_bodies = 100;
constexpr double share_of_few = 0.5, above_mean = 16;

}  // namespace

template <int Dim>
BodiesOfStep<Dim>::BodiesOfStep(const Unknowns<Dim>& unknowns, const std::vector<int>& few) : list(few) {
  if (list.empty()) {
    list.resize(unknowns.count());
    std::iota(list.begin(), list.end(), 0);
    place = unknowns.place;
    upwards = unknowns.upwards;
    scale = unknowns.scale;
    free = unknowns.free;
    return;
  }
  place.assign(unknowns.place.size(), -1);
  std::vector<int> index(unknowns.count(), -1);
  for (std::size_t i = 0; i < list.size(); ++i)
    place[unknowns.bodies[list[i]]] = index[list[i]] = static_cast<int>(i);
  for (const int i : unknowns.upwards)
    if (index[i] >= 0) upwards.push_back(index[i]);
  scale = of(unknowns.scale);
  free = of(unknowns.free);
}

template <int Dim>
Eigen::VectorXd BodiesOfStep<Dim>::of(const Eigen::VectorXd& all) const {
  constexpr int F = freedoms<Dim>;
  Eigen::VectorXd moving(F * list.size());
  for (std::size_t i = 0; i < list.size(); ++i)
    moving.segment<F>(F * i) = all.segment<F>(F * list[i]);
  return moving;
}

template <int Dim>
Eigen::VectorXd BodiesOfStep<Dim>::among_all(const Eigen::VectorXd& moving, std::size_t count) const {
  constexpr int F = freedoms<Dim>;
  Eigen::VectorXd all = Eigen::VectorXd::Zero(F * count);
  for (std::size_t i = 0; i < list.size(); ++i)
    all.segment<F>(F * list[i]) = moving.segment<F>(F * i);
  return all;
}

template <int Dim>
std::vector<int> few_of_residual(const Unknowns<Dim>& unknowns, const Eigen::VectorXd& residual) {
  constexpr int F = freedoms<Dim>;
  const std::size_t count = unknowns.count(), at_most = count / few_are_one_of;
  if (count < enough_bodies) return {};
  std::vector<std::pair<double, int>> parts;
  double all = 0;
  for (std::size_t i = 0; i < count; ++i) {
    double part = 0;
    for (int f = 0; f < F; ++f)
      part += residual[F * i + f] * residual[F * i + f] / unknowns.scale[F * i + f];
    parts.emplace_back(part, static_cast<int>(i));
    all += part;
  }
  std::ranges::sort(parts, std::ranges::greater{});
  double sum = 0;
  std::size_t few = 0;
  while (few < at_most && sum < share_of_few * all)
    sum += parts[few++].first;
  if (!(sum >= share_of_few * all)) return {};
  const double mean_of_rest = (all - sum) / static_cast<double>(count - few);
  while (few < 2 * at_most && parts[few].first > above_mean * mean_of_rest)
    ++few;
  std::vector<int> list;
  for (std::size_t i = 0; i < few; ++i)
    list.push_back(parts[i].second);
  std::ranges::sort(list);
  return list;
}

template <int Dim>
void keep_others(const Model<Dim>& model, const BodiesOfStep<Dim>& moving, ContactsState<Dim>& contacts) {
  contacts.kept.clear();
  if (!contacts.rises.empty()) return;
  const auto stands = [&](int part) { return moving.place[model.parts[part].body] < 0; };
  for (const Contact<Dim>& c : contacts.list)
    contacts.kept.push_back(!c.bond_due && stands(c.part_a) && stands(c.part_b));
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                   \
  template struct BodiesOfStep<Dim>;                                                                \
  template void keep_others<Dim>(const Model<Dim>&, const BodiesOfStep<Dim>&, ContactsState<Dim>&); \
  template std::vector<int> few_of_residual<Dim>(const Unknowns<Dim>&, const Eigen::VectorXd&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
