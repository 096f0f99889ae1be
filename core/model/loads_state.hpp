// The forces and moments on bodies.
#pragma once

#include <vector>

#include "core/base/energy.hpp"
#include "core/geometry/types.hpp"
#include "core/load/load.hpp"

namespace voussoir {

// of bodies, by source
template <int Dim>
using LoadsBySource = BySource<std::vector<Load<Dim>>, load_count>;

// The relief load on a body that excavated rock supported.
template <int Dim>
struct ReliefLoad {
  int body = 0;
  Load<Dim> load;    // at a share of 1; it keeps its direction and acts at the centroid
  double begun = 1;  // the share when the stage began
  double share = 1;  // that acts now
};

// The plate of one of Model::open_faces.
template <int Dim>
struct PlateState {
  Vector<Dim> face = Vector<Dim>::Zero();   // m: of the block's face since the side opened, less that of the column's
  Vector<Dim> plate = Vector<Dim>::Zero();  // m: displacement of the plate, likewise
  Vector<Dim> face_of_column = Vector<Dim>::Zero();  // m; before ground: twice the displacement of what entered
  Vector<Dim> face_origin = Vector<Dim>::Zero(), column_origin = Vector<Dim>::Zero();  // m: when the side opened
  Vector<Dim> force = Vector<Dim>::Zero();                                             // N on the block
};

// a load that stays as it is
template <int Dim>
struct ConstantLoad {
  int body = 0;
  Load<Dim> load;  // it keeps its direction and acts at the centroid
};

// The load that the column's outer image puts on a body of Model::column_bodies.
template <int Dim>
struct ColumnLoad {
  Load<Dim> at_begin, now;
};

// where an image of Model::column_images is relative to its body
template <int Dim>
struct ImageOffset {
  Vector<Dim> displacement = Vector<Dim>::Zero();  // m
  Rotation<Dim> rotation;                          // of its frame, in the body's
};

// What acts through sides that waves leave.
template <int Dim>
struct OpenSidesState {
  double time = 0;                           // s: up to which the plates have moved
  std::vector<PlateState<Dim>> plates;       // as Model::open_faces
  std::vector<ConstantLoad<Dim>> reactions;  // of the supports that were there before
  std::vector<ColumnLoad<Dim>> columns;      // as Model::column_bodies
  std::vector<ImageOffset<Dim>> images;      // as Model::column_images
};

template <int Dim>
struct LoadsState {
  std::vector<Load<Dim>> total;          // by body: of all sources together, before damping
  LoadsBySource<Dim> by_source;          // by body; empty for a source that the scene does not use
  std::vector<BodyStiffness> stiffened;  // by body: added by loads other than the contacts; empty if none adds any
  std::vector<ReliefLoad<Dim>> relief;   // by excavation, then by body
  OpenSidesState<Dim> open_sides;
};

}  // namespace voussoir
