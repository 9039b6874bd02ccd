#include "primitives/roll.h"

#include <algorithm>
#include <cmath>

#include "primitives/push_record.h"
#include "primitives/roll_prism.h"
#include "primitives/roll_support.h"

namespace prehensile {
namespace {

constexpr double kNegligible = 1e-6;

Vec2 axis_of(const Model& model) {
  const auto& cylinder = *std::get_if<CylinderShape>(&model.scene.object.shape);
  return cylinder.axis == Axis::kX ? Vec2(1.0, 0.0) : Vec2(0.0, 1.0);
}

RollSection refused(std::string_view reason) { return {.reason = reason}; }

/// The support sticks and the object turns in place between the jaws.
bool rolls(const CrossSectionModel& section, double sheet_rate,
           const CrossSectionInstant& instant) {
  const double error =
      std::max({std::abs(instant.v_z), std::abs(instant.v_u),
                std::abs(instant.roll_rate * section.radius - sheet_rate)});
  return usable(instant.status) && error <= kNegligible * std::abs(sheet_rate);
}

/// Why an instant is no roll.
PushStop stop_of(const CrossSectionInstant& instant) {
  switch (instant.status) {
    case InstantStatus::kAmbiguous:
      return {
          TransitionStatus::kAmbiguous,
          {},
          "two motions are possible, as where the fingers alone can carry the object"};
    case InstantStatus::kDynamic:
      return {TransitionStatus::kFalls, EventKind::kGravityLost,
              "the jaws do not hold the object, and gravity pulls it off the support"};
    case InstantStatus::kJammed:
      return {TransitionStatus::kJammed,
              {},
              "the support wedges the object against the fixed jaw"};
    case InstantStatus::kMoves:
    case InstantStatus::kHolds:
    case InstantStatus::kNonuniqueForces:
      break;
    case InstantStatus::kBadInput:
    case InstantStatus::kNotRun:
    case InstantStatus::kSeparated:
    case InstantStatus::kOutOfIterations:
      return {TransitionStatus::kUncertified, {}, "the instant has no answer"};
  }
  if (instant.mode[kSheet] == ContactMode::kStick) {
    return {TransitionStatus::kLeftGuard, EventKind::kGuard,
            "the support drags the object along and pushes the jaws with it"};
  }
  return {
      TransitionStatus::kLeftGuard, EventKind::kGuard,
      "the support slides under the object instead of rolling it: too little friction "
      "of the support or too much grip"};
}

/// What stays the same along the push.
struct Constant {
  const Grasp& start;
  double radius;
  double travel;
  double turn;  ///< [rad] of psi over the whole push
  const CrossSectionInstant& instant;
  double certificate;
};

Sample sample_at(const Constant& constant, double s) {
  const CrossSectionInstant& instant = constant.instant;
  Sample sample;
  sample.s = s;
  sample.grasp = {constant.start.X_HO, constant.start.psi + s * constant.turn};
  sample.push_force = instant.push_force;
  sample.normal_force = instant.normal_force[kSheet];
  sample.tangential_force = instant.tangential_force[kSheet];
  sample.slip_rate = instant.v_z + instant.roll_rate * constant.radius - constant.travel;
  sample.status = instant.status;
  sample.certificate = constant.certificate;
  return sample;
}

/// Why the roll cannot even begin; empty if it can.
std::string_view refusal(const RollSection& section, const Grasp& start, const Roll& roll,
                         const TransitionOptions& options) {
  if (!section.possible) return section.reason;
  if (!are_usable(options)) return "an option is out of range";
  if (!std::isfinite(roll.travel) || !std::isfinite(start.psi))
    return "a number is not finite";
  if (!std::isfinite(roll.grip_force) || roll.grip_force < 0.0)
    return "the grip force is no force";
  if (roll.travel == 0.0) return "the pusher does not move";
  return {};
}

}  // namespace

RollSection roll_section(const Model& model, int contact_index,
                         const Grasp& grasp) noexcept {
  if (model.prism)
    return refused("a prism rolls over its edges, not about an axis (query push)");
  if (!model.cross_section)
    return refused(
        "the object is not a cylinder held on its curved side, nor a prism that lies "
        "between the jaws");
  if (contact_index < 0 || contact_index >= static_cast<int>(model.contacts.size()))
    return refused("there is no such contact");
  const PushContact& contact = model.contacts[contact_index];
  const double along = contact.t.dot(axis_of(model));
  if (std::abs(along) < 0.5)
    return refused("the support is not on one of the object's long sides");
  if (contact.is_point) return refused("a point gives a rolling object no support");
  if (!pads_on_object(model, grasp.X_HO))
    return refused("the pads are not on the object");
  const double radius = model.cross_section->radius;
  if (std::abs(contact.n.dot(model.p_OCom)) > kNegligible * radius)
    return refused(
        "the centre of mass is off the axis about which the object would roll");
  const Vec2 gravity = model.mass * contact.g_O;
  const double rounding = 1e-12 * gravity.norm();
  if (std::abs(contact.t.dot(gravity)) > kNegligible * model.F + rounding)
    return refused(
        "gravity has a part along the object's axis, which sliding pads cannot "
        "hold");
  return {.possible = true,
          .weight = -contact.n.dot(gravity),
          .psi_per_travel = std::copysign(1.0 / radius, along)};
}

Transition apply_roll(const Model& model, const Grasp& start, const Roll& roll,
                      const TransitionOptions& options,
                      std::vector<Sample>* trace) noexcept {
  if (model.prism) return apply_prism_roll(model, start, roll, options, trace);
  PushRecord record(options.certificate_tolerance, trace);
  const RollSection section = roll_section(model, roll.contact, start);
  const std::string_view reason = refusal(section, start, roll, options);
  if (!reason.empty()) {
    record.stop({TransitionStatus::kRefused, {}, reason}, 0.0);
    return record.finish(start, 0.0, kNan, 0);
  }

  const PushContact& contact = model.contacts[roll.contact];
  const auto [gripped, drive] = section_roll(model, roll, section.weight);
  const CrossSectionInstant instant = solve_cross_section(gripped, drive);
  const double certificate = cross_section_residual(gripped, drive, instant);
  const Constant constant{start,       gripped.radius,
                          roll.travel, section.psi_per_travel * roll.travel,
                          instant,     certificate};
  record.add(sample_at(constant, 0.0));
  if (!record.stopped() && !rolls(gripped, roll.travel, instant)) {
    record.stop(stop_of(instant), 0.0);
  } else if (!record.stopped() && !lines_suffice(cylinder_loads(
                                      model, contact, start, instant, section.weight))) {
    record.stop({TransitionStatus::kRefused,
                 {},
                 "pads and support are too short: the object would tilt or yaw"},
                0.0);
  }
  if (record.stopped()) return record.finish(start, 0.0, 0.0, 1);

  const int samples =
      std::min(static_cast<int>(std::ceil(1.0 / options.max_step)), options.max_steps);
  for (int i = 1; i <= samples; ++i)
    record.add(sample_at(constant, static_cast<double>(i) / samples));
  return record.finish(sample_at(constant, 1.0).grasp, 1.0, 0.0, 1);
}

}  // namespace prehensile
