#include "primitives/prism_attitudes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prehensile {
namespace {

constexpr double kSquare = 1e-6;  // how far from square a pad may be
constexpr double kQuarter = 0.5 * std::numbers::pi;

}  // namespace

Vec2 half_pad(const Pad& pad, const Vec2& n_H) {
  const auto* rectangle = std::get_if<RectanglePad>(&pad);
  if (!rectangle) return Vec2::Zero();
  if (std::abs(n_H.x()) < kSquare)
    return {0.5 * rectangle->size.y(), 0.5 * rectangle->size.x()};
  if (std::abs(n_H.y()) < kSquare) return 0.5 * rectangle->size;
  return Vec2::Zero();
}

PrismRoll::PrismRoll(const Model& model, const Grasp& start, const Roll& roll)
    : model_(model),
      contact_(model.contacts[roll.contact]),
      start_(start),
      travel_(roll.travel),
      way_(roll.travel > 0.0 ? 1.0 : -1.0),
      sign_(contact_.t.dot(model.prism->axis) > 0.0 ? 1.0 : -1.0) {
  const LyingPrism& prism = *model.prism;
  const int side = contact_.n.dot(prism.lateral) > 0.0 ? 1 : -1;
  polygon_ = section_polygon(prism.section, side, prism.com);
  for (int i = 0; i < polygon_.count; ++i) {
    const Vec2 d = polygon_.vertex[(i + 1) % polygon_.count] - polygon_.vertex[i];
    direction_[i] = std::atan2(d.y(), d.x());
  }
  half_pad_ = half_pad(model.scene.gripper.pad, rotated(start.X_HO.theta, contact_.n));
  const Vec2 p_OF = finger_in_object(start.X_HO);
  finger_t_ = contact_.t.dot(p_OF);
  finger_height_ = contact_.n.dot(p_OF) - support_height(polygon_, first());
  grip_ = {roll.grip_force > 0.0 ? roll.grip_force : model.scene.gripper.grip_force,
           model.scene.gripper.friction, model.scene.gripper.jaw_mode};
  drive_ = {contact_.mu, travel_, -contact_.n.dot(model.mass * contact_.g_O)};
}

PrismContacts PrismRoll::contacts(double phi) const {
  return prism_contacts(polygon_, phi, pads(phi));
}

PrismLook PrismRoll::look(double phi) const {
  PrismLook look;
  look.contacts = contacts(phi);
  if (!look.contacts.held() || grip_.jaw_mode == JawMode::kLocked) return look;
  look.instant = solve_prism(polygon_, phi, look.contacts, grip_, drive_);
  look.certificate =
      prism_residual(polygon_, phi, pads(phi), grip_, drive_, look.instant);
  const auto& mode = look.instant.mode;
  look.rolls = usable(look.instant.status) && mode[kSheet] == ContactMode::kStick &&
               mode[kJaw1] != ContactMode::kOpen && mode[kJaw2] != ContactMode::kOpen &&
               way_ * look.instant.motion.roll_rate > 0.0 && keeps_straight(look);
  return look;
}

int PrismRoll::pivot(const PrismContacts& contacts) const {
  const SectionTouch& sheet = contacts.touch[kSheet];
  return sheet.vertex[staying_point(sheet, way_ > 0.0 ? 1 : -1)];
}

double PrismRoll::hand_z(const PrismContacts& contacts) const {
  if (grip_.jaw_mode == JawMode::kFixedJaw1) return contacts.jaw_z[kJaw1];
  if (grip_.jaw_mode == JawMode::kFixedJaw2) return contacts.jaw_z[kJaw2];
  return 0.5 * (contacts.jaw_z[kJaw1] + contacts.jaw_z[kJaw2]);
}

double PrismRoll::place(int pivot, double phi, const PrismContacts& contacts) const {
  return rotated(phi, polygon_.vertex[pivot]).x() - hand_z(contacts);
}

double PrismRoll::next(double phi, double longest, bool& is_flat) const {
  double step = kQuarter;
  for (int i = 0; i < polygon_.count; ++i) {
    double ahead = std::fmod(-way_ * (direction_[i] + phi), kQuarter);
    if (ahead < kSameAngle) ahead += kQuarter;
    if (ahead > kSameAngle) step = std::min(step, ahead);
  }
  is_flat = step <= longest + kSameAngle;
  if (is_flat) longest = step;
  return phi + way_ * std::min(step, longest);
}

Sample PrismRoll::sample(double phi, double s, const PrismLook& look) const {
  const PrismInstant& instant = look.instant;
  Sample sample;
  sample.s = s;
  sample.grasp = grasp(phi);
  sample.push_force = instant.push_force;
  sample.normal_force = instant.forces.normal[kSheet];
  sample.tangential_force = instant.forces.tangential[kSheet];
  const Vec2 foot = instant.forces.point[kSheet];
  sample.slip_rate = instant.motion.v_z - instant.motion.roll_rate * foot.y() - travel_;
  sample.opening = look.contacts.jaw_z[kJaw2] - look.contacts.jaw_z[kJaw1];
  sample.status = instant.status;
  sample.certificate = look.certificate;
  return sample;
}

Grasp PrismRoll::grasp(double phi) const {
  const double rise = support_height(polygon_, first()) - support_height(polygon_, phi);
  const Vec2 shift = rise * rotated(start_.X_HO.theta, contact_.n);
  Grasp grasp = start_;
  grasp.X_HO.x += shift.x();
  grasp.X_HO.y += shift.y();
  grasp.psi = sign_ * phi;
  return grasp;
}

PadReach PrismRoll::pads(double phi) const {
  const double finger = finger_height_ + support_height(polygon_, phi);
  return {finger - half_pad_.x(), finger + half_pad_.x()};
}

RollLoads PrismRoll::loads(const PrismLook& look) const {
  RollLoads loads;
  const SectionForces& forces = look.instant.forces;
  for (int i = 0; i < 3; ++i) {
    const Vec2& n = look.contacts.touch[i].normal;
    const Vec2 t = i == kJaw1 ? perp(n) : -perp(n);
    const Vec2 force = forces.normal[i] * n + forces.tangential[i] * t;
    loads.along_z[i] = force.x();
    loads.along_u[i] = force.y();
    loads.low[i] = std::max(-half_pad_.y(), contact_.t.dot(contact_.a) - finger_t_);
    loads.high[i] = std::min(half_pad_.y(), contact_.t.dot(contact_.b) - finger_t_);
  }
  loads.weight = drive_.weight;
  loads.length = model_.prism->length;
  add_support(model_, contact_, start_, loads);
  return loads;
}

bool PrismRoll::keeps_straight(const PrismLook& look) const {
  const RollLoads loads = this->loads(look);
  return loads.high[kJaw1] >= loads.low[kJaw1] && lines_suffice(loads);
}

PushStop PrismRoll::why_not(double phi, const PrismLook& look) const {
  using enum TransitionStatus;
  if (!look.contacts.held())
    return {kPadLost, EventKind::kPadOffFace, "a pad has nothing left to touch"};
  if (grip_.jaw_mode == JawMode::kLocked) {
    const auto width = [&](double angle) {
      const PrismContacts at = contacts(angle);
      return at.jaw_z[kJaw2] - at.jaw_z[kJaw1];
    };
    if (width(phi + way_ * kJustBefore) > width(phi))
      return {kJammed,
              {},
              "both jaws stand still, and the section would have to push them apart"};
    return {kPadLost, EventKind::kPadOffFace,
            "both jaws stand still while the section gets narrower: they let go of it"};
  }
  const PrismInstant& instant = look.instant;
  switch (instant.status) {
    case InstantStatus::kAmbiguous:
      return {
          kAmbiguous,
          {},
          "two motions are possible, as where the fingers alone can carry the object"};
    case InstantStatus::kDynamic:
      if (drive_.weight < 0.0)
        return {kFalls, EventKind::kGravityLost,
                "the jaws do not hold the object, and gravity pulls it off the support"};
      return {kFalls, EventKind::kTips,
              "weight and grip tip the object on by themselves: it runs ahead of the "
              "support"};
    case InstantStatus::kJammed:
      return {kJammed, {}, "the support wedges the object against a jaw"};
    case InstantStatus::kMoves:
    case InstantStatus::kHolds:
    case InstantStatus::kNonuniqueForces:
      break;
    case InstantStatus::kBadInput:
    case InstantStatus::kNotRun:
    case InstantStatus::kSeparated:
    case InstantStatus::kOutOfIterations:
      return {kUncertified,
              {},
              instant.exhausted ? "no contact mode has a solution here: the object would "
                                  "jerk or jam, and nothing short proves which"
                                : "the instant has no answer"};
  }
  if (instant.mode[kSheet] == ContactMode::kStick) {
    if (way_ * instant.motion.roll_rate > 0.0)
      return {kLeftGuard, EventKind::kGuard,
              "pads and support are too short: the object would tilt or yaw"};
    return {kLeftGuard, EventKind::kGuard,
            "the support drags the object along and pushes the jaws with it"};
  }
  return {kLeftGuard, EventKind::kGuard,
          "the support slides under the object instead of tipping it over its edge: too "
          "little friction of the support, or jaws that hold it upright"};
}

}  // namespace prehensile
