#include "core/output/atomic_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

namespace voussoir {
namespace {

// the process id keeps two programs that write the same result from sharing a temporary file
std::filesystem::path temporary_name(const std::filesystem::path& path) {
  std::filesystem::path temporary = path;
  temporary += ".part" + std::to_string(::getpid());
  return temporary;
}

[[noreturn]] void give_up(const std::filesystem::path& path, const std::filesystem::path& temporary) {
  const std::string reason = std::strerror(errno);
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  throw OutputError(path, reason);
}

}  // namespace

void write_file(const std::filesystem::path& path, std::string_view content) {
  const std::filesystem::path temporary = temporary_name(path);
  std::FILE* file = std::fopen(temporary.c_str(), "wb");
  if (!file) give_up(path, temporary);

  // a full disk may show only when the buffer is flushed: look at the answer of fclose as well
  const bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size();
  const int write_errno = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written) errno = write_errno;
  if (!written || !closed) give_up(path, temporary);
  if (std::rename(temporary.c_str(), path.c_str()) != 0) give_up(path, temporary);
}

void prepare_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw OutputError(folder, error.message());
  if (!std::filesystem::is_directory(folder)) throw OutputError(folder, "not a folder");

  // hours of computing should not end at a folder that refuses files
  const std::filesystem::path probe = temporary_name(folder / "probe");
  std::FILE* file = std::fopen(probe.c_str(), "wb");
  if (!file) throw OutputError(folder, std::strerror(errno));
  std::fclose(file);
  std::filesystem::remove(probe, error);
}

}  // namespace voussoir
