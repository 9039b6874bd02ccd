/// What of a scene is not known exactly, as its file states it.
#pragma once

#include <string>
#include <vector>

namespace prehensile {

enum class Spread {
  kBox,     ///< every value within its half width, uniform
  kNormal,  ///< the widths are standard deviations
};

/// Half widths around the values of the scene, or standard deviations. Robust plans and
/// the sampling of plans ask for it, nothing else.
struct Uncertainty {
  Spread spread = Spread::kBox;
  double sigmas = 3.0;    ///< of a normal distribution, that a robust plan survives
  double friction = 0.0;  ///< relative, of the pushers
  double finger_friction = 0.0;  ///< relative
  double grip_force = 0.0;       ///< relative
  double mass = 0.0;             ///< relative
  double torque_radius = 0.0;    ///< relative, of the pads' load
  double centre_of_mass = 0.0;   ///< [m] along x and along y of O
  double start_position = 0.0;   ///< [m] of the object in the hand, along x and along y
  double start_angle = 0.0;      ///< [rad] of the object in the hand
  double pusher_place = 0.0;     ///< [m] along the face
  double pusher_tilt = 0.0;      ///< [rad] of the pushers in the world

  friend bool operator==(const Uncertainty&, const Uncertainty&) = default;
};

/// One number of an uncertainty with its valid range, ends included.
struct UncertaintyWidth {
  std::string field;  ///< key in a scene file
  double value, least, most;
  const char* unit;
};
std::vector<UncertaintyWidth> widths_of(const Uncertainty& uncertainty);

}  // namespace prehensile
