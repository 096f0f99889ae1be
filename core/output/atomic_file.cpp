#include "core/output/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>

namespace voussoir {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view temporary_extension = ".voussoir-part";

// with the process id two programs that write the same result do not share a temporary file
fs::path temporary_name(const fs::path& path) {
  fs::path temporary = path;
  temporary += std::string(temporary_extension) + std::to_string(::getpid());
  return temporary;
}

bool is_temporary(const fs::path& path) {
  const std::string extension = path.extension().string();
  if (!extension.starts_with(temporary_extension)) return false;
  const std::string_view process = std::string_view(extension).substr(temporary_extension.size());
  return !process.empty() && std::all_of(process.begin(), process.end(), [](char c) { return '0' <= c && c <= '9'; });
}

// 0 or the error
int flush(int file) {
  while (::fsync(file) != 0)
    if (errno != EINTR) return errno;
  return 0;
}

// 0 or the error
int write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(file, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : EIO;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

// A rename is permanent only after its folder is on the disk. File systems that cannot flush a folder return EINVAL.
void flush_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) throw output_error(folder, errno);
  const int error = flush(descriptor);
  ::close(descriptor);
  if (error != 0 && error != EINVAL) throw output_error(folder, error);
}

// a temporary file with the complete content on the disk; errors name the intended file
fs::path write_temporary(const fs::path& path, std::string_view content) {
  const fs::path temporary = temporary_name(path);
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (file < 0) throw output_error(path, errno);

  // a full disk may be reported only when the data is flushed or the file closed; an interrupted close has closed
  int error = write_all(file, content);
  if (error == 0) error = flush(file);
  if (::close(file) != 0 && error == 0 && errno != EINTR) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    throw output_error(path, error);
  }
  return temporary;
}

void put_in_place(const fs::path& temporary, const fs::path& path) {
  if (::rename(temporary.c_str(), path.c_str()) != 0) {
    const int error = errno;
    ::unlink(temporary.c_str());
    throw output_error(path, error);
  }
}

}  // namespace

void write_file(const fs::path& path, std::string_view content) {
  put_in_place(write_temporary(path, content), path);
  flush_folder(path);
}

void write_file_and_keep(const fs::path& path, const fs::path& previous, std::string_view content) {
  const fs::path temporary = write_temporary(path, content);
  if (::rename(path.c_str(), previous.c_str()) != 0 && errno != ENOENT) {
    const int error = errno;
    ::unlink(temporary.c_str());
    throw output_error(previous, error);
  }
  put_in_place(temporary, path);
  flush_folder(path);
}

void append_to_file(const fs::path& path, std::string_view content) {
  const int file = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOFOLLOW);
  if (file < 0) throw output_error(path, errno);
  int error = write_all(file, content);
  if (::close(file) != 0 && error == 0 && errno != EINTR) error = errno;
  if (error != 0) throw output_error(path, error);
}

void move_file(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) throw output_error(to, errno);
  flush_folder(to);
}

void remove_unfinished_files(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (is_temporary(entry.path())) remove_file(entry.path());
}

void remove_file(const fs::path& path) {
  if (::unlink(path.c_str()) != 0 && errno != ENOENT) throw output_error(path, errno);
}

void prepare_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw output_error(folder, error.value());
  if (!fs::is_directory(folder)) throw output_error(folder, ENOTDIR);

  // hours of computing should not be lost because a folder refuses files
  const fs::path probe = temporary_name(folder / "probe");
  const int file = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (file < 0) throw output_error(folder, errno);
  ::close(file);
  remove_file(probe);
}

}  // namespace voussoir
