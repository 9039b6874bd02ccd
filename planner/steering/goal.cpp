#include "planner/steering/goal.h"

#include <algorithm>
#include <cmath>

#include "planner/geometry/segment.h"
#include "planner/steering/confines.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// Offsets of a free angle from that of the start [degrees].
constexpr std::array<double, 12> kAngles = {0.0,   15.0, -15.0, 30.0,  -30.0,  60.0,
                                            -60.0, 90.0, -90.0, 135.0, -135.0, 180.0};
/// Free positions step in shares of the object's length.
constexpr double kStep = 0.04;         // one free position at a fixed angle
constexpr int kSteps = 25;             // to both sides together
constexpr double kCoarseStep = 0.125;  // one free position at a free angle
constexpr int kCoarseSteps = 7;
constexpr double kPlaneStep = 0.15;  // two free positions
constexpr int kPlaneSteps = 5;
/// Within tolerances.
constexpr int kTurns = 7;
constexpr int kWindings = 3;
constexpr int kDirections = 8;

bool fixes_all(const Goal& goal) { return goal.x && goal.y && goal.theta; }

/// Fixes all, and counts angles by whole turns.
bool winds(const Goal& goal) {
  return fixes_all(goal) && goal.theta_is == ThetaMeaning::kAngle;
}

/// 0, 1, -1, 2, -2, ... times the step.
double offset(int i, double step) { return step * (i % 2 == 0 ? -i / 2 : (i + 1) / 2); }

/// The digits of i in this base, mirrored at the point: in (0, 1).
double radical_inverse(int i, int base) {
  double inverse = 0.0;
  double digit = 1.0;
  for (; i > 0; i /= base) {
    digit /= base;
    inverse += digit * (i % base);
  }
  return inverse;
}

double flat_distance(const Model& model, const FlatState& from, const GoalPlace& to) {
  return flat_distance(model, from, FlatState{to.p_OF, to.theta[0]});
}

class PlaceCollector {
 public:
  PlaceCollector(const Model& model, const Goal& goal, const FlatState& start,
                 const Margin& margin = Margin::none())
      : model_(model), goal_(goal), start_(start), margin_(margin) {}

  /// All places at one angle of O in H (and its whole turns).
  void add_angle(double theta) {
    const Vec2 kept = -rotated(theta, start_.p_OF);
    const bool both_free = !goal_.x && !goal_.y;
    const int windings =
        goal_.theta && goal_.theta_is == ThetaMeaning::kAngle ? kWindings : 1;
    if (both_free) {
      for (int i = 0; i < kPlaneSteps * kPlaneSteps; ++i) {
        const Vec2 d{offset(i / kPlaneSteps, kPlaneStep),
                     offset(i % kPlaneSteps, kPlaneStep)};
        add(theta, kept + model_.L * d, windings);
      }
    } else if (goal_.x && goal_.y) {
      add(theta, {*goal_.x, *goal_.y}, windings);
    } else {
      const int steps = goal_.theta ? kSteps : kCoarseSteps;
      const double step = goal_.theta ? kStep : kCoarseStep;
      for (int i = 0; i < steps; ++i) {
        const double d = model_.L * offset(i, step);
        add(theta, {goal_.x.value_or(kept.x() + d), goal_.y.value_or(kept.y() + d)},
            windings);
      }
    }
  }

  /// The i-th member of a sequence over what the goal leaves free.
  void add_scattered(const Scatter& scatter, int i) {
    const auto off = [&](int base) {
      return scatter.width * (radical_inverse(i + 1, base) - 0.5);
    };
    const bool is_angle = goal_.theta && goal_.theta_is == ThetaMeaning::kAngle;
    const double theta = goal_.theta ? nearest_angle(goal_, start_.theta)
                                     : scatter.around.theta + 2.0 * kPi * off(2);
    const Vec2 kept = -rotated(theta, scatter.around.p_OF);
    const Vec2 position = kept + model_.L * Vec2(off(3), off(5));
    add(theta, {goal_.x.value_or(position.x()), goal_.y.value_or(position.y())},
        is_angle ? kWindings : 1);
  }

  /// The goal that fixes all, by more whole turns than add_angle.
  void add_wound(double theta) {
    for (int share = 0; share < kWoundShares; ++share) {
      add(theta, {*goal_.x, *goal_.y}, kWindings, first_of(share));
    }
  }

  /// Places off the goal that fixes all by what its tolerances leave, and those that are
  /// not; at such whole turns.
  void add_tolerated(double middle, int windings, int first) {
    const Vec2 place{*goal_.x, *goal_.y};
    const bool shared = goal_.test == GoalTest::kWeightedSum;
    const double most =
        kUsedTolerance * (shared ? goal_.position_tolerance / goal_.characteristic_length
                                 : goal_.angle_tolerance);
    for (int i = 0; i < kTurns; ++i) {
      const double turn = most * offset(i, 2.0 / (kTurns - 1));
      const double used = shared ? goal_.characteristic_length * std::abs(turn) : 0.0;
      const double off = kUsedTolerance * goal_.position_tolerance - used;
      add(middle + turn, place, windings, first);
      if (off <= 0.0) continue;
      for (int k = 0; k < kDirections; ++k) {
        const Vec2 beside = rotated(2.0 * kPi * k / kDirections, {off, 0.0});
        add(middle + turn, place + beside, windings, first);
      }
      for (int k = 0; !shared && k < 4; ++k) {
        const Vec2 corner = rotated(0.5 * kPi * k, {off, off});
        add(middle + turn, place + corner, windings, first);
      }
    }
  }

  static int first_of(int share) { return (share + 1) * kWindings; }

  const GoalPlaces& as_added() const { return places_; }

  GoalPlaces sorted() {
    std::sort(places_.places.begin(), places_.places.begin() + places_.count,
              [this](const GoalPlace& a, const GoalPlace& b) {
                return flat_distance(model_, start_, a) <
                       flat_distance(model_, start_, b);
              });
    return places_;
  }

 private:
  void add(double theta, const Vec2& position, int windings, int first = 0) {
    const Vec2 p_OF = -rotated(-theta, position);
    if (places_.count == GoalPlaces::kCapacity || !contains(model_.pad_face, p_OF) ||
        is_too_near_the_border(p_OF)) {
      return;
    }
    GoalPlace place{.p_OF = p_OF};
    for (int i = first; i < first + windings; ++i) {
      const double angle = theta + offset(i, 2.0 * kPi);
      if (limits_admit(model_.scene, {p_OF, angle})) place.theta[place.count++] = angle;
    }
    if (place.count > 0) places_.places[places_.count++] = place;
  }

  bool is_too_near_the_border(const Vec2& p_OF) const {
    if (margin_.grasp + margin_.tilt == 0.0) return false;
    if (is_place_given(goal_, start_.p_OF, p_OF)) return false;
    const double way = 2.0 * (p_OF - start_.p_OF).norm();
    const double room = carried(margin_, way).grasp;
    return distance_to_border(model_.pad_face, p_OF, p_OF) < room;
  }

  const Model& model_;
  const Goal& goal_;
  const FlatState& start_;
  Margin margin_;
  GoalPlaces places_;
};

}  // namespace

GoalError goal_error(const Goal& goal, const Grasp& grasp) {
  const auto angle_error = [](const std::optional<double>& wanted, double angle) {
    return wanted ? std::abs(wrapped(angle - *wanted)) : 0.0;
  };
  const bool is_number = goal.theta && goal.theta_is == ThetaMeaning::kNumber;
  return {goal.x ? std::abs(grasp.X_HO.x - *goal.x) : 0.0,
          goal.y ? std::abs(grasp.X_HO.y - *goal.y) : 0.0,
          is_number ? std::abs(grasp.X_HO.theta - *goal.theta)
                    : angle_error(goal.theta, grasp.X_HO.theta),
          angle_error(goal.psi, grasp.psi)};
}

double goal_excess(const Goal& goal, const Grasp& grasp) {
  const GoalError error = goal_error(goal, grasp);
  if (goal.test == GoalTest::kWeightedSum) {
    const double sum = std::hypot(error.x, error.y) +
                       goal.characteristic_length * (error.theta + error.psi);
    return std::max(0.0, sum - goal.position_tolerance);
  }
  const double position = std::max(error.x, error.y) / goal.position_tolerance;
  const double angle = std::max(error.theta, error.psi) / goal.angle_tolerance;
  return std::max(0.0, std::max(position, angle) - 1.0);
}

bool reaches(const Goal& goal, const Grasp& grasp) {
  return goal_excess(goal, grasp) <= 0.0;
}

double nearest_angle(const Goal& goal, double theta) {
  if (!goal.theta) return theta;
  if (goal.theta_is == ThetaMeaning::kNumber) return *goal.theta;
  return theta + wrapped(*goal.theta - theta);
}

std::optional<double> angle_between(const Model& model, const GoalPlace& place,
                                    double low, double high) noexcept {
  const auto end = place.theta.begin() + place.count;
  const auto met = std::find_if(place.theta.begin(), end, [&](double theta) {
    return theta >= low && theta <= high;
  });
  if (met != end) return *met;
  const bool is_number =
      model.scene.goal && model.scene.goal->theta_is == ThetaMeaning::kNumber;
  if (is_number || place.count == 0) return std::nullopt;
  const double theta = place.theta[0];
  const double turned = theta + 2.0 * kPi * std::ceil((low - theta) / (2.0 * kPi));
  if (turned > high) return std::nullopt;
  return turned;
}

bool is_place_given(const Goal& goal, const Vec2& p_OF_start, const Vec2& p_OF) noexcept {
  constexpr double kSame = 1e-9;  // [m]
  return fixes_all(goal) || (p_OF - p_OF_start).norm() <= kSame;
}

GoalPlaces goal_places(const Model& model, const Goal& goal, const FlatState& start,
                       const Margin& margin) noexcept {
  PlaceCollector collector(model, goal, start, margin);
  if (goal.theta) {
    collector.add_angle(nearest_angle(goal, start.theta));
  } else {
    for (const double degrees : kAngles) {
      collector.add_angle(start.theta + degrees * kPi / 180.0);
    }
  }
  return collector.sorted();
}

GoalPlaces scattered_places(const Model& model, const Goal& goal, const FlatState& start,
                            const Scatter& scatter, const Margin& margin) noexcept {
  if (fixes_all(goal)) return {};
  PlaceCollector collector(model, goal, start, margin);
  for (int i = 0; i < GoalPlaces::kCapacity; ++i) {
    collector.add_scattered(scatter, scatter.round * GoalPlaces::kCapacity + i);
  }
  return collector.sorted();
}

GoalPlaces wound_places(const Model& model, const Goal& goal,
                        const FlatState& start) noexcept {
  if (!winds(goal)) return {};
  PlaceCollector collector(model, goal, start);
  collector.add_wound(nearest_angle(goal, start.theta));
  return collector.as_added();
}

GoalPlaces tolerated_places(const Model& model, const Goal& goal,
                            const FlatState& start) noexcept {
  if (!fixes_all(goal)) return {};
  PlaceCollector collector(model, goal, start);
  collector.add_tolerated(nearest_angle(goal, start.theta), 1, 0);
  return collector.sorted();
}

GoalPlaces wound_tolerated_places(const Model& model, const Goal& goal,
                                  const FlatState& start, int share) noexcept {
  if (!winds(goal)) return {};
  PlaceCollector collector(model, goal, start);
  collector.add_tolerated(nearest_angle(goal, start.theta), kWindings,
                          PlaceCollector::first_of(share));
  return collector.sorted();
}

double roll_needed(const Goal& goal, double psi) {
  if (!goal.psi) return 0.0;
  const double left = wrapped(*goal.psi - psi);
  const double tolerance =
      goal.test == GoalTest::kWeightedSum
          ? 0.5 * goal.position_tolerance / goal.characteristic_length
          : goal.angle_tolerance;
  return std::abs(left) <= tolerance ? 0.0 : left;
}

Goal planar_goal(const Goal& goal) {
  Goal planar = goal;
  planar.psi.reset();
  if (goal.psi && goal.test == GoalTest::kWeightedSum) planar.position_tolerance *= 0.5;
  return planar;
}

FlatState flat_state(const Grasp& grasp) {
  return {finger_in_object(grasp.X_HO), grasp.X_HO.theta};
}

Grasp grasp_of(const FlatState& state, double psi) {
  return {pose_from_finger(state.p_OF, state.theta), psi};
}

}  // namespace prehensile
