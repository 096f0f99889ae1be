#include "core/scene/scene_text.hpp"

#include <fstream>
#include <system_error>

#include "core/scene/scene_error.hpp"

namespace voussoir {

std::string file_text(const std::filesystem::path& file) {
  std::error_code error;
  const std::string name = file.string();
  if (!std::filesystem::exists(file, error)) {
    if (error == std::errc::permission_denied)
      throw SceneError(name + ": a folder on the way to it must not be entered; check the folders' permissions");
    throw SceneError(name + ": no such file; check the path of the scene");
  }
  if (!std::filesystem::is_regular_file(file, error))
    throw SceneError(name + ": not a file; give the path of a scene in TOML, e.g. scene.toml");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size > largest_scene_file)
    throw SceneError(name + ": larger than 16 MB; a scene must be smaller, is this a scene file?");
  // whole or refused: a stream copied to a stream would end quietly where reading fails
  std::ifstream stream(file, std::ios::binary);
  std::string text(size, '\0');
  if (!stream.read(text.data(), static_cast<std::streamsize>(size)))
    throw SceneError(name + ": cannot be read; check its permissions");
  return text;
}

}  // namespace voussoir
