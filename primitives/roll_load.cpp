#include "primitives/roll_load.h"

#include <algorithm>
#include <cmath>

#include "primitives/prism_attitudes.h"
#include "primitives/roll.h"

namespace prehensile {
namespace {

/// Of a cylinder: its axis stays in the middle of the hand, above the support's line.
RollLoad load_of(const Sample& sample) {
  return {.s = sample.s,
          .grasp = sample.grasp,
          .normal_force = sample.normal_force,
          .tangential_force = sample.tangential_force};
}

/// The section stays the same, and so does all that it bears.
void set_places_of_cylinder(const Model& model, const Grasp& start, const Roll& roll,
                            std::vector<RollLoad>& loads) {
  const PushContact& contact = model.contacts[static_cast<std::size_t>(roll.contact)];
  const double weight = roll_section(model, roll.contact, start).weight;
  const auto [section, drive] = section_roll(model, roll, weight);
  const double along = support_place(
      cylinder_loads(model, contact, start, solve_cross_section(section, drive), weight));
  for (RollLoad& load : loads) load.along = along;
}

void set_place(const PrismRoll& prism, RollLoad& load) {
  const PrismLook look = prism.look(prism.attitude(load.grasp.psi));
  const PrismContacts first = prism.contacts(prism.first());
  load.z_HO = prism.hand_z(first) - prism.hand_z(look.contacts);
  load.z_foot = load.z_HO + look.instant.forces.point[kSheet].x();
  load.along = support_place(prism.loads(look));
}

}  // namespace

std::vector<RollLoad> roll_loads(const Model& model, const Grasp& start,
                                 const Roll& roll) {
  std::vector<Sample> trace;
  if (!apply(model, start, roll, {}, &trace).completed()) return {};
  std::vector<RollLoad> loads;
  loads.reserve(trace.size());
  for (const Sample& sample : trace) loads.push_back(load_of(sample));
  if (model.prism) {
    const PrismRoll prism(model, start, roll);
    for (RollLoad& load : loads) set_place(prism, load);
  } else {
    set_places_of_cylinder(model, start, roll, loads);
  }
  return loads;
}

RollLoad roll_load_at(const std::vector<RollLoad>& loads, double s) {
  const auto after =
      std::ranges::lower_bound(loads, s, {}, [](const RollLoad& load) { return load.s; });
  if (after == loads.begin()) return loads.front();
  if (after == loads.end()) return loads.back();
  const RollLoad& a = *(after - 1);
  const RollLoad& b = *after;
  const double share = (s - a.s) / (b.s - a.s);
  const auto mix = [&](double from, double to) { return std::lerp(from, to, share); };
  const PlanarPose& X_a = a.grasp.X_HO;
  const PlanarPose& X_b = b.grasp.X_HO;
  return {.s = s,
          .grasp = {{mix(X_a.x, X_b.x), mix(X_a.y, X_b.y), mix(X_a.theta, X_b.theta)},
                    mix(a.grasp.psi, b.grasp.psi)},
          .normal_force = mix(a.normal_force, b.normal_force),
          .tangential_force = mix(a.tangential_force, b.tangential_force),
          .z_HO = mix(a.z_HO, b.z_HO),
          .z_foot = mix(a.z_foot, b.z_foot),
          .along = mix(a.along, b.along)};
}

}  // namespace prehensile
