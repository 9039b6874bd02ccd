#include "planner/walks/place_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// The slopes of the others are looked at so many at once first.
constexpr std::size_t kInBlock = 4;
static_assert((kSlopesOfWhole - 1) % (kStretches * kInBlock) == 0);
static_assert((kSlopesOfClipped - 1) % (kStretches * kInBlock) == 0);
static_assert((kMoreSlopesOfClipped - 1) % (kStretches * kInBlock) == 0);

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
      samples_(slopes_.size() * angles_),
      boxes_(2 * (slopes_.size() / kInBlock + 1)) {}

DirectedDrag::DirectedDrag(DirectedDrag* other)
    : model_(other->model_),
      pads_(other->pads_),
      e_(-other->e_),
      slopes_(other->slopes_),
      angles_(other->angles_),
      boxes_(other->boxes_.size()),
      opposite_(other) {}

DirectedDrag DirectedDrag::opposite() { return DirectedDrag(this); }

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

const DirectedDrag::WrenchBox& DirectedDrag::box(std::size_t block, Angles of) noexcept {
  WrenchBox& box = boxes_[2 * block + (of == Angles::kAll ? 1 : 0)];
  if (box.known) return box;
  const std::size_t begin = block * kInBlock;
  const std::size_t end = std::min(begin + kInBlock, slopes_.size());
  const std::size_t angles = of == Angles::kAll ? angles_ : 1;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (std::size_t i = begin; i < end; ++i) {
    for (std::size_t k = 0; k < angles; ++k) {
      const Sample next = sample(i, k);
      const Vec3 wrench(next.force.x(), next.force.y(), next.moment);
      low = low.cwiseMin(wrench);
      high = high.cwiseMax(wrench);
    }
  }
  box = {0.5 * (low + high), 0.5 * (high - low), true};
  return box;
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
    const auto hopeless = [](double size) { return -kHopeless * (1.0 + size); };
    hopeless_advance_ = hopeless(std::max(std::abs(turning_a_), std::abs(turning_b_)));
    hopeless_friction_ = hopeless(contact.mu);
    hopeless_a_ = hopeless(a_.norm());
    hopeless_b_ = hopeless(b_.norm());
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
    const auto look_at = [&](unsigned bit, double value, double hopeless) {
      if (value < hopeless) failing |= 1u << bit;
    };
    look_at(0, advance(i), hopeless_advance_);
    if (failing != 0) return failing;
    const Sample sample = drag_.sample(i, 0);
    const Vec2 force = sample.force - contact_.gamma;
    const double moment = sample.moment - weight_;
    const double allowed = contact_.mu * force.dot(contact_.n);
    const double along = force.dot(contact_.t);
    look_at(1, allowed - along, hopeless_friction_);
    look_at(2, allowed + along, hopeless_friction_);
    look_at(3, cross(a_, force) - moment, hopeless_a_);
    look_at(4, moment - cross(b_, force), hopeless_b_);
    return failing;
  }

  /// Whether it sticks at none of the slopes of the block that begins at `i`, or at all:
  /// true only where the box of their wrenches decides.
  bool fails_all_from(std::size_t i) const {
    bool advances = false;
    for (std::size_t k = i; k < end_of_block(i) && !advances; ++k) {
      advances = advance(k) >= kAside;
    }
    return !advances || least_over(drag_.box(i / kInBlock, Angles::kFirst), 1.0) < kAside;
  }
  bool sticks_all_from(std::size_t i) const {
    for (std::size_t k = i; k < end_of_block(i); ++k) {
      if (advance(k) < kAside) return false;
    }
    return least_over(drag_.box(i / kInBlock, Angles::kAll), -1.0) >= kAside;
  }

  std::size_t end_of_block(std::size_t i) const {
    return std::min(i + kInBlock, drag_.slopes_.size());
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

  /// Of the inequalities, each where a box has most of it (side 1) or least (side -1).
  double least_over(const WrenchBox& box, double side) const {
    const Vec2 force = box.middle.head<2>() - contact_.gamma;
    const double moment = box.middle.z() - weight_;
    const auto extreme = [&](const Vec2& of_force, double of_moment) {
      return of_force.dot(force) + of_moment * moment +
             side * (of_force.cwiseAbs().dot(box.half.head<2>()) +
                     std::abs(of_moment) * box.half.z());
    };
    const Vec2 normal = contact_.mu * contact_.n;
    return std::min({extreme(contact_.n, 0.0), extreme(normal - contact_.t, 0.0),
                     extreme(normal + contact_.t, 0.0), extreme(perp(a_), -1.0),
                     extreme(-perp(b_), 1.0)});
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
  double hopeless_advance_, hopeless_friction_, hopeless_a_, hopeless_b_;
};

bool DirectedDrag::is_in_cone(const StickContact& contact) noexcept {
  for (std::size_t i = 0; i < slopes_.size(); ++i) {
    const Vec2 force = sample(i, 0).force - contact.gamma;
    const double normal = force.dot(contact.n);
    const double aside = contact.mu * normal - std::abs(force.dot(contact.t));
    if (std::min(normal, aside) >= kAside) return true;
  }
  return false;
}

KappaRanges DirectedDrag::kappas(const StickContact& contact, const Vec2& p_OF) noexcept {
  const Instants instants(*this, contact, p_OF);
  const std::size_t stride = (slopes_.size() - 1) / kStretches;
  KappaRanges set;
  bool stuck = false;
  const auto fail_at = [&](std::size_t i) {
    if (stuck) set.intervals[set.count - 1].hi = instants.border(i);
    stuck = false;
  };
  unsigned after = instants.hopeless(0);
  for (std::size_t begin = 0; begin < slopes_.size(); begin += stride) {
    const std::size_t end = std::min(begin + stride, slopes_.size());
    const unsigned before = after;
    after = end < slopes_.size() ? instants.hopeless(end) : 0;
    if ((before & after) != 0) {
      fail_at(begin);
      continue;
    }
    for (std::size_t i = begin; i < end; ++i) {
      if (i % kInBlock == 0 && instants.fails_all_from(i)) {
        fail_at(i);
        i += kInBlock - 1;
        continue;
      }
      if ((i == begin && before != 0) || !instants.sticks(i)) {
        fail_at(i);
        continue;
      }
      if (!stuck) {
        if (set.count == 2) return set;
        const double lo = i > 0 ? instants.border(i) : slopes_[0].kappa;
        set.intervals[set.count++] = {lo, slopes_[i].kappa};
      }
      stuck = true;
      if (i % kInBlock == 0 && instants.sticks_all_from(i)) {
        i = instants.end_of_block(i) - 1;
      }
      set.intervals[set.count - 1].hi = slopes_[i].kappa;
    }
  }
  return set;
}

}  // namespace prehensile
