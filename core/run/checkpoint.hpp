// A checkpoint: the progress of a simulation as one block of bytes that is read completely or refused.
//
//   "VOUSSOIR checkpoint\n", order mark 0x01020304, format version
//   dimension, step, scene hash, build, size of the payload
//   payload: every member of Progress
//   checksum (FNV-1a, 64 bits) of all bytes before it: a change of any byte changes it
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/run/progress.hpp"

namespace voussoir {

// incremented with every change of Progress
inline constexpr int checkpoint_format = 26;

// the error of the bytes, e.g. "is damaged: …"; the caller adds the file's name
struct CheckpointError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct CheckpointRecord {
  std::string scene_hash;  // of the scene that was run (LoadedScene::hash)
  std::string build;       // the program that wrote it
  int dimension = 3;
  long long step = 0;
};

// the progress as bytes, for read_checkpoint with the same hash: that of the scene (input_hash)
template <int Dim>
std::string checkpoint_bytes(const Progress<Dim>& progress, const std::string& scene_hash);

// Only the record. Throws CheckpointError for bytes that are not a checkpoint, of another format or byte order,
// truncated or damaged.
CheckpointRecord checkpoint_record(std::string_view bytes);

// The size of the checkpoint with these first bytes, at least 4096 of a longer one: a file of another size need not be
// read. Throws CheckpointError as checkpoint_record does.
std::uintmax_t checkpoint_size(std::string_view head);

// as checkpoint_record, and refuses another scene's or dimension's progress
template <int Dim>
Progress<Dim> read_checkpoint(std::string_view bytes, const std::string& scene_hash);

// this program's build: version, commit, compiler
std::string build_name();

}  // namespace voussoir
