#include "core/scene/scene_text.hpp"

#include <fstream>
#include <sstream>

#include "core/scene/scene_error.hpp"

namespace voussoir {

std::string file_text(const std::filesystem::path& file) {
  std::error_code error;
  const std::string name = file.string();
  if (!std::filesystem::exists(file, error)) throw SceneError(name + ": no such file; check the path of the scene");
  if (!std::filesystem::is_regular_file(file, error))
    throw SceneError(name + ": not a file; give the path of a scene in TOML, e.g. scene.toml");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size > largest_scene_file)
    throw SceneError(name + ": larger than 16 MB; a scene must be smaller, is this a scene file?");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream && size > 0) text << stream.rdbuf();
  if (!stream) throw SceneError(name + ": cannot be read; check its permissions");
  return text.str();
}

}  // namespace voussoir
