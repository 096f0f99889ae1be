#include "core/scene/scene_text.hpp"

#include "core/scene/scene_error.hpp"
#include "text/plain_text.hpp"
#include "text/read_file.hpp"

namespace voussoir {

std::string file_text(const std::filesystem::path& file) {
  try {
    return read_file(file, largest_scene_file);
  } catch (const ReadFault& fault) {
    throw SceneError(printable(file.string()) + ": " + fault.what(), printable(file.string()));
  }
}

}  // namespace voussoir
