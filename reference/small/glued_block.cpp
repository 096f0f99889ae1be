#include "reference/small/glued_block.hpp"

namespace voussoir::reference {
namespace {

double weight_of(const GluedBlock& b) {
  return b.density * b.gravity * b.length * b.height;
}

double moment_of(const GluedBlock& b) {
  return 0.5 * b.length * weight_of(b);
}

}  // namespace

double glued_rotation(const GluedBlock& b) {
  return 12 * moment_of(b) / (b.normal_stiffness * b.height * b.height * b.height);
}

double glued_drop(const GluedBlock& b) {
  return weight_of(b) / (b.shear_stiffness * b.height) + 0.5 * b.length * glued_rotation(b);
}

double glued_edge_tension(const GluedBlock& b) {
  return 6 * moment_of(b) / (b.height * b.height);
}

double glued_part_tension(const GluedBlock& b, int parts) {
  const double n = parts;
  return glued_edge_tension(b) * (1 - 1 / n) / (1 - 1 / (n * n));
}

}  // namespace voussoir::reference
