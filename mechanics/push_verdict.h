/// From the motions of an instant to its status. Internal to the mechanics layer.
#pragma once

#include "mechanics/push_modes.h"

namespace prehensile {

struct PushVerdict {
  InstantStatus status = InstantStatus::kOutOfIterations;
  Motion motion;
  bool has_evidence = false;
  PlanarTwist evidence;
  bool has_other = false;
  PlanarTwist other;
};

/// Generators of a cone of wrenches that the pusher may exert.
struct PusherCone {
  int count = 0;
  std::array<PlanarWrench, 4> edges;
};

/// All forces of the pusher (`with_friction`), or those of a frictionless one.
inline PusherCone pusher_cone(const ScaledPush& push, bool with_friction) {
  PusherCone cone;
  for (int i = 0; i < push.count; ++i) {
    for (const int slip : {1, -1}) {
      const Vec2 f = with_friction ? push.edge(slip) : push.n;
      if (slip == 1 || with_friction) {
        cone.edges[cone.count++] = wrench_of(push.p[i], f).normalized();
      }
    }
  }
  return cone;
}

/// A twist against which no force of the cone works, and with which gravity gains more
/// power than the pads can take: then no force of the cone keeps the object from falling.
/// The strongest such twist has none, one or two edges of the cone at right angles.
template <class Body>
bool find_fall(const Body& body, const PlanarWrench& w_g, const PlanarTwist& unsupported,
               const PusherCone& cone, PlanarTwist& fall) {
  const auto falls = [&](const PlanarTwist& v) {
    for (int k = 0; k < cone.count; ++k) {
      if (cone.edges[k].dot(v) < -1e-13 * v.norm()) return false;
    }
    const double gain = w_g.dot(v) - body.dissipation(v);
    if (!(gain > 1e-11 * w_g.norm() * v.norm())) return false;
    fall = v / v.norm();
    return true;
  };
  if (falls(unsupported)) return true;
  for (int k = 0; k < cone.count; ++k) {
    const PlanarWrench& e = cone.edges[k];
    const PlanarTwist along = w_g.cross(e);
    const double area = along.squaredNorm();
    if (area <= 1e-24 * w_g.squaredNorm()) continue;
    const PlanarTwist start = (w_g - w_g.dot(e) * e) / area;
    const LowestOnLine low = body.lowest(start, along, PlanarWrench::Zero(), nullptr);
    if (low.bounded && falls(low.u - low.u.dot(e) * e)) return true;
    for (int l = 0; l < k; ++l) {
      const PlanarTwist v = e.cross(cone.edges[l]);
      if (falls(v) || falls(-v)) return true;
    }
  }
  return false;
}

/// The pusher presses on the object at rest while it slides along it: a state only if
/// gravity needs the pusher. The force is taken from the middle of the possible range.
template <class Body>
bool carried_at_rest(const Body& body, const ScaledPush& push, Motion& motion) {
  for (int i = 0; i < push.count; ++i) {
    const double slide = push.t.dot(point_velocity(push.V, push.p[i]));
    if (std::abs(push.approach(i)) > kGrazing || slide == 0.0) continue;
    motion = Motion{};
    motion.support = static_cast<Motion::Support>(i);
    motion.slip = slide > 0.0 ? -1 : 1;
    const PlanarWrench e = wrench_of(push.p[i], push.edge(motion.slip));
    const RayExit exit = body.exit(push.w_g, e, nullptr);
    const RayExit entry = body.exit(push.w_g, -e, nullptr);
    if (!exit.hit || !entry.hit || exit.lambda <= 0.0) continue;
    motion.w = 0.5 * (exit.lambda + std::max(0.0, -entry.lambda)) * e;
    judge(push, motion);
    if (motion.residual <= kJudged) return true;
  }
  return false;
}

/// Gravity is more than the pads can hold: the pusher carries the object, or it falls.
/// Without a status, `evidence` still shows that gravity is not held.
template <class Body>
PushVerdict judge_unheld(const Body& body, const ScaledPush& push,
                         const PlanarTwist& unsupported) {
  PushVerdict verdict;
  verdict.has_evidence = true;
  if (find_fall(body, push.w_g, unsupported, pusher_cone(push, true), verdict.evidence)) {
    verdict.status = InstantStatus::kDynamic;
    return verdict;
  }
  std::array<Motion, PushModes<Body>::kMost> motions;
  int count = PushModes<Body>(body, push).all_motions(motions);
  if (count == 0 && carried_at_rest(body, push, motions[0])) count = 1;
  if (count > 0) {
    verdict.status = InstantStatus::kAmbiguous;
    verdict.motion = motions[0];
    verdict.evidence = unsupported;
    verdict.has_other = count > 1;
    if (count > 1) verdict.other = motions[1].u;
    return verdict;
  }
  if (find_fall(body, push.w_g, unsupported, pusher_cone(push, false),
                verdict.evidence)) {
    verdict.status = InstantStatus::kDynamic;
    return verdict;
  }
  verdict.evidence = unsupported;
  return verdict;
}

/// A pusher that approaches at no point: the object rests in the pads. With `probe`, also
/// looks for the object being dragged along by friction, which a receding pusher can do.
/// A mode scaled to an approach that is rounding is no such motion: it is rest.
template <class Body>
PushVerdict judge_receding(const Body& body, const ScaledPush& push, bool probe) {
  PushVerdict verdict;
  verdict.status = InstantStatus::kSeparated;
  for (int i = 0; i < push.count; ++i) {
    if (push.approach(i) >= -kGrazing) verdict.status = InstantStatus::kHolds;
  }
  judge(push, verdict.motion);
  if (!probe) return verdict;
  std::array<Motion, PushModes<Body>::kMost> motions;
  const int count = PushModes<Body>(body, push).all_motions(motions);
  for (int k = 0; k < count && !verdict.has_other; ++k) {
    if (is_same_motion(motions[k].u, verdict.motion.u)) continue;
    verdict.status = InstantStatus::kAmbiguous;
    verdict.has_other = true;
    verdict.other = motions[k].u;
  }
  return verdict;
}

/// A pad that is one point lets the object turn about it without resistance: the object
/// may swing off the pusher at any sufficient rate. Sought at about the rate of the push
/// first, as a pusher that hardly approaches would tell it from the motion `u` no more.
inline bool swings_off(const ScaledPush& push, const PlanarTwist& u, PlanarTwist& swing) {
  double reach = 0.0;
  for (int i = 0; i < push.count; ++i) reach = std::max(reach, push.p[i].norm());
  for (const double side : {1.0, -1.0}) {
    const auto opening = [&](int i) { return side * push.n.dot(perp(push.p[i])); };
    double rate = 0.0;
    for (int i = 0; i < push.count; ++i) {
      if (opening(i) > 1e-9) rate = std::max(rate, 2.0 * push.approach(i) / opening(i));
    }
    if (rate <= 0.0) continue;
    for (const double turn : {std::max(rate, 1.0 / reach), rate}) {
      bool possible = true;
      for (int i = 0; i < push.count; ++i) {
        possible = possible && turn * opening(i) >= push.approach(i);
      }
      swing = {0.0, 0.0, side * turn};
      if (possible && !is_same_motion(swing, u)) return true;
    }
  }
  return false;
}

/// The quasi-static instant. `known` is a motion found before, or null. `probe` looks for
/// more motions even where the pads hold gravity and there should be only one.
template <class Body>
PushVerdict judge_push(const Body& body, const ScaledPush& push, const Motion* known,
                       bool probe) {
  PlanarTwist unsupported;
  const bool held = body.holds(push.w_g, &unsupported);
  if (!held) return judge_unheld(body, push, unsupported);
  double approach = push.approach(0);
  if (push.count == 2) approach = std::max(approach, push.approach(1));
  if (approach <= kGrazing) return judge_receding(body, push, probe);

  PushVerdict verdict;
  const PushModes<Body> modes(body, push);
  bool found = known != nullptr;
  if (found) {
    verdict.motion = *known;
  } else {
    found = modes.any_motion(verdict.motion);
  }
  if (probe || !found) {
    std::array<Motion, PushModes<Body>::kMost> motions;
    const int count = modes.all_motions(motions);
    found = count > 0;
    if (found) verdict.motion = motions[0];
    verdict.has_other = count > 1;
    if (count > 1) verdict.other = motions[1].u;
  }
  if (!found) return verdict;
  PlanarTwist swing;
  if (body.is_point() && swings_off(push, verdict.motion.u, swing)) {
    verdict.has_other = true;
    verdict.other = swing;
  }
  const bool forces_vary = verdict.motion.force_high - verdict.motion.force_low > kJudged;
  verdict.status = verdict.has_other ? InstantStatus::kAmbiguous
                   : forces_vary     ? InstantStatus::kNonuniqueForces
                                     : InstantStatus::kMoves;
  return verdict;
}

/// Writes a verdict, except the finger points, into an answer.
inline void report(const ScaledPush& push, const PushVerdict& verdict,
                   PlanarInstant& answer) {
  answer.status = verdict.status;
  if (usable(verdict.status) || verdict.status == InstantStatus::kAmbiguous) {
    report(push, verdict.motion, answer);
  }
  if (verdict.has_evidence) answer.evidence = twist_in_hand(push, verdict.evidence);
  if (verdict.has_other) answer.other = twist_in_hand(push, verdict.other);
}

}  // namespace prehensile
