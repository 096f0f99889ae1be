#include "core/model/schedule.hpp"

#include <cmath>

namespace voussoir {

template <int Dim>
void set_strength(const Model<Dim>& model, Searched searched, const std::vector<int>& properties, double level,
                  Schedule& schedule) {
  if (searched == Searched::factor) schedule.strength_factor.resize(model.properties.size(), 1);
  for (const int p : properties) {
    schedule.friction[p] = level;
    if (searched == Searched::friction) continue;
    const double stated = model.properties[p].friction;
    schedule.friction[p] = level == 1 ? stated : std::atan(std::tan(stated) / level);
    schedule.strength_factor[p] = level;
  }
}

template void set_strength<2>(const Model<2>&, Searched, const std::vector<int>&, double, Schedule&);
template void set_strength<3>(const Model<3>&, Searched, const std::vector<int>&, double, Schedule&);

}  // namespace voussoir
