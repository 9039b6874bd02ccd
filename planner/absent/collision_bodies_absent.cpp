#include "planner/obstacles/collision_bodies.h"

namespace prehensile {

struct CollisionBodies::Bodies {};

bool collisions_are_built() { return false; }

CollisionBodies::CollisionBodies(const Model& /*model*/) {}
CollisionBodies::~CollisionBodies() = default;

double CollisionBodies::hand_distance(const PlanarPose& /*X_WH*/, double /*enough*/,
                                      double /*z*/, double /*coarse*/) const {
  return 0.0;
}

double CollisionBodies::object_distance(const PlanarPose& /*X_WO*/, double /*enough*/,
                                        double /*z*/, double /*coarse*/) const {
  return 0.0;
}

double CollisionBodies::palm_distance(const PlanarPose& /*X_OH*/, double /*enough*/,
                                      double /*coarse*/) const {
  return 0.0;
}

double CollisionBodies::hand_reach() const { return 0.0; }

double CollisionBodies::object_reach() const { return 0.0; }

std::int64_t CollisionBodies::queries() const { return 0; }

}  // namespace prehensile
