#include "planner/checks/space_margin.h"

#include <algorithm>
#include <array>

#include "primitives/linear_push.h"
#include "primitives/uncertainty.h"

namespace prehensile {
namespace {

constexpr double kSlip = 1e-6;  // [m] that counts

double& at(BoxPoint& point, Unknown unknown) {
  return point[static_cast<std::size_t>(unknown)];
}

std::string fault_of_member(const Model& nominal, const UncertainPush& member,
                            const TransitionOptions& options) {
  const char* kWithin = " within the margin";
  if (!check(member.scene).empty()) return std::string("no possible scene") + kWithin;
  const Model model = prepare(member.scene, nominal.options);
  LinearPush push = as_linear(member.push);
  push.contact = counterpart(nominal, push.contact, model);
  if (push.contact < 0) return std::string("no such contact") + kWithin;
  const Transition done = apply(model, member.start, push, options);
  if (!done.completed()) return std::string(name(done.status)) + kWithin;
  if (done.slipped > kSlip) return std::string("it slips in space") + kWithin;
  return {};
}

}  // namespace

std::string space_margin_fault(const Model& model, const PlannedPush& planned,
                               const Margin& margin, const TransitionOptions& options) {
  if (std::holds_alternative<Roll>(planned.push)) return {};
  const LinearPush push = as_linear(planned.push);
  if (!is_in_space(model, push, options)) return {};
  const PushContact& contact = model.contacts[push.contact];
  const Grasp start{planned.start.X_HO};  // rolled it looks as it did at 0
  UncertaintyBox box;
  box[Unknown::kFriction] = margin.friction;
  box[Unknown::kGripForce] = margin.force;
  if (!contact.is_point) {
    box[Unknown::kTorqueRadius] = margin.torque_radius;
    box[Unknown::kPlace] = margin.place;
    box[Unknown::kCentreOfMassX] = margin.centre_of_mass * std::abs(contact.t.x());
    box[Unknown::kCentreOfMassY] = margin.centre_of_mass * std::abs(contact.t.y());
  }
  const std::array<Unknown, 3> ends = {Unknown::kGripForce, Unknown::kTorqueRadius,
                                       Unknown::kPlace};
  const int combinations = contact.is_point ? 2 : 16;
  if (margin.weightless) {
    UncertainPush member = vary(model.scene, start, push, box, BoxPoint{});
    member.scene.g_W.setZero();
    member.scene.g_Wz = 0.0;
    const std::string fault = fault_of_member(model, member, options);
    if (!fault.empty()) return fault + ", without gravity";
  }
  if (box.active().empty()) return {};
  for (int i = 0; i < combinations; ++i) {
    BoxPoint point{};
    at(point, Unknown::kFriction) = -1.0;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      at(point, ends[k]) = (i >> k & 1) != 0 ? 1.0 : -1.0;
    }
    const double along = (i >> 3 & 1) != 0 ? 1.0 : -1.0;
    at(point, Unknown::kCentreOfMassX) = contact.t.x() < 0.0 ? -along : along;
    at(point, Unknown::kCentreOfMassY) = contact.t.y() < 0.0 ? -along : along;
    const UncertainPush member = vary(model.scene, start, push, box, point);
    std::string fault = fault_of_member(model, member, options);
    if (!fault.empty()) return fault;
  }
  return {};
}

}  // namespace prehensile
