// The callback by which columns of history.csv are added.
#pragma once

#include <functional>
#include <string>

namespace voussoir {

using AddColumn = std::function<void(std::string name, std::string unit)>;

}  // namespace voussoir
