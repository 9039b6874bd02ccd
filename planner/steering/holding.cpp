#include "planner/steering/holding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "mechanics/certificate.h"
#include "planner/planner.h"
#include "planner/steering/goal.h"

namespace prehensile {
namespace {

/// Slack of gravity above rounding, in units of the friction force.
constexpr double kFirmlyHeld = 1e-6;

/// Friction bodies of whole flat pads, relative to the ellipsoid of the same F and c, lie
/// between 0.86 (a line; 0.93 a disc) and 1.04: so far from the border it decides.
constexpr double kSurelyHeld = 1.0 - 0.84;
constexpr double kSurelyHeldByDisc = 1.0 - 0.92;
constexpr double kSurelyNotHeld = 1.0 - 1.06;

/// Work of asking the pads point by point, in stick tests.
constexpr std::int64_t kExactCheck = 50;

/// Pads and gravity about the middle of their friction.
class HeldAboutMiddle {
 public:
  explicit HeldAboutMiddle(const PlanarGrasp& grasp)
      : grasp_(grasp), capacity_(grasp.capacity()), weight_(grasp.w_g.head<2>()) {
    for (int j = 0; j < grasp.count; ++j) {
      middle_ += grasp.bound[j] / capacity_ * Vec2(grasp.x[j], grasp.y[j]);
    }
    for (int j = 0; j < grasp.count; ++j) {
      spin_ += grasp.bound[j] * lever(j).norm();
    }
    moment_ = grasp.w_g[2] - cross(middle_, weight_);
  }

  /// Decided by the friction of a few twists, or not.
  std::optional<bool> decided() const {
    if (!(spin_ > 0.0)) return std::nullopt;
    if (adds_up(friction_in(Vec2::Zero(), moment_ < 0.0 ? -1.0 : 1.0))) return true;
    const double radius = spin_ / capacity_;
    for (const double stretch : std::array{1.0, 0.7, 1.4}) {
      const double turning = stretch * radius;
      const double omega = moment_ / (turning * turning);
      const Friction friction = friction_in(weight_, omega);
      if (weight_.squaredNorm() + moment_ * omega > friction.power) return false;
      if (adds_up(friction)) return true;
    }
    return std::nullopt;
  }

 private:
  struct Friction {
    Vec2 force = Vec2::Zero();
    double moment = 0.0;
    double power = 0.0;
  };

  /// Of pads that move with this twist.
  Friction friction_in(const Vec2& velocity, double omega) const {
    Friction sum;
    for (int j = 0; j < grasp_.count; ++j) {
      const Vec2 r = lever(j);
      const Vec2 slip = velocity + omega * perp(r);
      const double rate = slip.norm();
      if (!(rate > 0.0)) continue;
      const Vec2 force = grasp_.bound[j] / rate * slip;
      sum.force += force;
      sum.moment += cross(r, force);
      sum.power += grasp_.bound[j] * rate;
    }
    return sum;
  }

  /// Shares of this friction and of that of a translation make up gravity, with something
  /// to spare.
  bool adds_up(const Friction& friction) const {
    constexpr double kSum = 0.999;
    const double share = moment_ == 0.0 ? 0.0 : moment_ / friction.moment;
    const Vec2 rest = weight_ - share * friction.force;
    return share >= 0.0 && share + rest.norm() / capacity_ < kSum;
  }

  Vec2 lever(int j) const { return Vec2(grasp_.x[j], grasp_.y[j]) - middle_; }

  const PlanarGrasp& grasp_;
  double capacity_;  // [N]
  Vec2 weight_;      // [N]
  Vec2 middle_ = Vec2::Zero();
  double spin_ = 0.0;    // [Nm] of friction in a turn about the middle
  double moment_ = 0.0;  // [Nm] of gravity about it
};

bool is_held(const PlanarGrasp& grasp) {
  if (const auto held = HeldAboutMiddle(grasp).decided()) return *held;
  return gravity_slack(grasp) > kFirmlyHeld;
}

/// Pads that are not round, or not whole, hold other moments at other angles.
int points_of(double turn) {
  constexpr double kTurn = 0.3;  // [rad] between two looks
  return static_cast<int>(std::clamp(std::ceil(std::abs(turn) / kTurn) + 1.0, 5.0, 65.0));
}

}  // namespace

bool pads_hold_gravity(const Model& model, const PlanarPose& X_HO, const Vec2& g_O,
                       Work& work) noexcept {
  return pads_hold_gravity(model, X_HO, g_O, Margin::none(), work);
}

bool pads_hold_gravity(const Model& model, const PlanarPose& X_HO, const Vec2& g_O,
                       const Margin& margin, Work& work) noexcept {
  const Vec2 p_OF = finger_in_object(X_HO);
  if (model.has_soft_points()) {
    return holding_slack(model, p_OF, g_O, margin) > kFirmlyHeld;
  }
  if (!can_roll(model.scene.object) && model.region.is_whole(X_HO)) {
    const double slack = holding_slack(model, p_OF, g_O, margin);
    const bool disc = model.region.is_isotropic();
    if (slack >= (disc ? kSurelyHeldByDisc : kSurelyHeld)) return true;
    if (slack <= kSurelyNotHeld) return false;
  }
  work.other += kExactCheck;
  PlanarGrasp grasp = grasp_at(model, X_HO, g_O);
  if (grasp.count == 0) return false;
  if (margin.is_none()) return is_held(grasp);
  for (int j = 0; j < grasp.count; ++j) {
    grasp.x[j] *= 1.0 - margin.torque_radius;
    grasp.y[j] *= 1.0 - margin.torque_radius;
  }
  grasp.w_g *= 1.0 + margin.force;
  const double moment = uncertain_moment(model, p_OF, g_O, margin);
  const double nominal = grasp.w_g[2];
  return std::ranges::all_of(std::array{1.0, -1.0}, [&](double sense) {
    grasp.w_g[2] = nominal + sense * moment;
    return is_held(grasp);
  });
}

namespace {

/// Whether start or goal have the object where a move begins or ends.
bool is_given(const SearchModel& search, const FlatState& state) noexcept {
  if (state.p_OF == search.p_OF_start) return true;
  if (!search.model->scene.goal) return false;
  Goal goal = *search.model->scene.goal;
  goal.psi.reset();
  return is_place_given(goal, search.p_OF_start, state.p_OF) &&
         reaches(goal, {pose_from_finger(state.p_OF, state.theta)});
}

}  // namespace

bool pads_hold_gravity(const SearchModel& search, const Move& move, Work& work) noexcept {
  const Model& model = *search.model;
  const Vec2& g_O = model.contacts[search.contacts[move.contact].contact].g_O;
  if (g_O.isZero(0.0)) return true;
  const int points = search.exact_everywhere ? 2  // the load of a disc is convex
                                             : points_of(move.to.theta - move.from.theta);
  for (int i = 0; i < points; ++i) {
    // The ends first: gravity is lost there before it is lost between them.
    const int place = i == 0 ? 0 : i == 1 ? points - 1 : i - 1;
    const double share = static_cast<double>(place) / (points - 1);
    const PlanarPose X_HO = pose_along(move.from, move.to, share);
    const bool is_end = place == 0 || place == points - 1;
    if (is_end) {
      const FlatState& end = place == 0 ? move.from : move.to;
      const Margin margin = search.margin_from(end.p_OF);
      if (pads_hold_gravity(model, X_HO, g_O, margin, work)) continue;
      if (!is_given(search, end)) return false;
    }
    if (!pads_hold_gravity(model, X_HO, g_O, work)) return false;
  }
  return true;
}

}  // namespace prehensile
