#include "planner/pads/spread_pads.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mechanics/sticking.h"
#include "planner/pads/ring_pads.h"

namespace prehensile {
namespace {

/// Places along a push are less than this apart, in torque radii.
constexpr double kApart = 0.125;

}  // namespace

bool has_clipped_discs(const Model& model) {
  return model.region.is_isotropic() && !model.region.is_fixed_in_hand() &&
         !can_roll(model.scene.object) && model.F > 0.0 && model.c > 0.0;
}

template <class Scalar>
SpreadPadsOf<Scalar>::SpreadPadsOf(const Model& model, const Vec2& p_OF,
                                   int angles) noexcept
    : angles_(angles) {
  for (int k = 0; k < angles; ++k) {
    const double theta = 2.0 * std::numbers::pi * k / angles;
    const PlanarGrasp grasp =
        grasp_at(model, pose_from_finger(p_OF, theta), Vec2::Zero());
    if (grasp.count == 0) {
      points_ = {};
      return;
    }
    points_.add(grasp, theta, 1.0, angles * model.F);
  }
}

template class SpreadPadsOf<double>;
template class SpreadPadsOf<float>;

double spread_slack(const Model& model, const PushContact& contact, const Vec2& p_OF,
                    const Vec2& velocity, double omega) noexcept {
  if (velocity.isZero(0.0) && omega == 0.0) return kNan;
  const SpreadPads pads(model, p_OF);
  if (pads.are_lost()) return -std::numeric_limits<double>::infinity();
  return slack_of_friction(model, contact, p_OF, pads.drag(velocity, omega));
}

double spread_slack_along(const Model& model, const PushContact& contact,
                          const Vec2& p_OF, const Vec2& e, double travel, double turn,
                          int most, int* clipped) noexcept {
  const double whole = ring_slack(model, contact, p_OF, e, travel, turn);
  const auto slack_at = [&](double share) {
    const Vec2 at = p_OF - share * travel * e;
    if (model.region.is_whole(pose_from_finger(at, 0.0))) return whole;
    if (clipped) ++*clipped;
    return spread_slack(model, contact, at, travel * e, turn);
  };
  const double wanted = std::ceil(travel / (kApart * model.c));
  const int parts = static_cast<int>(std::min(std::max(wanted, 2.0), 1.0 * most));
  double slack = std::min(slack_at(0.0), slack_at(1.0));
  for (int i = 1; i < parts && slack >= -kStickTolerance; ++i) {
    slack = std::min(slack, slack_at(static_cast<double>(i) / parts));
  }
  return slack;
}

}  // namespace prehensile
