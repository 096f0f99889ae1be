// What a program that links Voussoir needs, and all that docs/library.md calls stable: read a scene, run it, read its
// results, write files and checkpoints, continue from one, and the contact of two convex parts. The other installed
// headers may change with any version.
//
//   const Scene scene = read_scene("scene.toml");
//   const Prepared<3> prepared = prepare<3>(scene);
//   Progress<3> progress = initial_progress(prepared);
//   simulate<3>(prepared, progress, {});
//   const Value* factor = progress.results.find("factor_of_safety");
#pragma once

// the version of the library
#include "core/base/version.hpp"
// read_scene, parse_scene, prepare; SceneError
#include "core/scene/scene.hpp"
#include "core/scene/scene_error.hpp"
// initial_progress, simulate, Watcher; Results
#include "core/output/results.hpp"
#include "core/run/simulate.hpp"
#include "core/run/watcher.hpp"
// results.json, history.csv, any file written completely or not at all; OutputError
#include "core/output/atomic_file.hpp"
#include "core/output/history_csv.hpp"
#include "core/output/output_error.hpp"
#include "core/output/results_json.hpp"
// checkpoint_bytes, read_checkpoint; CheckpointError
#include "core/run/checkpoint.hpp"
// make_block from half-spaces; contact_between two of them
#include "core/contact/contact.hpp"
#include "core/contact/contact_between.hpp"
#include "core/geometry/half_space.hpp"
#include "core/geometry/polytope.hpp"
#include "core/slicing/block.hpp"
