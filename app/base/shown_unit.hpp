// Units of the tables that commands print: forces in kN, stresses in kPa, moments in kN m. Files are SI.
#pragma once

#include <string>

namespace voussoir {

struct ShownUnit {
  double size;       // in SI units
  std::string name;  // empty: a number without a unit
};

// The unit in which a value of the SI unit `si` is printed ("N", "Pa", "N m", "N/m³", …; "1": a number; any other unit
// is printed as it is).
ShownUnit shown_unit(const std::string& si);

// a space and the unit; nothing for a number
std::string after_value(const ShownUnit& unit);

// a value in SI units and its unit as they are printed: "24.5 kN" of 24500 and "N"
std::string quantity_text(double value, const std::string& si);

}  // namespace voussoir
