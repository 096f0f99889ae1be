// The mechanism of a failure, from where the bodies were in equilibrium and where they are when it is judged.
//
// A body moves if a corner of it has moved by a tenth of the way of the corner that moved most. Bodies near each
// other form a cluster if one's rigid motion takes the corners of the other to within a tenth of that way. A cluster
// turns if its rotation alone moves a corner by a tenth of its largest way; it turns about an edge if a corner of a
// face that was in contact has moved by less than a tenth of it.
#pragma once

#include "core/model/prepared.hpp"
#include "core/output/failure_mechanism.hpp"

namespace voussoir {

// From the placements and contacts `before` to those `after`, both by body; the forces are those after. Joints have the
// names of the scene. Unknown if no free body has moved.
template <int Dim>
FailureMechanism find_mechanism(const Model<Dim>& model, const std::vector<Placement<Dim>>& from,
                                const ContactsState<Dim>& before, const std::vector<Placement<Dim>>& to,
                                const ContactsState<Dim>& after);

// Of a motion that ends with these forces; the number of bonds that had broken before it. Nothing if there were none.
template <int Dim>
std::optional<BondsOfMotion> bonds_of_motion(long long broken_before, const State<Dim>& now);

// the free bodies that have moved, ascending
template <int Dim>
std::vector<int> moving_set(const Model<Dim>& model, const std::vector<Placement<Dim>>& from,
                            const std::vector<Placement<Dim>>& to);

}  // namespace voussoir
