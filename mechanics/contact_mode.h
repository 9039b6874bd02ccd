/// The planar instant in a contact mode that is given, whether or not the mode obeys the
/// inequalities of the pusher's law: its motion and forces are smooth functions of pose
/// and drive, also beyond the point where the mode ends. That is what an integrator needs
/// to follow a mode up to its end and to locate that end.
#pragma once

#include "mechanics/limit_surface.h"
#include "mechanics/planar_problem.h"

namespace prehensile {

/// Which ends of the pusher carry load, and the sign of the slip of the object along t.
struct ContactModeOfPush {
  enum class Load { kFirst, kSecond, kBoth };  ///< a point pusher: kFirst
  Load load = Load::kFirst;
  int slip = 0;  ///< -1, 0 (sticks), +1
};

/// The motion that obeys balance, the pads' friction and the equations of the mode. Its
/// inequalities are left to the reader: normal forces may be negative, tangential ones
/// exceed the cone, and slip point the wrong way.
struct MotionInMode {
  bool exists = false;
  PlanarTwist V_HO = PlanarTwist::Zero();
  std::array<double, 2> normal_force{0.0, 0.0};      ///< [N]
  std::array<double, 2> tangential_force{0.0, 0.0};  ///< [N] along t
  int pivot = -1;         ///< pad point about which the object turns; -1: none
  bool held = false;      ///< the pads alone hold gravity
  bool advances = false;  ///< the pusher does, somewhere
};

/// Quasi-static. `guess`: a twist near the answer, any scale for a slipping point, or
/// null. Does not exist where data are not finite, or the friction of a slipping mode
/// cannot break the grasp. No heap, no exceptions.
MotionInMode solve_planar_in_mode(const PlanarGrasp& grasp, const PlanarDrive& drive,
                                  const ContactModeOfPush& mode,
                                  const PlanarTwist* guess = nullptr) noexcept;

/// The same over the ellipsoid, in closed form.
MotionInMode solve_limit_surface_in_mode(const LimitSurface& surface,
                                         const PlanarWrench& w_g,
                                         const PlanarDrive& drive,
                                         const ContactModeOfPush& mode) noexcept;

}  // namespace prehensile
