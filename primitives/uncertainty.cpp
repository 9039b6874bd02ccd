#include "primitives/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/outline.h"
#include "scene/split_mix.h"

namespace prehensile {
namespace {

/// Place, direction and travel of a push, where it has them.
struct MovePush {
  double place, travel, turn_of_direction;

  template <typename Straight>
  void operator()(Straight& push) const {
    push.place += place;
    push.e = rotated(turn_of_direction, push.e);
    push.travel = std::max(0.0, push.travel + travel);
  }
  void operator()(Pivot& pivot) const { pivot.place += place; }
  void operator()(Roll& roll) const { roll.travel += travel; }
};

}  // namespace

std::string_view name(Unknown unknown) {
  static constexpr std::array<std::string_view, kUnknowns> kNames = {
      "friction",         "finger friction",  "grip force",  "mass",   "torque radius",
      "centre of mass x", "centre of mass y", "place",       "travel", "direction",
      "grasp x",          "grasp y",          "grasp angle", "tilt"};
  return kNames[static_cast<std::size_t>(unknown)];
}

bool may_be_relative(Unknown unknown) { return unknown <= Unknown::kTorqueRadius; }

std::vector<Unknown> UncertaintyBox::active() const {
  std::vector<Unknown> out;
  for (int i = 0; i < kUnknowns; ++i) {
    if (half_width[static_cast<std::size_t>(i)] > 0.0) {
      out.push_back(static_cast<Unknown>(i));
    }
  }
  return out;
}

UncertaintyBox box_of(const CalibrationRecord& record) {
  constexpr double kMostShare = 0.95;
  UncertaintyBox box;
  box[Unknown::kFriction] = std::min(kMostShare, record.friction);
  box[Unknown::kFingerFriction] = std::min(kMostShare, record.finger_friction);
  box[Unknown::kTorqueRadius] = std::min(kMostShare, record.torque_radius);
  box[Unknown::kPlace] = box[Unknown::kTravel] = record.place;
  return box;
}

UncertaintyBox usual_box() {
  UncertaintyBox box;
  box[Unknown::kFriction] = 0.10;
  box[Unknown::kFingerFriction] = 0.05;
  box[Unknown::kGripForce] = 0.03;
  box[Unknown::kMass] = 0.01;
  box[Unknown::kTorqueRadius] = 0.10;
  box[Unknown::kCentreOfMassX] = box[Unknown::kCentreOfMassY] = 0.7e-3;
  box[Unknown::kPlace] = 1e-3;
  box[Unknown::kGraspX] = box[Unknown::kGraspY] = 0.5e-3;
  box[Unknown::kTilt] = 0.5 * std::numbers::pi / 180.0;
  return box;
}

UncertaintyBox stated_box(const Scene& scene) {
  UncertaintyBox box;
  if (!scene.uncertainty) return box;
  const Uncertainty& u = *scene.uncertainty;
  box[Unknown::kFriction] = u.friction;
  box[Unknown::kFingerFriction] = u.finger_friction;
  box[Unknown::kGripForce] = u.grip_force;
  box[Unknown::kMass] = u.mass;
  box[Unknown::kTorqueRadius] = u.torque_radius;
  box[Unknown::kCentreOfMassX] = box[Unknown::kCentreOfMassY] = u.centre_of_mass;
  box[Unknown::kGraspX] = box[Unknown::kGraspY] = u.start_position;
  box[Unknown::kGraspAngle] = u.start_angle;
  box[Unknown::kPlace] = u.pusher_place;
  box[Unknown::kTilt] = u.pusher_tilt;
  return box;
}

UncertaintyBox box_of(const Scene& scene) {
  UncertaintyBox box = stated_box(scene);
  const bool normal = scene.uncertainty && scene.uncertainty->spread == Spread::kNormal;
  if (!normal) return box;
  for (double& width : box.half_width) width *= scene.uncertainty->sigmas;
  return box;
}

BoxPoint random_point(std::uint64_t seed, std::uint64_t index) {
  BoxPoint point;
  std::uint64_t state = split_mix(split_mix(seed) + index);
  for (double& coordinate : point) {
    state = split_mix(state);
    coordinate = 2.0 * static_cast<double>(state >> 11) * 0x1.0p-53 - 1.0;
  }
  return point;
}

BoxPoint random_normal_point(std::uint64_t seed, std::uint64_t index) {
  BoxPoint point;
  std::uint64_t state = split_mix(split_mix(seed) + index);
  const auto uniform = [&state] {  // in (0, 1]
    state = split_mix(state);
    return (static_cast<double>(state >> 11) + 1.0) * 0x1.0p-53;
  };
  for (double& coordinate : point) {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    coordinate = radius * std::cos(2.0 * std::numbers::pi * uniform());
  }
  return point;
}

BoxPoint corner(const UncertaintyBox& box, std::uint64_t index) {
  BoxPoint point{};
  int bit = 0;
  for (const Unknown unknown : box.active()) {
    point[static_cast<std::size_t>(unknown)] = (index >> bit++) & 1U ? 1.0 : -1.0;
  }
  return point;
}

namespace {

/// A pusher that names no face keeps the one that it is opposite to while it is straight.
void tilt_pushers(Scene& scene, double tilt) {
  const auto names_none = [](const Pusher& pusher) { return pusher.faces.empty(); };
  std::vector<Face> faces;
  if (std::ranges::any_of(scene.pushers, names_none)) {
    faces = faces_of(scene.object.shape);
  }
  for (Pusher& pusher : scene.pushers) {
    if (names_none(pusher)) {
      const int face = face_towards(faces, rotated(pusher.normal_angle, {1.0, 0.0}));
      if (face >= 0) pusher.faces.push_back(faces[static_cast<std::size_t>(face)].name);
    }
    pusher.normal_angle += tilt;
  }
}

}  // namespace

UncertainPush vary(const Scene& scene, const Grasp& start, const Push& push,
                   const UncertaintyBox& box, const BoxPoint& at) {
  const auto offset = [&](Unknown unknown) {
    return box[unknown] * at[static_cast<std::size_t>(unknown)];
  };
  const auto changed = [&](Unknown unknown, double nominal) {
    const bool absolute = box.is_absolute[static_cast<std::size_t>(unknown)];
    return std::max(0.0, nominal + offset(unknown) * (absolute ? 1.0 : nominal));
  };
  UncertainPush out{scene, start, push};
  for (Pusher& pusher : out.scene.pushers) {
    pusher.friction = changed(Unknown::kFriction, pusher.friction);
  }
  Gripper& gripper = out.scene.gripper;
  for (double& friction : gripper.friction) {
    friction = changed(Unknown::kFingerFriction, friction);
  }
  gripper.grip_force = changed(Unknown::kGripForce, gripper.grip_force);
  if (gripper.grip_range) {
    for (double& force : *gripper.grip_range) {
      force = changed(Unknown::kGripForce, force);
    }
  }
  if (auto* roll = std::get_if<Roll>(&out.push); roll && roll->grip_force > 0.0) {
    roll->grip_force = changed(Unknown::kGripForce, roll->grip_force);
  }
  out.scene.object.mass = changed(Unknown::kMass, scene.object.mass);
  if (box[Unknown::kTorqueRadius] > 0.0) {
    const ContactRegion pads(scene, 16);
    const double c = pads.torque_radius();
    if (c > 0.0) {
      const double factor = std::max(1e-3, changed(Unknown::kTorqueRadius, c) / c);
      gripper.pad = resized(gripper.pad, factor);
    }
  }
  const Vec2 shift(offset(Unknown::kCentreOfMassX), offset(Unknown::kCentreOfMassY));
  if (!shift.isZero(0.0)) {
    out.scene.object.p_OCom = Vec2(centre_of_mass(scene.object) + shift);
    out.scene.object.z_OCom = height_of_mass(scene.object);
  }
  const double tilt = offset(Unknown::kTilt);
  if (tilt != 0.0) tilt_pushers(out.scene, tilt);
  std::visit(MovePush{offset(Unknown::kPlace), offset(Unknown::kTravel),
                      offset(Unknown::kDirection) - tilt},
             out.push);
  if (const double angle = offset(Unknown::kGraspAngle); angle != 0.0) {
    out.start.X_HO =
        pose_from_finger(finger_in_object(start.X_HO), start.X_HO.theta + angle);
  }
  out.start.X_HO.x += offset(Unknown::kGraspX);
  out.start.X_HO.y += offset(Unknown::kGraspY);
  out.scene.start = out.start;
  return out;
}

int counterpart(const Model& nominal, int contact, const Model& varied) noexcept {
  const PushContact& wanted = nominal.contacts[static_cast<std::size_t>(contact)];
  const auto same_place = [&wanted](const PushContact& other) {
    return other.pusher == wanted.pusher && other.face == wanted.face;
  };
  // Grip forces vary with the scene, their order does not.
  int before = 0;
  for (int i = 0; i < contact; ++i) before += same_place(nominal.contacts[i]) ? 1 : 0;
  int own = -1;
  for (int i = 0; i < static_cast<int>(varied.contacts.size()); ++i) {
    if (!same_place(varied.contacts[i])) continue;
    if (own < 0) own = i;
    if (before-- == 0) return i;
  }
  return own;
}

}  // namespace prehensile
