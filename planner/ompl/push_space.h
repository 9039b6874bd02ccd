/// The state space of OMPL's planners: real vector (p_x, p_y, c theta[, r psi]) [m] with
/// the Euclidean metric. p_OF is the place of the finger axis in O; with an isotropic pad
/// this space is flat and a straight segment is one push, so path length is the travel T
/// of the plan cost.
///
/// Raw OMPL states are read and written by this class only.
#pragma once

#include <ompl/base/spaces/RealVectorStateSpace.h>

#include "planner/steering/push_steps.h"

namespace prehensile {

class PushSpace : public ompl::base::RealVectorStateSpace {
 public:
  /// Bounds: the outline's bounding box; angles half a turn beyond the start and the
  /// nearest goal, psi likewise.
  PushSpace(const PushSteps& steps, const Grasp& start);

  PushState read(const ompl::base::State* state) const;
  void write(const PushState& from, ompl::base::State* state) const;

  /// Marks a refused control: a state that no validity check accepts.
  void write_refusal(ompl::base::State* state) const;

  /// A straight motion and its reverse are two questions: some planners would take the
  /// answer to one for that to the other.
  bool hasSymmetricInterpolate() const override { return false; }

  /// Projects onto all coordinates, in cells of a twentieth of the object. (OMPL's
  /// default for this dimension is a random matrix, which would cost a seed.)
  void registerProjections() override;

 private:
  double theta_scale_;
  double psi_scale_;
  double cell_;
};

}  // namespace prehensile
