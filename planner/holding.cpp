#include "planner/holding.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mechanics/certificate.h"

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

/// A twist in which gravity gains more power than friction takes, among the normals of
/// ellipsoids about the middle of the pads: enough to reject, not to accept.
bool surely_falls(const PlanarGrasp& grasp) {
  Vec2 middle = Vec2::Zero();
  const double capacity = grasp.capacity();
  for (int j = 0; j < grasp.count; ++j) {
    middle += grasp.bound[j] / capacity * Vec2(grasp.x[j], grasp.y[j]);
  }
  double radius = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    radius += grasp.bound[j] / capacity * (Vec2(grasp.x[j], grasp.y[j]) - middle).norm();
  }
  const Vec2 weight = grasp.w_g.head<2>();
  const double moment = grasp.w_g[2] - cross(middle, weight);
  for (const double stretch : std::array{1.0, 0.7, 1.4}) {
    const double turning = stretch * radius;
    const double omega = moment / (turning * turning);
    double power = weight.squaredNorm() + moment * omega;
    for (int j = 0; j < grasp.count; ++j) {
      const Vec2 r = Vec2(grasp.x[j], grasp.y[j]) - middle;
      power -= grasp.bound[j] * (weight + omega * perp(r)).norm();
    }
    if (power > 0.0) return true;
  }
  return false;
}

/// Pads that are not round, or not whole, hold other moments at other angles.
int points_of(double turn) {
  constexpr double kTurn = 0.3;  // [rad] between two looks
  return static_cast<int>(std::clamp(std::ceil(std::abs(turn) / kTurn) + 1.0, 5.0, 65.0));
}

}  // namespace

bool pads_hold_gravity(const Model& model, const PlanarPose& X_HO, const Vec2& g_O,
                       Work& work) noexcept {
  if (model.has_soft_points()) {
    return holding_slack(model, finger_in_object(X_HO), g_O, Margin::none()) >
           kFirmlyHeld;
  }
  if (!can_roll(model.scene.object) && model.region.is_whole(X_HO)) {
    const double slack =
        holding_slack(model, finger_in_object(X_HO), g_O, Margin::none());
    const bool disc = model.region.is_isotropic();
    if (slack >= (disc ? kSurelyHeldByDisc : kSurelyHeld)) return true;
    if (slack <= kSurelyNotHeld) return false;
  }
  work.other += kExactCheck;
  const PlanarGrasp grasp = grasp_at(model, X_HO, g_O);
  return grasp.count > 0 && !surely_falls(grasp) && gravity_slack(grasp) > kFirmlyHeld;
}

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
    if (!pads_hold_gravity(model, pose_along(move.from, move.to, share), g_O, work)) {
      return false;
    }
  }
  return true;
}

}  // namespace prehensile
