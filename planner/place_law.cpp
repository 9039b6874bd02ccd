#include "planner/place_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mechanics/pad_drag.h"

namespace prehensile {
namespace {

/// Slack that is kept, over F and F c, for what lies between the samples and the places.
constexpr double kAside = 1e-3;

/// Slopes lie evenly in the angle of (1, kappa), up to this kappa.
constexpr double kMostKappa = 10.0;
constexpr int kSlopesOfWhole = 181;
constexpr int kSlopesOfClipped = 61;

/// Angles of the object at which whole and clipped pads are looked at: of these there are
/// more points.
constexpr int kAngles = 8;
constexpr int kAnglesOfClippedDiscs = 3;

double slope_angle(int i, int slopes) {
  return std::atan(kMostKappa) * (2.0 * i / (slopes - 1) - 1.0);
}

std::vector<DirectedDrag::Slope> slopes_of(int count) {
  std::vector<DirectedDrag::Slope> slopes;
  slopes.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double angle = slope_angle(i, count);
    slopes.push_back({angle, std::cos(angle), std::sin(angle)});
  }
  return slopes;
}

}  // namespace

KappaRanges common(const KappaRanges& one, const KappaRanges& other) noexcept {
  KappaRanges both;
  for (int i = 0; i < one.count; ++i) {
    for (int j = 0; j < other.count; ++j) {
      const double lo = std::max(one.intervals[i].lo, other.intervals[j].lo);
      const double hi = std::min(one.intervals[i].hi, other.intervals[j].hi);
      if (lo <= hi && both.count < 2) both.intervals[both.count++] = {lo, hi};
    }
  }
  return both;
}

PadsAtPlace::PadsAtPlace(const Model& model, const Vec2& p_OF)
    : are_whole_(!can_roll(model.scene.object) &&
                 model.region.is_whole(pose_from_finger(p_OF, 0.0))) {
  const bool discs = model.region.is_isotropic() || can_roll(model.scene.object);
  const int angles = model.has_soft_points() ? 1
                     : are_whole_ || !discs  ? kAngles
                                             : kAnglesOfClippedDiscs;
  for (int k = 0; k < angles; ++k) {
    const double theta = 2.0 * std::numbers::pi * k / angles;
    PlanarGrasp grasp = grasp_at(model, pose_from_finger(p_OF, theta), Vec2::Zero());
    if (grasp.count == 0) continue;
    for (int j = 0; j < grasp.count; ++j) {
      const Vec2 r = rotated(-theta, Vec2(grasp.x[j], grasp.y[j]));
      grasp.x[j] = r.x();
      grasp.y[j] = r.y();
    }
    grasps_.push_back(grasp);
  }
}

DirectedDrag::DirectedDrag(const Model& model, const PadsAtPlace& pads, const Vec2& e)
    : e_(e), slopes_(slopes_for(pads)), angles_(pads.grasps().size()) {
  samples_.reserve(slopes_.size() * angles_);
  for (const Slope& slope : slopes_) {
    const Vec2 velocity = slope.cosine * e;
    for (const PlanarGrasp& grasp : pads.grasps()) {
      if (model.has_soft_points()) {
        samples_.push_back({velocity, slope.sine});
        continue;
      }
      const PadDrag drag = drag_of_points(grasp.count, grasp.x, grasp.y, grasp.bound, 1.0,
                                          velocity, slope.sine / model.c);
      samples_.push_back({drag.force / model.F, drag.moment / (model.F * model.c)});
    }
  }
}

std::span<const DirectedDrag::Slope> DirectedDrag::slopes_for(const PadsAtPlace& pads) {
  static const std::vector<Slope> whole = slopes_of(kSlopesOfWhole);
  static const std::vector<Slope> clipped = slopes_of(kSlopesOfClipped);
  return pads.are_whole() ? whole : clipped;
}

KappaRanges DirectedDrag::kappas(const StickContact& contact,
                                 const Vec2& p_OF) const noexcept {
  const auto lever = [&](const Vec2& from, const Vec2& to) {
    return Vec2((to - from) / contact.c);
  };
  const Vec2 a = lever(p_OF, contact.a);
  const Vec2 b = lever(p_OF, contact.b);
  const double weight = cross(lever(p_OF, contact.p_OCom), contact.gamma);
  const auto slack_of = [&](const Sample& sample) {
    const Vec2 force = sample.force - contact.gamma;
    const double moment = sample.moment - weight;
    const double normal = force.dot(contact.n);
    return std::min({normal, contact.mu * normal - std::abs(force.dot(contact.t)),
                     cross(a, force) - moment, moment - cross(b, force)});
  };
  const double straight = contact.n.dot(e_);
  const double turning_a = contact.n.dot(perp(a));
  const double turning_b = contact.n.dot(perp(b));
  const auto slack_at = [&](std::size_t i) {
    const Slope& slope = slopes_[i];
    double slack = slope.cosine * straight +
                   std::max(slope.sine * turning_a, slope.sine * turning_b);
    for (std::size_t k = 0; k < angles_; ++k) {
      slack = std::min(slack, slack_of(samples_[i * angles_ + k]));
    }
    return slack - kAside;
  };
  KappaRanges set;
  double before = -1.0;
  for (std::size_t i = 0; i < slopes_.size(); ++i) {
    const double now = slack_at(i);
    const auto crossing = [&] {  // of zero, between the sample before and this one
      const double share = before / (before - now);
      return std::tan(std::lerp(slopes_[i - 1].angle, slopes_[i].angle, share));
    };
    if (now >= 0.0 && before < 0.0) {
      if (set.count == 2) break;
      const double lo = i > 0 ? crossing() : std::tan(slopes_[0].angle);
      set.intervals[set.count++] = {lo, std::tan(slopes_[i].angle)};
    } else if (now >= 0.0) {
      set.intervals[set.count - 1].hi = std::tan(slopes_[i].angle);
    } else if (before >= 0.0) {
      set.intervals[set.count - 1].hi = crossing();
    }
    before = now;
  }
  return set;
}

}  // namespace prehensile
