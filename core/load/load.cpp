#include "core/load/load.hpp"

namespace voussoir {

template <int Dim>
Load<Dim>& Load<Dim>::operator+=(const Load& more) {
  force += more.force;
  moment += more.moment;
  return *this;
}

template <int Dim>
Load<Dim> load_of(const DeadLoad<Dim>& load, const Matrix<Dim>& axes) {
  return {load.force, moment(Vector<Dim>(axes * load.place), load.force)};
}

template struct Load<2>;
template struct Load<3>;
template Load<2> load_of<2>(const DeadLoad<2>&, const Matrix<2>&);
template Load<3> load_of<3>(const DeadLoad<3>&, const Matrix<3>&);

}  // namespace voussoir
