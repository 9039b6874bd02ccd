#include "scene/uncertainty.h"

namespace prehensile {

std::vector<UncertaintyWidth> widths_of(const Uncertainty& u) {
  constexpr double kMostShare = 0.9;
  constexpr double kMostLength = 1.0;
  constexpr double kMostAngle = 1.0;
  return {{"sigmas", u.sigmas, 0.1, 10.0, ""},
          {"friction", u.friction, 0.0, kMostShare, ""},
          {"finger_friction", u.finger_friction, 0.0, kMostShare, ""},
          {"grip_force", u.grip_force, 0.0, kMostShare, ""},
          {"mass", u.mass, 0.0, kMostShare, ""},
          {"torque_radius", u.torque_radius, 0.0, kMostShare, ""},
          {"centre_of_mass", u.centre_of_mass, 0.0, kMostLength, "m"},
          {"start_position", u.start_position, 0.0, kMostLength, "m"},
          {"start_angle_deg", u.start_angle, 0.0, kMostAngle, "rad"},
          {"pusher_place", u.pusher_place, 0.0, kMostLength, "m"},
          {"pusher_tilt_deg", u.pusher_tilt, 0.0, kMostAngle, "rad"}};
}

}  // namespace prehensile
