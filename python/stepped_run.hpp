// A scene that is run in portions of steps, without Python in it: what module.cpp shows to Python.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

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

// Throws SceneError, also for what the core alone cannot do: outside solvers, and runs beside the answer.
std::shared_ptr<const OpenedScene> open_scene(Scene stated);

// How the bodies have moved, by body: what arrays of Python look into.
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

  // Advances by at most so many steps, fewer where `stop`, which is asked before each, says so. False: the scene is
  // done. After an exception nothing can be told of the run any more, and it refuses to go on.
  virtual bool advance(long long steps, const std::function<bool()>& stop) = 0;
  virtual bool done() const = 0;

  virtual int dimension() const = 0;
  virtual double time() const = 0;  // s
  virtual long long steps() const = 0;
  virtual std::string stage() const = 0;  // under way, or the last one
  virtual std::vector<std::string> body_names() const = 0;
  virtual std::string state_hash() const = 0;  // core/model/state_hash.hpp

  // The arrays of now. They stay where they are, and get the numbers of the present with `show_motions`, until a stage
  // adds bodies; those of before then keep the last numbers that they had.
  virtual std::shared_ptr<const MotionArrays> motions() const = 0;
  virtual void show_motions() = 0;

  // as the program's frames of this moment hold them (core/output/paraview.hpp)
  virtual PolyData contacts() const = 0;
  virtual PolyData surface() const = 0;

  virtual std::string results() const = 0;  // the text of results.json
  virtual History history() const = 0;

  // Writes what the program writes for a run: scene.toml, history.csv, bolts.csv, lining.csv, a frame of now and, once
  // the scene is done, results.json. The next time into the same folder it adds a frame. Throws FileInTheWay where it
  // would replace a file that the scene reads, a run of the program, or without `overwrite` any file of another run,
  // and OutputError.
  virtual void save(const std::filesystem::path& folder, bool overwrite) = 0;
};

// from the start
std::unique_ptr<SteppedRun> start(const std::shared_ptr<const OpenedScene>& scene, int threads);

}  // namespace voussoir::python
