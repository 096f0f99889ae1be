#include "benchmarks/judge/kernels.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>

#include "core/testing/shapes.hpp"

namespace voussoir::benchmarks {
namespace {

// null if it is not there
template <class Function>
Function* function_of(void* library, const char* name) {
  return reinterpret_cast<Function*>(dlsym(library, name));
}

template <class Function>
Function* compulsory(void* library, const char* name, const std::string& path) {
  if (Function* found = function_of<Function>(library, name)) return found;
  throw std::runtime_error(fmt::format(
      "{}: no function {}; export it with C linkage, as benchmarks/judge/voussoir_kernel.h declares it", path, name));
}

}  // namespace

Kernel load_kernel(const std::filesystem::path& path) {
  // a bare name would be looked for in the system's folders
  const std::string file = std::filesystem::absolute(path).string();
  if (!std::filesystem::exists(file))
    throw std::runtime_error(fmt::format("{}: no such file; give a shared library", file));
  const std::shared_ptr<void> library(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL), [](void* open) {
    if (open) dlclose(open);
  });
  if (!library) throw std::runtime_error(fmt::format("{}: no shared library that can be loaded: {}", file, dlerror()));
  const int version = compulsory<decltype(voussoir_kernel_version)>(library.get(), "voussoir_kernel_version", file)();
  if (version != VOUSSOIR_KERNEL_VERSION)
    throw std::runtime_error(
        fmt::format("{}: built for version {} of voussoir_kernel.h, this is version {}; build it again", file, version,
                    VOUSSOIR_KERNEL_VERSION));
  Kernel kernel;
  kernel.library = library;
  const char* name = compulsory<decltype(voussoir_kernel_name)>(library.get(), "voussoir_kernel_name", file)();
  if (!name || !*name) throw std::runtime_error(file + ": voussoir_kernel_name gives no name; return one");
  kernel.name = name;
  kernel.contact = compulsory<decltype(voussoir_contact)>(library.get(), "voussoir_contact", file);
  kernel.prepare = function_of<decltype(voussoir_prepare)>(library.get(), "voussoir_prepare");
  kernel.release = function_of<decltype(voussoir_release)>(library.get(), "voussoir_release");
  if (!kernel.prepare != !kernel.release)
    throw std::runtime_error(file + ": exports only one of voussoir_prepare and voussoir_release; export both or none");
  return kernel;
}

PreparedBlock::PreparedBlock(const Kernel& kernel, const HalfSpaces<3>& planes)
    : PreparedBlock(kernel, planes, shapes::block<3>(planes).vertices) {}

PreparedBlock::PreparedBlock(const Kernel& kernel, const HalfSpaces<3>& planes,
                             const std::vector<Vector<3>>& vertices) {
  for (const HalfSpace<3>& p : planes)
    planes_.insert(planes_.end(), {p.normal[0], p.normal[1], p.normal[2], p.offset});
  for (const Vector<3>& v : vertices)
    vertices_.insert(vertices_.end(), {v[0], v[1], v[2]});
  block_ = std::make_unique<voussoir_block>(voussoir_block{static_cast<std::int32_t>(planes.size()),
                                                           static_cast<std::int32_t>(vertices.size()), planes_.data(),
                                                           vertices_.data()});
  if (!kernel.prepare) {
    handle_ = std::shared_ptr<const void>(std::shared_ptr<const void>(), block_.get());
    return;
  }
  const void* made = kernel.prepare(block_.get());
  if (!made)
    throw std::runtime_error(
        fmt::format("{}: voussoir_prepare fails for a block of {} planes", kernel.name, planes.size()));
  handle_ = std::shared_ptr<const void>(made, [kernel](const void* handle) { kernel.release(handle); });
}

voussoir_pose pose_of(const Matrix<3>& rotation, const Vector<3>& position) {
  voussoir_pose pose;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      pose.rotation[3 * i + j] = rotation(i, j);
    pose.position[i] = position[i];
  }
  return pose;
}

}  // namespace voussoir::benchmarks
