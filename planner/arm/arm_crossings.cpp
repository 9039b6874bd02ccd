#include "planner/arm/arm_crossings.h"

#include <algorithm>
#include <cmath>

#include "planner/obstacles/placement.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr double kCut = 1e-4;  // [m] what touches the object flush does not cut it

/// A pusher at rest: a piece of a straight line in the pad plane, over some heights.
struct Barrier {
  Vec2 centre, along;                ///< in W, `along` of unit length
  double half_length = 0.0;          ///< [m] infinity: endless; 0: a point
  double z_low = 0.0, z_high = 0.0;  ///< [m] in W
};

Barrier barrier_of(const Pusher& pusher) {
  const double half_length = 0.5 * length_in_plane(pusher.feature).value_or(0.0);
  const double half_width = 0.5 * width_across_plane(pusher.feature);
  const Vec2 normal(std::cos(pusher.normal_angle), std::sin(pusher.normal_angle));
  return {pusher.p_WP, perp(normal), half_length, pusher.z_WP - half_width,
          pusher.z_WP + half_width};
}

/// How deep a barrier lies in the outline, at the deepest of the middles between the
/// places where it meets the border [m]; not positive: it does not cut it.
double depth_of(const Barrier& barrier, const std::vector<Vec2>& outline,
                const PlanarPose& X_WO) {
  const PlanarPose X_OW = inverse(X_WO);
  const Vec2 centre = transform(X_OW, barrier.centre);
  const Vec2 along = rotated(X_OW.theta, barrier.along);
  const Vec2 across = perp(along);
  std::vector<double> cuts;  // [m] along the barrier, from its centre
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i] - centre;
    const Vec2 b = outline[(i + 1) % outline.size()] - centre;
    const double a_off = across.dot(a), b_off = across.dot(b);
    if ((a_off < 0.0) == (b_off < 0.0)) continue;
    const double share = a_off / (a_off - b_off);
    const double cut = along.dot(a + share * (b - a));
    cuts.push_back(std::clamp(cut, -barrier.half_length, barrier.half_length));
  }
  std::ranges::sort(cuts);
  double depth = -kInfinity;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const Vec2 middle = centre + 0.5 * (cuts[i - 1] + cuts[i]) * along;
    depth = std::max(depth, depth_inside(outline, middle));
  }
  return depth;
}

/// The held object at a sample, in W.
PlanarPose object_in_world(const Model& model, const Plan& plan,
                           const ArmSample& sample) {
  const PlannedPush& planned = plan.pushes[static_cast<std::size_t>(sample.push)];
  if (sample.phase == ArmPhase::kPush || sample.phase == ArmPhase::kGrip) {
    const auto contact = static_cast<std::size_t>(contact_of(planned.push));
    return object_at_pusher(model, model.contacts[contact],
                            as_linear(planned.push).place);
  }
  const double angle =
      2.0 * std::atan2(sample.X_WH.orientation.z(), sample.X_WH.orientation.w());
  const PlanarPose X_WH{sample.X_WH.position.x(), sample.X_WH.position.y(), angle};
  return compose(
      X_WH, sample.phase == ArmPhase::kRetreat ? planned.end.X_HO : planned.start.X_HO);
}

}  // namespace

std::vector<ArmCrossing> arm_crossings(const Model& model, const Plan& plan,
                                       const ArmMotion& motion) {
  const std::vector<Pusher>& pushers = model.scene.pushers;
  const double reach = reach_along_z(model.scene.object.shape);
  std::vector<char> met(pushers.size(), 0);
  std::vector<ArmCrossing> crossings;
  for (const ArmSample& sample : motion.samples) {
    const Push& push = plan.pushes[static_cast<std::size_t>(sample.push)].push;
    const int at_work =
        sample.phase == ArmPhase::kTransit
            ? -1
            : model.contacts[static_cast<std::size_t>(contact_of(push))].pusher;
    const PlanarPose X_WO = object_in_world(model, plan, sample);
    const double z = sample.X_WH.position.z();
    for (std::size_t i = 0; i < pushers.size(); ++i) {
      if (met[i] || static_cast<int>(i) == at_work) continue;
      const Barrier barrier = barrier_of(pushers[i]);
      if (barrier.z_low >= z + reach || barrier.z_high <= z - reach) continue;
      if (depth_of(barrier, model.outline, X_WO) <= kCut) continue;
      met[i] = 1;
      crossings.push_back({static_cast<int>(i), sample.phase, sample.push, sample.t});
    }
  }
  return crossings;
}

}  // namespace prehensile
