#include "core/testing/end_bytes.hpp"

#include "core/run/fields.hpp"

namespace voussoir {

template <int Dim>
std::string bits_of(const State<Dim>& state) {
  return bytes_of(state);
}

template <int Dim>
std::string bits_of(const Progress<Dim>& progress) {
  return bytes_of(progress);
}

template <int Dim>
std::string end_of(Progress<Dim> progress) {
  progress.results.seconds = 0;
  return bytes_of(progress);
}

#define INSTANTIATE(Dim)                                   \
  template std::string bits_of<Dim>(const State<Dim>&);    \
  template std::string bits_of<Dim>(const Progress<Dim>&); \
  template std::string end_of<Dim>(Progress<Dim>);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

}  // namespace voussoir
