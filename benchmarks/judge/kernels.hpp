// Contact kernels behind the C interface of voussoir_kernel.h: a shared library's, and our own.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/judge/voussoir_kernel.h"
#include "core/geometry/half_space.hpp"

namespace voussoir::benchmarks {

struct Kernel {
  std::string name;
  decltype(&voussoir_contact) contact = nullptr;
  decltype(&voussoir_prepare) prepare = nullptr;  // null with `release`: the handle is the block
  decltype(&voussoir_release) release = nullptr;
  std::shared_ptr<void> library;  // open as long as a copy of the kernel exists
};

// Throws std::runtime_error with one line if the file is no shared library, lacks a function, or was built with another
// version of the header.
Kernel load_kernel(const std::filesystem::path& path);

Kernel own_kernel();

// A block as a kernel gets it, prepared. Throws std::runtime_error if planes close no block or the kernel fails.
class PreparedBlock {
 public:
  PreparedBlock(const Kernel& kernel, const HalfSpaces<3>& planes);
  PreparedBlock(const Kernel& kernel, const HalfSpaces<3>& planes, const std::vector<Vector<3>>& vertices);
  const void* handle() const { return handle_.get(); }

 private:
  std::vector<double> planes_, vertices_;
  std::unique_ptr<voussoir_block> block_;  // its address stays when this object moves
  std::shared_ptr<const void> handle_;
};

voussoir_pose pose_of(const Matrix<3>& rotation, const Vector<3>& position);

}  // namespace voussoir::benchmarks
