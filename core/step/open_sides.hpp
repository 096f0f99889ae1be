// Forces through sides that waves leave: plates behind half a joint, and columns of rock beyond a free field.
#pragma once

#include <vector>

#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/step/load_row.hpp"

namespace voussoir {

// m/s: the mean of the upgoing wave between two times since the stage began, `to` after `from`: its displacement over
// the step by the step
template <int Dim>
Vector<Dim> upgoing_between(const EnteringWave<Dim>& wave, double from, double to);

// m: displacement of the centroid of an open face by the body's present pose, which is cached
template <int Dim>
Vector<Dim> displacement_of(const OpenFace<Dim>& face, const CachedPose<Dim>& pose);

// Moves the plates up to the time of the positions, finds their forces and the loads that the columns' outer images put
// on them; the ledger gets the energy of the springs, added to that of the contacts, and what came in and went out. The
// contacts' loads have been found. Again at the same time: the same.
template <int Dim>
void find_open_sides(const Model<Dim>& model, const Schedule& schedule, const BodiesState<Dim>& bodies,
                     const ContactsState<Dim>& contacts, LoadsState<Dim>& loads, Ledger& ledger);

// the load of the contacts of a column's body with its images beyond the side
template <int Dim>
Load<Dim> load_from_outside(const Model<Dim>& model, const ContactsState<Dim>& contacts, const ColumnBody<Dim>& column);

// rows of the table of loads (loads.cpp)
template <int Dim>
bool has_reactions(const Model<Dim>& model, const LoadInputs<Dim>& now);
template <int Dim>
void reaction_loads(const Model<Dim>& model, int threads, const LoadInputs<Dim>& now, std::vector<Load<Dim>>& loads);
template <int Dim>
bool has_plates(const Model<Dim>& model, const LoadInputs<Dim>& now);
template <int Dim>
void plate_loads(const Model<Dim>& model, int threads, const LoadInputs<Dim>& now, std::vector<Load<Dim>>& loads);
template <int Dim>
void add_plate_stiffness(const Model<Dim>& model, const LoadInputs<Dim>& now, std::vector<BodyStiffness>& stiffness);
template <int Dim>
bool has_columns(const Model<Dim>& model, const LoadInputs<Dim>& now);
template <int Dim>
void column_loads(const Model<Dim>& model, int threads, const LoadInputs<Dim>& now, std::vector<Load<Dim>>& loads);

// The images of the columns repeat the motions of their bodies, which have moved; also when a stage begins.
template <int Dim>
void place_image(const Body<Dim>& body, const Motion<Dim>& of_column, const ImageOffset<Dim>& offset,
                 Motion<Dim>& motion);

}  // namespace voussoir
