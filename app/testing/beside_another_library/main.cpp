// A program that uses Voussoir's library and another one: the other's values arrive, and the scenes end in the bits of
// the program `voussoir`, with any flags of either. Prints the state hash of each scene that is named.
#include <Eigen/Dense>
#include <cstdio>
#include <vector>
#include <voussoir/core/run/simulate.hpp>
#include <voussoir/core/scene/scene.hpp>

#include "app/testing/beside_another_library/other.hpp"

using namespace voussoir;

namespace {

template <int Dim>
std::string hash_of(const Scene& scene) {
  const Prepared<Dim> prepared = prepare<Dim>(scene);
  Progress<Dim> progress = initial_progress(prepared);
  simulate<Dim>(prepared, progress, {});
  // the library's own vectors in arithmetic of this program's flags
  Vector<Dim> sum = Vector<Dim>::Zero();
  for (const auto& motion : progress.state.bodies.motions)
    sum += 0.1 * motion.displacement + 0.3 * motion.velocity.cwiseAbs();
  const Matrix<Dim> square = sum * sum.transpose() + Matrix<Dim>::Identity();
  if (!(square.inverse().determinant() > 0) || !(sum.normalized().norm() >= 0)) return "no arithmetic";
  return progress.results.state_hash;
}

}  // namespace

int main(int count, char** files) {
  const Sample sample = make_sample();
  std::vector<Eigen::Vector4d> solved;
  for (int k = 0; k < 4; ++k)
    solved.push_back(make_matrix().inverse() * (make_matrix() * Eigen::Vector4d::Unit(k)));
  if (sizeof(Sample) != size_of_sample() || sample.values[2] != 3 || !(std::abs(solved[2][2] - 1) < 1e-14)) {
    std::printf("a vector of another library arrives as %g for 3, in %zu bytes for %zu\n", sample.values[2],
                sizeof(Sample), size_of_sample());
    return 1;
  }
  for (int k = 1; k < count; ++k) {
    const Scene scene = read_scene(files[k]);
    std::printf("%s\n", (scene.dimension == 2 ? hash_of<2>(scene) : hash_of<3>(scene)).c_str());
  }
}
