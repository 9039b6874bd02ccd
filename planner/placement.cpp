#include "planner/placement.h"

namespace prehensile {

PlanarPose object_at_pusher(const Model& model, const PushContact& contact,
                            double place) {
  const Vec2 touched = 0.5 * (contact.a + contact.b) + place * contact.t;
  const Vec2 p = model.scene.pushers[static_cast<std::size_t>(contact.pusher)].p_WP -
                 rotated(contact.theta_WO, touched);
  return {p.x(), p.y(), contact.theta_WO};
}

}  // namespace prehensile
