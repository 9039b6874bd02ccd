#include "planner/place_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prehensile {
namespace {

/// Slack that is kept, over F and F c, for what lies between the samples and the places.
constexpr double kAside = 1e-3;

/// Slopes lie evenly in the angle of (1, kappa), up to this kappa.
constexpr double kMostKappa = 10.0;
constexpr double kMostKappaIfSteep = 40.0;
constexpr int kSlopesOfWhole = 181;
constexpr int kSlopesOfClipped = 61;
constexpr int kMoreSlopesOfClipped = 121;

/// So many stretches of slopes are first looked at whether they are hopeless: at both of
/// their ends an inequality lacks so much, over F or F c.
constexpr std::size_t kStretches = 15;
constexpr double kHopeless = 0.25;

/// Angles of the object at which whole and clipped pads are looked at: of these there are
/// more points.
constexpr int kAngles = 8;
constexpr int kAnglesOfClippedDiscs = 3;

std::vector<DirectedDrag::Slope> slopes_up_to(double most_kappa, int count) {
  std::vector<DirectedDrag::Slope> slopes;
  slopes.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double angle = std::atan(most_kappa) * (2.0 * i / (count - 1) - 1.0);
    slopes.push_back({angle, std::cos(angle), std::sin(angle), std::tan(angle)});
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

bool PadsAtPlace::are_whole_at(const Model& model, const Vec2& p_OF) {
  return !can_roll(model.scene.object) &&
         model.region.is_whole(pose_from_finger(p_OF, 0.0));
}

PadsAtPlace::PadsAtPlace(const Model& model, const Vec2& p_OF)
    : are_whole_(are_whole_at(model, p_OF)) {
  const bool discs = model.region.is_isotropic() || can_roll(model.scene.object);
  const int angles = model.has_soft_points() ? 1
                     : are_whole_ || !discs  ? kAngles
                                             : kAnglesOfClippedDiscs;
  for (int k = 0; k < angles; ++k) {
    const double theta = 2.0 * std::numbers::pi * k / angles;
    const PlanarGrasp grasp =
        grasp_at(model, pose_from_finger(p_OF, theta), Vec2::Zero());
    if (grasp.count == 0) continue;
    at_angles_.emplace_back().add(grasp, theta, model.c, model.F);
  }
}

DirectedDrag::DirectedDrag(const Model& model, const PadsAtPlace& pads, const Vec2& e,
                           Steepness steepness)
    : model_(model),
      pads_(pads),
      e_(e),
      slopes_(slopes_for(pads, steepness)),
      angles_(static_cast<std::size_t>(pads.angles())),
      samples_(slopes_.size() * angles_) {}

DirectedDrag::DirectedDrag(DirectedDrag* other) noexcept
    : model_(other->model_),
      pads_(other->pads_),
      e_(-other->e_),
      slopes_(other->slopes_),
      angles_(other->angles_),
      opposite_(other) {}

DirectedDrag DirectedDrag::opposite() noexcept { return DirectedDrag(this); }

std::span<const DirectedDrag::Slope> DirectedDrag::slopes_for(const PadsAtPlace& pads,
                                                              Steepness steepness) {
  static const auto whole = slopes_up_to(kMostKappa, kSlopesOfWhole);
  static const auto clipped = slopes_up_to(kMostKappa, kSlopesOfClipped);
  static const auto more_of_clipped = slopes_up_to(kMostKappa, kMoreSlopesOfClipped);
  static const auto steep_of_whole = slopes_up_to(kMostKappaIfSteep, kSlopesOfWhole);
  static const auto steep_of_clipped =
      slopes_up_to(kMostKappaIfSteep, kMoreSlopesOfClipped);
  const bool are_whole = pads.are_whole();
  switch (steepness) {
    case Steepness::kSteep:
      return are_whole ? steep_of_whole : steep_of_clipped;
    case Steepness::kUsualFinely:
      return are_whole ? whole : more_of_clipped;
    case Steepness::kUsual:
      break;
  }
  return are_whole ? whole : clipped;
}

DirectedDrag::Sample DirectedDrag::sample(std::size_t slope, std::size_t angle) noexcept {
  if (opposite_) {
    const Sample sample = opposite_->sample(slopes_.size() - 1 - slope, angle);
    return {-sample.force, -sample.moment, true};
  }
  Sample& sample = samples_[slope * angles_ + angle];
  if (sample.known) return sample;
  sample.known = true;
  const Vec2 velocity = slopes_[slope].cosine * e_;
  const double turning = slopes_[slope].sine;
  if (model_.has_soft_points()) {
    sample.force = velocity;
    sample.moment = turning;
    return sample;
  }
  const auto drag = pads_.drag(static_cast<int>(angle), velocity, turning);
  sample.force = drag.force;
  sample.moment = drag.moment;
  return sample;
}

/// How firmly a contact sticks at one place, slope by slope.
class DirectedDrag::Instants {
 public:
  Instants(DirectedDrag& drag, const StickContact& contact, const Vec2& p_OF)
      : drag_(drag), contact_(contact) {
    const auto lever = [&](const Vec2& to) { return Vec2((to - p_OF) / contact.c); };
    a_ = lever(contact.a);
    b_ = lever(contact.b);
    weight_ = cross(lever(contact.p_OCom), contact.gamma);
    straight_ = contact.n.dot(drag.e_);
    turning_a_ = contact.n.dot(perp(a_));
    turning_b_ = contact.n.dot(perp(b_));
  }

  bool sticks(std::size_t i) const {
    if (!(advance(i) - kAside >= 0.0)) return false;
    for (std::size_t k = 0; k < drag_.angles_; ++k) {
      if (!(slack_of(drag_.sample(i, k)) - kAside >= 0.0)) return false;
    }
    return true;
  }

  double slack(std::size_t i) const {
    double slack = advance(i);
    for (std::size_t k = 0; k < drag_.angles_; ++k) {
      slack = std::min(slack, slack_of(drag_.sample(i, k)));
    }
    return slack - kAside;
  }

  /// Inequalities, one bit each, that fail by so much at one angle that they fail at the
  /// next few slopes as well: all but those that fail at both may stick between two.
  unsigned hopeless(std::size_t i) const {
    unsigned failing = 0;
    const auto look_at = [&](unsigned bit, double value, double size) {
      if (value < -kHopeless * size) failing |= 1u << bit;
    };
    look_at(0, advance(i), 1.0 + std::max(std::abs(turning_a_), std::abs(turning_b_)));
    if (failing != 0) return failing;
    const Sample sample = drag_.sample(i, 0);
    const Vec2 force = sample.force - contact_.gamma;
    const double moment = sample.moment - weight_;
    const double allowed = contact_.mu * force.dot(contact_.n);
    const double along = force.dot(contact_.t);
    look_at(1, allowed - along, 1.0 + contact_.mu);
    look_at(2, allowed + along, 1.0 + contact_.mu);
    look_at(3, cross(a_, force) - moment, 1.0 + a_.norm());
    look_at(4, moment - cross(b_, force), 1.0 + b_.norm());
    return failing;
  }

  /// The kappa between two slopes at which the slack is nought.
  double border(std::size_t i) const {
    const double before = slack(i - 1);
    const double share = before / (before - slack(i));
    return std::tan(std::lerp(drag_.slopes_[i - 1].angle, drag_.slopes_[i].angle, share));
  }

 private:
  double advance(std::size_t i) const {
    const Slope& slope = drag_.slopes_[i];
    return slope.cosine * straight_ +
           std::max(slope.sine * turning_a_, slope.sine * turning_b_);
  }

  double slack_of(const Sample& sample) const {
    const Vec2 force = sample.force - contact_.gamma;
    const double moment = sample.moment - weight_;
    const double normal = force.dot(contact_.n);
    return std::min({normal, contact_.mu * normal - std::abs(force.dot(contact_.t)),
                     cross(a_, force) - moment, moment - cross(b_, force)});
  }

  DirectedDrag& drag_;
  const StickContact& contact_;
  Vec2 a_, b_;
  double weight_, straight_, turning_a_, turning_b_;
};

KappaRanges DirectedDrag::kappas(const StickContact& contact, const Vec2& p_OF) noexcept {
  const Instants instants(*this, contact, p_OF);
  const std::size_t stride = (slopes_.size() - 1) / kStretches;
  KappaRanges set;
  bool stuck = false;
  unsigned before = 0;
  unsigned after = instants.hopeless(0);
  for (std::size_t i = 0; i < slopes_.size(); ++i) {
    if (i % stride == 0) {
      before = after;
      after = i + stride < slopes_.size() ? instants.hopeless(i + stride) : 0;
    }
    const bool is_hopeless = i % stride == 0 ? before != 0 : (before & after) != 0;
    const bool sticks = !is_hopeless && instants.sticks(i);
    if (sticks && !stuck) {
      if (set.count == 2) break;
      const double lo = i > 0 ? instants.border(i) : slopes_[0].kappa;
      set.intervals[set.count++] = {lo, slopes_[i].kappa};
    } else if (sticks) {
      set.intervals[set.count - 1].hi = slopes_[i].kappa;
    } else if (stuck) {
      set.intervals[set.count - 1].hi = instants.border(i);
    }
    stuck = sticks;
  }
  return set;
}

}  // namespace prehensile
