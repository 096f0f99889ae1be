// The points at which bodies press on each other within an implicit step: contacts at the half of the step's motion,
// and pairs beside them that may meet or part within it.
#pragma once

#include <vector>

#include "core/base/settings.hpp"
#include "core/implicit/face_points.hpp"
#include "core/implicit/mean_motion.hpp"
#include "core/implicit/point_law.hpp"
#include "core/model/joint_histories.hpp"
#include "core/model/state.hpp"

namespace voussoir {

template <int Dim>
struct StepPoint {
  int contact = 0;  // place in ContactsState::list
  int body_a = 0, body_b = 0;
  // At half of the motion; the point from the first centroid and from the second, m. These are the arms of the force,
  // too: of the points of either body whose mean place over the step is this one, so that a pair's moments cancel.
  Vector<Dim> normal, point, from_b;
  double area = 0;  // m²; of a constant stiffness the share of the contact's 1
  PointStep law;
  Vector<Dim> from = Vector<Dim>::Zero();  // N: shear of the spring before the step, in the plane of the point
  PointForce<Dim> force;

  // m: of the second body relative to the first over the step
  Vector<Dim> motion(const std::vector<MeanMotion<Dim>>& mean) const {
    const MeanMotion<Dim>&a = mean[body_a], &b = mean[body_b];
    return law.h * (b.velocity + cross(b.spin, from_b) - a.velocity - cross(a.spin, point));
  }
  double overlap_after(const Vector<Dim>& motion_of_step) const { return law.overlap - normal.dot(motion_of_step); }
  Vector<Dim> slip(const Vector<Dim>& motion_of_step) const {
    return motion_of_step - normal.dot(motion_of_step) * normal;
  }
};

// The motion of a step, and how much of it leads from its start to the bodies' present poses.
template <int Dim>
struct StepMotion {
  const std::vector<MeanMotion<Dim>>& mean;  // by body
  double h;                                  // s
  double passed;                             // of the step: 0 at its start, 0.5 at its half
};

// Those of a contact. Its springs are kept from step to step as JointState has them: their stress is uniform over what
// presses, but for a turn about the centre.
template <int Dim>
struct StepContact {
  int contact = 0;                   // place in ContactsState::list
  std::size_t first = 0, count = 0;  // of its points
  PressedArea<Dim> end;              // what presses at the end, relative to the first body at half of the motion
  double lost = 0;                   // J: by the springs where they were divided among the points
  double slipped = 0;                // J: taken at once where friction was lowered before the step
};

template <int Dim>
struct StepPoints {
  std::vector<StepPoint<Dim>> points;
  std::vector<StepContact<Dim>> contacts;
};

// N m: of a force at an arm, about the normal; 2-D: none
template <int Dim>
double moment_about(const Vector<Dim>& normal, const Vector<Dim>& arm, const Vector<Dim>& force) {
  if constexpr (Dim == 2)
    return 0;
  else
    return normal.dot(arm.cross(force));
}

// All points at the present poses. `before`: the histories at the start of the step, in the order of the contacts,
// which have been found at these poses. The bodies' poses are cached. Forces are those of springs that do not move on.
// `all` is replaced.
template <int Dim>
void find_step_points(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                      const BodiesState<Dim>& bodies, const ContactsState<Dim>& contacts,
                      const JointHistories<Dim>& before, const StepMotion<Dim>& motion, Counters& counters,
                      StepPoints<Dim>& all);

// Why implicit steps do not follow a joint of these properties, as a clause; empty: they do.
std::string not_followed_implicitly(const JointProperties& properties, const ContactSettings& contact);

}  // namespace voussoir
