// Pictures of a model in space: blocks as shaded faces.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cases/picture.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir::cases {

// current corners of a body's parts, model coordinates, m
inline std::vector<Vector<3>> corners(const Body<3>& body, const Motion<3>& motion) {
  std::vector<Vector<3>> points;
  for (const Polytope<3>& part : body.parts)
    for (const Vector<3>& v : part.vertices)
      points.push_back(body.reference + motion.displacement + matrix(motion.rotation) * v);
  return points;
}

// parallel projection
struct Camera {
  double azimuth_deg = -60, height_deg = 20;                   // direction of the eye, from x and from the horizontal
  std::vector<std::string> hidden = {};                        // bodies that are not drawn
  std::function<std::uint32_t(std::size_t body)> colour = {};  // rgb; default: see write_picture
  // selects the faces to draw by corners (world) and outward normals; default: all that face the eye
  std::function<bool(std::size_t body, const std::vector<Vector<3>>& corners, const Vector<3>& normal)> drawn = {};
};

// The faces that the camera sees. Fixed bodies are grey, the others have a colour for each number of faces.
inline std::vector<PictureFace> picture(const Model<3>& model, const State<3>& state, const Camera& camera) {
  const View view(camera.azimuth_deg, camera.height_deg);
  std::vector<PictureFace> faces;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<3>& body = model.bodies[b];
    if (std::find(camera.hidden.begin(), camera.hidden.end(), body.name) != camera.hidden.end()) continue;
    const Matrix<3> axes = matrix(state.bodies.motions[b].rotation);
    const Vector<3> centroid = model.origin + body.reference + state.bodies.motions[b].displacement;
    for (const Polytope<3>& part : body.parts)
      for (std::size_t f = 0; f < part.faces.size(); ++f) {
        const Vector<3> normal = axes * part.faces[f].normal;
        if (normal.dot(view.eye) <= 0) continue;
        std::vector<Vector<3>> corners;
        for (const int v : part.loops[f])
          corners.push_back(centroid + axes * part.vertices[v]);
        if (camera.drawn && !camera.drawn(b, corners, normal)) continue;
        // Okabe and Ito's colours, by 4, 6, 8, 12 and 20 faces
        const std::size_t count = part.faces.size();
        const std::uint32_t base = camera.colour ? camera.colour(b)
                                   : body.fixed  ? (b % 2 ? 0xd0d0d0 : 0xb8b8a0)
                                   : count <= 4  ? 0xd55e00
                                   : count <= 6  ? 0x0072b2
                                   : count <= 8  ? 0x009e73
                                   : count <= 12 ? 0xcc79a7
                                                 : 0xe69f00;
        faces.push_back(shaded_face(view, corners, normal, base));
        faces.back().depth = centroid.dot(view.eye);
        if (body.fixed) faces.back().depth -= 1e6;  // plates are behind the blocks on them
      }
  }
  return faces;
}

// the same as CSV
inline void write_picture(const std::string& case_name, const std::string& file, const Model<3>& model,
                          const State<3>& state, const Camera& camera) {
  write_faces(case_name, file, picture(model, state, camera));
}

}  // namespace voussoir::cases
