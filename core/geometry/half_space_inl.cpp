#include "core/geometry/half_space_inl.hpp"

namespace voussoir {

template double signed_distance<2>(const HalfSpace<2>&, const Vector<2>&);
template double signed_distance<3>(const HalfSpace<3>&, const Vector<3>&);

}  // namespace voussoir
