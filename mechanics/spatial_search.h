/// The spatial balance solved with everything that helps: further starts, friction and
/// compliance approached from easier values, and falls. Internal to the mechanics layer.
#pragma once

#include "mechanics/spatial_newton.h"

namespace prehensile {

/// Solves one scaled problem again and again until it is solved.
class SpatialSearch {
 public:
  SpatialSearch(const ScaledSpatial& problem, double tolerance, int max_steps)
      : problem_(problem), tolerance_(tolerance), max_steps_(max_steps) {}

  /// The first attempt; `warm` may be null.
  bool solve_directly(const NewtonStart* warm);

  /// Other starts; nearly all motions are among them.
  bool solve_otherwise();

  /// Everything else.
  bool solve_stubbornly();

  /// What the object does in the grasp of the pads alone, quasi-statically. `last` may be
  /// null: how it rested in a similar problem. Close to its limit a rest is seldom found
  /// from elsewhere.
  enum class Hold { kHeld, kFalls, kUnknown };
  Hold judge_hold(const NewtonStart* last);
  Hold judge_hold_patiently();

  /// Whether the object rests in the pads alone although it may fall as well.
  bool approach_rest();
  const SpatialRates& rest_rates() const { return rest_rates_; }  ///< if kHeld
  const SpatialForces& rest_forces() const { return rest_forces_; }

  /// The motion found is slower than foundations may yield.
  bool is_at_rest() const;

  /// The motion found is the object at rest in the pads, untouched by the pusher.
  bool rests_in_pads() const;

  /// A fall, with the pusher in place or the pads alone; forces and rates are its own.
  /// It is slow enough for the yield of foundations to be read from its rates.
  bool find_fall(bool pads_only, SpatialForces& forces, SpatialRates& rates);

  /// A motion that differs from the one found, from other starts.
  bool find_other(SpatialForces& forces, SpatialRates& rates);

  /// A set of forces that balance each other, towards which a jam tends as compliance
  /// vanishes; the largest normal force is 1. Starts from the motion found, if any.
  bool find_jam(SpatialForces& forces);

  const SpatialForces& forces() const { return forces_; }
  const NewtonResult& result() const { return result_; }
  int steps() const { return steps_; }

 private:
  bool attempt(const NewtonStart& start, int budget);
  NewtonResult rest_from(NewtonStart start, int budget);
  Hold judge_hold(bool patiently);
  bool approach_friction();
  bool approach_compliance();
  bool approach_statics();
  bool follow_jam(double softest, NewtonStart start, SpatialForces& forces);

  const ScaledSpatial& problem_;
  const double tolerance_;
  const int max_steps_;
  int steps_ = 0;
  NewtonResult result_;
  SpatialForces forces_;
  SpatialForces rest_forces_;
  SpatialRates rest_rates_ = SpatialRates::Zero();
};

}  // namespace prehensile
