#include "planner/arm/arm_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/arm/push_load.h"
#include "planner/arm/transit.h"
#include "planner/costs.h"
#include "planner/obstacles/placement.h"

namespace prehensile {
namespace {

constexpr double kPeakRate = 1.875;
const double kPeakSecondRate = 10.0 / std::sqrt(3.0);
constexpr double kTouch = 2.0;  // [N] allowed on top of what is expected

ArmPose spatial(const HandPose& hand) {
  return {{hand.X_WH.x, hand.X_WH.y, hand.z},
          Eigen::Quaterniond(Eigen::AngleAxisd(hand.X_WH.theta, Vec3::UnitZ()))};
}

/// The samples [first, end) of one phase.
struct Run {
  ArmPhase phase = ArmPhase::kTransit;
  int push = 0;
  std::size_t first = 0, end = 0;
};

class MotionWriter {
 public:
  MotionWriter(const Model& model, const Plan& plan, const ArmLimits& limits)
      : model_(model), plan_(plan), limits_(limits) {
    const ToolTransform& tool = model.scene.gripper.tool;
    p_HT_ = tool.p_HT;
    q_HT_ = Eigen::Quaterniond(tool.q_HT[3], tool.q_HT[0], tool.q_HT[1], tool.q_HT[2])
                .normalized();
  }

  ArmMotion write() {
    for (std::size_t i = 0; i < plan_.pushes.size(); ++i) {
      push_ = static_cast<int>(i);
      begin_placement();
      write_push();
      end_placement();
    }
    motion_.seconds = steps_ / limits_.rate;
    if (motion_.is_too_long) {
      motion_.samples = {};
    } else {
      set_guards();
    }
    return std::move(motion_);
  }

 private:
  const PlannedPush& planned() const {
    return plan_.pushes[static_cast<std::size_t>(push_)];
  }
  const PushContact& contact() const {
    return model_.contacts[static_cast<std::size_t>(contact_of(planned().push))];
  }
  double place() const { return as_linear(planned().push).place; }

  /// The push with this index goes on where the one before it left the pusher.
  bool continues(int index) const {
    if (index <= 0 || index >= static_cast<int>(plan_.pushes.size())) return false;
    const auto now = static_cast<std::size_t>(index);
    return same_placement(plan_.pushes[now].push, plan_.pushes[now - 1].push);
  }

  /// The hand while the object, at X_HO in it, stands off the pusher by `gap`.
  HandPose hand(const PlanarPose& X_HO, double gap) const {
    PlanarPose X_WO = object_at_pusher(model_, contact(), place());
    const Vec2 off = gap * rotated(X_WO.theta, contact().n);
    X_WO.x += off.x();
    X_WO.y += off.y();
    return {compose(X_WO, inverse(X_HO)), z_};
  }

  void begin_placement() {
    if (continues(push_)) return;
    if (push_ == 0) grip_ = grip_on_way(0);
    z_ = 0.0;
    const PlanarPose& X_HO = planned().start.X_HO;
    held_ = X_HO;
    const HandPose away = hand(X_HO, limits_.clearance);
    if (push_ > 0) write_transit(away, X_HO);
    move(ArmPhase::kApproach, limits_.clearance, 0.0, limits_.approach_speed,
         [&](double s) { return hand(X_HO, (1.0 - s) * limits_.clearance); });
  }

  /// To the next placement with the object at X_HO in the hand.
  void write_transit(const HandPose& away, const PlanarPose& X_HO) {
    HandPose to = away;
    to.X_WH.theta =
        last_.X_WH.theta + wrapped(away.X_WH.theta - last_.X_WH.theta);  // the short way
    const HeldObject held{X_HO, grip_ / model_.scene.gripper.grip_force};
    auto way = find_transit(model_, held, last_, to, plan_.seed);
    if (!way) {
      motion_.blocked_transits.push_back(push_);
      way = {last_, to};
    }
    turns_ = way->back().X_WH.theta - away.X_WH.theta;
    for (std::size_t i = 1; i < way->size(); ++i) {
      const HandPose& from = (*way)[i - 1];
      const HandPose& next = (*way)[i];
      const Vec2 step = translation(next.X_WH) - translation(from.X_WH);
      move(ArmPhase::kTransit, std::hypot(step.norm(), next.z - from.z),
           next.X_WH.theta - from.X_WH.theta, limits_.transit_speed, [&](double s) {
             HandPose pose = between(from, next, s);
             pose.X_WH.theta -= turns_;
             return pose;
           });
    }
  }

  void write_push() {
    loads_.emplace(model_, planned(), z_);
    if (const auto* roll = std::get_if<Roll>(&planned().push)) return write_roll(*roll);
    const LinearPush push = as_linear(planned().push);
    change_grip(grip_force_of(model_, planned().push), planned().start);
    const PlanarPose& X_HO = planned().start.X_HO;
    const PlanarPose X_WP = object_at_pusher(model_, contact(), push.place);
    move(ArmPhase::kPush, push.travel, push.turn, limits_.push_speed, [&](double s) {
      return HandPose{compose(X_WP, inverse(pusher_pose(push, X_HO, s))), z_};
    });
    held_ = planned().end.X_HO;
  }

  void write_roll(const Roll& roll) {
    change_grip(grip_force_of(model_, planned().push), planned().start);
    const HandPose begin = hand(planned().start.X_HO, 0.0);
    move(ArmPhase::kPush, std::abs(roll.travel), 0.0, limits_.push_speed, [&](double s) {
      return HandPose{begin.X_WH, begin.z - s * roll.travel};
    });
    z_ -= roll.travel;
    held_ = planned().end.X_HO;
    change_grip(grip_on_way(push_ + 1), planned().end);
  }

  void end_placement() {
    if (continues(push_ + 1)) return;
    change_grip(grip_on_way(push_ + 1), planned().end);
    const PlanarPose& X_HO = planned().end.X_HO;
    move(ArmPhase::kRetreat, limits_.clearance, 0.0, limits_.approach_speed,
         [&](double s) { return hand(X_HO, s * limits_.clearance); });
    last_ = hand(X_HO, limits_.clearance);
    last_.X_WH.theta += turns_;
  }

  double grip_on_way(int push) const {
    return grip_force_on_way(model_, plan_.pushes, static_cast<std::size_t>(push));
  }

  /// While the hand stands still at the pusher.
  void change_grip(double to, const Grasp& grasp) {
    const double from = grip_;
    if (from == to) return;
    const HandPose still = hand(grasp.X_HO, 0.0);
    run(ArmPhase::kGrip, limits_.grip_seconds, [&](double s) {
      grip_ = std::lerp(from, to, s);
      return HandPose{still.X_WH, z_};
    });
    grip_ = to;
  }

  /// A motion of this length and turn within the limits, its rates in proportion: the
  /// tool goes along with the hand, and on a circle about it.
  template <typename Path>
  void move(ArmPhase phase, double length, double turn, double speed, const Path& path) {
    const double lever = p_HT_.head<2>().norm();
    const double way = std::abs(length) + lever * std::abs(turn);
    const double angle = std::abs(turn);
    const double round =
        std::hypot(kPeakSecondRate * angle, kPeakRate * kPeakRate * angle * angle);
    const double second = kPeakSecondRate * std::abs(length) + lever * round;
    run(phase,
        std::max({kPeakRate * way / speed, kPeakRate * angle / limits_.turn_speed,
                  std::sqrt(second / limits_.acceleration),
                  std::sqrt(kPeakSecondRate * angle / limits_.turn_acceleration)}),
        path);
  }

  template <typename Path>
  void run(ArmPhase phase, double seconds, const Path& path) {
    const double steps = std::max(1.0, std::ceil(seconds * limits_.rate));
    const std::size_t first = motion_.samples.size();
    motion_.is_too_long |= static_cast<double>(first) + steps + 1.0 >
                           static_cast<double>(limits_.most_samples);
    if (motion_.is_too_long) {
      path(1.0);  // for what it leaves behind
      steps_ += steps;
      return;
    }
    for (int i = 0; i <= steps; ++i) {
      // The first sample of a phase repeats the last of the one before, under its name.
      const double share = i / steps;
      const double s = rest_to_rest(share);
      const HandPose pose = path(s);
      add(phase, (steps_ + i) / limits_.rate, s, pose);
    }
    steps_ += steps;
    runs_.push_back({phase, push_, first, motion_.samples.size()});
  }

  void add(ArmPhase phase, double t, double s, HandPose pose) {
    pose.X_WH.theta += turns_;
    ArmSample sample{.t = t, .phase = phase, .push = push_};
    sample.X_WH = spatial(pose);
    sample.X_WT = {sample.X_WH.position + sample.X_WH.orientation * p_HT_,
                   sample.X_WH.orientation * q_HT_};
    sample.grip_force = grip_;
    set_load(phase == ArmPhase::kPush ? loads_->at(s) : load_at_rest(model_, held_),
             sample);
    motion_.samples.push_back(sample);
  }

  /// Push and weight, moved to the tool.
  void set_load(const HeldLoad& load, ArmSample& sample) const {
    const Vec3 weight(model_.mass * model_.scene.g_W.x(),
                      model_.mass * model_.scene.g_W.y(),
                      model_.mass * model_.scene.g_Wz);
    const Vec3 pushed = sample.X_WH.orientation * load.f_H;
    const auto from_tool = [&](const Vec3& p_H) {
      return Vec3(sample.X_WH.position + sample.X_WH.orientation * p_H -
                  sample.X_WT.position);
    };
    const Vec3 moment =
        from_tool(load.p_HCom).cross(weight) + from_tool(load.p_HP).cross(pushed);
    sample.force = sample.X_WT.orientation.conjugate() * (weight + pushed);
    sample.moment = sample.X_WT.orientation.conjugate() * moment;
  }

  /// Greatest expected force of these samples.
  double most_of(const Run& run) const {
    double most = 0.0;
    for (std::size_t i = run.first; i < run.end; ++i) {
      most = std::max(most, motion_.samples[i].force.norm());
    }
    return most;
  }

  /// Every phase at a pusher bears the pushes next to it: a touch that comes early takes
  /// the whole of the push to come, and what a push has built up stays until the hand
  /// has left, or until the next push at this place has built up its own.
  void set_guards() {
    std::vector<double> of_push(plan_.pushes.size(), 0.0);
    for (const Run& run : runs_) {
      if (run.phase != ArmPhase::kPush) continue;
      of_push[static_cast<std::size_t>(run.push)] = most_of(run);
    }
    const auto push = [&](int index) { return of_push[static_cast<std::size_t>(index)]; };
    for (const Run& run : runs_) {
      double most = most_of(run);
      if (run.phase != ArmPhase::kTransit) most = std::max(most, push(run.push));
      if (run.phase == ArmPhase::kPush || run.phase == ArmPhase::kGrip) {
        if (continues(run.push)) most = std::max(most, push(run.push - 1));
        if (continues(run.push + 1)) most = std::max(most, push(run.push + 1));
      }
      for (std::size_t i = run.first; i < run.end; ++i) {
        motion_.samples[i].guard_force = limits_.guard_factor * most + kTouch;
      }
    }
  }

  const Model& model_;
  const Plan& plan_;
  const ArmLimits& limits_;
  Vec3 p_HT_;
  Eigen::Quaterniond q_HT_;
  ArmMotion motion_;
  std::vector<Run> runs_;
  PlanarPose held_;                 // X_HO between pushes
  std::optional<PushLoads> loads_;  // of the push that is written
  int push_ = 0;
  double steps_ = 0.0;  // whole ones of 1 / rate since the motion began
  double grip_ = 0.0;
  double z_ = 0.0;      // of the hand, which rolls leave off the mid-plane
  double turns_ = 0.0;  // whole turns that keep the angle of the hand continuous
  HandPose last_;
};

}  // namespace

std::string_view name(ArmPhase phase) {
  switch (phase) {
    case ArmPhase::kTransit:
      return "transit";
    case ArmPhase::kApproach:
      return "approach";
    case ArmPhase::kGrip:
      return "grip";
    case ArmPhase::kPush:
      return "push";
    case ArmPhase::kRetreat:
      return "retreat";
  }
  return "unknown";
}

double rest_to_rest(double u) noexcept {
  return u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
}

PlanarPose pusher_in_world(const Model& model, const PushContact& contact, double place) {
  const Vec2 touched = 0.5 * (contact.a + contact.b) + place * contact.t;
  const Vec2 p = model.scene.pushers[static_cast<std::size_t>(contact.pusher)].p_WP -
                 rotated(contact.theta_WO, touched);
  return {p.x(), p.y(), contact.theta_WO};
}

ArmMotion arm_motion(const Model& model, const Plan& plan, const ArmLimits& limits) {
  return MotionWriter(model, plan, limits).write();
}

PushFromPoses push_from_poses(const std::vector<ArmPose>& X_WH, const PlanarPose& X_HO,
                              const LinearPush& push) {
  PushFromPoses found{push};
  if (X_WH.empty()) return found;
  std::vector<Vec2> path;     // of the finger axis in P
  std::vector<double> turns;  // of P in the hand, summed up over the samples
  const auto angle = [](const ArmPose& pose) {
    return 2.0 * std::atan2(pose.orientation.z(), pose.orientation.w());
  };
  const auto planar = [&](const ArmPose& pose) {
    return PlanarPose{pose.position.x(), pose.position.y(), angle(pose)};
  };
  const PlanarPose X_WP = compose(planar(X_WH.front()), X_HO);
  double turn = 0.0;
  for (std::size_t i = 0; i < X_WH.size(); ++i) {
    if (i > 0) turn -= wrapped(angle(X_WH[i]) - angle(X_WH[i - 1]));
    path.push_back(translation(compose(inverse(X_WP), planar(X_WH[i]))));
    turns.push_back(turn);
  }
  const Vec2 way = path.back() - path.front();
  found.push.travel = way.norm();
  found.push.turn = turn;
  if (found.push.travel > 0.0) found.push.e = -way / found.push.travel;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec2 done = path[i] - path.front();
    const double along = -found.push.e.dot(done);
    found.stray = std::max(found.stray, (done + along * found.push.e).norm());
    if (found.push.travel <= 0.0) continue;
    const double expected = turn * along / found.push.travel;
    found.stray_angle = std::max(found.stray_angle, std::abs(turns[i] - expected));
  }
  return found;
}

}  // namespace prehensile
