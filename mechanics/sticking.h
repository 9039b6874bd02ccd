/// Sticking pushes: the test of one instant, the interval of feasible rotation of a whole
/// linear move, and the margin against uncertain parameters.
///
/// A linear move keeps e (direction, in O) and kappa = c omega/|v| constant: the finger
/// axis runs straight through the object while the hand turns at a constant rate. Over an
/// isotropic pad its push wrench is constant, so one test certifies the whole push
/// (PLANNER 1.2, 1.3 and 2).
///
/// Signs: the object moves with velocity |v| e relative to the hand, so p_OF moves along
/// -e; kappa > 0 turns the object counter-clockwise.
#pragma once

#include "mechanics/model.h"

namespace prehensile {

/// Box of uncertainty that a push must survive (PLANNER 4.6). Zero: nominal.
struct Margin {
  double friction = 0.10;        ///< relative, of the pusher
  double force = 0.10;           ///< relative, of m g / F
  double torque_radius = 0.10;   ///< relative, of c
  double place = 1e-3;           ///< [m] of the pusher along the face
  double centre_of_mass = 1e-3;  ///< [m]

  Margin scaled(double factor) const {
    return {friction * factor, force * factor, torque_radius * factor, place * factor,
            centre_of_mass * factor};
  }
  static Margin none() { return {0.0, 0.0, 0.0, 0.0, 0.0}; }
};

/// A contact compiled for the sticking tests: ends in O, gravity as acceleration over F.
struct StickContact {
  Vec2 n, t, a, b;
  double mu = 0.0;
  Vec2 gamma = Vec2::Zero();  ///< m g_O / F, dimensionless
  Vec2 p_OCom = Vec2::Zero();
  double c = 0.0;  ///< [m]
};
StickContact stick_contact(const Model& model, const PushContact& contact, double place);

/// At most three closed intervals of kappa; unbounded ends are +-infinity.
struct KappaSet {
  struct Interval {
    double lo = 0.0;
    double hi = 0.0;
  };
  int count = 0;
  std::array<Interval, 3> intervals;

  bool contains(double kappa) const;
  bool empty() const { return count == 0; }
};

/// All kappa for which the contact sticks while the finger axis is at p_OF and the object
/// moves along e (unit, in O), over the ellipsoid; closed form. For a point contact
/// (a == b) the set is one value at most.
KappaSet sticking_kappas(const StickContact& contact, const Vec2& p_OF,
                         const Vec2& e) noexcept;

/// The same for every member of the box of uncertainty: corners of (m/F, c), least
/// friction, ends moved inward. A subset of the nominal set.
KappaSet robust_kappas(const StickContact& contact, const Vec2& p_OF, const Vec2& e,
                       const Margin& margin) noexcept;

/// What the pusher must exert on the object for a wanted friction wrench, tested against
/// the contact: the smallest slack of cone and face ends.
struct StickTest {
  double push_force = kNan;          ///< [N]
  double normal_force = kNan;        ///< [N]
  double tangential_force = kNan;    ///< [N] along t
  double centre_of_pressure = kNan;  ///< [m] along t from the centre of the face
  double slack =
      kNan;  ///< least of cone slack / F and moment slack about the ends / (F c);
             ///< >= 0: sticks
};

/// One instant with the friction wrench of the ellipsoid; v_e = |v|, omega any common
/// scale.
StickTest stick_test(const StickContact& contact, double F, const Vec2& p_OF,
                     const Vec2& e, double v, double omega) noexcept;

/// One instant with the real pad region at this pose, worst over the box. Also holds for
/// pads that are not isotropic. The object moves with (v e, omega) relative to the hand.
StickTest exact_stick_test(const Model& model, const PushContact& contact, double place,
                           const PlanarPose& X_HO, const Vec2& e, double v, double omega,
                           const Margin& margin) noexcept;

/// The grasp alone holds gravity g_O at this place, by the ellipsoid with this margin:
/// 1 - load, positive: held.
double holding_slack(const Model& model, const Vec2& p_OF, const Vec2& g_O,
                     const Margin& margin) noexcept;

}  // namespace prehensile
