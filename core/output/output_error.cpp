#include "core/output/output_error.hpp"

#include <cerrno>
#include <cstring>

namespace voussoir {
namespace {

OutputError::Kind kind_of(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return OutputError::Kind::disk_full;
    case EACCES:
    case EPERM:
    case EROFS:
      return OutputError::Kind::not_permitted;
    default:
      return OutputError::Kind::failed;
  }
}

}  // namespace

OutputError output_error(const std::filesystem::path& path, int error_number) {
  return {path, std::strerror(error_number), kind_of(error_number)};
}

}  // namespace voussoir
