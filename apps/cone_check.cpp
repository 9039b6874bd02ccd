#include "apps/cone_check.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "mechanics/pad_law.h"
#include "primitives/space_cone.h"

namespace prehensile::apps {
namespace {

constexpr double kNear = 1e-6;  // [rad] of an edge

/// The first of the members that no cone has seen.
constexpr std::uint64_t kFresh = std::uint64_t{1} << 32;

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

/// Whether the motion lies in the cone; none where the slices next to it disagree.
std::optional<bool> in_cone(const MotionCone& cone, const Motion& motion, bool robust) {
  if (cone.is_point) {
    const std::vector<DirectionRange>& ranges = robust ? cone.robust : cone.nominal;
    return std::any_of(ranges.begin(), ranges.end(), [&](const DirectionRange& range) {
      return range.lo <= motion.direction && motion.direction <= range.hi;
    });
  }
  const auto after = std::upper_bound(
      cone.slices.begin(), cone.slices.end(), motion.direction,
      [](double at, const ConeSlice& slice) { return at < slice.direction; });
  if (after == cone.slices.begin() || after == cone.slices.end()) return {};
  const double rate = std::tan(motion.turn) / cone.c;
  const auto has = [&](const ConeSlice& slice) {
    return (robust ? slice.robust : slice.nominal).contains(rate);
  };
  const bool inside = has(*after);
  if (inside != has(*std::prev(after))) return {};
  return inside;
}

}  // namespace

ConeCheck check_cone(const ConeQuestion& question, const ConeMember& nominal,
                     const std::vector<ConeMember>& members) {
  ConeCheck check;
  const double c = nominal.contact.c;
  const PlanarGrasp held = grasp_at(question.model, question.grasp.X_HO,
                                    question.model.contacts[question.contact].g_O);
  std::uint64_t fresh = kFresh;
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
    if (const PlanarInstant exact = solve_by_pad_law(question.model, held, drive);
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

ConeCheck check_cone_in_space(const ConeQuestion& question, const MotionCone& cone) {
  ConeCheck check;
  std::uint64_t fresh = kFresh;
  for (int i = 0; i < question.count; ++i) {
    const Motion motion = random_motion(question.seed + 17, i);
    const std::optional<bool> inside = in_cone(cone, motion, false);
    if (!inside) continue;
    ++check.asked;
    check.inside += *inside;
    const double rate = std::tan(motion.turn) / cone.c;
    const SpatialVerdict exact =
        sticks_in_space(question.model, question.grasp, question.contact, question.place,
                        motion.direction, rate);
    check.exact_asked += exact.is_known;
    check.exact_agrees += exact.is_known && (exact.margin >= 0.0) == *inside;
    if (cone.members == 0 || !in_cone(cone, motion, true).value_or(false)) continue;
    const std::optional<SpaceMember> other =
        space_member(question.model, question.grasp, question.contact, question.place,
                     question.box, random_point(question.seed, fresh++));
    if (!other) continue;
    ++check.robust_asked;
    check.robust_sticks +=
        sticks_in_space(*other, question.contact, motion.direction, rate).margin >= 0.0;
  }
  return check;
}

}  // namespace prehensile::apps
