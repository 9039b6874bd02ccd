/// What one push can do from one state: the questions that OMPL's planners ask, answered
/// in one place so that propagator, directed sampler and motion validator cannot
/// disagree. Names no OMPL type.
///
/// `join`, `approach` and `follow` count as one propagation each, and refuse everything
/// once the budget is spent: some planners ask on without looking at their termination
/// condition.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "planner/planner.h"
#include "planner/steering.h"

namespace prehensile {

/// A point of OMPL's search: the flat state and the roll angle [rad], neither wrapped.
struct PushState {
  FlatState flat;
  double psi = 0.0;
};

PushState state_of(const Grasp& grasp);
Grasp grasp_of(const PushState& state);

/// The member of the goal set next to a grasp: free coordinates are taken from the grasp,
/// angles are the nearest of all whole turns.
Grasp member_near(const Goal& goal, const Grasp& grasp);

/// One control: at most one roll in place, then at most one straight move. `share` and
/// not kappa is stored because a share of the feasible rotations makes sense before the
/// state is known, which is when blind samplers draw it.
struct PushControl {
  int letter = 0;        ///< index in SearchModel::contacts, or finish_letter
  double heading = 0.0;  ///< [rad] in O of e, the direction in which the object moves
  double share = 0.5;    ///< 0..1 of the feasible slopes atan(kappa)
  double travel = 0.0;   ///< [m] length of the move in (p_OF, c theta); 0: no move
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
  PushSteps(const SearchModel& search, const Goal& goal, Work& work);

  /// Lengths that stand for one radian in the metric of the search [m]. The first is c,
  /// except for pads without any torque, where no length is natural.
  double theta_scale() const { return theta_scale_; }
  double psi_scale() const { return psi_scale_; }

  /// The letter of the control that goes straight to the goal, by whichever contact can.
  /// Samplers that do not see the state would hit a small goal only by chance.
  int finish_letter() const { return static_cast<int>(search_.contacts.size()); }

  /// The pads are on the object, and some contact's gravity is held.
  bool is_valid(const PushState& state) const noexcept;

  /// The step that ends exactly at `to`: a roll, a straight move, both, or neither where
  /// the states are equal.
  std::optional<PushStep> join(const PushState& from, const PushState& to,
                               int preferred = -1);

  /// The step that comes close to `to` with this contact: right place, rotation clipped
  /// to what sticks, rolled as wanted.
  std::optional<PushStep> approach(const PushState& from, const PushState& to,
                                   int contact);

  /// The step of a control; nothing where the control is refused.
  std::optional<PushStep> follow(const PushState& from, const PushControl& control);

  /// The control whose step this is.
  PushControl control_for(const PushState& from, const PushStep& step) const;

  /// Whether this control has any rotation that sticks; counts nothing.
  bool may_stick(const PushState& from, const PushControl& control) const noexcept;

  const SearchModel& search() const { return search_; }
  const Model& model() const { return *search_.model; }
  const Goal& goal() const { return goal_; }
  const Work& work() const { return work_; }

 private:
  bool counted() noexcept;
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
  Work stick_tests_{.budget = std::numeric_limits<std::int64_t>::max()};
  double theta_scale_ = 1.0;
  double psi_scale_ = 1.0;
};

}  // namespace prehensile
