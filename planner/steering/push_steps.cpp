#include "planner/steering/push_steps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/steering/chain.h"
#include "planner/steering/confines.h"
#include "planner/steering/goal.h"
#include "planner/steering/holding.h"
#include "planner/steering/roll_step.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// Steered moves keep this share of the feasible slopes away from both edges, so that
/// rounding cannot turn a step that was found into one that is refused.
constexpr double kEdge = 1e-9;

/// The feasible slopes phi = atan(kappa) of a contact and direction, laid end to end.
/// Slopes are bounded where kappa is not: +-pi/2 is a pure turn.
class Slopes {
 public:
  explicit Slopes(const KappaSet& kappas) : count_(kappas.count) {
    for (int i = 0; i < count_; ++i) {
      low_[i] = std::atan(kappas.intervals[i].lo);
      high_[i] = std::atan(kappas.intervals[i].hi);
      total_ += high_[i] - low_[i];
    }
  }

  bool empty() const { return count_ == 0; }

  double at(double share) const {
    double left = std::clamp(share, kEdge, 1.0 - kEdge) * total_;
    for (int i = 0; i + 1 < count_; ++i) {
      if (left <= high_[i] - low_[i]) return low_[i] + left;
      left -= high_[i] - low_[i];
    }
    return low_[count_ - 1] + left;
  }

  double share_of(double slope) const {
    double below = 0.0;
    for (int i = 0; i < count_; ++i) {
      below += std::clamp(slope, low_[i], high_[i]) - low_[i];
    }
    return total_ > 0.0 ? below / total_ : 0.5;
  }

  double clipped(double slope) const {
    double best = low_[0];
    for (int i = 0; i < count_; ++i) {
      const double inset = kEdge * (high_[i] - low_[i]);
      const double candidate = std::clamp(slope, low_[i] + inset, high_[i] - inset);
      if (i == 0 || std::abs(candidate - slope) < std::abs(best - slope)) {
        best = candidate;
      }
    }
    return best;
  }

 private:
  int count_;
  std::array<double, std::tuple_size_v<decltype(KappaSet::intervals)>> low_{}, high_{};
  double total_ = 0.0;
};

Slopes slopes_of(const SearchModel& search, int contact, const Vec2& p_OF,
                 const Vec2& e) {
  return Slopes(
      robust_kappas(search.contacts[contact].stick, p_OF, e, search.margin_from(p_OF)));
}

bool equal(const FlatState& a, const FlatState& b) {
  return a.p_OF == b.p_OF && a.theta == b.theta;
}

}  // namespace

PushState state_of(const Grasp& grasp) { return {flat_state(grasp), grasp.psi}; }

Grasp grasp_of(const PushState& state) { return grasp_of(state.flat, state.psi); }

Grasp member_near(const Goal& goal, const Grasp& grasp) {
  Grasp member = grasp;
  member.X_HO.x = goal.x.value_or(grasp.X_HO.x);
  member.X_HO.y = goal.y.value_or(grasp.X_HO.y);
  member.X_HO.theta = nearest_angle(goal, grasp.X_HO.theta);
  member.psi += roll_needed(goal, grasp.psi);
  return member;
}

FlatBox box_around(const Model& model, const Grasp& start, const Goal& goal) {
  const double theta = member_near(goal, start).X_HO.theta;
  FlatBox box{{model.pad_face.front(), std::min(start.X_HO.theta, theta) - kPi},
              {model.pad_face.front(), std::max(start.X_HO.theta, theta) + kPi}};
  for (const Vec2& corner : model.pad_face) {
    box.low.p_OF = box.low.p_OF.cwiseMin(corner);
    box.high.p_OF = box.high.p_OF.cwiseMax(corner);
  }
  const GraspLimits limits = model.scene.limits.value_or(GraspLimits{});
  const TurnWindow window = theta_window(model.scene);
  box.low.theta = std::max(box.low.theta, window.low);
  box.high.theta = std::min(box.high.theta, window.high);
  if (limits.finger_low) box.low.p_OF = box.low.p_OF.cwiseMax(*limits.finger_low);
  if (limits.finger_high) box.high.p_OF = box.high.p_OF.cwiseMin(*limits.finger_high);
  return box;
}

/// A motion of unit length in (p_OF, c theta) that sticks at its beginning.
struct PushSteps::Projection {
  int contact = -1;
  double heading = 0.0;
  double slope = 0.0;
  double cosine = -2.0;  ///< of the angle to the wanted motion
};

PushSteps::PushSteps(const SearchModel& search, const Goal& goal, Work& work,
                     ControlMeaning meaning)
    : search_(search), goal_(goal), work_(work), meaning_(meaning) {
  theta_scale_ = model().c > 0.0 ? model().c : 0.1 * model().L;
  if (model().roll_radius > 0.0) psi_scale_ = model().roll_radius;
}

bool PushSteps::is_valid(const PushState& state) const noexcept {
  ++states_seen_;
  const Vec2& p_OF = state.flat.p_OF;
  if (!p_OF.allFinite() || !std::isfinite(state.flat.theta) ||
      !std::isfinite(state.psi)) {
    return false;
  }
  if (!limits_admit(model().scene, state.flat)) return false;
  if (!pads_on_object(model(), pose_from_finger(p_OF, state.flat.theta))) return false;
  if (model().contacts.empty()) return true;
  return std::ranges::any_of(model().contacts, [&](const PushContact& contact) {
    return holding_slack(model(), p_OF, contact.g_O, search_.margin) >= 0.0;
  });
}

std::optional<PushStep> PushSteps::join(const PushState& from, const PushState& to,
                                        int preferred) {
  if (!counted()) return {};
  return joined(from, to, preferred);
}

std::optional<PushStep> PushSteps::approach(const PushState& from, const PushState& to,
                                            int contact) {
  if (!counted()) return {};
  const Vec2 dp = to.flat.p_OF - from.flat.p_OF;
  const double length = dp.norm();
  if (!(length > 0.0)) return {};
  const Slopes slopes = slopes_of(search_, contact, from.flat.p_OF, -dp / length);
  if (slopes.empty()) return {};

  const double turn = theta_scale_ * (to.flat.theta - from.flat.theta);
  const double slope = slopes.clipped(std::atan2(turn, length));
  PushState end = to;
  end.flat.theta = from.flat.theta + length * std::tan(slope) / theta_scale_;
  PushStep step{.to = representable(end), .move_contact = contact};
  if (end.psi != from.psi) {
    step.roll = roll_to(from, step.to.psi);
    if (!step.roll) step.to.psi = from.psi;
  }
  if (!move_works(contact, from.flat, step.to.flat)) return {};
  return step;
}

std::optional<PushStep> PushSteps::closest(const PushState& from, const PushState& to) {
  std::optional<PushStep> best;
  double least = std::numeric_limits<double>::infinity();
  for (int contact = 0; contact < finish_letter(); ++contact) {
    const std::optional<PushStep> step = approach(from, to, contact);
    if (!step) continue;
    const double turn = std::abs(step->to.flat.theta - to.flat.theta);
    if (turn < least) {
      least = turn;
      best = step;
    }
  }
  return best;
}

std::optional<PushStep> PushSteps::extend(const PushState& from, const PushState& to,
                                          double longest) {
  if (!counted()) return {};
  const Vec2 dp = to.flat.p_OF - from.flat.p_OF;
  const Vec3 way(dp.x(), dp.y(), theta_scale_ * (to.flat.theta - from.flat.theta));
  const double length = way.norm();
  if (!(length > 0.0)) return {};
  const double travel = std::min(length, longest);
  PushState end = to;
  if (travel < length) {
    end.flat.p_OF = from.flat.p_OF + travel / length * dp;
    end.flat.theta += (travel / length - 1.0) * (to.flat.theta - from.flat.theta);
  }
  end.psi = from.psi;
  if (auto straight = joined(from, representable(end), -1)) return straight;

  const Projection next = projected(from.flat.p_OF, way / length);
  if (next.contact < 0 || next.cosine <= 0.0 || !counted()) return {};
  const Vec2 e(std::cos(next.heading), std::sin(next.heading));
  end.flat.p_OF = from.flat.p_OF - travel * std::cos(next.slope) * e;
  end.flat.theta = from.flat.theta + travel * std::sin(next.slope) / theta_scale_;
  const PushStep step{.to = representable(end), .move_contact = next.contact};
  if (!move_works(next.contact, from.flat, step.to.flat)) return {};
  return step;
}

/// For one heading the nearest slope is known in closed form; over the headings the
/// cosine has one top within the cone of a contact, found among some of them and then by
/// golden sections.
PushSteps::Projection PushSteps::projected(const Vec2& p_OF, const Vec3& wanted) const {
  constexpr int kHeadings = 24;  // around
  constexpr int kSections = 12;
  constexpr double kGolden = 0.6180339887498949;
  constexpr double kSpacing = 2.0 * std::numbers::pi / kHeadings;
  const auto at = [&](int contact, double heading) {
    const Vec2 e(std::cos(heading), std::sin(heading));
    const Slopes slopes = slopes_of(search_, contact, p_OF, e);
    Projection motion{.contact = contact, .heading = heading};
    if (slopes.empty()) return motion;
    const double along = -wanted.head<2>().dot(e);
    motion.slope = slopes.clipped(std::atan2(wanted.z(), along));
    motion.cosine = along * std::cos(motion.slope) + wanted.z() * std::sin(motion.slope);
    return motion;
  };
  Projection best;
  for (int contact = 0; contact < finish_letter(); ++contact) {
    const StickContact& stick = search_.contacts[contact].stick;
    const double middle = std::atan2(stick.n.y(), stick.n.x());
    Projection top;
    for (int i = 0; i < kHeadings; ++i) {
      const Projection motion = at(contact, middle + i * kSpacing);
      if (motion.cosine > top.cosine) top = motion;
    }
    if (top.contact < 0) continue;
    double low = top.heading - kSpacing;
    double high = top.heading + kSpacing;
    for (int i = 0; i < kSections; ++i) {
      const Projection left = at(contact, high - kGolden * (high - low));
      const Projection right = at(contact, low + kGolden * (high - low));
      const bool is_left = left.cosine > right.cosine ||
                           (left.cosine == right.cosine && right.heading > top.heading);
      (is_left ? high : low) = is_left ? right.heading : left.heading;
      for (const Projection& motion : {left, right}) {
        if (motion.cosine > top.cosine) top = motion;
      }
    }
    if (top.cosine > best.cosine) best = top;
  }
  return best;
}

std::optional<PushStep> PushSteps::aimed(const PushState& from,
                                         const PushControl& control) {
  const PushState to{{{control.heading, control.share}, control.travel / theta_scale_},
                     from.psi + control.roll};
  std::optional<PushStep> step = joined(from, representable(to), -1);
  if (!step) step = closest(from, to);
  return step && step->does_something() ? step : std::nullopt;
}

std::optional<PushStep> PushSteps::follow(const PushState& from,
                                          const PushControl& control) {
  if (!counted()) return {};
  if (control.letter == aim_letter()) return aimed(from, control);
  if (control.letter == finish_letter()) {
    const PushState goal = state_of(member_near(goal_, grasp_of(from)));
    const std::optional<PushStep> step = joined(from, representable(goal), -1);
    return step && step->does_something() ? step : std::nullopt;
  }
  PushStep step{.to = from};
  if (control.roll != 0.0) {
    step.to.psi += control.roll;
    step.to = representable(step.to);
    step.roll = roll_to(from, step.to.psi);
    if (!step.roll) return {};
  }
  if (control.travel == 0.0) {
    return step.roll ? std::optional(step) : std::nullopt;
  }
  const Vec2 e(std::cos(control.heading), std::sin(control.heading));
  double slope = std::numbers::pi * (control.share - 0.5);
  if (meaning_ == ControlMeaning::kSteered) {
    const Slopes slopes = slopes_of(search_, control.letter, from.flat.p_OF, e);
    if (slopes.empty()) return {};
    slope = slopes.at(control.share);
  }
  step.to.flat.p_OF -= control.travel * std::cos(slope) * e;
  step.to.flat.theta += control.travel * std::sin(slope) / theta_scale_;
  step.to = representable(step.to);
  step.move_contact = control.letter;
  if (!move_works(control.letter, from.flat, step.to.flat)) return {};
  return step;
}

std::optional<PushState> PushSteps::end_of(const PushState& from,
                                           const PushControl& control) const {
  const Vec2 e(std::cos(control.heading), std::sin(control.heading));
  const Slopes slopes = slopes_of(search_, control.letter, from.flat.p_OF, e);
  if (slopes.empty()) return {};
  const double slope = slopes.at(control.share);
  PushState end = from;
  end.flat.p_OF -= control.travel * std::cos(slope) * e;
  end.flat.theta += control.travel * std::sin(slope) / theta_scale_;
  return representable(end);
}

bool PushSteps::works(int contact, const PushState& from, const PushState& to) {
  return counted() && move_works(contact, from.flat, to.flat);
}

PushControl PushSteps::control_for(const PushState& from, const PushStep& step) const {
  PushControl control{.roll = step.to.psi - from.psi};
  if (step.move_contact < 0) return control;
  const Vec2 dp = step.to.flat.p_OF - from.flat.p_OF;
  const double turn = theta_scale_ * (step.to.flat.theta - from.flat.theta);
  control.letter = step.move_contact;
  control.heading = std::atan2(-dp.y(), -dp.x());
  control.travel = std::hypot(dp.norm(), turn);
  const Vec2 e(std::cos(control.heading), std::sin(control.heading));
  if (meaning_ == ControlMeaning::kBlind) {
    control.share = 0.5 + std::atan2(turn, dp.norm()) / std::numbers::pi;
    return control;
  }
  control.share = slopes_of(search_, step.move_contact, from.flat.p_OF, e)
                      .share_of(std::atan2(turn, dp.norm()));
  return control;
}

bool PushSteps::may_stick(const PushState& from,
                          const PushControl& control) const noexcept {
  if (control.letter >= finish_letter() || control.travel == 0.0) return true;
  const Vec2 e(std::cos(control.heading), std::sin(control.heading));
  return !slopes_of(search_, control.letter, from.flat.p_OF, e).empty();
}

/// Looks for collisions cost far more than a propagation without them.
bool PushSteps::counted() noexcept {
  work_.other += std::exchange(stick_tests_.other, 0);
  if (work_.spent()) return false;
  ++work_.propagations;
  return true;
}

std::optional<PushStep> PushSteps::joined(const PushState& from, const PushState& to,
                                          int preferred) {
  PushStep step{.to = to};
  if (!equal(from.flat, to.flat)) {
    step.move_contact = contact_that_moves(from.flat, to.flat, preferred);
    if (step.move_contact < 0) return {};
  }
  if (to.psi != from.psi) {
    step.roll = roll_to(from, to.psi);
    if (!step.roll) {
      step.roll = roll_to({to.flat, from.psi}, to.psi);
      step.roll_first = false;
    }
    if (!step.roll) return {};
  }
  return step;
}

bool PushSteps::move_works(int contact, const FlatState& from,
                           const FlatState& to) noexcept {
  const Move move{contact, from, to};
  return move_sticks(search_, contact, from, to, stick_tests_) &&
         exact_slack(search_, move, stick_tests_) >= -kStickTolerance &&
         pads_hold_gravity(search_, move, stick_tests_) &&
         is_confined(search_, move, stick_tests_);
}

int PushSteps::contact_that_moves(const FlatState& from, const FlatState& to,
                                  int preferred) noexcept {
  if (preferred >= 0 && move_works(preferred, from, to)) return preferred;
  for (int contact = 0; contact < finish_letter(); ++contact) {
    if (contact != preferred && move_works(contact, from, to)) return contact;
  }
  return -1;
}

std::optional<Roll> PushSteps::roll_to(const PushState& from, double psi) const {
  Plan plan;
  plan.start = grasp_of(from);
  if (!insert_roll(model(), psi - from.psi, search_.margin, {}, plan)) return {};
  return std::get<Roll>(plan.pushes.front().push);
}

PushState PushSteps::representable(const PushState& state) const {
  return {{state.flat.p_OF, state.flat.theta * theta_scale_ / theta_scale_},
          state.psi * psi_scale_ / psi_scale_};
}

}  // namespace prehensile
