// What the viewer shows of a support that is drawn as a line.
#pragma once

#include <array>
#include <optional>

namespace voussoir {

struct ViewLine {
  double force = 0;             // N along it, tension positive; of a bolt that of one
  std::optional<double> use{};  // utilisation of a bolt: force over yield; nothing without yield
  bool collar = false;          // a bolt's collar is at the first end
  bool broken = false;
  // of a lining, at both ends: thrust, N, compression positive; moment, N m, sagging positive; pressure of the rock, Pa
  std::optional<std::array<std::array<double, 2>, 3>> section{};
};

}  // namespace voussoir
