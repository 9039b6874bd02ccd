#include "planner/roll_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "primitives/roll.h"

namespace prehensile {
namespace {

/// Grips that are tried, as the share of the weight that the fingers could carry.
constexpr std::array<double, 6> kCarriedShares = {0.8, 0.6, 0.4, 0.2, 0.1, 0.05};

double weight_on(const Model& model, const PushContact& contact) {
  return -model.mass * contact.g_O.dot(contact.n);
}

/// The roll of this contact at a grasp, with the tightest grip within the margin; false
/// if it cannot.
bool make_roll(const Model& model, int contact, const Grasp& grasp, double dpsi,
               const Margin& margin, const TransitionOptions& options,
               PlannedPush& planned) {
  const RollSection section = roll_section(model, contact, grasp);
  if (!section.possible) return false;
  const CrossSectionModel& constants = *model.cross_section;
  Roll roll{.contact = contact, .travel = dpsi / section.psi_per_travel};
  const double friction = constants.friction[0] + constants.friction[1];
  for (const double share : kCarriedShares) {
    if (roll_slack(model, roll, margin) >= 0.0) break;
    roll.grip_force = friction > 0.0 ? share * section.weight / friction : 0.0;
  }
  if (roll_slack(model, roll, margin) < 0.0) return false;
  const Transition rolled = apply(model, grasp, roll, options);
  planned.push = roll;
  planned.start = grasp;
  planned.end = rolled.end;
  return rolled.completed();
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

double roll_slack(const Model& model, const Roll& roll, const Margin& margin) {
  if (!model.cross_section) return -std::numeric_limits<double>::infinity();
  CrossSectionModel section = *model.cross_section;
  if (roll.grip_force > 0.0) section.grip_force = roll.grip_force;
  section.grip_force *= 1.0 + margin.force;
  const PushContact& contact = model.contacts[roll.contact];
  const double weight = weight_on(model, contact);
  if (!(weight > 0.0)) return -std::numeric_limits<double>::infinity();
  const double carried = (section.friction[0] + section.friction[1]) * section.grip_force;
  const double threshold = rolling_threshold(section, roll.travel, weight);
  const double friction = contact.mu * (1.0 - margin.friction);
  return std::min(friction - threshold, 1.0 - carried / weight);
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
