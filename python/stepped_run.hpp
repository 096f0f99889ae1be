// A scene that is run in portions of steps, without Python: module.cpp binds it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "core/key_blocks/block_survey.hpp"
#include "core/model/prepared.hpp"
#include "core/output/results.hpp"
#include "core/output/vtp.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::python {

// read, cut and judged
struct OpenedScene {
  Scene stated;
  std::string text;                   // the effective scene: the file with its overrides, as TOML
  std::string hash;                   // as in results.json of the program's run
  std::vector<std::string> warnings;  // stated values that look like mistakes, one line each
  std::variant<Prepared<2>, Prepared<3>> prepared;
};

// Throws SceneError, also for features that the core lacks: external solvers, and additional runs for a result.
std::shared_ptr<const OpenedScene> open_scene(Scene stated);

// what `voussoir blocks` writes
struct BlockVerdicts {
  std::string json, csv;
  PolyData surface;
};

// Throws BadInput for scenes and stages that it cannot judge.
BlockVerdicts judge_blocks(const OpenedScene& scene, const SurveyRequest& request);

// The motion of the bodies, by body: the data of Python's arrays.
struct MotionArrays {
  int bodies = 0;
  std::vector<double> displacement;  // m, of the centroid; as many numbers for each body as the scene has dimensions
  std::vector<double> rotation;      // rad: a rotation vector for each body; in the plane an angle
  std::vector<double> velocity;      // m/s, half a step behind
};

// a file that must not be replaced: one line that names it
struct FileInTheWay : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class SteppedRun {
 public:
  virtual ~SteppedRun() = default;

  // Advances by at most this number of steps, fewer if `stop`, which is called before each, returns true. False: the
  // scene is done. After an exception the state of the run is undefined, and it refuses to continue.
  virtual bool advance(long long steps, const std::function<bool()>& stop) = 0;
  virtual bool done() const = 0;

  virtual int dimension() const = 0;
  virtual double time() const = 0;  // s
  virtual long long steps() const = 0;
  virtual std::string stage() const = 0;  // the present one, or the last
  virtual std::vector<std::string> body_names() const = 0;
  virtual std::string state_hash() const = 0;  // core/model/state_hash.hpp

  // The present arrays. Their addresses stay valid, and `show_motions` updates their values, until a stage adds bodies;
  // earlier arrays then keep their last values.
  virtual std::shared_ptr<const MotionArrays> motions() const = 0;
  virtual void show_motions() = 0;

  // as in the program's frames of this moment (core/output/paraview.hpp)
  virtual PolyData contacts() const = 0;
  virtual PolyData surface() const = 0;

  virtual std::string results() const = 0;  // the text of results.json
  virtual History history() const = 0;

  // Writes the files of the program's run: scene.toml, history.csv, bolts.csv, lining.csv, a frame of the present, with
  // output.view in view.bin too, and, once the scene is done, results.json. Another call for the same folder adds a
  // frame. Throws FileInTheWay if it would replace a file that the scene reads, a run of the program, or without
  // `overwrite` any file of another run, and OutputError.
  virtual void save(const std::filesystem::path& folder, bool overwrite) = 0;

  // Writes view.bin, the data of the interactive page: the start and the present. Throws OutputError.
  virtual void write_view(const std::filesystem::path& folder) const = 0;
};

// from the start
std::unique_ptr<SteppedRun> start(const std::shared_ptr<const OpenedScene>& scene, int threads);

}  // namespace voussoir::python
