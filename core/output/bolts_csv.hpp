// bolts.csv: what the springs of all bolts carried at the end of each stage, a row for each, and before those of a
// grouted bolt one for its plate. A grouted bar carries most at a joint or at its plate, so that the rows hold its
// greatest force. Columns:
//   stage                    from 1
//   bolts, bolt, joint       the name, which of its bolts, and which joint along it, from the collar; all from 1; joint
//   0 is a plate x_m, y_m, z_m            between the spring's anchors, world coordinates body_a, body_b           its
//   blocks force_N, shear_N         along the bolt, tension positive, and across it; of one bolt, also in the plane
//   extension_m, plastic_m   since it was installed, and how much of it is plastic; of a grouted bar how far the joint
//                            has opened along it, and how far the bar has yielded there
//   use                      force over yield; empty where it has none
//   broken                   1 where it is
//   slip_m                   of a grouted bar in the two blocks at the joint, the most; empty of others
#pragma once

#include <filesystem>
#include <vector>

#include "core/output/results.hpp"

namespace voussoir {

std::string bolts_csv(const std::vector<BoltRow>& rows);

// throws OutputError
void write_bolts_csv(const std::filesystem::path& path, const std::vector<BoltRow>& rows);

}  // namespace voussoir
