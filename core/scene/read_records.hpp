// Earthquake records that a scene names: files read into the scene's tree, and the motions that follow.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene_files.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// `factor = { record = … }` becomes a list of one, so that overrides address every record as factor.1, factor.2, …
void list_records(Node& scene);

// Reads the file of every record below [[stage]] whose samples are not stated, or whose file, interval or column an
// override has changed, into its key `samples`: so checks, the scene's hash and a resumed run see the values. A file is
// in the folder of the file that names it; `scene_file` is that of the scene itself. The tree need not be checked yet.
void read_record_files(Node& scene, const std::string& scene_file, FilesRead& read);

// The records that a checked table states under `factor`; empty if it states none.
std::vector<RecordSpec> read_records(const Subject& table);

// its motion and direction, as many entries as dimensions
RecordedMotion recorded_motion(const RecordSpec& record, int dimension);

}  // namespace voussoir
