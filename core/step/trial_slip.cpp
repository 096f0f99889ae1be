#include "core/step/trial_slip.hpp"

#include <algorithm>
#include <vector>

namespace voussoir {
namespace {

constexpr double longest_in_trial = 2;  // elastic displacements

// of the farthest: bodies that come so far are those that move
constexpr double moving_fraction = 0.5;

// of the displacement: what a turn moves points by, from which bodies turn
constexpr double turning_fraction = 0.1;

template <int Dim>
Vector<Dim> accepted_of(const StaticIncrement<Dim>& increment, std::size_t place) {
  return Eigen::Map<const Vector<Dim>>(increment.progress.accepted.data() + freedoms<Dim> * place);
}

// m
template <int Dim>
double longest_of(const Unknowns<Dim>& unknowns, const StaticIncrement<Dim>& increment) {
  std::vector<double> moved(unknowns.count());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const int b = unknowns.bodies[i];
    moved[i] = (increment.base.motions[b].displacement + accepted_of<Dim>(increment, i) - increment.began[b]).norm();
  }
  const double most = *std::ranges::max_element(moved);
  double elastic = 0;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (moved[i] >= moving_fraction * most) elastic = std::max(elastic, increment.elastic[unknowns.bodies[i]]);
  return std::max(longest_in_trial * elastic, most);
}

}  // namespace

template <int Dim>
double shorten_in_trial(const Unknowns<Dim>& unknowns, const StaticIncrement<Dim>& increment, Eigen::VectorXd& dq) {
  if (increment.elastic.empty()) return 0;
  double most = 0;
  for (std::size_t i = 0; i < unknowns.count(); ++i)
    most = std::max(most, dq.template segment<Dim>(freedoms<Dim> * i).norm());
  const double longest = longest_of(unknowns, increment);
  if (!(most > longest)) return 0;
  dq *= longest / most;
  return most / longest;
}

template <int Dim>
bool has_slipped_far(const Model<Dim>& model, double slip, const Unknowns<Dim>& unknowns,
                     const StaticIncrement<Dim>& increment) {
  if (increment.elastic.empty()) return false;
  double most = 0, turned = 0;
  bool far = false;
  for (std::size_t i = 0; i < unknowns.count(); ++i) {
    const int b = unknowns.bodies[i];
    const double moved = accepted_of<Dim>(increment, i).norm();
    const Eigen::Map<const Spin<Dim>> turn(increment.progress.accepted.data() + freedoms<Dim> * i + Dim);
    far = far || moved > slip * increment.elastic[b];
    most = std::max(most, moved);
    turned = std::max(turned, turn.norm() * model.bodies[b].radius);
  }
  return far && turned < turning_fraction * most;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                             \
  template double shorten_in_trial<Dim>(const Unknowns<Dim>&, const StaticIncrement<Dim>&, Eigen::VectorXd&); \
  template bool has_slipped_far<Dim>(const Model<Dim>&, double, const Unknowns<Dim>&, const StaticIncrement<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
