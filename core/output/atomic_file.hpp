// Files appear whole or not at all: written under a temporary name beside the target, flushed to the disk, renamed, and
// the folder flushed. Every function throws OutputError.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/output/output_error.hpp"

namespace voussoir {

// replaces `path` by `content`
void write_file(const std::filesystem::path& path, std::string_view content);

// as write_file; what `path` was becomes `previous` as soon as the new content is safe on the disk
void write_file_and_keep(const std::filesystem::path& path, const std::filesystem::path& previous,
                         std::string_view content);

// Adds to a file. Not flushed to the disk, and a program that is killed may leave a part of it.
void append_to_file(const std::filesystem::path& path, std::string_view content);

// `to` becomes what `from` was
void move_file(const std::filesystem::path& from, const std::filesystem::path& to);

// Temporary files of programs that were killed; the caller knows that no other program writes to the folder.
void remove_unfinished_files(const std::filesystem::path& folder);

// a file that need not be there
void remove_file(const std::filesystem::path& path);

// makes the folder and its parents, and proves that a file can be created there
void prepare_folder(const std::filesystem::path& folder);

}  // namespace voussoir
