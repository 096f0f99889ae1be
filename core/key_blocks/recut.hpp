// A block of a sliced mass cut again by other planes, as of a sample of orientations, without slicing the mass.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/surface.hpp"
#include "core/key_blocks/assembly.hpp"

namespace voussoir {

// Cuts blocks that are one convex part, whose every face lies on nothing or with all of its area on one neighbour
// across one joint. If no other plane of the mass crosses such a block, before or after, it has the same faces and
// neighbours in the mass sliced by the other planes (of which joints that end are thought to go on).
template <int Dim>
class Recutter {
 public:
  explicit Recutter(const Assembly<Dim>& assembly);

  // The block with these planes of the joints, by Model::joints and in model coordinates; planes of no joint stay.
  // False, and no block: its faces or neighbours change or it is not such a block; water or bolts act on it. The block
  // has neither `contacts` nor moments. Its memory is used again.
  bool recut(int body, std::span<const HalfSpace<Dim>> planes, Block<Dim>& block);

 private:
  bool is_crossed(const HalfSpace<Dim>& plane, const Vector<Dim>& centroid, double radius,
                  const std::vector<Vector<Dim>>& corners) const;
  bool cut(int body, std::span<const HalfSpace<Dim>> planes);
  bool stays_whole(int body, std::span<const HalfSpace<Dim>> planes) const;
  bool add_faces(int body, Block<Dim>& block) const;

  const Assembly<Dim>& assembly_;
  std::vector<HalfSpace<Dim>> loose_;  // planes of faces that no joint made
  HalfSpaces<Dim> faces_;              // of the block, from its former centroid
  Surface<Dim> surface_;               // likewise
};

}  // namespace voussoir
