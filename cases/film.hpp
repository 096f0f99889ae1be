// A scene run with its frames kept, and pictures of them: blocks as shaded faces.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/run_scene.hpp"
#include "cases/case_tools.hpp"
#include "cases/picture.hpp"

namespace voussoir::cases {

struct Film {
  SceneRun run;
  std::vector<State<3>> frames;  // the begin, then as the scene's output asks, the end of each stage among them

  const Prepared<3>& scene() const { return std::get<Prepared<3>>(run.scene.prepared); }
  const Model<3>& model() const { return scene().model; }
  const State<3>& last() const { return frames.back(); }
};

enum class Goals { demanded, optional };

// Runs a 3-D scene to its end, and demands that it reached its goals unless they are optional.
inline Film film(const std::filesystem::path& path, Goals goals = Goals::demanded,
                 const std::vector<std::string>& overrides = {}) {
  Film film;
  film.run.scene = load_scene(path, overrides);
  const Prepared<3>& scene = film.scene();
  film.frames.push_back(scene.state);
  Watcher<3> watcher;
  watcher.frame = [&](const Model<3>&, const State<3>& state, double) { film.frames.push_back(state); };
  Progress<3> progress = begin(scene);
  simulate(scene, progress, watcher);
  film.run.results = std::move(progress.results);
  const Outcome outcome = film.run.results.outcome;
  if (outcome != Outcome::done && !(goals == Goals::optional && outcome == Outcome::incomplete))
    throw std::runtime_error(path.string() + ": " + film.run.results.message);
  return film;
}

// corners of a body's parts where they are now, model coordinates, m
inline std::vector<Vector<3>> corners(const Body<3>& body, const Motion<3>& motion) {
  std::vector<Vector<3>> points;
  for (const Polytope<3>& part : body.parts)
    for (const Vector<3>& v : part.vertices)
      points.push_back(body.reference + motion.displacement + matrix(motion.rotation) * v);
  return points;
}

// parallel projection
struct Camera {
  double azimuth_deg = -60, height_deg = 20;                   // where the eye stands, from x and from the horizontal
  std::vector<std::string> hidden = {};                        // bodies that are not drawn
  std::function<std::uint32_t(std::size_t body)> colour = {};  // rgb; without it as write_picture says
  // the faces to draw, from their corners (world) and outward normals; without it all that look at the eye
  std::function<bool(std::size_t body, const std::vector<Vector<3>>& corners, const Vector<3>& normal)> drawn = {};
};

// The faces that the camera sees. Fixed bodies are grey, the others have a colour for each number of faces.
inline std::vector<PictureFace> picture(const Model<3>& model, const State<3>& state, const Camera& camera) {
  const View view(camera.azimuth_deg, camera.height_deg);
  std::vector<PictureFace> faces;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<3>& body = model.bodies[b];
    if (std::find(camera.hidden.begin(), camera.hidden.end(), body.name) != camera.hidden.end()) continue;
    const Matrix<3> axes = matrix(state.motions[b].rotation);
    const Vector<3> centroid = model.origin + body.reference + state.motions[b].displacement;
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
        if (body.fixed) faces.back().depth -= 1e6;  // plates lie behind the blocks that stand on them
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
