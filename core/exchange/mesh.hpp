// Blocks as surfaces: STL and OBJ in and out. A block is convex, so a surface that is open, folded or not convex is
// refused with the reason.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/types.hpp"
#include "text/file_fault.hpp"

namespace voussoir {

struct Facet {
  std::vector<int> corners;  // places in `points`, counter-clockwise seen from outside
  int line = 0;              // where the file states it; 0: a binary one
};

struct Mesh {
  std::string name;
  int line = 0;
  std::vector<Vector<3>> points;  // m; equal points are one
  std::vector<Facet> facets;
  // m, between neighbouring numbers in the file where its coordinates are largest: of floats in a binary STL, else by
  // the most digits of a coordinate; 0: not read from a file
  double spacing = 0;
  int digits = 0;  // most of a coordinate; 0: floats
};

// Every `solid` of an ASCII STL, or the one solid of a binary one, whose single precision leaves 7 digits. Corners of
// neighbours must be written with equal numbers: they are one point only when they are equal. Throws FileFault.
std::vector<Mesh> read_stl(std::string_view bytes);

// Every object (`o`) of a Wavefront OBJ; of its statements v, f, o, and without effect g, s, vn, vt, vp, usemtl,
// mtllib.
std::vector<Mesh> read_obj(std::string_view text);

// ASCII, 17 digits where needed: points come back to the last bit. STL's facets are triangles, fans of the faces.
std::string stl_text(const std::vector<Mesh>& meshes);
std::string obj_text(const std::vector<Mesh>& meshes);

// The corners of the solid that the mesh bounds. Throws FileFault if it has no volume, is open, is turned inside out
// in part, consists of several pieces, or is not convex by more than the rounding of its coordinates; by less, the
// corners are those of its convex hull. Points on an edge or inside a face are not corners. `remarks` receives the
// effect of the rounding on the block.
std::vector<Vector<3>> convex_corners(const Mesh& mesh, std::vector<FileRemark>* remarks = nullptr);

}  // namespace voussoir
