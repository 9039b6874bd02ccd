#include "planner/checks/meet_end.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/LU>

namespace prehensile {
namespace {

constexpr double kMet = 2e-7;     // [m], angles times c
constexpr double kSteady = 8e-7;  // [m], with half the step; and of slip
constexpr int kMostSteps = 12;
constexpr double kProbe = 1e-4;   // change for a derivative, as a share of what it is of
constexpr double kLongest = 0.3;  // step, as such a share
constexpr std::array kParts = {1, 2, 4, 8};  // that a push is divided into

/// A push by a point as three numbers: turn of its direction [rad], and changes of travel
/// and place as shares of `length`.
struct Aim {
  LinearPush first;
  double length = 1.0;           ///< [m]
  double low = 0.0, high = 0.0;  ///< [m] places on the face

  std::optional<LinearPush> at(const Vec3& u) const {
    LinearPush push = first;
    push.e = rotated(u[0], first.e);
    push.travel += u[1] * length;
    push.place += u[2] * length;
    const bool sound = push.travel > 0.0 && push.place >= low && push.place <= high;
    return sound ? std::optional(push) : std::nullopt;
  }
};

class EndOfPush {
 public:
  EndOfPush(const Model& model, const TransitionOptions& options,
            const PlannedPush& planned, const Aim& aim, std::int64_t& instants)
      : model_(model),
        options_(options),
        planned_(planned),
        aim_(aim),
        instants_(instants) {}

  /// By how much the end is missed [m]; nothing where the push does not get to an end, or
  /// slips on its way.
  std::optional<Vec3> missed(const Vec3& u) const { return missed(u, options_); }

  /// Whether the end is met by steps of half the length as well: it may hang on errors of
  /// the steps where the object turns about a point that is far ahead of the pads.
  bool is_steady(const Vec3& u) const {
    TransitionOptions half = options_;
    half.max_step *= 0.5;
    const std::optional<Vec3> off = missed(u, half);
    return off && off->norm() <= kSteady;
  }

 private:
  std::optional<Vec3> missed(const Vec3& u, const TransitionOptions& options) const {
    const std::optional<LinearPush> push = aim_.at(u);
    if (!push) return std::nullopt;
    const Transition done = apply(model_, planned_.start, *push, options);
    instants_ += done.instants;
    if (!done.completed() || done.slipped > kSteady) return std::nullopt;
    const PlanarPose& end = done.end.X_HO;
    const PlanarPose& wanted = planned_.end.X_HO;
    return Vec3(end.x - wanted.x, end.y - wanted.y,
                model_.c * (end.theta - wanted.theta));
  }

  const Model& model_;
  const TransitionOptions& options_;
  const PlannedPush& planned_;
  const Aim& aim_;
  std::int64_t& instants_;
};

/// Columns: what a change of each number does to the end.
std::optional<Eigen::Matrix3d> slopes(const EndOfPush& end, const Vec3& u,
                                      const Vec3& missed) {
  Eigen::Matrix3d slope;
  for (int k = 0; k < 3; ++k) {
    std::optional<Vec3> there;
    double change = kProbe;
    for (const double sign : {1.0, -1.0}) {
      change = sign * kProbe;
      there = end.missed(u + change * Vec3::Unit(k));
      if (there) break;
    }
    if (!there) return std::nullopt;
    slope.col(k) = (*there - missed) / change;
  }
  return slope;
}

/// The numbers with which the push meets its end, if any are found.
std::optional<Vec3> aimed(const EndOfPush& end) {
  Vec3 u = Vec3::Zero();
  std::optional<Vec3> missed = end.missed(u);
  if (!missed) return std::nullopt;
  std::optional<Eigen::Matrix3d> slope = slopes(end, u, *missed);
  for (int i = 0; slope && i < kMostSteps; ++i) {
    if (missed->norm() <= kMet) return u;
    Vec3 step = -slope->fullPivLu().solve(*missed);
    if (!step.allFinite()) return std::nullopt;
    if (const double most = step.cwiseAbs().maxCoeff(); most > kLongest) {
      step *= kLongest / most;
    }
    std::optional<Vec3> there;
    while (!(there = end.missed(u + step)) || there->norm() > 2.0 * missed->norm()) {
      step *= 0.5;
      if (step.norm() < 1e-9) return std::nullopt;
    }
    *slope += (*there - *missed - *slope * step) * step.transpose() / step.squaredNorm();
    u += step;
    missed = there;
  }
  return std::nullopt;
}

/// The push, corrected so that it ends where it is planned to; false if that fails.
bool meets_end(const Model& model, const TransitionOptions& options, PlannedPush& planned,
               std::int64_t& instants) {
  auto& push = std::get<LinearPush>(planned.push);
  const PushContact& contact = model.contacts[static_cast<std::size_t>(push.contact)];
  const double half_face = 0.5 * (contact.b - contact.a).norm();
  const Aim aim{push, std::max(push.travel, model.c), -half_face, half_face};
  const EndOfPush end(model, options, planned, aim, instants);
  const std::optional<Vec3> u = aimed(end);
  if (!u || !end.is_steady(*u)) return false;
  push = *aim.at(*u);
  return true;
}

/// One of so many equal parts of the straight way of a push.
PlannedPush part_of(const PlannedPush& whole, int part, int parts) {
  LinearPush push = std::get<LinearPush>(whole.push);
  const Vec2 p_OF = finger_in_object(whole.start.X_HO);
  const auto grasp_at_share = [&](double s) {
    return Grasp{pose_from_finger(p_OF - s * push.travel * push.e,
                                  whole.start.X_HO.theta + s * push.turn),
                 whole.start.psi};
  };
  PlannedPush piece = whole;
  if (part > 0) piece.start = grasp_at_share(static_cast<double>(part) / parts);
  if (part + 1 < parts) piece.end = grasp_at_share((part + 1.0) / parts);
  push.travel /= parts;
  push.turn /= parts;
  piece.push = push;
  return piece;
}

/// Begins where the object is, which for a plan as it is done is where the push before
/// ended at half the step, and tells where it is then.
class Follower {
 public:
  Follower(const Model& model, const TransitionOptions& options, const Grasp& start,
           std::int64_t& instants)
      : model_(model), half_(options), at_(start), instants_(instants) {
    half_.max_step *= 0.5;
  }

  const Grasp& at() const { return at_; }
  void go_back(const Grasp& grasp) { at_ = grasp; }

  /// Goes on to where a push that begins there ends; to its planned end, and false, if it
  /// does not get to an end.
  bool follow(const PlannedPush& planned) {
    const Transition done = apply(model_, at_, planned.push, half_);
    instants_ += done.instants;
    at_ = done.completed() ? done.end : planned.end;
    return done.completed();
  }

 private:
  const Model& model_;
  TransitionOptions half_;
  Grasp at_;
  std::int64_t& instants_;
};

/// The push in the fewest parts that all meet their ends; as it is where none do.
void append_corrected(const Model& model, const TransitionOptions& options,
                      const PlannedPush& planned, Follower& follower,
                      std::vector<PlannedPush>& pushes, std::int64_t& instants) {
  const Grasp before = follower.at();
  for (const int parts : kParts) {
    const std::size_t count = pushes.size();
    bool all = true;
    for (int i = 0; all && i < parts; ++i) {
      pushes.push_back(part_of(planned, i, parts));
      pushes.back().start = follower.at();
      all = meets_end(model, options, pushes.back(), instants) &&
            follower.follow(pushes.back());
      pushes.back().end = follower.at();
    }
    if (all) return;
    pushes.resize(count);
    follower.go_back(before);
  }
  pushes.push_back(planned);
  follower.follow(planned);
}

}  // namespace

bool is_by_point(const Model& model, const Push& push) {
  return !std::holds_alternative<Roll>(push) &&
         model.contacts[static_cast<std::size_t>(contact_of(push))].is_point;
}

bool has_pushes_by_points(const Model& model, const Plan& plan) {
  return std::ranges::any_of(plan.pushes, [&](const PlannedPush& planned) {
    return is_by_point(model, planned.push);
  });
}

void meet_ends(const Model& model, const TransitionOptions& options, Plan& plan) {
  const auto is_aimed = [&](const PlannedPush& planned) {
    const auto* const push = std::get_if<LinearPush>(&planned.push);
    return push && push->travel > 0.0 && is_by_point(model, planned.push);
  };
  if (std::ranges::none_of(plan.pushes, is_aimed)) return;
  std::vector<PlannedPush> pushes;
  Follower follower(model, options, plan.pushes.front().start, plan.instants);
  for (const PlannedPush& planned : plan.pushes) {
    if (is_aimed(planned)) {
      append_corrected(model, options, planned, follower, pushes, plan.instants);
      continue;
    }
    pushes.push_back(planned);
    pushes.back().start = follower.at();
    follower.follow(pushes.back());
    pushes.back().end = follower.at();
  }
  if (is_aimed(plan.pushes.back())) pushes.back().end = plan.pushes.back().end;
  plan.pushes = std::move(pushes);
  plan.goal = plan.pushes.back().end;
}

}  // namespace prehensile
