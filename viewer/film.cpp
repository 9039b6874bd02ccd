#include "viewer/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/checks/exact_check.h"

namespace prehensile::viewer {
namespace {

constexpr double kRides = 1e-9;  // [m] and [rad] that a riding object strays in P

constexpr double kSheet = 1.3;  // of a sheet's width over what is rolled on

/// The part of a push that was done.
Push done_part(const Push& push, double done) {
  if (const auto* roll = std::get_if<Roll>(&push)) {
    Roll part = *roll;
    part.travel *= done;
    return part;
  }
  LinearPush part = as_linear(push);
  part.travel *= done;
  part.turn *= done;
  part.bend *= done;
  return part;
}

/// A plan names its pushes by their motions, a push alone is what was asked for.
std::string kind_of(const Push& push, bool is_plan) {
  if (std::holds_alternative<Roll>(push)) return "roll";
  const LinearPush linear = as_linear(push);
  if (is_plan) return kind_name(linear.travel, linear.turn, 0.0);
  if (std::holds_alternative<Slide>(push)) return "slide";
  return std::holds_alternative<Pivot>(push) ? "pivot" : "push";
}

/// The object moves with the pusher as one body, held by all points that could.
bool rides(const PushContact& contact, const FilmFrame& frame) {
  const PlanarPose X_PO = compose(inverse(frame.X_HP), frame.grasp.X_HO);
  const std::vector<PointLoad>& loads = frame.loads.pusher;
  const std::size_t least = contact.is_point ? 1 : 2;
  return std::hypot(X_PO.x, X_PO.y) < kRides && std::abs(X_PO.theta) < kRides &&
         loads.size() >= least &&
         std::all_of(loads.begin(), loads.end(), [](const PointLoad& load) {
           return load.mode == ContactMode::kStick;
         });
}

/// Slack and motion cone, where the object rides on the pusher.
void add_margins(const Model& model, const LinearPush& push, const Margin& margin,
                 FilmFrame& frame) {
  const PushContact& contact = model.contacts[static_cast<std::size_t>(push.contact)];
  if (!rides(contact, frame)) return;
  const Vec2 e = rotated(frame.s * push.bend, push.e);
  const auto slack = [&](const Margin& box) {
    return exact_stick_test(model, contact, push.place, frame.grasp.X_HO, e, push.travel,
                            push.turn, box, frame.s * push.travel)
        .slack;
  };
  frame.slack = slack(Margin::none());
  frame.robust_slack = slack(margin);
  if (push.travel <= 0.0) return;
  // The cone of a line is one of directions at the finger axis, that of a point one of
  // directions of the point.
  Vec2 way = e;
  if (contact.is_point) {
    const Vec2 arm = 0.5 * (contact.a + contact.b) + push.place * contact.t -
                     finger_in_object(frame.grasp.X_HO);
    way = push.travel * e + push.turn * perp(arm);
  }
  frame.direction = std::atan2(contact.t.dot(way), contact.n.dot(way));
  const ConeMember member =
      cone_member(model, push.contact, push.place, frame.grasp.X_HO);
  const double rate = push.turn / push.travel;
  frame.cone =
      ranges_where([&](double direction) { return sticks(member, direction, rate); });
}

FilmFrame frame_at(const Model& model, const FilmPush& filmed, const Margin& margin,
                   const Sample& sample) {
  FilmFrame frame{.s = sample.s, .grasp = sample.grasp, .sample = sample};
  frame.loads =
      loads_at(model, filmed.start, filmed.push, sample, filmed.transition.in_space);
  frame.z_HO = frame.loads.z_HO;
  frame.jaw_z = frame.loads.jaw_z;
  if (const auto* roll = std::get_if<Roll>(&filmed.push)) {
    frame.X_HP = filmed.start.X_HO;
    frame.z_HP = sample.s * roll->travel;
    return frame;
  }
  const LinearPush push = as_linear(filmed.push);
  frame.X_HP = pusher_pose(push, filmed.start.X_HO, sample.s);
  add_margins(model, push, margin, frame);
  return frame;
}

/// At most `most` samples, the first and the last among them.
std::vector<Sample> thinned(const std::vector<Sample>& trace, std::size_t most) {
  if (trace.size() <= most) return trace;
  std::vector<Sample> kept;
  kept.reserve(most);
  for (std::size_t i = 0; i < most; ++i) {
    kept.push_back(trace[i * (trace.size() - 1) / (most - 1)]);
  }
  return kept;
}

FilmPush film_push(const Model& model, const Grasp& start, const Push& push,
                   const Margin& margin, int frames, const FilmOptions& options) {
  FilmPush filmed{.push = push, .start = start, .kind = kind_of(push, options.is_plan)};
  filmed.contact = contact_of(push);
  const PushContact& contact = model.contacts[static_cast<std::size_t>(filmed.contact)];
  const double place = std::holds_alternative<Roll>(push) ? 0.0 : as_linear(push).place;
  filmed.p_PC = 0.5 * (contact.a + contact.b) + place * contact.t;
  TransitionOptions dense = options.transition;
  dense.max_step = std::min(dense.max_step, 2.0 / frames);
  std::vector<Sample> trace;
  filmed.transition = apply(model, start, push, dense, &trace);
  if (trace.empty()) trace.push_back({.s = 0.0, .grasp = start});
  const auto most = static_cast<std::size_t>(frames);
  for (const Sample& sample : thinned(trace, most)) {
    filmed.frames.push_back(frame_at(model, filmed, margin, sample));
  }
  return filmed;
}

PlanarPose planar(const ArmPose& pose) {
  return {pose.position.x(), pose.position.y(),
          2.0 * std::atan2(pose.orientation.z(), pose.orientation.w())};
}

/// A retreat takes the same way, but from where the push has left the hand: the robot's
/// motion is that of plans, whose objects end flush with their pushers.
void retreat_from(const Film& film, FilmPhase& pushed, FilmPhase& retreat) {
  if (pushed.kind != ArmPhase::kPush) return;
  const FilmPush& push = film.pushes[static_cast<std::size_t>(pushed.push)];
  const PlanarPose X_WP = compose(pushed.X_WH_from, push.frames.front().X_HP);
  const PlanarPose X_WH = compose(X_WP, inverse(push.frames.back().X_HP));
  const Vec2 way = translation(retreat.X_WH_to) - translation(retreat.X_WH_from);
  pushed.X_WH_to = retreat.X_WH_from = X_WH;
  retreat.X_WH_to = {X_WH.x + way.x(), X_WH.y + way.y(), X_WH.theta};
}

/// The robot's motion for the pushes as far as they went, phase by phase.
std::vector<FilmPhase> phases_of(const Model& model, const Film& film,
                                 const ArmLimits& limits) {
  Plan done;
  done.status = PlanStatus::kReachedGoal;
  for (const FilmPush& push : film.pushes) {
    done.pushes.push_back({.push = done_part(push.push, push.transition.done),
                           .start = push.start,
                           .end = push.transition.end,
                           .push_force = push.transition.max_push_force});
  }
  const ArmMotion motion = arm_motion(model, done, limits);
  std::vector<FilmPhase> phases;
  for (std::size_t i = 0; i < motion.samples.size(); ++i) {
    const ArmSample& sample = motion.samples[i];
    const bool goes_on = !phases.empty() && phases.back().kind == sample.phase &&
                         phases.back().push == sample.push &&
                         sample.t > motion.samples[i - 1].t;
    PlanarPose X_WH = planar(sample.X_WH);
    const double z = sample.X_WH.position.z();
    if (!phases.empty()) {  // angles go on from where they were
      const double before = phases.back().X_WH_to.theta;
      X_WH.theta = before + wrapped(X_WH.theta - before);
    }
    if (!goes_on) {
      phases.push_back({sample.phase, sample.push, sample.t, sample.t, X_WH, X_WH, z, z});
    }
    phases.back().end = sample.t;
    phases.back().X_WH_to = X_WH;
    phases.back().z_to = z;
  }
  for (std::size_t i = 1; i < phases.size(); ++i) {
    if (phases[i].kind == ArmPhase::kRetreat)
      retreat_from(film, phases[i - 1], phases[i]);
  }
  return phases;
}

}  // namespace

Film film(const Model& model, const Plan& plan, const FilmOptions& options) {
  Film result;
  result.name = model.scene.name;
  result.region = plan.proof.region;
  const int count = std::clamp(static_cast<int>(plan.pushes.size()), 1, options.pushes);
  const int frames = std::clamp(options.frames / count, 3, 80);
  Replay replayed;
  if (options.is_plan && plan.usable()) {
    replayed = replay(model, plan);
    result.agrees = replayed.agrees;
    result.why = replayed.why;
  }
  Grasp grasp = plan.start;
  double travelled = 0.0;
  for (std::size_t i = 0; i < plan.pushes.size(); ++i) {
    if (static_cast<int>(i) == options.pushes) {
      result.left_out = static_cast<int>(plan.pushes.size()) - options.pushes;
      break;
    }
    const Push& push = plan.pushes[i].push;
    const int contact = contact_of(push);
    if (contact < 0 || contact >= static_cast<int>(model.contacts.size())) break;
    result.pushes.push_back(
        film_push(model, grasp, push, carried(plan.margin, travelled), frames, options));
    travelled += travel_in_pad_plane(push);
    if (i < replayed.pushes.size()) result.pushes.back().why = replayed.pushes[i].why;
    grasp = result.pushes.back().transition.end;
    if (!result.pushes.back().transition.completed()) break;
  }
  result.phases = phases_of(model, result, options.limits);
  return result;
}

PusherBody pusher_in(const Film& film, const Model& model, int pusher) {
  PusherBody body =
      pusher_body(model, model.scene.pushers[static_cast<std::size_t>(pusher)]);
  for (const FilmPush& push : film.pushes) {
    const auto* roll = std::get_if<Roll>(&push.push);
    if (!roll) continue;
    if (model.contacts[static_cast<std::size_t>(push.contact)].pusher != pusher) continue;
    body.width = std::max(body.width, kSheet * 2.0 * std::abs(roll->travel));
  }
  return body;
}

}  // namespace prehensile::viewer
