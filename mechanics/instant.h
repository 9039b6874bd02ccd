/// The answer about one instant: how the object moves, what the pusher must exert, what
/// every contact point carries and does. Common to all planar solvers.
///
/// Source: paper section VI.
#pragma once

#include <array>
#include <limits>
#include <string_view>

#include "mechanics/planar_problem.h"

namespace prehensile {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

enum class InstantStatus {
  kNotRun,  ///< nothing below is valid
  kMoves,   ///< twist and forces valid and unique
  kHolds,   ///< the object stands still and the pusher slides along it; forces valid
  kNonuniqueForces,  ///< the motion is unique, the forces are one valid choice; interval
                     ///< set
  kAmbiguous,  ///< at least two certified motions: twist and `other`; or gravity is not
               ///< held by the grasp alone (`evidence` is a twist by which it gains at
               ///< least as much power as friction takes) and the pusher carries the
               ///< object
  kSeparated,  ///< the pusher leaves the object, which stays in the grasp
  kDynamic,    ///< no quasi-static motion: `evidence` is a twist with which gravity gains
               ///< more power than friction can take, and which no pusher force opposes
               ///< (or, where friction at the pusher might, parts from it); the object
               ///< falls
  kJammed,     ///< no motion is possible: `evidence` is a self-balanced set of forces
  kOutOfIterations,  ///< no answer; residual says how close the last iterate came
  kBadInput,  ///< a zero push rate, no friction points, or a value that is not finite
};
std::string_view name(InstantStatus status);

/// True if twist and forces may be used.
bool usable(InstantStatus status);

/// True if twist and forces describe a motion: usable, or one of several.
bool has_motion(InstantStatus status);

enum class ContactMode { kOpen, kStick, kSlipPlus, kSlipMinus, kSlip };
std::string_view name(ContactMode mode);

/// What a pusher point does. Force on the object; slip of the object relative to the
/// pusher along t (rates as in the problem).
struct PusherPoint {
  double normal_force = kNan;      ///< lambda_n [N], >= 0
  double tangential_force = kNan;  ///< lambda_t [N] along t = perp(n)
  double normal_rate = kNan;       ///< c_n, >= 0; > 0 opens
  double slip_rate = kNan;         ///< c_t
  ContactMode mode =
      ContactMode::kOpen;  ///< open, stick, slip plus or minus (sign of c_t)
};

/// Friction force of both pads on the object at a finger point. Not initialised: filling
/// the whole capacity would cost more than a closed-form solve.
struct FingerPoint {
  Vec2 force;        ///< [N] in H
  ContactMode mode;  ///< stick or slip
};

struct PlanarInstant {
  InstantStatus status = InstantStatus::kNotRun;
  PlanarTwist V_HO =
      PlanarTwist::Constant(kNan);  ///< object twist (acceleration if inertia)
  PlanarWrench w_push =
      PlanarWrench::Constant(kNan);  ///< pusher on object, about origin of H
  double push_force = kNan;  ///< |f| of w_push [N]; in the quasi-static limit the least
                             ///< pusher force that breaks the grasp
  int pusher_count = 0;
  std::array<PusherPoint, 2> pusher;
  int finger_count = 0;
  std::array<FingerPoint, PlanarGrasp::kCapacity> finger;  ///< [0, finger_count) are set

  double residual = kNan;  ///< solver's own natural-map residual in units (F0, V0)
  int iterations = 0;
  int evaluations = 0;  ///< sums over the finger points, with derivatives or without, of
                        ///< all modes tried (Newton's method: its steps); 0 for solvers
                        ///< without points

  PlanarTwist evidence = PlanarTwist::Constant(kNan);  ///< see kDynamic, kAmbiguous
  PlanarTwist other = PlanarTwist::Constant(kNan);     ///< see kAmbiguous, if found
  double force_low = kNan;   ///< see kNonuniqueForces: least and
  double force_high = kNan;  ///< greatest normal push force at this motion [N]
};

}  // namespace prehensile
