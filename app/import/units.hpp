// The unit of a file's coordinates, by one rule for all formats: metres are used as they are, another unit of length is
// converted and reported, a file without a unit is read as metres and reported, anything else is refused.
#pragma once

#include <string_view>

#include "app/import/imported.hpp"
#include "app/import/length_unit.hpp"

namespace voussoir {

// The positions of a file's points in the scene: in m, moved by the --shift.
class FilePlacement {
 public:
  explicit FilePlacement(const Vector<3>& shift) : shift_(shift) {}

  // The unit that the file states: by its English name, by the number of DXF's $INSUNITS, by GeoJSON's member crs (the
  // text that names it). Throws FileFault at an unknown one, and at a system that is not plane.
  void named_unit(const Word& name, std::string_view key);
  void drawing_unit(const Word& code);
  void reference_system(std::string_view crs, int line);

  double metres() const { return unit_.metres; }  // of one unit of the file
  Vector<3> operator()(const Vector<3>& point, int line) const;
  // the remark on the unit for the user
  void tell(JointCollector& joints) const;

 private:
  void state(const LengthUnit& unit, std::string where);

  Vector<3> shift_;
  LengthUnit unit_;
  std::string stated_;  // the text that states the file's unit; empty if there is none
};

}  // namespace voussoir
