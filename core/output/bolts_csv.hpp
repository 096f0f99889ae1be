// bolts.csv: what the springs of all bolts carried at the end of each stage, a row for each. Columns:
//   stage                    from 1
//   bolts, bolt, joint       the name, which of its bolts, and which joint along it, from the collar; all from 1
//   x_m, y_m, z_m            between the spring's anchors, world coordinates
//   body_a, body_b           its blocks
//   force_N, shear_N         along the bolt, tension positive, and across it; of one bolt, also in the plane
//   extension_m, plastic_m   since it was installed, and how much of it is plastic
//   use                      force over yield; empty where it has none
//   broken                   1 where it is
#pragma once

#include <filesystem>
#include <vector>

#include "core/results.hpp"

namespace voussoir {

std::string bolts_csv(const std::vector<BoltRow>& rows);

// throws OutputError
void write_bolts_csv(const std::filesystem::path& path, const std::vector<BoltRow>& rows);

}  // namespace voussoir
