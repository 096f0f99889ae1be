#pragma once
// The matrix as pages of the manual: equations by tests, the cases of the thesis, promises by tests, and the basis of
// the checks.
#include <string>

#include "reports/matrix.hpp"

namespace voussoir::reports {

std::string equations_page(const Matrix& matrix, const verification::Verdicts& verdicts);
// Equations that files of core/<room> name, with their formulas, as a part of a page; empty if there are none.
std::string room_equations(const Matrix& matrix, const std::string& room);
std::string thesis_page(const Matrix& matrix);
std::string promises_page(const Matrix& matrix);
std::string grounds_page(const Matrix& matrix, const verification::Verdicts& verdicts);

}  // namespace voussoir::reports
