#include "planner/obstacles/placement.h"

#include <cmath>

namespace prehensile {

PlanarPose object_at_pusher(const Model& model, const PushContact& contact,
                            double place) {
  const Vec2 touched = 0.5 * (contact.a + contact.b) + place * contact.t;
  const Vec2 p = model.scene.pushers[static_cast<std::size_t>(contact.pusher)].p_WP -
                 rotated(contact.theta_WO, touched);
  return {p.x(), p.y(), contact.theta_WO};
}

double farthest_place(const PushContact& contact) {
  if (!std::isfinite(contact.half_length)) return 0.0;
  return std::abs(0.5 * (contact.b - contact.a).norm() - contact.half_length);
}

}  // namespace prehensile
