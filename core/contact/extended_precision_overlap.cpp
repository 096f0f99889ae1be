#include "core/contact/extended_precision_overlap.hpp"

#include <array>
#include <limits>
#include <span>

#include "core/solvers/double_double.hpp"

namespace voussoir {
namespace {

template <int Dim>
using Row = std::array<DoubleDouble, Dim>;

template <int Dim>
Row<Dim> row_of(const Vector<Dim>& v) {
  Row<Dim> row;
  for (int k = 0; k < Dim; ++k)
    row[k] = v[k];
  return row;
}

template <int Dim>
DoubleDouble product(const Row<Dim>& a, const Vector<Dim>& b) {
  DoubleDouble sum;
  for (int k = 0; k < Dim; ++k)
    sum = sum + a[k] * b[k];
  return sum;
}

// the nearest face that a ray from the point meets, point and direction in the part's own frame
template <int Dim>
struct End {
  DoubleDouble distance = std::numeric_limits<double>::max();
  int face = -1;

  End(std::span<const HalfSpace<Dim>> faces, const Row<Dim>& point, const Row<Dim>& direction) {
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const DoubleDouble slope = product<Dim>(direction, faces[i].normal);
      if (!(slope > 0)) continue;
      const DoubleDouble along = (faces[i].offset - product<Dim>(point, faces[i].normal)) / slope;
      if (!(along < distance)) continue;
      distance = along;
      face = static_cast<int>(i);
    }
  }
};

}  // namespace

template <int Dim>
void measure_overlap_in_extended_precision(const Pair<Dim>& pair, Contact<Dim>& contact) {
  const Vector<Dim>&point = contact.proof.point, &axis = contact.proof.axis;
  Row<Dim> from_b, point_b, backward_b;
  for (int k = 0; k < Dim; ++k)
    from_b[k] = exact_sum(point[k], -pair.offset[k]);
  for (int k = 0; k < Dim; ++k) {
    const Vector<Dim> column = pair.rotation.col(k);
    point_b[k] = product<Dim>(from_b, column);
    backward_b[k] = -product<Dim>(row_of<Dim>(axis), column);
  }
  const End<Dim> a(pair.a->faces, row_of<Dim>(point), row_of<Dim>(axis)), b(pair.b->faces, point_b, backward_b);
  if (a.face < 0 || b.face < 0) return;
  contact.geometry.overlap = (a.distance + b.distance).high;
  contact.geometry.face_a = a.face;
  contact.geometry.face_b = b.face;
}

template void measure_overlap_in_extended_precision<2>(const Pair<2>&, Contact<2>&);
template void measure_overlap_in_extended_precision<3>(const Pair<3>&, Contact<3>&);

}  // namespace voussoir
