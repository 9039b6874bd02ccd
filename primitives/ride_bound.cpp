#include "primitives/ride_bound.h"

#include <algorithm>
#include <cmath>

namespace prehensile {
namespace {

constexpr int kHalvings = 8;

/// What the margins may lose over a share of the push.
struct Loss {
  std::array<double, 2> normal_force{0.0, 0.0};  ///< [N]
  double force = 0.0;                            ///< [N] change of the friction force
};

Loss most_loss(const PlanarGrasp& grasp, const PlanarDrive& drive, double turn,
               double curve, double share) {
  const double length = (drive.p_HC[1] - drive.p_HC[0]).norm();
  Loss loss;
  for (int j = 0; j < grasp.count; ++j) {
    const Vec2 p(grasp.x[j], grasp.y[j]);
    const double speed = point_velocity(drive.V_HP, p).norm();
    // In P the velocity of a pad point turns with the pads about the finger axis.
    const double change = (turn * turn * p.norm() + std::abs(curve)) * share;
    const double turned =
        change < speed ? std::min(2.0, 2.0 * change / (2.0 * speed - change)) : 2.0;
    const double moved = (speed + 0.5 * change) * share;
    loss.force += grasp.bound[j] * turned;
    for (int k = 0; k < 2; ++k) {
      // The load of one end is the moment about the other over their distance.
      const double lever = (p - drive.p_HC[1 - k]).norm();
      loss.normal_force[k] += grasp.bound[j] * (moved + lever * turned) / length;
    }
  }
  return loss;
}

bool lasts(const RideMargin& margin, const Loss& loss, double mu) {
  return margin.normal_force[0] > loss.normal_force[0] &&
         margin.normal_force[1] > loss.normal_force[1] &&
         margin.friction_left > std::hypot(1.0, mu) * loss.force;
}

}  // namespace

double sure_to_last(const PlanarGrasp& grasp, const PlanarDrive& drive, double turn,
                    double curve, const RideMargin& margin, double most) noexcept {
  double share = most;
  for (int i = 0; i < kHalvings; ++i) {
    if (lasts(margin, most_loss(grasp, drive, turn, curve, share), drive.mu))
      return share;
    share *= 0.6;
  }
  return 0.0;
}

}  // namespace prehensile
