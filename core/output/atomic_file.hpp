// Files are written completely or not at all: under a temporary name in the target's folder, flushed to the disk,
// renamed, and the folder flushed. Every function throws OutputError.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/output/output_error.hpp"

namespace voussoir {

// replaces `path` by `content`
void write_file(const std::filesystem::path& path, std::string_view content);

// as write_file; the old file becomes `previous` when the new content is safely on the disk
void write_file_and_keep(const std::filesystem::path& path, const std::filesystem::path& previous,
                         std::string_view content);

// Appends to a file. Not flushed to the disk; a killed program may leave a part of the text.
void append_to_file(const std::filesystem::path& path, std::string_view content);

// renames `from` to `to`
void move_file(const std::filesystem::path& from, const std::filesystem::path& to);

// Temporary files of programs that were killed; the caller knows that no other program writes to the folder.
void remove_unfinished_files(const std::filesystem::path& folder);

// a file that may be absent
void remove_file(const std::filesystem::path& path);

// makes the folder and its parents, and tests that a file can be created there
void prepare_folder(const std::filesystem::path& folder);

}  // namespace voussoir
