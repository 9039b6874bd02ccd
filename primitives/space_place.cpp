#include "primitives/space_place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "optimisation/nonlinear_program.h"
#include "primitives/force_search.h"
#include "primitives/space_cone.h"
#include "primitives/space_grip.h"
#include "primitives/spatial_push_instant.h"

namespace prehensile {
namespace {

/// Places along the push that are looked at.
constexpr int kPathSamples = 9;

/// Places on the face that are tried before the best of them is improved.
constexpr int kPlaces = 21;

/// Relative, of the least grip force.
constexpr double kForcePrecision = 1e-4;

/// What a place without the wanted motion is told to be.
InstantStatus status_of(const PushStop& stop) {
  switch (stop.status) {
    case TransitionStatus::kPusherLost:
      return InstantStatus::kSeparated;
    case TransitionStatus::kLeavesPlane:
      return InstantStatus::kMoves;
    case TransitionStatus::kFalls:
      return InstantStatus::kDynamic;
    case TransitionStatus::kJammed:
      return InstantStatus::kJammed;
    case TransitionStatus::kAmbiguous:
      return InstantStatus::kAmbiguous;
    case TransitionStatus::kIterationLimit:
      return InstantStatus::kOutOfIterations;
    default:
      return InstantStatus::kNotRun;
  }
}

double slack_of(const Model& model, const LinearPush& push, const PlanarPose& X_HO,
                bool is_path) {
  SpatialPushInstant instant(model, push, {X_HO, 0.0}, {});
  const Seat seat = instant.geometry().first();
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < (is_path ? kPathSamples : 1); ++k) {
    const double s = k / (kPathSamples - 1.0);
    if (instant.solve(seat, s, Vec2::Zero())) return kNoMotionInSpace;
    least = std::min(least, instant.margin(seat, Regime::kStick).least());
    // Further motions are of interest only beside one that sticks.
    if (least < 0.0) continue;
    if (instant.solve(seat, s, Vec2::Zero(), Search::kAllMotions)) {
      return kNoMotionInSpace;
    }
  }
  return least;
}

}  // namespace

double slack_in_space(const Model& model, const WantedMotion& wanted, int contact,
                      double place) {
  return slack_of(model, wanted.push(contact, place), wanted.X_HO, wanted.is_path);
}

double robust_slack_in_space(const Model& model, const WantedMotion& wanted, int contact,
                             double place, const Margin& margin) {
  UncertaintyBox box;
  box[Unknown::kFriction] = margin.friction;
  box[Unknown::kGripForce] = margin.force;
  box[Unknown::kTorqueRadius] = margin.torque_radius;
  box[Unknown::kPlace] = margin.place;
  box[Unknown::kCentreOfMassX] = box[Unknown::kCentreOfMassY] = margin.centre_of_mass;
  double least = slack_in_space(model, wanted, contact, place);
  const std::size_t corners = std::size_t{1} << box.active().size();
  for (std::size_t i = 0; i < corners && least > kNoMotionInSpace; ++i) {
    const BoxPoint at = corner(box, i);
    if (at[static_cast<std::size_t>(Unknown::kFriction)] > 0.0) continue;
    const std::optional<SpaceMember> member =
        space_member(model, {wanted.X_HO, 0.0}, contact, place, box, at);
    if (!member) return kNoMotionInSpace;
    least =
        std::min(least, slack_in_space(member->model, wanted, contact, member->place));
  }
  return least;
}

void make_in_space(const Model& model, const WantedMotion& wanted, const Margin& margin,
                   PlacedPush& placed) {
  const int contact = placed.push.contact;
  SpatialPushInstant instant(model, placed.push, {wanted.X_HO, 0.0}, {});
  const Seat seat = instant.geometry().first();
  const PushStop stop = instant.solve(seat, 0.0, Vec2::Zero(), Search::kAllMotions);
  placed.slack = slack_in_space(model, wanted, contact, placed.push.place);
  placed.robust_slack =
      robust_slack_in_space(model, wanted, contact, placed.push.place, margin);
  placed.found = false;
  if (stop) {
    placed.status = status_of(stop);
    return;
  }
  const Sample sample = instant.sample(0.0, 0.0);
  placed.status = sample.status;
  placed.push_force = sample.push_force;
  placed.certificate = sample.certificate;
  const Vec2 rate = instant.rate();
  placed.twist_error = std::hypot(rate[0], model.c * rate[1]) / instant.speed();
  placed.found = usable(placed.status) && placed.slack >= 0.0 &&
                 placed.twist_error <= kPlaceTwistTolerance && placed.certificate <= 1e-6;
}

SpacePlace best_place_in_space(const Model& model, const WantedMotion& wanted,
                               int contact, double grip_low, double grip_high) {
  const PushContact& face = model.contacts[contact];
  const double half_face = 0.5 * (face.b - face.a).norm();
  const double range = grip_high - grip_low;
  SpacePlace best;
  const auto judge = [&](double place, double force) {
    ++best.evaluations;
    const double slack = slack_in_space(gripped(model, force), wanted, contact, place);
    if (!std::isfinite(best.grip_force) || slack > best.slack) {
      best.place = place;
      best.grip_force = force;
      best.slack = slack;
    }
    return slack;
  };
  for (const double share : {0.5, 0.0, 1.0}) {
    for (int k = 0; k < kPlaces; ++k) {
      judge(half_face * (2.0 * k / (kPlaces - 1.0) - 1.0), grip_low + share * range);
    }
    if (range == 0.0) break;
  }
  NonlinearProgram program;
  program.start = {best.place / half_face};
  program.lower = {-1.0};
  program.upper = {1.0};
  if (range > 0.0) {
    program.start.push_back((best.grip_force - grip_low) / range);
    program.lower.push_back(0.0);
    program.upper.push_back(1.0);
  }
  program.objective = [&](std::span<const double> x, std::span<double>) {
    return -judge(x[0] * half_face, grip_low + (x.size() > 1 ? x[1] * range : 0.0));
  };
  minimise_nlopt(program, LocalMethod::kSubplex,
                 {.tolerance = 1e-6, .max_evaluations = 80}, 0.05);
  return best;
}

double loosest_in_space(const Model& model, const WantedMotion& wanted, int contact,
                        double place, double grip_low, double grip_high,
                        const Margin& margin) {
  const auto survives = [&](double force) {
    return robust_slack_in_space(gripped(model, force), wanted, contact, place, margin) >=
           0.0;
  };
  if (!survives(grip_high)) return grip_high;
  if (survives(grip_low)) return grip_low;
  return force_end(grip_high, grip_low, kForcePrecision, survives).inside;
}

}  // namespace prehensile
