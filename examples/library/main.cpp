// A program that links Voussoir: runs each scene that is named, in two parts with a checkpoint between them, writes its
// results.json, and asks for the contact of two cubes.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <voussoir/voussoir.hpp>

using namespace voussoir;

namespace {

template <int Dim>
void run_in_two_parts(const Scene& scene, const std::filesystem::path& out) {
  const Prepared<Dim> prepared = prepare<Dim>(scene);
  Progress<Dim> progress = initial_progress(prepared);
  int steps = 0;
  Watcher<Dim> watcher;
  watcher.pause = [&](const Progress<Dim>&) { return ++steps > 5; };
  if (!simulate(prepared, progress, watcher)) {
    const std::string hash = input_hash(scene);
    const std::string bytes = checkpoint_bytes(progress, hash);
    write_file(out / "checkpoint", bytes);
    progress = read_checkpoint<Dim>(bytes, hash);  // of another scene's it would throw
    simulate<Dim>(prepared, progress, {});
  }
  const Results& results = progress.results;
  for (const auto& [name, value] : results.values)
    std::printf("  %s = %.6g %s\n", name.c_str(), value.value, value.unit.c_str());
  std::printf("  %s, %s\n", outcome_name(results.outcome).c_str(), results.state_hash.c_str());
  write_results_json(out / "results.json", results,
                     {.title = prepared.title, .dimension = Dim, .input_hash = input_hash(scene)});
}

// the cube of side 1 m about its origin
Polytope<3> cube() {
  HalfSpaces<3> sides;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      sides.push_back({sign * Vector<3>::Unit(axis), 0.5});
  return make_block<3>(sides, {no_joint, no_joint, no_joint, no_joint, no_joint, no_joint}).part;
}

}  // namespace

int main(int count, char** files) try {
  std::printf("Voussoir %s\n", version().c_str());
  const ContactBetween<3> contact = contact_between<3>(cube(), {}, cube(), {.position = {0.1, 0, 0.99}});
  std::printf("two cubes overlap by %.6f m over %.6f m2\n", contact.geometry.overlap, contact.geometry.area);
  for (int k = 1; k < count; ++k) {
    const Scene scene = read_scene(files[k]);
    const auto out = std::filesystem::path("results") / std::filesystem::path(files[k]).stem();
    prepare_folder(out);
    std::printf("%s:\n", files[k]);
    scene.dimension == 2 ? run_in_two_parts<2>(scene, out) : run_in_two_parts<3>(scene, out);
  }
  return contact.status == ContactStatus::touching ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
