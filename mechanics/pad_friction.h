/// Friction of discretised pads as a convex function of the twist: the `Body` of
/// PushModes for the exact solver. Internal to the mechanics layer.
///
/// D(u) = sum b_j |c_j(u)|, c_j = (v_x - w y_j, v_y + w x_j). Points about the centre of
/// the bounds, sum b_j = 1, mean square lever 1. D is smooth except where a point is the
/// centre of rotation; there its force is any vector within its bound (`PivotPoint`).
#pragma once

#include <Eigen/Core>

#include "mechanics/pad_kernels.h"
#include "mechanics/push_modes.h"

namespace prehensile {

class PadFriction {
 public:
  /// Centre of the bounds and size of the pads, found before the points are scaled.
  struct Frame {
    Vec2 centre = Vec2::Zero();  ///< [m] in H
    double length = 0.0;         ///< [m] root mean square lever; 0 for a point
    double torque_radius = 0.0;  ///< [m] mean lever: torque capacity over force capacity
    double force = 0.0;          ///< [N] capacity; 0 or not finite: no friction
  };
  static Frame frame_of(const PlanarGrasp& grasp) noexcept;

  /// `frame.length` > 0: for a pad that is one point, any length, with `is_point`.
  PadFriction(const PlanarGrasp& grasp, const Frame& frame, bool is_point) noexcept;

  /// Points that rounding can hardly tell apart become one place, because a pivot between
  /// them would be ill-conditioned. False if there are none. Takes the square of `count`.
  bool merge_near_points() noexcept;

  int count() const { return count_; }

  /// How often friction, with its derivatives or without, has been summed over the pads.
  int sums() const { return sums_; }
  bool is_point() const { return is_point_; }
  Vec2 at(int j) const { return {x_[j], y_[j]}; }
  double bound(int j) const { return b_[j]; }

  double dissipation(const PlanarTwist& u) const noexcept;

  /// Gradient of D, with the pivot's force in place of its undefined term.
  PlanarWrench resistance(const PlanarTwist& u, const PivotPoint& pivot) const noexcept;

  /// The pad point at the centre of rotation of u, if there is one.
  PivotPoint pivot_at(const PlanarTwist& u) const noexcept;

  RayExit exit(const PlanarWrench& w, const PlanarWrench& e,
               const PlanarTwist* guess) const noexcept;
  LowestOnLine lowest(const PlanarTwist& u0, const PlanarTwist& d, const PlanarWrench& w,
                      const PlanarTwist* guess) const noexcept;

  /// Roots of a slide. Up to two are sought by Newton's method from the sphere's; more,
  /// or one that this does not find, by a scan.
  int slides(const SlideQuestion& question, int capacity, double* roots) const noexcept;

  /// The root of a slide that Newton's method finds from `root`, on either side of the
  /// start; false if it finds none.
  bool nearest_slide(const SlideQuestion& question, double& root) const noexcept;

  /// w lies strictly inside S (for a point: within its bound, and through it). Otherwise
  /// `unsupported` is a twist with D < w.u.
  bool holds(const PlanarWrench& w, PlanarTwist* unsupported) const noexcept;

  /// u times a positive scale; a pivot stays exactly at rest.
  PlanarTwist scaled_twist(const PlanarTwist& u, const PivotPoint& pivot,
                           double scale) const noexcept;

  /// A pivot whose force is not determined by the motion: the smallest force with which
  /// the pusher obeys its law, and the range of the push force over all such.
  void choose_pivot_force(const ScaledPush& push, Motion& motion) const noexcept;

  /// Resisting force of every point at twist u.
  void moving_forces(const PlanarTwist& u, const PivotPoint& pivot,
                     Vec2* forces) const noexcept;

  /// Resisting forces by which the pads, at rest, balance w: those at the limit in the
  /// direction of w, scaled down. One entry per point.
  void rest_forces(const PlanarWrench& w, Vec2* forces) const noexcept;

  /// Bound of all points that coincide with point j.
  double merged_bound(int j) const noexcept;

 private:
  PaddedColumns points() const {
    return {x_.data(), y_.data(), b_.data(), padded_, &sums_};
  }
  PlanarTwist rotation_about(int j, double omega) const;
  int nearest_to_centre(const PlanarTwist& u) const noexcept;

  bool rests_on_pivot(const PlanarTwist& u0, const PlanarTwist& d, const PlanarWrench& w,
                      LowestOnLine& lowest) const noexcept;

  PlanarTwist exit_guess(const PlanarWrench& w, const PlanarWrench& e) const noexcept;
  struct PivotTest {
    bool leaves = false;
    RayExit exit;
    bool has_beside = false;
    PlanarTwist beside;
  };
  PivotTest test_pivot(int j, const PlanarWrench& w,
                       const PlanarWrench& e) const noexcept;
  RayExit exit_of_pads(const PlanarWrench& w, const PlanarWrench& e,
                       const PlanarTwist* guess) const noexcept;
  RayExit exit_of_point(const PlanarWrench& w, const PlanarWrench& e) const noexcept;
  bool proves_held(const PlanarWrench& support, const PlanarWrench& w) const noexcept;
  bool clearly_holds(const PlanarWrench& w) const noexcept;

  int count_ = 0;
  int padded_ = 0;  ///< count_ rounded up to whole lanes; the rest has bound 0
  mutable int sums_ = 0;
  bool is_point_ = false;
  double torque_radius_ = 1.0;  ///< mean lever
  double reach_ = 1.0;          ///< largest lever
  alignas(32) std::array<double, PlanarGrasp::kCapacity> x_;
  alignas(32) std::array<double, PlanarGrasp::kCapacity> y_;
  alignas(32) std::array<double, PlanarGrasp::kCapacity> b_;
};

}  // namespace prehensile
