// How those who are asked for columns of history.csv give them.
#pragma once

#include <functional>
#include <string>

namespace voussoir {

using AddColumn = std::function<void(std::string name, std::string unit)>;

}  // namespace voussoir
