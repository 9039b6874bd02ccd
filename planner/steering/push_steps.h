/// What one push can do from one state: the questions that sampling planners ask, OMPL's
/// and others, answered in one place so that propagator, directed sampler and motion
/// validator cannot disagree. Names no OMPL type.
///
/// `join`, `approach`, `extend`, `follow` and `works` count as one propagation for each
/// contact or move that they try, and refuse everything once the budget is spent: some
/// planners ask on without looking at their termination condition.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "planner/planner.h"
#include "planner/steering/steering.h"
#include "scene/constants.h"

namespace prehensile {

/// A point of the search: the flat state and the roll angle [rad], neither wrapped.
struct PushState {
  FlatState flat;
  double psi = 0.0;
};

PushState state_of(const Grasp& grasp);
Grasp grasp_of(const PushState& state);

/// The member of the goal set next to a grasp: free coordinates are taken from the grasp,
/// angles are the nearest of all whole turns.
Grasp member_near(const Goal& goal, const Grasp& grasp);

/// Where sampling planners search: the outline's bounding box; angles half a turn beyond
/// the start and the nearest goal; both as far as the limits of the scene reach.
struct FlatBox {
  FlatState low, high;
};
FlatBox box_around(const Model& model, const Grasp& start, const Goal& goal);

/// What the numbers of a control mean.
enum class ControlMeaning {
  kSteered,  ///< `share` is of the slopes that stick
  kBlind,    ///< `share` is of all slopes, -pi/2 .. pi/2: most controls are refused
};

/// One control: at most one roll in place, then at most one straight move. `share` and
/// not kappa is stored because a share of the feasible rotations makes sense before the
/// state is known, which is when some planners draw it.
struct PushControl {
  int letter = 0;        ///< index in SearchModel::contacts, finish_letter or aim_letter
  double heading = 0.0;  ///< [rad] in O of e, the direction in which the object moves;
                         ///< of an aim: the wanted p_OF.x [m]
  double share = 0.5;    ///< 0..1 of the slopes atan(kappa); of an aim: p_OF.y [m]
  double travel = 0.0;   ///< [m] length of the move in (p_OF, c theta), 0: no move; of an
                         ///< aim: c theta [m]
  double roll = 0.0;     ///< [rad] change of psi before the move
};

/// What a control does.
struct PushStep {
  PushState to;
  int move_contact = -1;     ///< index in SearchModel::contacts; -1: no move
  std::optional<Roll> roll;  ///< in place
  bool roll_first = true;    ///< before the move, else after it

  bool does_something() const { return move_contact >= 0 || roll.has_value(); }
};

class PushSteps {
 public:
  PushSteps(const SearchModel& search, const Goal& goal, Work& work,
            ControlMeaning meaning = ControlMeaning::kSteered);

  /// Lengths that stand for one radian in the metric of the search [m]. The first is c,
  /// except for pads without any torque, where no length is natural.
  double theta_scale() const { return theta_scale_; }
  double psi_scale() const { return psi_scale_; }

  /// The letter of the control that goes straight to the goal, by whichever contact can.
  /// Samplers that do not see the state would hit a small goal only by chance.
  int finish_letter() const { return static_cast<int>(search_.contacts.size()); }

  /// The letter of the control that goes to a wanted state as well as one push can: it
  /// lets planners steer that draw their controls before they know the state.
  int aim_letter() const { return finish_letter() + 1; }

  ControlMeaning meaning() const { return meaning_; }

  /// The pads are on the object, and some contact's gravity is held.
  bool is_valid(const PushState& state) const noexcept;

  /// How often `is_valid` was asked.
  std::int64_t states_seen() const { return states_seen_; }

  /// The step that ends exactly at `to`: a roll, a straight move, both, or neither where
  /// the states are equal.
  std::optional<PushStep> join(const PushState& from, const PushState& to,
                               int preferred = -1);

  /// The step that comes close to `to` with this contact: right place, rotation clipped
  /// to what sticks, rolled as wanted.
  std::optional<PushStep> approach(const PushState& from, const PushState& to,
                                   int contact);

  /// The best of what all contacts can do by `approach`.
  std::optional<PushStep> closest(const PushState& from, const PushState& to);

  /// One move of at most `longest` [m] towards `to`: straight if a push does that, else
  /// along the motion next to it, by angle in (p_OF, c theta), of all motions that stick
  /// for some contact.
  std::optional<PushStep> extend(const PushState& from, const PushState& to,
                                 double longest);

  /// The step of a control; nothing where the control is refused.
  std::optional<PushStep> follow(const PushState& from, const PushControl& control);

  /// Where the move of a steered control leads from here, as far as the slopes that stick
  /// here say; with a negative travel, whence it leads here. Nothing where no slope
  /// sticks. Whether the move works is left to `works`; counts nothing.
  std::optional<PushState> end_of(const PushState& from,
                                  const PushControl& control) const;

  /// Whether this contact does the straight move.
  bool works(int contact, const PushState& from, const PushState& to);

  /// The control whose step this is.
  PushControl control_for(const PushState& from, const PushStep& step) const;

  /// Whether this control has any rotation that sticks; counts nothing.
  bool may_stick(const PushState& from, const PushControl& control) const noexcept;

  const SearchModel& search() const { return search_; }
  const Model& model() const { return *search_.model; }
  const Goal& goal() const { return goal_; }
  const Work& work() const { return work_; }

  /// A random control of a contact: a heading mostly within its friction cone, any share,
  /// short moves as often as long ones. `uniform` gives numbers in [0, 1).
  template <typename Uniform>
  PushControl random_push(double longest, Uniform&& uniform) const;

 private:
  struct Projection;

  bool counted() noexcept;
  Projection projected(const Vec2& p_OF, const Vec3& wanted) const;
  std::optional<PushStep> aimed(const PushState& from, const PushControl& control);
  bool move_works(int contact, const FlatState& from, const FlatState& to) noexcept;
  int contact_that_moves(const FlatState& from, const FlatState& to,
                         int preferred) noexcept;
  std::optional<Roll> roll_to(const PushState& from, double psi) const;
  std::optional<PushStep> joined(const PushState& from, const PushState& to,
                                 int preferred);
  PushState representable(const PushState& state) const;

  const SearchModel& search_;
  Goal goal_;
  Work& work_;
  ControlMeaning meaning_;
  Work stick_tests_{.budget = std::numeric_limits<std::int64_t>::max()};
  mutable std::int64_t states_seen_ = 0;
  double theta_scale_ = 1.0;
  double psi_scale_ = 1.0;
};

template <typename Uniform>
PushControl PushSteps::random_push(double longest, Uniform&& uniform) const {
  constexpr double kConeShare = 0.8;  // of headings
  const double contacts = static_cast<double>(search_.contacts.size());
  PushControl push;
  push.letter = static_cast<int>(contacts * uniform());
  const StickContact& stick = search_.contacts[push.letter].stick;
  const double width = uniform() < kConeShare ? std::atan(stick.mu) : kPi;
  push.heading = std::atan2(stick.n.y(), stick.n.x()) + (2.0 * uniform() - 1.0) * width;
  push.share = uniform();
  const double length = uniform();
  push.travel = longest * length * length;
  return push;
}

}  // namespace prehensile
