// Bytes to joints of another program's format, which the first byte chooses: refused in one line, or a table that reads
// back to itself.
#include <cmath>
#include <cstdint>

#include "app/import/formats.hpp"
#include "fuzz/require.hpp"
#include "text/plain_text.hpp"

namespace voussoir::fuzz {
namespace {

void read(char format, std::string_view text) {
  static constexpr ImportedJoints (*readers[])(std::string_view, const Vector<3>&) = {read_facets, read_fab, read_dxf,
                                                                                      read_traces};
  const ImportedJoints found = readers[static_cast<unsigned char>(format) % 4](text, Vector<3>::Zero());
  require(!found.joints.empty(), "an accepted file has a joint");
  require(found.out_of_plane.size() == found.joints.size(), "every joint has its distance from its plane, or none");
  for (const JointRow& joint : found.joints) {
    double square = 0;
    for (const double x : joint.normal)
      square += x * x;
    require(std::abs(square - 1) < 1e-12 && !(joint.normal.back() < 0), "normals are unit and upward");
    require(*joint.dip_deg >= 0 && *joint.dip_deg <= 90, "a dip is in its range");
    require(*joint.dip_direction_deg >= 0 && *joint.dip_direction_deg < 360, "a dip direction is in its range");
    for (const double extent : joint.extents)
      require(extent > 0, "an extent is positive");
  }
  for (const std::string& remark : found.remarks)
    require(!text_fault(remark), "a remark is one line of plain text");
  for (const Dropped& dropped : found.dropped)
    require(!text_fault(dropped.reason), "a reason is one line of plain text");
  const std::string table = joint_table(found.joints, found.dimension);
  require(joint_table(read_joint_table(table, found.dimension), found.dimension) == table,
          "a table reads back to itself");
}

}  // namespace
}  // namespace voussoir::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace voussoir::fuzz;
  if (size == 0) return 0;
  const Stopwatch stopwatch;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    read(bytes.front(), bytes.substr(1));
  } catch (const voussoir::FileFault& fault) {
    require(!voussoir::text_fault(fault.what()), "an error is one line of plain text");
  }
  return 0;
}
