/// Goal sets: a goal may fix some coordinates only, has tolerances, and counts angles by
/// whole turns. Internal to the planner.
#pragma once

#include <array>
#include <optional>

#include "planner/planner.h"
#include "planner/steering/steering.h"

namespace prehensile {

/// How far a grasp is from a goal, coordinate by coordinate; 0 where the goal leaves the
/// coordinate free.
struct GoalError {
  double x = 0.0;      ///< [m], >= 0
  double y = 0.0;      ///< [m], >= 0
  double theta = 0.0;  ///< [rad], >= 0; of an angle to the nearest whole turn
  double psi = 0.0;    ///< [rad], >= 0, to the nearest whole turn
};
GoalError goal_error(const Goal& goal, const Grasp& grasp);

/// The angle of the goal: the nearest to `theta` of all whole turns, the number where it
/// is one, `theta` itself where the goal leaves it free [rad].
double nearest_angle(const Goal& goal, double theta);

/// A place of the finger axis at which the goal is met, with the angles that meet it
/// there and that the limits admit: the nearest to the start first, then one turn more to
/// either side.
struct GoalPlace {
  Vec2 p_OF = Vec2::Zero();
  int count = 0;
  std::array<double, 3> theta{};
};

/// An angle from `low` to `high` [rad] that meets the goal at a place: one of those of
/// the place, else the first one by whole turns, where these do not count.
std::optional<double> angle_between(const Model& model, const GoalPlace& place,
                                    double low, double high) noexcept;

/// Whether the pads are where the goal or the start has them, and not where the planner
/// chose to: a goal that leaves a coordinate free leaves the place of the finger axis
/// free, too.
bool is_place_given(const Goal& goal, const Vec2& p_OF_start, const Vec2& p_OF) noexcept;

/// Members of a goal set, nearest to the start first. A fixed coordinate takes its exact
/// value; a free one keeps that of the start first, then steps through a fixed grid.
/// Where the planner chooses, the pads keep the margin from the border after a way twice
/// as long as the straight one.
struct GoalPlaces {
  static constexpr int kCapacity = 96;
  int count = 0;
  std::array<GoalPlace, kCapacity> places;
};
GoalPlaces goal_places(const Model& model, const Goal& goal, const FlatState& start,
                       const Margin& margin = Margin::none()) noexcept;

/// Where scattered members of a goal set lie: around a state, over a share of the
/// object's length and of a turn, the next ones of a sequence in each round.
struct Scatter {
  FlatState around;
  double width = 1.0;
  int round = 0;  ///< >= 0
};

/// Members of a goal that leaves coordinates free, those of a sequence that fills the
/// range of these evenly (Halton 1960); as many as there is room for. None of a goal that
/// fixes all.
GoalPlaces scattered_places(const Model& model, const Goal& goal, const FlatState& start,
                            const Scatter& scatter, const Margin& margin) noexcept;

/// A goal that fixes place and angle, at more whole turns than goal_places: two to
/// thirteen to either side, the fewest first. None where the angle is a number.
GoalPlaces wound_places(const Model& model, const Goal& goal,
                        const FlatState& start) noexcept;

/// A plan that ends off the goal, within its tolerances, must cost less than this share
/// of the best one that does not.
inline constexpr double kWorthTolerance = 0.9;

/// Such a plan uses up to this share of the tolerances.
inline constexpr double kUsedTolerance = 0.98;

/// Members of a goal that fixes place and angle but for its tolerances, in the corners of
/// the square, too, where each coordinate has its own; nearest to the start first,
/// without whole turns.
GoalPlaces tolerated_places(const Model& model, const Goal& goal,
                            const FlatState& start) noexcept;

/// These at the whole turns of wound_places, up to three of them at a time: those of
/// `share`, 0 to kWoundShares - 1, the fewest first.
inline constexpr int kWoundShares = 8;
GoalPlaces wound_tolerated_places(const Model& model, const Goal& goal,
                                  const FlatState& start, int share) noexcept;

/// The roll that is left from `psi` to the goal [rad], in (-pi, pi]; 0 if the goal does
/// not fix it, or is met within its tolerance (half of a tolerance shared with the
/// place).
double roll_needed(const Goal& goal, double psi);

/// The goal in the pad plane: without the roll angle, and with half of a shared
/// tolerance.
Goal planar_goal(const Goal& goal);

/// The planner's state of a grasp, and back.
FlatState flat_state(const Grasp& grasp);
Grasp grasp_of(const FlatState& state, double psi);

}  // namespace prehensile
