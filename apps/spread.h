/// Many members of a box of uncertainty pushed to their ends, and what their poses say.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "primitives/spread_interval.h"
#include "primitives/transition.h"
#include "primitives/uncertainty.h"

namespace prehensile::apps {

/// A planar motion against the nominal one: along the normal and the tangent of the face
/// at the start, and turned; about the object's own axis where the push is a roll.
struct Deviation {
  double normal = kNan;      ///< [m]
  double tangential = kNan;  ///< [m]
  double angle = kNan;       ///< [rad]
};
inline constexpr int kDeviations = 3;
inline constexpr std::array<double Deviation::*, kDeviations> kDeviationParts = {
    &Deviation::normal, &Deviation::tangential, &Deviation::angle};

struct EnsembleMember {
  TransitionStatus status = TransitionStatus::kNotRun;
  bool is_scene = true;  ///< false: the box reaches beyond what a scene may be
  Deviation end;         ///< of the end pose in the hand
  Deviation motion;      ///< of the motion from the member's own start
  double max_push_force = kNan;

  bool completed() const { return status == TransitionStatus::kCompleted; }
};

struct Ensemble {
  Transition nominal;
  Deviation nominal_motion;  ///< from the start, in the same directions
  std::vector<EnsembleMember> members;

  int completed() const;
  /// Of the completed members, ascending; `of` is &EnsembleMember::end or ::motion.
  std::vector<double> sorted(Deviation EnsembleMember::*of,
                             double Deviation::*part) const;
  /// "380 completed, 20 pusher lost"
  std::string tally() const;
};

struct EnsembleOptions {
  UncertaintyBox box;
  int samples = 400;
  std::uint64_t seed = 1;
  int jobs = 1;
  double tolerance = 1e-6;  ///< [m] of each end pose
};

/// Pushes the nominal push and `samples` members; the same for any number of jobs.
Ensemble run_ensemble(const Model& model, const Grasp& start, const Push& push,
                      const EnsembleOptions& options);

}  // namespace prehensile::apps
