#include "planner/steering/holding.h"

#include <algorithm>
#include <array>
#include <cmath>

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

bool is_held(const PlanarGrasp& grasp) {
  return gravity_slack_exceeds(grasp, kFirmlyHeld);
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
