/// Which push makes the object move as wanted: the inverse of the transition function.
///
/// A wanted motion fixes the friction of the sliding pads and so the wrench that the
/// pusher must exert, whatever the pusher does. A contact can exert it if it lies in the
/// friction cone of the contact and acts within the face; both are affine in the wrench,
/// and the wrench is affine in the grip force. So whether a contact can make the motion,
/// and with which grip forces, has a closed form over the real pads, and where it cannot,
/// one twist proves it: no force of the contact takes power from it, and the wanted
/// wrench does.
///
/// Where a contact needs space, neither holds: loads shift, and the wrench of the pads
/// with them. There places are tried by spatial instants, and nothing is proved.
///
/// Source: the future work of the paper (section VIII).
#pragma once

#include <vector>

#include "mechanics/sticking.h"
#include "primitives/transition.h"

namespace prehensile {

/// The object's motion from a pose: a linear move with the finger axis running straight
/// in O, done whole (`is_path`) or looked at in its first instant only.
struct WantedMotion {
  PlanarPose X_HO;               ///< at the start
  Vec2 velocity = Vec2::Zero();  ///< in O, of O against the finger axis [m]
  double turn = 0.0;             ///< [rad], over the same time
  bool is_path = false;

  /// In H, about the finger axis.
  PlanarTwist twist_HO() const;
  /// As a push of this contact.
  LinearPush push(int contact, double place) const;
};

/// The move that an object twist (in H, about the finger axis, any scale) begins.
WantedMotion motion_of_twist(const PlanarPose& X_HO, const PlanarTwist& V_HO);

/// The linear move from pose to pose; angles are not wrapped.
WantedMotion motion_between(const PlanarPose& from, const PlanarPose& to);

struct PlaceOptions {
  double grip_low = 0.0;  ///< [N] of each finger; both 0: that of the scene
  double grip_high = 0.0;
  bool least_force = false;   ///< instead of most margin
  Margin margin;              ///< that the slack should survive
  std::vector<int> contacts;  ///< that may be used; empty: all
};

/// What one contact can do, by closed form; no solver is asked.
struct ContactVerdict {
  int contact = 0;
  bool possible = false;
  double grip_low = kNan;  ///< [N] of the grip forces for which it is possible
  double grip_high = kNan;
  std::string_view reason;  ///< static text; empty if possible
  /// Not possible by balance of forces: a twist about the finger axis, in H. No force of
  /// this contact anywhere on its face works against it; the wanted wrench does, at
  /// every allowed grip force. NaN where the reason is another.
  PlanarTwist proof = PlanarTwist::Constant(kNan);
};
std::vector<ContactVerdict> verdicts_of(const Model& model, const WantedMotion& wanted,
                                        const PlaceOptions& options);

/// Checks a proof from the start, with code of its own: power of the extreme forces of
/// the contact, and of the wrench that the sliding pads ask for, at both grip forces.
bool proves(const Model& model, const WantedMotion& wanted, const PlaceOptions& options,
            const ContactVerdict& verdict);

/// How firmly a place sticks while the object makes the wanted motion: the slacks of a
/// `PlacedPush`. NaN where the object does not make it.
struct PlaceSlack {
  double nominal = kNan;
  double robust = kNan;
};

/// As the search judges places: over the real pads, and of a line in space by spatial
/// instants (a point in space is not judged by its place: NaN). `model` is gripped with
/// the force in question.
PlaceSlack slack_at(const Model& model, const WantedMotion& wanted, int contact,
                    double place, const Margin& margin);

struct PlacedPush {
  bool found = false;
  LinearPush push;
  double grip_force = kNan;    ///< [N]
  double slack = kNan;         ///< as in StickTest, least along the path, nominal
  double robust_slack = kNan;  ///< least over the margin
  double push_force = kNan;    ///< [N] at the start
  /// Forward, by the exact solver with the real pads, the spatial one where needed:
  InstantStatus status = InstantStatus::kNotRun;
  double certificate = kNan;   ///< worst entry
  double twist_error = kNan;   ///< against the wanted twist, relative; angles weigh c
  Transition forward;          ///< of a path
  double end_distance = kNan;  ///< [m] from the wanted pose
  double end_angle = kNan;     ///< [rad]
};

/// Accepted errors of the forward check.
inline constexpr double kPlaceTwistTolerance = 1e-6;
inline constexpr double kPlaceDistanceTolerance = 2e-5;  // [m]
inline constexpr double kPlaceAngleTolerance = 5e-4;     // [rad]

struct PlaceAnswer {
  enum class Status {
    kFound,
    kImpossible,  ///< no contact can; `verdicts` prove it, each for its contact
    kNotFound,    ///< no push passed the forward check; not a proof
    kBadInput,    ///< nothing moves, or pads, friction or grip force are missing
  };
  Status status = Status::kBadInput;
  std::string_view reason;  ///< static text; empty if found
  std::vector<ContactVerdict> verdicts;
  PlacedPush best;
  int evaluations = 0;  ///< of the stick test
};
std::string_view name(PlaceAnswer::Status status);

/// Searches all contacts: the closed form gives starts, NLopt (where built) improves
/// place and grip force over the real pads, and the exact solver has the last word.
PlaceAnswer find_place(const Model& model, const WantedMotion& wanted,
                       const PlaceOptions& options = {});

/// The possible motion of the first instant whose direction is nearest to the wanted one,
/// as far as a search over all directions and a local improvement find it.
struct NearestMotion {
  bool found = false;
  WantedMotion motion;
  double angle = kNan;  ///< [rad] between the directions of (v, c omega)
  PlaceAnswer answer;
};
NearestMotion nearest_motion(const Model& model, const WantedMotion& wanted,
                             const PlaceOptions& options = {});

}  // namespace prehensile
