#include "core/run/checkpoint.hpp"

#include <fmt/format.h>

#include <cereal/archives/binary.hpp>
#include <cstdint>
#include <cstring>
#include <istream>
#include <streambuf>

#include "core/base/fingerprint.hpp"
#include "core/base/version.hpp"
#include "core/run/fields.hpp"

namespace voussoir {
namespace {

constexpr std::string_view checkpoint_magic = "VOUSSOIR checkpoint\n";
constexpr std::uint32_t order_mark = 0x01020304;
constexpr std::size_t seal_size = 24;  // the text of a checksum: "fnv1a64:" and 16 digits

// after magic and order mark
struct Header {
  std::uint32_t format = checkpoint_format, dimension = 3;
  std::int64_t step = 0;
  std::string scene_hash, build;
  std::uint64_t payload = 0;  // bytes

  template <class Archive>
  void serialize(Archive& archive) {
    archive(format, dimension, step, scene_hash, build, payload);
  }
};

// reads memory without a copy
struct Bytes : std::streambuf {
  explicit Bytes(std::string_view bytes) {
    char* begin = const_cast<char*>(bytes.data());
    setg(begin, begin, begin + bytes.size());
  }
  std::size_t consumed() const { return static_cast<std::size_t>(gptr() - eback()); }
};

void require_format(std::uint32_t format) {
  if (format != checkpoint_format)
    throw CheckpointError(
        fmt::format("has format {}, this program reads format {}: resume it with the program that "
                    "wrote it",
                    format, checkpoint_format));
}

// the bytes between magic and seal, after the seal has been verified
std::string_view unseal(std::string_view bytes) {
  if (!bytes.starts_with(checkpoint_magic)) throw CheckpointError("is not a checkpoint of this program");
  constexpr std::size_t least = checkpoint_magic.size() + sizeof order_mark + seal_size;
  if (bytes.size() < least) throw CheckpointError("is cut short");
  std::uint32_t mark = 0;
  std::memcpy(&mark, bytes.data() + checkpoint_magic.size(), sizeof mark);
  if (mark == 0x04030201) throw CheckpointError("was written on a machine with the other byte order");
  const std::string_view content = bytes.substr(0, bytes.size() - seal_size);
  if (fingerprint(content) != bytes.substr(content.size())) throw CheckpointError("is damaged or cut short");
  if (mark != order_mark) throw CheckpointError("was written on a machine of unknown byte order");
  return content.substr(checkpoint_magic.size() + sizeof mark);
}

// the header, and the bytes after it
Header read_header(std::string_view& content) {
  Bytes source(content);
  std::istream stream(&source);
  cereal::BinaryInputArchive archive(stream);
  Header header;
  archive(header.format);
  require_format(header.format);
  archive(header.dimension, header.step, header.scene_hash, header.build, header.payload);
  content.remove_prefix(source.consumed());
  if (header.payload != content.size()) throw CheckpointError("does not have the size it states");
  return header;
}

}  // namespace

std::string build_name() {
  return fmt::format("voussoir {} ({}), {}", version(), commit(), compiler());
}

template <int Dim>
std::string checkpoint_bytes(const Progress<Dim>& progress, const std::string& scene_hash) {
  const std::string payload = bytes_of(progress);
  std::string bytes(checkpoint_magic);
  bytes.append(reinterpret_cast<const char*>(&order_mark), sizeof order_mark);
  bytes +=
      bytes_of(Header{checkpoint_format, Dim, progress.state.counters.steps, scene_hash, build_name(), payload.size()});
  bytes += payload;
  bytes += fingerprint(bytes);
  return bytes;
}

CheckpointRecord checkpoint_record(std::string_view bytes) {
  std::string_view content = unseal(bytes);
  const Header header = read_header(content);
  return {header.scene_hash, header.build, static_cast<int>(header.dimension), header.step};
}

std::uintmax_t checkpoint_size(std::string_view head) {
  // by hand: these bytes are not verified yet, and a library would allocate memory for any length that they state
  constexpr std::uint64_t longest_text = 2000;
  std::string_view rest = head;
  const auto take = [&rest]<class T>(T number) {
    if (rest.size() < sizeof number) throw CheckpointError("is damaged or cut short");
    std::memcpy(&number, rest.data(), sizeof number);
    rest.remove_prefix(sizeof number);
    return number;
  };
  if (!head.starts_with(checkpoint_magic)) throw CheckpointError("is not a checkpoint of this program");
  rest.remove_prefix(checkpoint_magic.size());
  if (take(std::uint32_t{}) != order_mark) return head.size();  // the reader reports the reason
  require_format(take(std::uint32_t{}));
  take(std::uint32_t{});  // dimension
  take(std::int64_t{});   // step
  for (int text = 0; text < 2; ++text) {
    const auto length = take(std::uint64_t{});
    if (length > longest_text || length > rest.size()) throw CheckpointError("is damaged or cut short");
    rest.remove_prefix(length);
  }
  const auto payload = take(std::uint64_t{});
  return (head.size() - rest.size()) + payload + seal_size;
}

template <int Dim>
Progress<Dim> read_checkpoint(std::string_view bytes, const std::string& scene_hash) {
  std::string_view content = unseal(bytes);
  const Header header = read_header(content);
  if (header.scene_hash != scene_hash || header.dimension != Dim)
    throw CheckpointError("belongs to another scene: was the scene in the folder changed?");
  Bytes source(content);
  std::istream stream(&source);
  cereal::BinaryInputArchive archive(stream);
  Progress<Dim> progress;
  archive(progress);
  return progress;
}

template std::string checkpoint_bytes<2>(const Progress<2>&, const std::string&);
template std::string checkpoint_bytes<3>(const Progress<3>&, const std::string&);
template Progress<2> read_checkpoint<2>(std::string_view, const std::string&);
template Progress<3> read_checkpoint<3>(std::string_view, const std::string&);

}  // namespace voussoir
