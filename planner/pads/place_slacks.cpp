#include "planner/pads/place_slacks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mechanics/pad_law.h"
#include "mechanics/sticking.h"
#include "planner/pads/ring_pads.h"
#include "scene/constants.h"
#include "scene/outline.h"
#include "scene/segment_distance.h"

namespace prehensile {
namespace {

constexpr int kDirections = FreeDirections::kLookedAt;

/// Nodes of the grid over the longer side of the object.
constexpr int kNodesPerSide = 72;

/// Where the discs are clipped only every second direction is looked at.
constexpr int kStrideWhereClipped = 2;

/// What has less at the rates of turn first looked at is as good as none.
constexpr double kHopeless = -0.35;

/// Rates of turn that are looked at, evenly in the angle of (1, kappa), and steps towards
/// the best between them.
constexpr int kSlopes = 61;
constexpr int kSlopesWhereClipped = 17;
constexpr int kRefinements = 6;
constexpr double kSteepest = 1.56;  // [rad]

/// The friction of whole discs is tabulated at so many.
constexpr int kTabulated = 361;

/// Over which the points of clipped discs are spread: fewer than the check looks at.
constexpr int kAnglesOfFinder = 5;

/// Of the friction: what the check of barriers wants to be missing where the grasp alone
/// does not hold the object, and a little.
constexpr double kSurelyMissing = 0.015;

/// Where the ellipsoid of whole discs is this far from falling or holding, it decides.
constexpr double kFarFromFalling = 0.4;

/// What contacts ask at one place, for one motion after another.
class Asked {
 public:
  Asked(const Model& model, const Vec2& p_OF) : model_(model), p_OF_(p_OF) {
    const bool whole = model.region.is_whole(pose_from_finger(p_OF, 0.0));
    const PushContact* before = nullptr;
    double held = 0.0;
    for (const PushContact& contact : model.contacts) {
      if (!before || contact.g_O != before->g_O) held = held_at(contact.g_O, whole);
      before = &contact;
      if (held < kHopeless) continue;
      asked_.push_back({&contact, {model, contact, p_OF}, held});
    }
  }

  bool is_nothing() const { return asked_.empty(); }

  /// `friction()` is asked for where some contact can advance.
  template <class Friction>
  double slack(const Eigen::Vector3d& motion, const Friction& friction) const {
    double most = -kInfinity;
    std::optional<Eigen::Vector3d> known;
    for (const Of& asked : asked_) {
      const PushContact& contact = *asked.contact;
      const auto advance = [&](const Vec2& end) {
        return advance_at(end, contact, p_OF_, model_.c, motion);
      };
      if (std::max(advance(contact.a), advance(contact.b)) < 0.0) continue;
      if (!known) known = friction();
      most = std::max(most, std::min(asked.held, asked.demands.slack(*known)));
    }
    return most;
  }

 private:
  struct Of {
    const PushContact* contact;
    StickDemands demands;
    double held;
  };

  /// What the friction has more than gravity asks of the grasp alone.
  double held_at(const Vec2& g_O, bool whole) const {
    if (whole) {
      const double by_ellipsoid = holding_slack(model_, p_OF_, g_O, Margin::none());
      if (std::abs(by_ellipsoid) > kFarFromFalling) return by_ellipsoid;
    }
    const PlanarGrasp grasp = grasp_at(model_, pose_from_finger(p_OF_, 0.0), g_O);
    if (grasp.count == 0) return -kInfinity;
    return gravity_slack_by_pad_law(model_, grasp) + kSurelyMissing;
  }
  const Model& model_;
  const Vec2& p_OF_;
  std::vector<Of> asked_;
};

Eigen::Vector3d motion_along(const Vec2& e, double angle) {
  return {std::cos(angle) * e.x(), std::cos(angle) * e.y(), std::sin(angle)};
}

/// The greatest value found of a function of the angle of (1, kappa): it rises to it and
/// falls from it nearby.
template <class Function>
double most_over_slopes(int count, const Function& value) {
  const double step = 2.0 * kSteepest / (count - 1);
  double most = -kInfinity;
  double best = 0.0;
  for (int i = 0; i < count; ++i) {
    const double angle = step * i - kSteepest;
    const double at = value(angle);
    if (at > most) {
      most = at;
      best = angle;
    }
  }
  if (most < kHopeless) return std::max(most, -1.0);
  double low = std::max(best - step, -kSteepest);
  double high = std::min(best + step, kSteepest);
  for (int i = 0; i < kRefinements; ++i) {
    const double third = (high - low) / 3.0;
    const double at_low = value(low + third);
    const double at_high = value(high - third);
    most = std::max({most, at_low, at_high});
    (at_low < at_high ? low : high) += at_low < at_high ? third : -third;
  }
  return most;
}

/// The place of an outline that is nearest to one outside, a little way in.
Vec2 nearest_inside(const std::vector<Vec2>& outline, const Vec2& p) {
  constexpr double kIn = 1e-6;  // [m]
  Vec2 nearest = outline.front();
  for (std::size_t i = 0, before = outline.size() - 1; i < outline.size(); before = i++) {
    const double share = nearest_share(p, outline[before], outline[i]);
    const Vec2 on_edge = outline[before] + share * (outline[i] - outline[before]);
    if ((on_edge - p).norm() < (nearest - p).norm()) nearest = on_edge;
  }
  return nearest + kIn * (nearest - p).normalized();
}

}  // namespace

PlaceSlacks::PlaceSlacks(const Model& model)
    : model_(model),
      grid_(PlaceGrid::over(model.pad_face, kNodesPerSide)),
      profiles_(static_cast<std::size_t>(grid_.count())) {
  for (int i = 0; i < kTabulated; ++i) {
    const double angle = kSteepest * (2.0 * i / (kTabulated - 1) - 1.0);
    const RingFriction friction =
        ring_friction(model.region.whole(), model.c, std::abs(angle));
    whole_.push_back({friction.along, std::copysign(friction.moment, angle) / model.c});
  }
}

PlaceSlacks::Profile PlaceSlacks::at(const Vec2& p_OF) {
  Profile sum{};
  for (const auto& [node, share] : grid_.around(p_OF)) {
    if (share == 0.0) continue;
    const Profile& profile = at_node(node);
    for (int k = 0; k < kDirections; ++k) sum[k] += share * profile[k];
  }
  return sum;
}

/// Nodes beside the object stand for where it is nearest, or what is between them and the
/// first on it would seem to stick less.
const PlaceSlacks::Profile& PlaceSlacks::at_node(int node) {
  std::optional<Profile>& profile = profiles_[static_cast<std::size_t>(node)];
  if (!profile) {
    const Vec2 place = grid_.place(node);
    const double depth = depth_inside(model_.pad_face, place);
    const bool is_beside = depth < 0.0 && depth > -2.0 * grid_.spacing;
    profile = looked_at(is_beside ? nearest_inside(model_.pad_face, place) : place);
  }
  return *profile;
}

PlaceSlacks::Profile PlaceSlacks::looked_at(const Vec2& p_OF) const {
  Profile slacks;
  slacks.fill(-1.0);
  if (depth_inside(model_.pad_face, p_OF) < 0.0) return slacks;
  const Asked asked(model_, p_OF);
  if (asked.is_nothing()) return slacks;
  if (model_.region.is_whole(pose_from_finger(p_OF, 0.0))) {
    for (int k = 0; k < kDirections; ++k) {
      const Vec2 e = -towards(FreeDirections::direction(k));
      slacks[k] = most_over_slopes(kSlopes, [&](double angle) {
        return asked.slack(motion_along(e, angle),
                           [&] { return friction_of_whole(angle, e); });
      });
    }
    return slacks;
  }
  const QuickSpreadPads pads(model_, p_OF, kAnglesOfFinder);
  if (pads.are_lost()) return slacks;
  for (int k = 0; k < kDirections; k += kStrideWhereClipped) {
    const Vec2 e = -towards(FreeDirections::direction(k));
    slacks[k] = most_over_slopes(kSlopesWhereClipped, [&](double angle) {
      const Eigen::Vector3d motion = motion_along(e, angle);
      return asked.slack(motion, [&] { return friction_in(pads, motion, model_.c); });
    });
  }
  for (int k = 1; k < kDirections; k += kStrideWhereClipped) {
    slacks[k] = 0.5 * (slacks[k - 1] + slacks[(k + 1) % kDirections]);
  }
  return slacks;
}

Eigen::Vector3d PlaceSlacks::friction_of_whole(double angle, const Vec2& e) const {
  const double at = 0.5 * (angle / kSteepest + 1.0) * (kTabulated - 1);
  const auto i = static_cast<std::size_t>(std::clamp(at, 0.0, kTabulated - 2.0));
  const double share = at - static_cast<double>(i);
  const double along = std::lerp(whole_[i].along, whole_[i + 1].along, share);
  return {along * e.x(), along * e.y(),
          std::lerp(whole_[i].moment, whole_[i + 1].moment, share)};
}

}  // namespace prehensile
