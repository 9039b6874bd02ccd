#include "apps/cone_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mechanics/planar_instant.h"
#include "primitives/space_cone.h"

namespace prehensile::apps {
namespace {

constexpr double kNear = 1e-6;  // [rad] of an edge

struct Motion {
  double direction = 0.0;
  double turn = 0.0;  ///< atan(c omega / speed)
};

/// The object follows a line; the point of contact sticks.
bool follows(const PlanarInstant& instant, const PlanarDrive& drive, double c) {
  if (drive.count == 1) return instant.pusher[0].mode == ContactMode::kStick;
  const PlanarTwist difference = instant.V_HO - drive.V_HP;
  return difference.head<2>().norm() + c * std::abs(difference[2]) <=
         1e-6 * (drive.V_HP.head<2>().norm() + c * std::abs(drive.V_HP[2]));
}

PlanarDrive drive_of(const ConeMember& member, const Motion& motion) {
  PlanarDrive drive = member.drive;
  const Vec2 v =
      rotated(member.theta + motion.direction + member.turned, member.contact.n);
  // A point's velocity is its own; that of a line is taken at the finger axis.
  drive.V_HP = {v.x(), v.y(),
                drive.count == 1 ? 0.0 : std::tan(motion.turn) / member.contact.c};
  return drive;
}

bool in_cone(const ConeMember& member, const Motion& motion, double c) {
  return sticks(member, motion.direction, std::tan(motion.turn) / c);
}

bool is_near_an_edge(const ConeMember& member, const Motion& motion, double c) {
  const bool inside = in_cone(member, motion, c);
  for (const double side : {-kNear, kNear}) {
    if (in_cone(member, {motion.direction + side, motion.turn}, c) != inside ||
        in_cone(member, {motion.direction, motion.turn + side}, c) != inside) {
      return true;
    }
  }
  return false;
}

Motion random_motion(std::uint64_t seed, int i) {
  const BoxPoint at = random_point(seed, static_cast<std::uint64_t>(i));
  return {0.6 * std::numbers::pi * at[0], 0.49 * std::numbers::pi * at[1]};
}

}  // namespace

ConeCheck check_cone(const ConeQuestion& question, const ConeMember& nominal,
                     const std::vector<ConeMember>& members) {
  ConeCheck check;
  const double c = nominal.contact.c;
  const PlanarGrasp held = grasp_at(question.model, question.grasp.X_HO,
                                    question.model.contacts[question.contact].g_O);
  const bool in_space =
      question.model.push_needs_space(question.model.contacts[question.contact]);
  // Members that the cone has not seen.
  std::uint64_t fresh = std::uint64_t{1} << 32;
  for (int i = 0; i < question.count; ++i) {
    const Motion motion = random_motion(question.seed + 17, i);
    if (is_near_an_edge(nominal, motion, c)) continue;
    const bool inside = in_cone(nominal, motion, c);
    const PlanarDrive drive = drive_of(nominal, motion);
    ++check.asked;
    check.inside += inside;
    const PlanarInstant closed = solve_limit_surface(nominal.surface, nominal.w_g, drive);
    if (usable(closed.status)) {
      check.closed_agrees += follows(closed, drive, c) == inside;
    } else if (closed.status == InstantStatus::kSeparated) {
      check.closed_agrees += !inside;
    } else {
      ++check.not_unique;
    }
    if (in_space) {
      const SpatialVerdict exact =
          sticks_in_space(question.model, question.grasp, question.contact,
                          question.place, motion.direction, std::tan(motion.turn) / c);
      check.exact_asked += exact.is_known;
      check.exact_agrees += exact.is_known && (exact.margin >= 0.0) == inside;
    } else if (const PlanarInstant exact = solve_planar(held, drive);
               usable(exact.status)) {
      ++check.exact_asked;
      check.exact_agrees += follows(exact, drive, c) == inside;
    }
    const bool robust =
        inside && !members.empty() &&
        std::all_of(members.begin(), members.end(),
                    [&](const ConeMember& m) { return in_cone(m, motion, c); });
    if (!robust) continue;
    const CompiledMember other =
        cone_member(question.model.scene, question.grasp, question.contact,
                    question.place, question.box, random_point(question.seed, fresh++));
    if (!other.usable) continue;
    ++check.robust_asked;
    check.robust_sticks += in_cone(other.member, motion, c);
  }
  return check;
}

}  // namespace prehensile::apps
