#include <algorithm>
#include <cmath>

#include "mechanics/pad_law.h"
#include "planner/costs.h"
#include "planner/planner.h"
#include "planner/proofs/barrier.h"
#include "planner/proofs/blocked_hand.h"
#include "planner/proofs/goal_cover.h"
#include "planner/proofs/refuse.h"
#include "planner/proofs/turn_proof.h"
#include "scene/constants.h"
#include "scene/pad_quadrature.h"

namespace prehensile {
namespace {

/// Says why a proof fails; always false.
bool refuse(std::string* why, const char* text) {
  if (why) *why = text;
  return false;
}

bool verify_no_pusher(const Model& model, std::string* why) {
  if (model.contacts.empty()) return true;
  return refuse(why, "there is a contact to push at");
}

/// Whether every place with one fixed coordinate of O in H is off the outline: the
/// coordinate is linear in p_OF, so its range over the outline is that of the vertices.
bool coordinate_is_off(const std::vector<Vec2>& outline, double theta, bool is_x,
                       double wanted, double slack) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vec2& vertex : outline) {
    const Vec2 position = -rotated(theta, vertex);
    const double value = is_x ? position.x() : position.y();
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return wanted + slack < low || wanted - slack > high;
}

/// Where the finger axis may be for the pads to touch: of the round side of a can, as far
/// from its middle line as the pads reach.
std::vector<Vec2> touchable_face(const Model& model) {
  std::vector<Vec2> face = model.pad_face;
  if (!model.cross_section) return face;
  const auto& cylinder = std::get<CylinderShape>(model.scene.object.shape);
  const int across = cylinder.axis == Axis::kX ? 1 : 0;
  const double reach = pad_reach(in_plane_equivalent(model.scene.gripper.pad));
  for (Vec2& vertex : face) vertex[across] = std::clamp(vertex[across], -reach, reach);
  return face;
}

bool verify_goal_off_object(const Model& model, std::string* why) {
  const Goal& goal = *model.scene.goal;
  const std::vector<Vec2> face = touchable_face(model);
  double reach = 0.0;
  for (const Vec2& vertex : face) reach = std::max(reach, vertex.norm());
  const bool off = for_all_goal_angles(goal, [&](double theta, double half_step) {
    const double slack = place_tolerance(goal) + 1e-9;
    if (goal.x && goal.y) {
      const Vec2 position{*goal.x, *goal.y};
      const Vec2 p_OF = -rotated(-theta, position);
      return depth_inside(face, p_OF) < -slack - half_step * position.norm();
    }
    const double room = slack + half_step * reach;
    return (goal.x && coordinate_is_off(face, theta, true, *goal.x, room)) ||
           (goal.y && coordinate_is_off(face, theta, false, *goal.y, room));
  });
  return off || refuse(why, "at a pose of the goal the pads may touch the object");
}

/// Power that gravity gains over friction in a twist, at least, when the object turns by
/// up to `turn` about the finger axis and the finger axis moves by up to `shift` in it.
double falling_power(const Model& model, const PlanarPose& X_HO, const Vec2& g_O,
                     const PlanarTwist& twist, double shift, double turn) {
  const PlanarGrasp grasp = grasp_at(model, X_HO, g_O);
  double reach = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    reach = std::max(reach, std::hypot(grasp.x[j], grasp.y[j]));
  }
  const double weight = model.mass * g_O.norm();
  const double uncertain = weight * shift + model.F * reach * turn;
  return grasp.w_g.dot(twist) - friction_power(model, grasp, twist) -
         std::abs(twist[2]) * uncertain;
}

/// The long axis of an object that may roll, in O.
Vec2 rolling_axis(const Model& model) {
  if (model.prism) return model.prism->axis;
  const auto& cylinder = std::get<CylinderShape>(model.scene.object.shape);
  return cylinder.axis == Axis::kX ? Vec2{1.0, 0.0} : Vec2{0.0, 1.0};
}

/// How far the goal is rolled from the start, beyond its tolerance; 0 or less: not at
/// all.
double roll_asked(const Model& model) {
  const Goal& goal = *model.scene.goal;
  return goal.psi ? std::abs(wrapped(*goal.psi - model.scene.start.psi)) -
                        angle_tolerance(goal)
                  : 0.0;
}

/// Whether a contact may roll the object with some grip: a line under a long side that
/// carries weight. With a loose enough grip any friction of the support suffices to roll
/// a cylinder. A prism is rolled where its goal asks for that; on a support that carries
/// nothing "the fingers hold it" is a second motion, or it falls.
bool may_roll(const Model& model) {
  if (!model.cross_section && !(model.prism && roll_asked(model) > 0.0)) return false;
  const Vec2 axis = rolling_axis(model);
  return std::ranges::any_of(model.contacts, [&](const PushContact& contact) {
    return std::abs(axis.dot(contact.n)) < 1e-6 && !contact.is_point &&
           contact.mu > 0.0 && contact.g_O.dot(contact.n) < 0.0;
  });
}

bool verify_start_falls(const Model& model, const Proof& proof, std::string* why) {
  if (may_roll(model)) return refuse(why, "a support may carry the object");
  const Vec2 g_O = model.scene.g_W / greatest_grip_share(model);
  const double power =
      falling_power(model, model.scene.start.X_HO, g_O, proof.twist, 0.0, 0.0);
  if (power > 0.0) return true;
  return refuse(why, "in this twist friction takes as much power as gravity gives");
}

/// Pads that lose no part over an edge are the same at every pose of the goal.
bool verify_goal_falls(const Model& model, std::string* why) {
  const Goal& goal = *model.scene.goal;
  if (!goal.x || !goal.y || !goal.theta) {
    return refuse(why, "the goal leaves a coordinate free");
  }
  if (!model.region.is_fixed_in_hand()) {
    return refuse(why, "the pads change over the poses of the goal");
  }
  if (may_roll(model)) return refuse(why, "a support may carry the object");
  const PlanarPose X_HO{*goal.x, *goal.y, *goal.theta};
  const double turn = angle_tolerance(goal);
  const double shift = place_tolerance(goal) + turn * translation(X_HO).norm();
  for (const PushContact& contact : model.contacts) {
    if (contact.is_point) {
      return refuse(why, "about a point the object may turn to where gravity is held");
    }
    PlanarTwist twist = PlanarTwist::Zero();
    gravity_slack_by_pad_law(model, grasp_at(model, X_HO, contact.g_O), &twist);
    if (falling_power(model, X_HO, contact.g_O, twist, shift, turn) <= 0.0) {
      return refuse(why, "gravity is held at a pose of the goal");
    }
  }
  return !model.contacts.empty() || refuse(why, "there is no contact");
}

/// Whether limits on the angle exclude every angle of the goal set.
bool angle_is_beyond(const Goal& goal, const GraspLimits& limits) {
  if (!goal.theta) return false;
  const double slack = angle_tolerance(goal) + 1e-9;
  double theta = *goal.theta;
  if (goal.theta_is == ThetaMeaning::kNumber) {
    return (limits.theta_low && theta + slack < *limits.theta_low) ||
           (limits.theta_high && theta - slack > *limits.theta_high);
  }
  if (!limits.theta_low || !limits.theta_high) return false;
  // The lowest winding that is not below the limits is above them.
  const double turns = std::ceil((*limits.theta_low - theta - slack) / (2.0 * kPi));
  theta += 2.0 * kPi * turns;
  return theta - slack > *limits.theta_high;
}

/// Whether limits on the place of the finger axis exclude it at every pose of the goal.
bool place_is_beyond(const Goal& goal, const GraspLimits& limits) {
  if (!goal.x || !goal.y || (!limits.finger_low && !limits.finger_high)) return false;
  return for_all_goal_places(goal, [&](const Vec2& p_OF, double slack) {
    return (limits.finger_low &&
            (p_OF.array() + slack < limits.finger_low->array()).any()) ||
           (limits.finger_high &&
            (p_OF.array() - slack > limits.finger_high->array()).any());
  });
}

bool verify_goal_beyond_limits(const Model& model, std::string* why) {
  if (!model.scene.limits) return refuse(why, "the scene has no limits");
  const Goal& goal = *model.scene.goal;
  const GraspLimits& limits = *model.scene.limits;
  return angle_is_beyond(goal, limits) || place_is_beyond(goal, limits) ||
         refuse(why, "a pose of the goal may be within the limits");
}

bool verify_no_roll(const Model& model, std::string* why) {
  if (roll_asked(model) <= 0.0) return refuse(why, "the goal asks for no roll");
  return !may_roll(model) || refuse(why, "a contact may roll the object");
}

/// Whether the finger axis never moves along `direction` while this contact pushes.
///
/// The push force lies in the friction cone, and an isotropic pad's friction points along
/// the object's motion e. An edge w of the dual cone along which gravity does not help
/// (w.g >= 0) therefore gives w.e >= 0; the finger axis moves along -e.
bool moves_away(const PushContact& contact, const Vec2& direction) {
  const double angle = std::atan(contact.mu) + kIsotropyError;
  const auto holds = [&](double side) {
    return (contact.mu * contact.n + side * contact.t).dot(contact.g_O) >= 0.0;
  };
  // The border of {e : w.e >= 0} for w = mu n + side t is n turned away from side t.
  const auto border = [&](double side) { return rotated(-side * angle, contact.n); };
  const bool plus = holds(1.0);
  const bool minus = holds(-1.0);
  if (plus && minus) {
    return direction.dot(border(1.0)) >= 0.0 && direction.dot(border(-1.0)) >= 0.0;
  }
  if (!plus && !minus) return false;
  const double side = plus ? 1.0 : -1.0;
  const Vec2 inward = side * perp(border(side));
  return std::abs(cross(direction, inward)) < 1e-9 && direction.dot(inward) > 0.0;
}

bool verify_half_space(const Model& model, const Proof& proof, std::string* why) {
  const Goal& goal = *model.scene.goal;
  if (!model.region.is_isotropic() || !model.region.is_fixed_in_hand()) {
    return refuse(why, "the friction of these pads need not point along the motion");
  }
  if (!goal.x || !goal.y) return refuse(why, "the goal leaves a coordinate free");
  if (std::abs(proof.direction.norm() - 1.0) > 1e-6) {
    return refuse(why, "the direction is not of unit length");
  }
  for (const PushContact& contact : model.contacts) {
    if (!moves_away(contact, proof.direction)) {
      return refuse(why, "a contact may move the finger axis along the direction");
    }
  }
  const Vec2 start = finger_in_object(model.scene.start.X_HO);
  const bool beyond = for_all_goal_places(goal, [&](const Vec2& p_OF, double radius) {
    return (p_OF - start).dot(proof.direction) > radius;
  });
  return beyond || refuse(why, "a pose of the goal is not beyond the half-plane");
}

}  // namespace

bool verify(const Model& model, const Proof& proof, std::string* why) {
  if (!model.scene.goal) return refuse(why, "the scene states no goal");
  if (reaches(*model.scene.goal, model.scene.start)) {
    return refuse(why, "the start is a goal");
  }
  switch (proof.kind) {
    case Proof::Kind::kGoalOffObject:
      return verify_goal_off_object(model, why);
    case Proof::Kind::kStartFalls:
      return verify_start_falls(model, proof, why);
    case Proof::Kind::kGoalFalls:
      return verify_goal_falls(model, why);
    case Proof::Kind::kNoPusher:
      return verify_no_pusher(model, why);
    case Proof::Kind::kNoRoll:
      return verify_no_roll(model, why);
    case Proof::Kind::kGoalBeyondLimits:
      return verify_goal_beyond_limits(model, why);
    case Proof::Kind::kHalfSpace:
      return verify_half_space(model, proof, why);
    case Proof::Kind::kBarrier:
      return verify_barrier(model, proof.region, why);
    case Proof::Kind::kStartBlocked:
      return is_blocked_at_start(model) ||
             refuse(why, "a push may begin at the start without a collision");
    case Proof::Kind::kGoalBlocked:
      return is_blocked_at_goal(model) ||
             refuse(why, "a push may end at a pose of the goal without a collision");
    case Proof::Kind::kTurn:
      return verify_turn(model, proof, why);
    case Proof::Kind::kNone:
      break;
  }
  return refuse(why, "there is no proof");
}

}  // namespace prehensile
