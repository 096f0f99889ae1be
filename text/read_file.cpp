#include "text/read_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace voussoir {
namespace {

// a regular file that is open for reading
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path) {
    // a pipe without a writer must not keep us waiting
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    const bool missing = errno == ENOENT || errno == ENOTDIR || errno == ELOOP || errno == ENAMETOOLONG;
    if (descriptor_ < 0 && missing) throw ReadFault("no such file; check its path");
    if (descriptor_ < 0) throw ReadFault("cannot be read; check its permissions and those of the folders above it");
    if (::fstat(descriptor_, &status_) != 0 || !S_ISREG(status_.st_mode)) {
      ::close(descriptor_);
      throw ReadFault("not a file but a folder, a pipe or a device; give the path of a file");
    }
  }
  ~OpenFile() { ::close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  std::uintmax_t size() const { return static_cast<std::uintmax_t>(status_.st_size); }

  std::string read(std::uintmax_t count) const {
    std::string content(count, '\0');
    for (std::size_t have = 0; have < content.size();) {
      const ssize_t got = ::read(descriptor_, content.data() + have, content.size() - have);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) throw ReadFault("cannot be read; check its permissions");
      have += static_cast<std::size_t>(got);
    }
    return content;
  }

 private:
  int descriptor_;
  struct stat status_ = {};
};

}  // namespace

std::string read_file(const std::filesystem::path& file, std::uintmax_t most) {
  const OpenFile open(file);
  if (open.size() > most)
    throw ReadFault(fmt::format("larger than {} MB; is this the right file?", most / (1024 * 1024)));
  return open.read(open.size());
}

std::string read_head(const std::filesystem::path& file, std::uintmax_t most, std::uintmax_t& size) {
  const OpenFile open(file);
  size = open.size();
  return open.read(std::min(size, most));
}

}  // namespace voussoir
