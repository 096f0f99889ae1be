#include "app/base/gzip.hpp"

#include <zlib.h>

#include <algorithm>
#include <new>

namespace voussoir {

std::string gzipped(std::string_view bytes) {
  constexpr int window = 15, as_gzip = 16, memory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, window + as_gzip, memory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string packed;
  constexpr std::size_t piece = 1U << 18, largest = 1U << 30;
  int state = Z_OK;
  while (state != Z_STREAM_END) {
    if (stream.avail_in == 0) {
      const std::size_t part = std::min(bytes.size(), largest);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
      stream.avail_in = static_cast<uInt>(part);
      bytes.remove_prefix(part);
    }
    const std::size_t at = packed.size();
    packed.resize(at + piece);
    stream.next_out = reinterpret_cast<Bytef*>(packed.data() + at);
    stream.avail_out = piece;
    state = deflate(&stream, bytes.empty() ? Z_FINISH : Z_NO_FLUSH);
    packed.resize(at + piece - stream.avail_out);
  }
  deflateEnd(&stream);
  return packed;
}

}  // namespace voussoir
