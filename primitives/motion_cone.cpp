#include "primitives/motion_cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/constants.h"

namespace prehensile {
namespace {

/// Directions that are looked at before edges are refined.
constexpr int kScan = 720;

Vec2 direction_in_object(const ConeMember& member, double direction) {
  return rotated(direction + member.turned, member.contact.n);
}

bool point_sticks(const ConeMember& member, double direction) {
  const Vec2 v = rotated(member.theta, direction_in_object(member, direction));
  PlanarDrive drive = member.drive;
  drive.V_HP = {v.x(), v.y(), 0.0};
  const PlanarInstant instant = solve_limit_surface(member.surface, member.w_g, drive);
  return usable(instant.status) && instant.pusher[0].mode == ContactMode::kStick;
}

/// Rates of turn [rad/m] at which a line sticks.
KappaSet sticking_rates(const ConeMember& member, double direction) {
  KappaSet set = sticking_kappas(member.contact, member.p_OF,
                                 direction_in_object(member, direction));
  for (int i = 0; i < set.count; ++i) {
    set.intervals[i].lo /= member.contact.c;
    set.intervals[i].hi /= member.contact.c;
  }
  return set;
}

}  // namespace

ConeMember cone_member(const Model& model, int contact, double place,
                       const PlanarPose& X_HO) {
  const PushContact& pusher = model.contacts[contact];
  ConeMember member;
  member.contact = stick_contact(model, pusher, place);
  member.surface = model.surface();
  member.p_OF = finger_in_object(X_HO);
  member.w_g = grasp_at(model, X_HO, pusher.g_O).w_g;
  member.drive = drive_at(pusher, place, X_HO, PlanarTwist::Zero());
  member.theta = X_HO.theta;
  return member;
}

CompiledMember cone_member(const Scene& scene, const Grasp& start, int contact,
                           double place, const UncertaintyBox& box, const BoxPoint& at) {
  const UncertainPush varied =
      vary(scene, start, LinearPush{.contact = contact, .place = place}, box, at);
  if (!check(varied.scene).empty()) return {};
  const Model model = prepare(varied.scene);
  if (!(model.F > 0.0 && model.c > 0.0) || !pads_on_object(model, varied.start.X_HO)) {
    return {};
  }
  const LinearPush& push = std::get<LinearPush>(varied.push);
  CompiledMember out{true, cone_member(model, contact, push.place, varied.start.X_HO)};
  out.member.turned = std::atan2(push.e.y(), push.e.x());
  return out;
}

bool sticks(const ConeMember& member, double direction, double omega_per_speed) {
  if (member.contact.is_point) return point_sticks(member, direction);
  return sticking_rates(member, direction).contains(omega_per_speed);
}

MotionCone motion_cone(const ConeMember& nominal, const std::vector<ConeMember>& members,
                       int slices) {
  MotionCone cone;
  cone.is_point = nominal.contact.is_point;
  cone.c = nominal.contact.c;
  cone.members = static_cast<int>(members.size());
  const auto all_stick = [&](double direction) {
    return sticks(nominal, direction, 0.0) &&
           std::all_of(members.begin(), members.end(), [&](const ConeMember& member) {
             return sticks(member, direction, 0.0);
           });
  };
  cone.nominal = ranges_where([&](double d) { return sticks(nominal, d, 0.0); });
  cone.robust = members.empty() ? cone.nominal : ranges_where(all_stick);
  if (cone.is_point) return cone;
  for (int k = 0; k < slices; ++k) {
    ConeSlice slice;
    slice.direction =
        -std::numbers::pi + 2.0 * std::numbers::pi * k / std::max(1, slices - 1);
    slice.nominal = sticking_rates(nominal, slice.direction);
    slice.robust = slice.nominal;
    for (const ConeMember& member : members) {
      if (slice.robust.empty()) break;
      slice.robust = intersection(slice.robust, sticking_rates(member, slice.direction));
    }
    cone.slices.push_back(slice);
  }
  return cone;
}

std::vector<DirectionRange> ranges_where(const std::function<bool(double)>& holds) {
  const auto edge = [&](double inside, double outside) {
    while (std::abs(outside - inside) > 1e-10) {
      const double middle = 0.5 * (inside + outside);
      (holds(middle) ? inside : outside) = middle;
    }
    return inside;
  };
  std::vector<DirectionRange> ranges;
  double last = -kPi;
  bool was_inside = holds(last);
  if (was_inside) ranges.push_back({last, last});
  for (int k = 1; k <= kScan; ++k) {
    const double at = -kPi + 2.0 * kPi * k / kScan;
    const bool inside = holds(at);
    if (inside && !was_inside) ranges.push_back({edge(at, last), at});
    if (!inside && was_inside) ranges.back().hi = edge(last, at);
    if (inside) ranges.back().hi = at;
    was_inside = inside;
    last = at;
  }
  return ranges;
}

KappaSet intersection(const KappaSet& a, const KappaSet& b) {
  KappaSet out;
  for (int i = 0; i < a.count; ++i) {
    for (int j = 0; j < b.count; ++j) {
      const double lo = std::max(a.intervals[i].lo, b.intervals[j].lo);
      const double hi = std::min(a.intervals[i].hi, b.intervals[j].hi);
      if (lo <= hi && out.count < static_cast<int>(out.intervals.size())) {
        out.intervals[out.count++] = {lo, hi};
      }
    }
  }
  return out;
}

}  // namespace prehensile
