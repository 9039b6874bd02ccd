#include "primitives/contact_reading.h"

#include <cmath>
#include <limits>

namespace prehensile {
namespace {

double friction_left(const ContactReading& reading, const ContactScales& scales) {
  return (scales.mu * reading.normal_force - reading.friction) / scales.force;
}

}  // namespace

ContactScales scales_of(const Model& model, const LinearPush& push) noexcept {
  const PushContact& contact = model.contacts[push.contact];
  return {contact.mu, model.F + model.mass * contact.g_O.norm(),
          push.travel + std::abs(push.turn) * 0.5 * model.L};
}

ModeMargin margin_of(const ContactReading& reading, const ContactScales& scales,
                     const Seat& seat, Regime regime) noexcept {
  ModeMargin margin;
  const double yield = reading.yield / scales.speed;
  margin.pressed.fill(std::numeric_limits<double>::infinity());
  if (seat.kind == SeatKind::kFlush) {
    for (int k = 0; k < 2; ++k) {
      margin.pressed[k] =
          reading.load[k] / scales.force - reading.lift[k] / scales.speed + yield;
    }
  }
  const double slip = reading.slip / scales.speed;
  const double left = friction_left(reading, scales);
  switch (regime) {
    case Regime::kStick:
      margin.regime = left - std::abs(slip) + yield;
      break;
    case Regime::kSlipPlus:
      margin.regime = slip - left - yield;
      break;
    case Regime::kSlipMinus:
      margin.regime = -slip - left - yield;
      break;
  }
  return margin;
}

Regime regime_of(const ContactReading& reading, const ContactScales& scales) noexcept {
  const double slip = (std::abs(reading.slip) - reading.yield) / scales.speed;
  const bool sticks = friction_left(reading, scales) >= slip;
  return sticks ? Regime::kStick : slip_side_of(reading, scales);
}

Regime slip_side_of(const ContactReading& reading, const ContactScales& scales) noexcept {
  const double slip = reading.slip;
  const double friction = reading.tangential_force;
  const bool slips = std::abs(slip) / scales.speed > std::abs(friction) / scales.force;
  const double sign = slips ? slip : -friction;
  return sign > 0.0 ? Regime::kSlipPlus : Regime::kSlipMinus;
}

bool recedes_somewhere(const PlanarDrive& drive) noexcept {
  for (int k = 0; k < drive.count; ++k) {
    if (point_velocity(drive.V_HP, drive.p_HC[k]).dot(drive.n_H) < 0.0) return true;
  }
  return false;
}

Sample sample_of(const ContactReading& reading, InstantStatus status,
                 double push_force) noexcept {
  Sample sample;
  sample.push_force = push_force;
  sample.normal_force = reading.normal_force;
  sample.tangential_force = reading.tangential_force;
  sample.slip_rate = reading.slip;
  sample.status = status;
  return sample;
}

void scale_forces(double share, Sample& sample) noexcept {
  sample.push_force *= share;
  sample.normal_force *= share;
  sample.tangential_force *= share;
  for (double& force : sample.jaw_force) force *= share;
  sample.moment_across *= share;
}

PushStop stop_of(InstantStatus status) noexcept {
  using enum TransitionStatus;
  switch (status) {
    case InstantStatus::kMoves:
    case InstantStatus::kHolds:
    case InstantStatus::kNonuniqueForces:
      return {};
    case InstantStatus::kSeparated:
      return {kPusherLost, EventKind::kContactLost, "the pusher leaves the object"};
    case InstantStatus::kDynamic:
      return {kFalls, EventKind::kGravityLost, "nothing balances gravity"};
    case InstantStatus::kAmbiguous:
      return {kAmbiguous, {}, "two motions are possible"};
    case InstantStatus::kJammed:
      return {kJammed, {}, "no motion is possible"};
    case InstantStatus::kNotRun:
    case InstantStatus::kOutOfIterations:
    case InstantStatus::kBadInput:
      break;
  }
  return {kIterationLimit, {}, "an instant was not solved"};
}

}  // namespace prehensile
