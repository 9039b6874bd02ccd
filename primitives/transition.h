/// The transition function: a push goes in, a new in-hand pose comes out, with the forces
/// along the way, the events, an error estimate and the reason for stopping.
///
/// Instants are solved by the exact planar mechanics (roll: the cross-section), by the
/// exact spatial one where the scene needs it, or over the ellipsoid, and certified at
/// the ends of steps and at events. While a line sticks, the object follows the pusher's
/// exact rigid motion; otherwise the twist is integrated with adaptive steps, explicit
/// (Dormand-Prince 5(4)) or stiff (RODAS), and the changes of contact mode are located.
/// Where the pusher recedes somewhere, motions need not be unique: all contact modes are
/// tried there. docs/primitives.md tells it at length.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "mechanics/certificate.h"
#include "mechanics/planar_instant.h"
#include "primitives/push.h"

namespace prehensile {

enum class TransitionStatus {
  kNotRun,
  kCompleted,       ///< the whole push was done
  kLeftGuard,       ///< valid motion, but no longer the named primitive; stopped there
  kPusherLost,      ///< the pusher left the face or the object left the pusher
  kPadLost,         ///< the centre of the pads left the face
  kLeavesPlane,     ///< the object tilts or moves between the jaws, or these open
  kFalls,           ///< the grasp no longer holds gravity, or the object tips by itself
  kJammed,          ///< no motion possible
  kAmbiguous,       ///< two motions possible; stopped rather than guess
  kUncertified,     ///< an instant failed its certificate
  kIterationLimit,  ///< steps or Newton iterations used up
  kRefused,         ///< the push is not possible here: see `reason`
};
std::string_view name(TransitionStatus status);

enum class EventKind {
  kStick,          ///< the contact stops slipping
  kSlip,           ///< the contact begins to slip
  kCorner,         ///< one end of a flush line lifts
  kFlush,          ///< a tipped line lies on the face again
  kOverEdge,       ///< a prism rolled over an edge: its next side lies on the support
  kPusherOffFace,  ///< ends the push, like all that follow
  kPadOffFace,
  kContactLost,
  kGravityLost,
  kOutOfPlane,
  kTips,  ///< weight and grip tip a prism on, faster than the support moves
  kGuard,
};
std::string_view name(EventKind kind);

struct Event {
  EventKind kind = EventKind::kStick;
  double s = 0.0;  ///< share of the push at which it happened
};

/// What resists the motion of the object in the grasp.
enum class FrictionModel {
  kPads,      ///< the pads, point by point: the exact planar mechanics
  kEllipsoid  ///< the closed-form limit surface of the whole pads: several times faster,
              ///< exact only for grasps that have that surface
};

/// In how many dimensions the instants of a push are solved. The state of a finite push
/// is (x, y, theta) in either case: the jaws keep the faces that they hold parallel to
/// the pads, up to what the foundations of the pads yield (spatial_push_instant.h).
enum class PushLevel {
  kChoose,    ///< space where the scene needs it (Model::push_needs_space)
  kPadPlane,  ///< the loads of the pads stay as they are at rest
  kSpace      ///< the loads shift within and between the pads; not over the ellipsoid
};

struct TransitionOptions {
  double tolerance = 1e-6;  ///< [m] accepted error of the end pose (angles weigh c)
  double max_step = 0.05;   ///< share of the push between samples of a trace, and unit of
                            ///< the longest steps: seven (ellipsoid: fourteen) of it
                            ///< where the object slips or turns; lower it to see contact
                            ///< modes that last for less than half of such a step
  int max_steps = 2000;  ///< attempted steps, of a prism's roll in each turn; raise for
                         ///< stiff pushes at fine tolerance
  double certificate_tolerance = 1e-6;
  FrictionModel friction_model = FrictionModel::kPads;  ///< not for rolls
  PushLevel level = PushLevel::kChoose;                 ///< not for rolls
};

/// Every option is in its range.
bool are_usable(const TransitionOptions& options);

/// One point of the path.
struct Sample {
  double s = 0.0;
  Grasp grasp;
  double push_force = kNan;        ///< [N]
  double normal_force = kNan;      ///< [N]
  double tangential_force = kNan;  ///< [N]
  double slip_rate = kNan;         ///< object relative to pusher, per unit of s [m]
  double opening = kNan;           ///< [m] between the pads; rolls of a prism only
  InstantStatus status = InstantStatus::kNotRun;
  double certificate = kNan;  ///< worst entry

  /// Of pushes that are followed in space, else NaN:
  std::array<double, 2> jaw_force{kNan, kNan};  ///< [N] of jaw 1 and jaw 2
  double moment_across = kNan;  ///< [N m] that the pusher exerts about axes in the pad
                                ///< plane, through the middle of the grasp
  double pressed = kNan;        ///< share of the pads' points that carry load
  double out_of_plane = kNan;   ///< fastest motion of the object along the closing
                                ///< direction over the pads, as a share of what counts
                                ///< as leaving the pad plane
};

struct Transition {
  static constexpr int kMaxEvents = 16;

  TransitionStatus status = TransitionStatus::kNotRun;
  std::string_view reason;       ///< static text for people; empty if completed
  Grasp end;                     ///< pose where the push ended
  double done = 0.0;             ///< share of the push, 0..1
  double error_estimate = kNan;  ///< [m] of the end pose; no bound: within a few times
                                 ///< the error as a rule (docs/benchmarks.md)
  double slipped = 0.0;          ///< [m] path of the contact along the pusher
  double max_push_force = kNan;  ///< [N]
  double min_push_force = kNan;  ///< [N]
  double worst_certificate = kNan;
  bool in_space = false;          ///< the instants were spatial; then
  double least_jaw_force = kNan;  ///< [N] of the looser jaw
  double least_pressed = kNan;    ///< see Sample
  double most_out_of_plane = kNan;
  int instants = 0;     ///< mechanics calls
  int checks = 0;       ///< of sticking lines, where the motion is known and only the
                        ///< pusher's forces are looked at; a small part of an instant
  int event_count = 0;  ///< in `events`: the first ones, and the one that ended the push
  int more_events = 0;  ///< that there was no room for
  std::array<Event, kMaxEvents> events;

  bool completed() const { return status == TransitionStatus::kCompleted; }
};

/// Applies a push at a grasp. No heap unless `trace` is given, which receives the
/// samples.
Transition apply(const Model& model, const Grasp& start, const Push& push,
                 const TransitionOptions& options = {},
                 std::vector<Sample>* trace = nullptr) noexcept;

}  // namespace prehensile
