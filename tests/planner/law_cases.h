/// Random instants that tests of laws about pushes share.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "mechanics/sticking.h"
#include "planner/checks/exact_check.h"
#include "planner/pads/ring_pads.h"
#include "planner/pads/run_law.h"
#include "planner/pads/spread_pads.h"
#include "planner/steering/goal.h"
#include "planner/steering/steering.h"
#include "problems/pad_shapes.h"
#include "problems/published_regrasps.h"
#include "tests/support/random.h"

namespace prehensile::testing {

/// A kappa anywhere, often where the centre of rotation is among the pad points.
inline double random_kappa(Random& random) {
  const double size = random.chance(0.6) ? random.in(0.0, 3.0) : random.log_in(1e-3, 1e3);
  return random.chance(0.5) ? size : -size;
}

inline Scene with_square_pads(Scene scene) {
  scene.gripper.pad = RectanglePad{{0.016, 0.016}};
  return scene;
}

/// A square or a T among walls, pads that are whole everywhere.
inline Scene random_law_scene(Random& random) {
  Scene scene = random.chance(0.5) ? published_square(random.below(50))
                                   : published_tee(random.below(50));
  scene.gripper.grip_force = random.log_in(8.0, 200.0);
  const bool weightless = random.chance(0.2);
  scene.g_W =
      weightless
          ? Vec2(0.0, 0.0)
          : Vec2(rotated(random.in(-std::numbers::pi, std::numbers::pi), {9.81, 0}));
  for (auto& pusher : scene.pushers) pusher.friction = random.in(0.0, 1.2);
  if (random.chance(0.2)) return with_soft_points(scene);
  return random.chance(0.3) ? with_square_pads(scene) : scene;
}

/// The same with pads of any shape that are no discs: rectangles, lines, polygons.
inline Scene random_shape_scene(Random& random) {
  Scene scene = random_law_scene(random);
  scene.gripper.pad = DiscPad{0.01};
  const double ratio = random.log_in(0.05, 1.0);
  const int kind = random.below(4);
  if (kind == 0) {
    scene.gripper.pad = LinePad{random.in(0.01, 0.03), random.in(0.0, 3.0)};
  } else if (kind == 1) {
    scene = with_pads(scene, *pad_of_shape("half_disc"));
  } else {
    scene.gripper.pad =
        RectanglePad{{0.016 * std::sqrt(ratio), 0.016 / std::sqrt(ratio)}};
  }
  return scene;
}

/// Slack of an instant that the pads themselves decide, as whole plans are checked: rings
/// for discs, spread over all angles where the face clips them, else their points. Motion
/// (e, kappa / c).
inline double slack_of_pads(const Model& model, const PushContact& contact,
                            const PlanarPose& X_HO, const Vec2& e, double kappa) {
  const double omega = kappa / model.c;
  const Vec2 p_OF = finger_in_object(X_HO);
  const bool clips = has_clipped_discs(model);
  if (has_ring_pads(model) || (clips && model.region.is_whole(X_HO))) {
    return ring_slack(model, contact, p_OF, e, 1.0, omega);
  }
  if (clips) return spread_slack(model, contact, p_OF, e, omega);
  return exact_stick_test(model, contact, 0.0, X_HO, e, 1.0, omega, Margin::none()).slack;
}

/// A box of uncertainty, now and then of one parameter alone.
inline Margin random_margin(Random& random) {
  Margin margin = Margin{}.scaled(random.in(0.0, 1.5));
  margin.grasp = random.in(0.0, 1.5e-3);
  margin.tilt = random.in(0.0, 0.02);
  margin.weightless = random.chance(0.3);
  if (!random.chance(0.3)) return margin;
  Margin alone = Margin::none();  // one of them by itself
  double* parts[] = {&alone.friction, &alone.force,          &alone.torque_radius,
                     &alone.place,    &alone.centre_of_mass, &alone.grasp,
                     &alone.tilt};
  const double values[] = {margin.friction, margin.force,          margin.torque_radius,
                           margin.place,    margin.centre_of_mass, margin.grasp,
                           margin.tilt};
  const int which = random.below(7);
  *parts[which] = 2.0 * values[which];
  return alone;
}

/// An instant of a plan that begins with the finger axis at `begin` and has gone on for
/// `carried_on` [m] before a push that has `travelled` [m].
struct PlannedInstant {
  Vec2 begin;
  double carried_on = 0.0, travelled = 0.0;
};

/// Slack of such an instant over a margin, as plans are checked: rings for discs, else
/// the pads' points.
inline double robust_slack_of_pads(const Model& model, const PushContact& contact,
                                   const PlanarPose& X_HO, const Vec2& e, double kappa,
                                   const PlannedInstant& at, const Margin& margin) {
  const double omega = kappa / model.c;
  const Vec2 p_OF = finger_in_object(X_HO);
  const Margin here = carried(margin, at.carried_on);
  if (has_ring_pads(model)) {
    return ring_slack(model, contact, p_OF + at.travelled * e, e, 1.0, omega,
                      margin_of_laws(model, contact, here));
  }
  return exact_stick_test(model, contact, 0.0, X_HO, e, 1.0, omega, here, at.travelled)
      .slack;
}

/// Rate at which the pusher advances, at the end of the face where it does so most; over
/// a margin at worst.
inline double advance_of(const PushContact& contact, const Vec2& p_OF, const Vec2& e,
                         double omega, const Margin& margin = Margin::none()) {
  const auto rate = [&](const Vec2& end) {
    return contact.n.dot(e + omega * perp(end - p_OF));
  };
  const Vec2 inwards = margin.place * contact.t;
  const double n = contact.n.dot(e);
  return std::max(rate(contact.a + inwards), rate(contact.b - inwards)) - n +
         least_turned(n, cross(contact.n, e), margin.tilt) -
         margin.grasp * std::abs(omega);
}

/// Whether a move sticks as plans are checked, after the finger axis has `travelled` [m].
inline bool sticks_as_checked(const SearchModel& search, const Move& move,
                              const Margin& margin, double travelled) {
  return push_slack(*search.model, grasp_of(move.from, 0.0), push_of(search, move),
                    carried(margin, travelled)) >= -kStickTolerance;
}

/// A random move by a contact that sticks, if one is hit: most of them along the edges of
/// the friction cone, where ways are cheap.
inline std::optional<Move> random_sticking_move(const SearchModel& search, int contact,
                                                const FlatState& from, Random& random,
                                                Work& work) {
  const StickContact& stick = search.contacts[contact].stick;
  const double lean = std::atan(stick.mu);
  const Vec2 e = random.chance(0.6) ? rotated(random.chance(0.5) ? lean : -lean, stick.n)
                                    : random.direction();
  const double length = random.log_in(1e-4, 0.03);
  const KappaSet kappas = sticking_kappas(stick, from.p_OF, e);
  if (kappas.empty()) return std::nullopt;
  const auto& interval = kappas.intervals[random.below(kappas.count)];
  const double low = std::max(interval.lo, -30.0), high = std::min(interval.hi, 30.0);
  if (low > high) return std::nullopt;
  const double kappa =
      random.chance(0.5) ? std::clamp(0.0, low, high) : random.in(low, high);
  const FlatState to{from.p_OF - length * e,
                     from.theta + kappa * length / search.model->c};
  if (!segment_on_object(*search.model, from.p_OF, to.p_OF)) return std::nullopt;
  const Move move{contact, from, to};
  if (!(move_slack(search, move, 12, work) >= -kStickTolerance)) return std::nullopt;
  return move;
}

}  // namespace prehensile::testing
