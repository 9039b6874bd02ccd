/// Sticking pushes: the test of one instant, the interval of feasible rotation of a whole
/// linear move, and the margin against uncertain parameters.
///
/// A linear move keeps e (direction, in O) and kappa = c omega/|v| constant: the finger
/// axis runs straight through the object while the hand turns at a constant rate. Over an
/// isotropic pad its push wrench is constant in O: the friction force depends on e and
/// kappa only, and the moment p x v does not change while p runs along v. So one test
/// certifies the whole push.
///
/// Signs: the object moves with velocity |v| e relative to the hand, so p_OF moves along
/// -e; kappa > 0 turns the object counter-clockwise.
///
/// A contact is said to stick only if the pusher also advances, at one end of the face at
/// least. Where it recedes everywhere, gravity may still keep it pressed to the object,
/// but the object standing still in the grasp while the pusher leaves is an equilibrium
/// too.
///
/// Source of the stable-push test: motion cones of Chavan-Dafle, Holladay and Rodriguez
/// (RSS 2018) over the ellipsoid of Howe and Cutkosky; the intervals are derived in
/// sticking_kappas.cpp.
#pragma once

#include <cmath>
#include <span>

#include "mechanics/model.h"
#include "mechanics/pad_drag.h"

namespace prehensile {

/// A slack down to minus this still counts as sticking: the ends of a KappaSet are on the
/// border, where rounding decides the sign.
inline constexpr double kStickTolerance = 1e-9;

/// Box of uncertainty that a push must survive. Zero: nominal.
struct Margin {
  double friction = 0.10;        ///< relative, of the pusher
  double force = 0.10;           ///< relative, of m g / F
  double torque_radius = 0.10;   ///< relative, of c
  double place = 1e-3;           ///< [m] of the pusher along the face
  double centre_of_mass = 1e-3;  ///< [m]
  double grasp = 0.0;            ///< [m] of the finger axis in the object, any direction
  double tilt = 0.0;  ///< [rad] by which the motion and gravity, each on its own, may be
                      ///< turned against the face: a pusher or an object that is not
                      ///< quite at its angle in the world
  bool weightless = false;  ///< pushes have to stick without gravity as well, so that
                            ///< none needs its help

  Margin scaled(double factor) const {
    return {
        friction * factor,       force * factor, torque_radius * factor, place * factor,
        centre_of_mass * factor, grasp * factor, tilt * factor,          weightless};
  }
  static Margin none() { return {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}; }
  /// Least and greatest factor of the weight.
  double least_weight() const { return weightless ? 0.0 : 1.0 - force; }
  double most_weight() const { return 1.0 + force; }
  /// Whether anything may be off.
  bool has_box() const {
    return friction != 0.0 || force != 0.0 || torque_radius != 0.0 || place != 0.0 ||
           centre_of_mass != 0.0 || grasp != 0.0 || tilt != 0.0;
  }
  bool is_none() const { return !weightless && !has_box(); }
};

/// The margin of a push that begins after the finger axis has travelled so far [m] on
/// tilted pushes.
inline Margin carried(Margin margin, double travelled) {
  margin.grasp += margin.tilt * travelled;
  return margin;
}

/// Bound from below of the least scalar product of two vectors while one of them turns by
/// up to `tilt` [rad] either way: `along` is their scalar product, `across` their cross
/// product. Exact to third order in the tilt; `along` itself without tilt.
inline double least_turned(double along, double across, double tilt) noexcept {
  const double kept = along > 0.0 ? along * (1.0 - 0.5 * tilt * tilt) : along;
  return kept - std::abs(across) * tilt;
}

/// A contact compiled for the sticking tests: ends in O, gravity as acceleration over F.
///
/// A line pusher carries load anywhere from a to b. A point pusher carries it at one
/// place: a == b there, or a and b are the ends of the range from which the place of the
/// push is still to be chosen. The margin of a point pusher applies to its friction cone
/// only: an error of its place, of the centre of mass or of the torque radius changes how
/// the object turns about the point, and not whether the point sticks.
struct StickContact {
  Vec2 n, t, a, b;
  Vec2 centre = Vec2::Zero();  ///< [m] of the face: where places are counted from
  double mu = 0.0;
  Vec2 gamma = Vec2::Zero();  ///< m g_O / F, dimensionless
  Vec2 p_OCom = Vec2::Zero();
  double c = 0.0;  ///< [m] > 0
  bool is_point = false;
};

/// The model's F and c must be positive.
StickContact stick_contact(const Model& model, const PushContact& contact, double place);

/// The same with a pusher anywhere on the face: its ends are those of the face.
StickContact face_contact(const Model& model, const PushContact& contact);

/// At most four closed intervals of kappa in ascending order; unbounded ends are
/// +-infinity. One interval is the rule; gaps appear only where gravity helps to keep the
/// contact.
struct KappaSet {
  struct Interval {
    double lo = 0.0;
    double hi = 0.0;
  };
  int count = 0;
  std::array<Interval, 4> intervals;

  bool contains(double kappa) const;
  bool empty() const { return count == 0; }
};

/// All kappa for which the contact sticks while the finger axis is at p_OF and the object
/// moves along e (unit, in O), over the ellipsoid; closed form. For a point contact
/// (a == b) the set is a single value, or two where the moment of gravity about the point
/// exceeds F c. No heap.
KappaSet sticking_kappas(const StickContact& contact, const Vec2& p_OF,
                         const Vec2& e) noexcept;

/// The same for every member of the box of uncertainty at the same omega/|v|; kappa still
/// counts with the nominal c. A subset of the nominal set, and equal to the intersection
/// over the box unless the moment of gravity about a face end exceeds 2 F c: there the
/// set may be too small, never too large. Where a point pusher has a range, whether it
/// advances at its later place is left to robust_slack. No heap.
KappaSet robust_kappas(const StickContact& contact, const Vec2& p_OF, const Vec2& e,
                       const Margin& margin) noexcept;

/// What the pusher must exert on the object for a wanted friction wrench, tested against
/// the contact: the smallest slack of cone and face ends.
struct StickTest {
  double push_force = kNan;          ///< [N]
  double normal_force = kNan;        ///< [N]
  double tangential_force = kNan;    ///< [N] along t
  double centre_of_pressure = kNan;  ///< [m] along t from the centre of the face
  /// Least of cone slack / F, moment slack about the ends / (F c), and normal rate of the
  /// advancing end / sqrt(v^2 + c^2 omega^2). >= 0: sticks.
  double slack = kNan;
};

/// One instant with the friction wrench of the ellipsoid. The object moves with (v e,
/// omega) relative to the hand, in any common scale: v >= 0 [m], omega [rad], not both
/// zero (NaN). At a point contact (a == b) the moment is an equation, not an inequality:
/// met within 1e-9 F c it does not count in the slack. No heap.
StickTest stick_test(const StickContact& contact, double F, const Vec2& p_OF,
                     const Vec2& e, double v, double omega) noexcept;

/// Least slack of that instant over the box of uncertainty; velocity = v e, in O. Where
/// that is below `least`, anything below it may be returned, which is faster. No heap.
double robust_slack(const StickContact& contact, const Vec2& p_OF, const Vec2& velocity,
                    double omega, const Margin& margin,
                    double least = -std::numeric_limits<double>::infinity()) noexcept;

/// Least slack over the box of uncertainty of cone and face ends, as in `robust_slack`,
/// where the friction that the object overcomes, over F (force in O, moment [m] about the
/// finger axis), is one of these: the same motion over other torque radii. A tilted
/// motion begins at p_OF. Whether the pusher advances is not looked at. No heap.
double slack_of_frictions(const StickContact& contact, const Vec2& p_OF,
                          std::span<const PadDrag> frictions,
                          const Margin& margin) noexcept;

/// One instant with the real pad region at this pose: forces nominal, slack worst over
/// the box, where the torque radius scales the pad about the finger axis. Also holds for
/// pads that are not isotropic, for which a tilt of the motion is looked at at its ends
/// and in its middle. `travelled` [m]: path of the finger axis since the push began, all
/// of which was tilted. The object moves with (v e, omega) relative to the hand;
/// v == 0 turns it about the finger axis; NaN where nothing moves. Slack -infinity where
/// the pads have lost the face. At a point pusher a moment within 1e-3 F c counts as met:
/// the quadrature of a disc is isotropic to that order only. A pad point at the centre of
/// rotation, whose friction has no direction, counts as zero. Of a slack below `least`,
/// anything below it may be returned, which is faster. No heap.
StickTest exact_stick_test(
    const Model& model, const PushContact& contact, double place, const PlanarPose& X_HO,
    const Vec2& e, double v, double omega, const Margin& margin, double travelled = 0.0,
    double least = -std::numeric_limits<double>::infinity()) noexcept;

/// By so much the moment of gravity about the finger axis may be greater within this
/// margin than at its most weight alone [N m].
double uncertain_moment(const Model& model, const Vec2& p_OF, const Vec2& g_O,
                        const Margin& margin) noexcept;

/// The grasp alone holds gravity g_O at this place, by the ellipsoid with this margin:
/// 1 - load, positive: held. The load is convex in p_OF: held at both ends of a straight
/// move, gravity is held all along it.
double holding_slack(const Model& model, const Vec2& p_OF, const Vec2& g_O,
                     const Margin& margin) noexcept;

}  // namespace prehensile
