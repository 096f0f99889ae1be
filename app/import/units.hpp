// The unit of a file's coordinates, by one rule for all formats: metres are taken as they are, another length is
// converted and reported, a file that states none is taken as metres and reported, anything else is refused.
#pragma once

#include <string_view>

#include "app/import/imported.hpp"
#include "app/import/length_unit.hpp"

namespace voussoir {

// Where a file's points are in the scene: in m, moved by the --shift.
class FilePlacement {
 public:
  explicit FilePlacement(const Vector<3>& shift) : shift_(shift) {}

  // The unit that the file states: by its English name, by the number of DXF's $INSUNITS, by GeoJSON's member crs (the
  // text that names it). Throws FileFault at an unknown one, and at a system that is no plane.
  void named_unit(const Word& name, std::string_view key);
  void drawing_unit(const Word& code);
  void reference_system(std::string_view crs, int line);

  double metres() const { return unit_.metres; }  // of one unit of the file
  Vector<3> operator()(const Vector<3>& point, int line) const;
  // what the user must know about the unit
  void tell(JointCollector& joints) const;

 private:
  void state(const LengthUnit& unit, std::string where);

  Vector<3> shift_;
  LengthUnit unit_;
  std::string stated_;  // where the file states its unit; empty where it states none
};

}  // namespace voussoir
