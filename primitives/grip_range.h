/// How hard to grip for a push: the range of grip forces with which it does what it
/// should, and what the four phases of a push need along it (paper section I: hold,
/// relax, push, tighten).
///
/// A line that sticks must exert a wrench that is linear in the grip force, so its limits
/// at one place of the push are closed forms. A looser grip lets gravity win: the object
/// falls, or slides along the pusher. A tighter grip asks the pusher for forces that it
/// cannot exert. Where the push is followed in space the profile is too, by instants with
/// one grip force after the other (space_grip.h).
#pragma once

#include <vector>

#include "primitives/transition.h"

namespace prehensile {

struct GripRangeOptions {
  double tolerance = 1e-3;  ///< [m] of the end pose from the nominal one (angles weigh c)
  double least = 1e-3;      ///< [N] > 0, searched from here
  double greatest = 1e4;    ///< [N] to here
  double precision = 1e-6;  ///< relative, of the ends of the range
  int samples = 20;         ///< of the profile, along the push
  TransitionOptions transition;
};

/// A grip force at an end of the range, with the pushes that prove it.
struct GripEnd {
  double force = kNan;    ///< [N] the push still does what it should
  bool is_open = false;   ///< true: no limit was found up to the end of the search
  Transition inside;      ///< with `force`
  double beyond = kNan;   ///< [N] within `precision`: the push no longer does
  Transition outside;     ///< with `beyond`; NaN forces if open
  double strayed = kNan;  ///< [m] of the end of `outside` from the nominal pose
};

/// What one place of the push needs, with the object flush on the pusher; [N] of grip.
struct GripSample {
  double s = 0.0;
  double hold = kNan;        ///< the grasp alone holds gravity from here on
  double stick_low = kNan;   ///< the pusher sticks from here (0: from no grip at all)
  double stick_high = kNan;  ///< to here; infinity: however tight; below stick_low: never
};

struct GripRange {
  bool found = false;        ///< with some grip force of the search it does
  std::string_view reason;   ///< if not found: static text
  PlanarPose nominal;        ///< where the push should end
  GripEnd low, high;         ///< if found
  double hold_start = kNan;  ///< [N] phase 1: the least grip that holds before the push
  double hold_end = kNan;    ///< [N] phase 4: and at the nominal end, the pusher gone
  std::vector<GripSample> profile;  ///< phases 2 and 3
  bool in_space = false;            ///< all of it by spatial instants
};

/// The push does what it should if it is done to its end, within its guard, and leaves
/// the object within the tolerance of the nominal pose: where the pusher takes an object
/// that sticks to it (slide, pivot, line) or where the push at the scene's own grip force
/// ends (point). The range is the one around the scene's grip force, or the nearest to
/// it. Not for rolls. May allocate; thread-safe.
GripRange grip_range(const Model& model, const Grasp& start, const Push& push,
                     const GripRangeOptions& options = {});

/// The limits at one place of a flush push, in closed form but for `hold`.
GripSample grip_sample(const Model& model, const Grasp& start, const LinearPush& push,
                       double s);

}  // namespace prehensile
