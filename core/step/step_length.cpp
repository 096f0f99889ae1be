#include "core/step/step_length.hpp"
#include "core/step/support_table.hpp"

#include <algorithm>
#include <vector>

namespace voussoir {
namespace {

// The longest relative step of neighbours, over the smaller one's inscribed radius: beyond it contacts have another
// geometry.
constexpr double longest_step = 0.02;

// with more free bodies than this, a few loose ones do not shorten the steps of the others
constexpr std::size_t many = 100;
constexpr std::ptrdiff_t one_loose_of = 50;

template <int Dim>
Vector<Dim> way_of(const Eigen::VectorXd& dq, int at) {
  return at < 0 ? Vector<Dim>(Vector<Dim>::Zero()) : Vector<Dim>(dq.segment<Dim>(freedoms<Dim> * at));
}

// Step over the allowed one: of a body relative to its neighbours, since a column may sink by far more than the width
// of its blocks; of one without neighbours, absolute.
template <int Dim>
std::vector<double> excess_by_body(const Model<Dim>& model, const Unknowns<Dim>& unknowns, const State<Dim>& state,
                                   const Eigen::VectorXd& dq) {
  std::vector<double> excess(unknowns.count(), 0);
  std::vector<char> alone(unknowns.count(), 1);
  const auto add_pair = [&](int ba, int bb) {
    const int a = unknowns.place[ba], b = unknowns.place[bb];
    if (a < 0 && b < 0) return;
    const std::vector<double>& radius = unknowns.radius;
    const double size = a < 0 ? radius[bb] : b < 0 ? radius[ba] : std::min(radius[ba], radius[bb]);
    const double over = (way_of<Dim>(dq, b) - way_of<Dim>(dq, a)).norm() / (longest_step * size);
    const int mover = way_of<Dim>(dq, a).norm() > way_of<Dim>(dq, b).norm() ? a : b;
    if (mover >= 0) excess[mover] = std::max(excess[mover], over);
    if (a >= 0) alone[a] = 0;
    if (b >= 0) alone[b] = 0;
  };
  for (const Contact<Dim>& c : state.contacts.list)
    if (c.status != ContactStatus::apart) add_pair(model.parts[c.part_a].body, model.parts[c.part_b].body);
  for (const StepSupport<Dim>& row : step_supports<Dim>)
    if (row.touch) row.touch(model, state.supports, add_pair);
  for (std::size_t i = 0; i < unknowns.count(); ++i) {
    const Body<Dim>& body = model.bodies[unknowns.bodies[i]];
    const double turning = body.radius * dq.segment<spin_freedoms<Dim>>(freedoms<Dim> * i + Dim).norm();
    const double own = turning + (alone[i] ? way_of<Dim>(dq, static_cast<int>(i)).norm() : 0);
    excess[i] = std::max(excess[i], own / (longest_step * unknowns.radius[unknowns.bodies[i]]));
  }
  return excess;
}

}  // namespace

template <int Dim>
double shorten(const Model<Dim>& model, const Unknowns<Dim>& unknowns, const State<Dim>& state, Eigen::VectorXd& dq) {
  constexpr int F = freedoms<Dim>;
  const std::size_t count = unknowns.count();
  std::vector<double> excess = excess_by_body(model, unknowns, state, dq);
  const auto loose = std::count_if(excess.begin(), excess.end(), [](double over) { return over > 1; });
  if (loose > 0 && count >= many && loose * one_loose_of <= static_cast<std::ptrdiff_t>(count)) {
    for (std::size_t i = 0; i < count; ++i)
      if (excess[i] > 1) dq.segment<F>(F * i) /= excess[i];
    excess = excess_by_body(model, unknowns, state, dq);
  }
  const double overshoot = excess.empty() ? 0 : *std::max_element(excess.begin(), excess.end());
  if (overshoot > 1) dq /= overshoot;
  return overshoot;
}

template double shorten<2>(const Model<2>&, const Unknowns<2>&, const State<2>&, Eigen::VectorXd&);
template double shorten<3>(const Model<3>&, const Unknowns<3>&, const State<3>&, Eigen::VectorXd&);

}  // namespace voussoir
