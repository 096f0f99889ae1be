// The bytes of a scene file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace voussoir {

inline constexpr std::uintmax_t largest_scene_file = 16 * 1024 * 1024;  // bytes; a scene is written by hand

// The whole file; SceneError when it is missing, no regular file, too large or unreadable.
std::string file_text(const std::filesystem::path& file);

}  // namespace voussoir
