#include "planner/steering/roll_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "planner/obstacles/confines_check.h"
#include "primitives/roll.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// Grips that are tried, as the share of the weight that the fingers could carry. A prism
/// wants one between the jaws' rubbing and its own weight.
constexpr std::array<double, 6> kCarriedShares = {0.8, 0.6, 0.4, 0.2, 0.1, 0.05};
constexpr std::array<double, 10> kCarriedSharesOfPrism = {
    0.8, 0.55, 0.37, 0.25, 0.17, 0.11, 0.08, 0.055, 0.037, 0.025};

double weight_on(const Model& model, const PushContact& contact) {
  return -model.mass * contact.g_O.dot(contact.n);
}

/// In closed form; only if the roll completes, which also takes lines long enough to keep
/// the object from tilting.
double cylinder_slack(const Model& model, const Grasp& start, const Roll& roll) {
  CrossSectionModel section = *model.cross_section;
  if (roll.grip_force > 0.0) section.grip_force = roll.grip_force;
  const PushContact& contact = model.contacts[roll.contact];
  const double weight = weight_on(model, contact);
  if (!(weight > 0.0)) return -kInfinity;
  const double carried = (section.friction[0] + section.friction[1]) * section.grip_force;
  const double threshold = rolling_threshold(section, roll.travel, weight);
  const double slack = std::min(contact.mu - threshold, 1.0 - carried / weight);
  if (slack < 0.0) return slack;
  return apply(model, start, roll, {}).completed() ? slack : -kInfinity;
}

/// Friction of the support above the steepest traction of a roll that is followed to its
/// end; -infinity if that is not reached.
double prism_slack(const Model& model, const Grasp& start, const Roll& roll) {
  std::vector<Sample> trace;
  const Transition done = apply(model, start, roll, {}, &trace);
  if (!done.completed()) return -kInfinity;
  double slack = kInfinity;
  for (const Sample& sample : trace) {
    slack = std::min(slack, model.contacts[roll.contact].mu -
                                std::abs(sample.tangential_force) / sample.normal_force);
  }
  return slack;
}

double nominal_slack(const Model& model, const Grasp& start, const Roll& roll) {
  if (model.prism) return prism_slack(model, start, roll);
  return model.cross_section ? cylinder_slack(model, start, roll) : -kInfinity;
}

/// Makes the pads of `corner` so many times as large as those of the model.
void resize_pads(double factor, const Model& model, Model& corner) {
  corner.scene.gripper.pad = resized(model.scene.gripper.pad, factor);
  if (model.cross_section) {
    corner.region = ContactRegion(corner.scene, model.options.points_per_pad);
  }
}

/// Travel of the support for a roll by dpsi [m]; NaN if this contact cannot roll the
/// object there, or plans do not roll it so far.
double travel_of(const Model& model, int contact, const Grasp& grasp, double dpsi) {
  if (!model.prism) {
    const RollSection section = roll_section(model, contact, grasp);
    return section.possible ? dpsi / section.psi_per_travel : kNan;
  }
  if (!looks_alike(*model.prism, grasp.psi + dpsi)) return kNan;
  const double way = model.contacts[contact].t.dot(model.prism->axis);
  return std::copysign(dpsi * model.roll_radius, dpsi * way);
}

/// The roll of this contact at a grasp, with the tightest grip within the margin; false
/// if it cannot.
bool make_roll(const Model& model, int contact, const Grasp& grasp, double dpsi,
               const Margin& margin, const TransitionOptions& options,
               PlannedPush& planned) {
  Roll roll{.contact = contact, .travel = travel_of(model, contact, grasp, dpsi)};
  if (!std::isfinite(roll.travel)) return false;
  const double weight = weight_on(model, model.contacts[contact]);
  const auto& mu = model.scene.gripper.friction;
  const auto shares = model.prism ? std::span<const double>(kCarriedSharesOfPrism)
                                  : std::span<const double>(kCarriedShares);
  double slack = roll_slack(model, grasp, roll, margin);
  for (const double share : shares) {
    if (slack >= 0.0 || !(weight > 0.0)) break;
    roll.grip_force = mu[0] + mu[1] > 0.0 ? share * weight / (mu[0] + mu[1]) : 0.0;
    slack = roll_slack(model, grasp, roll, margin);
  }
  if (slack < 0.0) return false;
  const Transition rolled = apply(model, grasp, roll, options);
  planned.push = roll;
  planned.start = grasp;
  planned.end = {grasp.X_HO, rolled.end.psi};  // O of a prism has risen and sunk again
  return rolled.completed() && confinement_fault(model, {planned}).empty();
}

/// Places for a roll, those that split no run of pushes first.
std::vector<std::size_t> roll_positions(const Plan& plan) {
  std::vector<std::size_t> positions = {0};
  std::vector<std::size_t> inside;
  for (std::size_t i = 1; i < plan.pushes.size(); ++i) {
    const bool splits =
        contact_of(plan.pushes[i].push) == contact_of(plan.pushes[i - 1].push);
    (splits ? inside : positions).push_back(i);
  }
  if (!plan.pushes.empty()) positions.push_back(plan.pushes.size());
  positions.insert(positions.end(), inside.begin(), inside.end());
  return positions;
}

bool make_roll(const Model& model, const Grasp& grasp, double dpsi, const Margin& margin,
               const TransitionOptions& options, PlannedPush& planned) {
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    if (make_roll(model, static_cast<int>(i), grasp, dpsi, margin, options, planned)) {
      return true;
    }
  }
  return false;
}

}  // namespace

double roll_slack(const Model& model, const Grasp& start, const Roll& roll,
                  const Margin& margin) {
  constexpr int kBits = 4;  // of a prism, whose corners take a millisecond each
  double slack = nominal_slack(model, start, roll);
  if (margin.is_none() || !(slack >= -kStickTolerance)) return slack;
  const double grip =
      roll.grip_force > 0.0 ? roll.grip_force : model.scene.gripper.grip_force;
  const PushContact& contact = model.contacts[roll.contact];
  const Vec2 aside = margin.grasp * rotated(start.X_HO.theta, contact.n + contact.t);
  const int bits = model.prism ? kBits : kBits + 1;
  Model corner = model;
  for (int i = 0; i < 1 << bits && slack >= 0.0; ++i) {
    const auto off = [&](int bit, double width) { return i >> bit & 1 ? width : -width; };
    corner.contacts[roll.contact].mu = contact.mu * (1.0 + off(0, margin.friction));
    for (std::size_t jaw = 0; jaw < 2; ++jaw) {
      const double share = 1.0 + off(1, 0.5 * margin.force);
      corner.scene.gripper.friction[jaw] = model.scene.gripper.friction[jaw] * share;
      if (model.cross_section) {
        corner.cross_section->friction[jaw] = model.cross_section->friction[jaw] * share;
      }
    }
    if (i % (1 << (bits - 1)) == 0) {
      resize_pads(1.0 + off(bits - 1, margin.torque_radius), model, corner);
    }
    Roll other = roll;
    other.grip_force = grip * (1.0 + off(2, 0.5 * margin.force));
    Grasp from = start;
    from.X_HO.x += off(3, aside.x());
    from.X_HO.y += off(3, aside.y());
    slack = std::min(slack, nominal_slack(corner, from, other));
  }
  return slack;
}

bool insert_roll(const Model& model, double dpsi, const Margin& margin,
                 const TransitionOptions& options, Plan& plan) {
  for (const std::size_t i : roll_positions(plan)) {
    const Grasp& grasp = i == 0 ? plan.start : plan.pushes[i - 1].end;
    PlannedPush roll;
    if (!make_roll(model, grasp, dpsi, margin, options, roll)) continue;
    plan.pushes.insert(plan.pushes.begin() + static_cast<std::ptrdiff_t>(i), roll);
    for (std::size_t k = i + 1; k < plan.pushes.size(); ++k) {
      plan.pushes[k].start.psi = roll.end.psi;
      plan.pushes[k].end.psi = roll.end.psi;
    }
    plan.goal = plan.pushes.back().end;
    return true;
  }
  return false;
}

}  // namespace prehensile
