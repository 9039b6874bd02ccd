#include "primitives/space_grip.h"

#include "mechanics/spatial_instant.h"
#include "mechanics/spatial_model.h"
#include "primitives/force_search.h"
#include "primitives/linear_push.h"
#include "primitives/spatial_push_instant.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// Least precision of forces: near the limit of holding an instant takes a thousand times
/// as long as elsewhere.
constexpr double kPrecision = 1e-5;

/// The pusher goes away from the face: does the object stay?
bool holds_in_space(const Model& model, const PushContact& contact,
                    const PlanarPose& X_HO, const Vec2& g_O) {
  PlanarDrive drive = drive_at(contact, 0.0, X_HO, PlanarTwist::Zero());
  drive.V_HP.head<2>() = -rotated(X_HO.theta, contact.n);
  const SpatialProblem problem = spatial_problem_at(model, contact, drive, X_HO, g_O,
                                                    {.follow_free_pressure = true});
  if (problem.count == 0) return false;
  // It may still follow the pusher by what the pads yield; a grasp that does not hold is
  // ambiguous or dynamic.
  const InstantStatus status = solve_spatial(problem).status;
  return usable(status) || status == InstantStatus::kSeparated;
}

/// Ends of the run of forces that do; 0 and infinity where the search ends first, and
/// low above high where none does.
template <class Does>
GripSample ends_of_run(const Model& model, const GripRangeOptions& options,
                       const Does& does) {
  GripSample sample;
  const ForceGrid grid(model.scene.gripper.grip_force, options.least, options.greatest);
  const std::optional<ForceRun> run = run_of_forces(grid, does);
  if (!run) {
    sample.stick_low = kInfinity;
    sample.stick_high = -kInfinity;
    return sample;
  }
  const double precision = std::max(options.precision, kPrecision);
  const auto end = [&](int inside, int beyond) {
    return force_end(grid.at(inside), grid.at(beyond), precision, does).inside;
  };
  sample.stick_low = run->low == grid.first() ? 0.0 : end(run->low, run->low - 1);
  sample.stick_high =
      run->high == grid.last() ? kInfinity : end(run->high, run->high + 1);
  return sample;
}

}  // namespace

Model gripped(const Model& model, double force) {
  Model other = model;
  const std::array<double, 2>& mu = model.scene.gripper.friction;
  other.scene.gripper.grip_force = force;
  const double w = model.mass * model.scene.g_Wz;
  other.jaw_force = jaw_forces(other.scene.gripper, w);
  other.F = w == 0.0 ? (mu[0] + mu[1]) * force
                     : mu[0] * other.jaw_force[0] + mu[1] * other.jaw_force[1];
  if (other.cross_section) other.cross_section->grip_force = force;
  return other;
}

double least_to_hold_in_space(const Model& model, int contact, const PlanarPose& X_HO,
                              const Vec2& g_O, const GripRangeOptions& options) {
  const GripSample run = ends_of_run(model, options, [&](double force) {
    const Model other = gripped(model, force);
    return holds_in_space(other, other.contacts[contact], X_HO, g_O);
  });
  return run.stick_low;
}

GripSample grip_sample_in_space(const Model& model, const Grasp& start,
                                const LinearPush& push, double s,
                                const GripRangeOptions& options) {
  const PushContact& contact = model.contacts[push.contact];
  const PlanarPose X_HO = pusher_pose(push, start.X_HO, s);
  GripSample sample;
  if (!contact.is_point) {
    sample = ends_of_run(model, options, [&](double force) {
      const Model other = gripped(model, force);
      SpatialPushInstant instant(other, push, start, options.transition);
      const Seat seat = instant.geometry().first();
      return !instant.solve(seat, s, Vec2::Zero(), Search::kAllMotions) &&
             instant.margin(seat, Regime::kStick).least() >= -instant.noise();
    });
  }
  sample.s = s;
  sample.hold = least_to_hold_in_space(model, push.contact, X_HO, contact.g_O, options);
  return sample;
}

}  // namespace prehensile
