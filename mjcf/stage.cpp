#include "mjcf/stage.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <set>

#include "planner/arm/arm_motion.h"

namespace prehensile::mjcf {
namespace {

// [m/s], and [m] that springs yield under the grip force: where loads shift these are
// stiff, so that the object stays in its plane, and the hand is slow. In a roll the
// support pulls at the object with up to twice the grip force, and coupled jaws stand
// still against that: over soft springs the object would give way by millimetres.
constexpr double kSpeed = 2e-3, kSpeedInSpace = 2e-4;
constexpr double kSoft = 1e-2, kStiff = 1e-4;
constexpr double kSamePsi = 1e-6;         // [rad]
constexpr double kLeastLever = 5e-3;      // [m] of turns of small pads
constexpr double kSamePoint = 1e-4;       // [m]
constexpr double kApproach = 1e-3;        // [m] of each push, about
constexpr double kMostSeconds = 1e5;      // [s] of all pushes: a day of simulation
constexpr std::size_t kMostCorners = 16;  // of a face that pads leave
constexpr int kLooks = 20;                // at a push for overhang

std::string of_push(std::size_t index) {
  return "push " + std::to_string(index + 1) + ": ";
}

std::string number(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof(buffer), "%g", value);
  return buffer;
}

const char* name(JawMode mode) {
  switch (mode) {
    case JawMode::kCoupled:
      return "coupled";
    case JawMode::kFixedJaw1:
      return "fixed_jaw_1";
    case JawMode::kFixedJaw2:
      return "fixed_jaw_2";
    case JawMode::kIndependent:
      return "independent";
    case JawMode::kLocked:
      return "locked";
  }
  return "unknown";
}

/// The object in H at the share s, if it rides on the pusher.
PlanarPose riding(const PlannedPush& planned, double s) {
  return pusher_pose(as_linear(planned.push), planned.start.X_HO, s);
}

/// Calls f with poses of the object along all pushes; of the start, where there are none.
template <typename F>
void along(const Stage& stage, const F& f) {
  if (stage.pushes.empty()) f(std::size_t{0}, stage.model->scene.start.X_HO);
  for (std::size_t i = 0; i < stage.pushes.size(); ++i) {
    for (int k = 0; k <= kLooks; ++k) {
      f(i, riding(stage.pushes[i], static_cast<double>(k) / kLooks));
    }
  }
}

double distance(const ContactPoints& one, const ContactPoints& other) {
  if (one.count != other.count) return 1.0;
  double most = 0.0;
  for (int j = 0; j < one.count; ++j) {
    most = std::max(most, std::hypot(one.x[j] - other.x[j], one.y[j] - other.y[j]));
  }
  return most;
}

void check_push(const Model& model, std::size_t index, const PlannedPush& planned) {
  const int contact = contact_of(planned.push);
  if (contact < 0 || contact >= static_cast<int>(model.contacts.size())) {
    throw NotCarried(of_push(index) + "contact " + std::to_string(contact) +
                     ": expected one of the scene's");
  }
  if (std::holds_alternative<Roll>(planned.push) && !model.cross_section) {
    throw NotCarried(of_push(index) +
                     "a prism that rolls, over whose edges the points of a pad would "
                     "yield one by one: expected a cylinder");
  }
  const PushContact& touched = model.contacts[static_cast<std::size_t>(contact)];
  if (is_round_side(model, touched) && !touched.is_point) {
    const double half_face = 0.5 * (touched.b - touched.a).norm();
    const double place = std::abs(as_linear(planned.push).place);
    if (touched.half_length < half_face + place) {
      throw NotCarried(of_push(index) +
                       "a pusher that ends on the side of a cylinder: expected one that "
                       "is longer");
    }
  }
}

/// Loads that shift need jaws whose springs can be told apart from their drive.
void check_jaws(const Gripper& gripper) {
  if (gripper.jaw_mode != JawMode::kCoupled && gripper.jaw_mode != JawMode::kLocked) {
    throw NotCarried(std::string("gripper.jaw_mode ") + name(gripper.jaw_mode) +
                     ": expected coupled or locked where the loads of the pads shift");
  }
}

void check_pressure(const Gripper& gripper) {
  if (gripper.pressure.law != PressureLaw::kFoundation) {
    throw NotCarried(
        "gripper.pressure.law: expected foundation where the loads of the pads shift");
  }
}

/// The object touches each pusher at one attitude; a round side has any.
void place_rolls(Stage& stage) {
  const Model& model = *stage.model;
  stage.psi.assign(model.contacts.size(), model.scene.start.psi);
  std::vector<bool> known(model.contacts.size(), false);
  for (std::size_t i = 0; i < stage.pushes.size(); ++i) {
    const PlannedPush& planned = stage.pushes[i];
    const auto contact = static_cast<std::size_t>(contact_of(planned.push));
    if (is_round_side(model, model.contacts[contact])) continue;
    if (known[contact] && std::abs(stage.psi[contact] - planned.start.psi) > kSamePsi) {
      throw NotCarried(
          of_push(i) +
          "the object has rolled since it last touched this pusher: expected "
          "the same roll");
    }
    known[contact] = true;
    stage.psi[contact] = planned.start.psi;
  }
}

/// The points of the pads have to stay where they are in the hand.
void place_points(Stage& stage) {
  const Model& model = *stage.model;
  const ContactRegion& region = model.region;
  if (!model.cross_section) {
    stage.points = region.whole();
    along(stage, [&](std::size_t, const PlanarPose& X_HO) {
      stage.overhangs = stage.overhangs || !region.is_whole(X_HO);
    });
    if (stage.overhangs && model.pad_face.size() > kMostCorners) {
      throw NotCarried("the pads overhang a face with " +
                       std::to_string(model.pad_face.size()) +
                       " corners: expected at most " + std::to_string(kMostCorners) +
                       ", or overhang: ignore");
    }
    return;
  }
  stage.points = region.at(stage.pushes.empty() ? model.scene.start.X_HO
                                                : stage.pushes.front().start.X_HO);
  along(stage, [&](std::size_t i, const PlanarPose& X_HO) {
    const double moved = distance(stage.points, region.at(X_HO));
    if (moved <= kSamePoint) return;
    throw NotCarried(of_push(i) + "the line where the pads touch the cylinder moves by " +
                     number(1e3 * moved) +
                     " mm in the hand: expected it to stay, as in slides along the axis");
  });
}

/// A speed at which no simulation would come to an end.
void check_seconds(const Stage& stage) {
  double seconds = 0.0;
  for (const PlannedPush& planned : stage.pushes) {
    seconds += seconds_of(stage, planned) + kApproach / stage.speed;
  }
  if (seconds <= kMostSeconds) return;
  throw NotCarried("a speed of " + number(1e3 * stage.speed) +
                   " mm/s, at which the pushes take " + number(seconds) +
                   " s: expected at most " + number(kMostSeconds) + " s");
}

}  // namespace

HandPose hand_at(const Model& model, const PlannedPush& planned, double s, double gap) {
  const PushContact& contact =
      model.contacts[static_cast<std::size_t>(contact_of(planned.push))];
  PlanarPose X_WP = pusher_in_world(model, contact, as_linear(planned.push).place);
  const Vec2 back = gap * rotated(X_WP.theta, contact.n);
  X_WP.x += back.x();
  X_WP.y += back.y();
  const auto* roll = std::get_if<Roll>(&planned.push);
  return {compose(X_WP, inverse(riding(planned, s))), roll ? -s * roll->travel : 0.0};
}

Eigen::Quaterniond attitude(const Model& model, double theta, double psi) {
  const auto* cylinder = std::get_if<CylinderShape>(&model.scene.object.shape);
  const int axis = cylinder ? static_cast<int>(cylinder->axis) : 0;
  return Eigen::Quaterniond(Eigen::AngleAxisd(theta, Vec3::UnitZ()) *
                            Eigen::AngleAxisd(psi, Vec3::Unit(axis)));
}

double rubbed_path(const Model& model, const Push& push) {
  if (const auto* roll = std::get_if<Roll>(&push)) return std::abs(roll->travel);
  const ContactPoints& points = model.region.whole();
  double lever = kLeastLever;
  for (int j = 0; j < points.count; ++j) {
    lever = std::max(lever, std::hypot(points.x[j], points.y[j]));
  }
  const LinearPush linear = as_linear(push);
  return linear.travel + lever * std::abs(linear.turn);
}

Stage stage(const Model& model, const std::vector<PlannedPush>& pushes, double speed) {
  Stage result{.model = &model, .pushes = pushes};
  const double grip = model.scene.gripper.grip_force;
  if (!(grip > 0.0)) {
    throw NotCarried("gripper.grip_force " + number(grip) +
                     " N: expected > 0, what holds the object");
  }
  std::set<int> contacts;
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    check_push(model, i, pushes[i]);
    contacts.insert(contact_of(pushes[i].push));
  }
  result.contacts.assign(contacts.begin(), contacts.end());
  if (pushes.empty()) {
    result.contacts.resize(model.contacts.size());
    std::iota(result.contacts.begin(), result.contacts.end(), 0);
  }
  place_rolls(result);
  result.in_space =
      std::any_of(result.contacts.begin(), result.contacts.end(), [&model](int contact) {
        return model.push_needs_space(model.contacts[static_cast<std::size_t>(contact)]);
      });
  const bool rolls = std::any_of(pushes.begin(), pushes.end(), [](const PlannedPush& p) {
    return std::holds_alternative<Roll>(p.push);
  });
  const bool shifts = result.in_space || rolls;
  if (shifts) check_jaws(model.scene.gripper);
  if (result.in_space) check_pressure(model.scene.gripper);
  place_points(result);
  // The loosest grip decides: springs too stiff for it make the pads rattle.
  double least = grip;
  for (const PlannedPush& planned : pushes)
    least = std::min(least, grip_force_of(model, planned.push));
  result.stiffness = least / (shifts ? kStiff : kSoft);
  result.speed = result.in_space ? kSpeedInSpace : kSpeed;
  if (speed > 0.0) result.speed = speed;
  check_seconds(result);
  return result;
}

double seconds_of(const Stage& stage, const PlannedPush& planned) {
  return rubbed_path(*stage.model, planned.push) / stage.speed;
}

bool is_round_side(const Model& model, const PushContact& contact) {
  const auto* cylinder = std::get_if<CylinderShape>(&model.scene.object.shape);
  if (!cylinder || cylinder->axis == Axis::kZ) return false;
  const Vec2 axis = cylinder->axis == Axis::kX ? Vec2::UnitX() : Vec2::UnitY();
  return std::abs(axis.dot(contact.n)) < 0.5;
}

}  // namespace prehensile::mjcf
