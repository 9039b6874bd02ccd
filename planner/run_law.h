/// What every run of sticking pushes by one contact obeys, whatever its path: the
/// inequalities of the motion cone, summed over the path. Internal to the planner.
///
/// p is the place of the finger axis in O, dT = sqrt(|dp|^2 + (c dtheta)^2). The pads'
/// friction f (over F) deviates from the motion e = -dp/|dp| by what their section says
/// (pad_section.h). Divided by the force along e, the four inequalities
/// of an instant (two edges of the friction cone, two ends of the face) become, for
/// constants that are maxima over the section,
///     w_k.(-dp)      >= -back_k dT               k = 0, 1: w_k = mu' n +- t
///     C dtheta       >= cross(p - low, dp)  - slack_low dT
///     C dtheta       <= cross(p - high, dp) + slack_high dT
/// with a cone mu' widened by the greatest deviation, so that back_k = 0 without gravity;
/// a contact pressed on by gravity has back_k > 0, one that has to lift some of the
/// weight back_k < 0.
#pragma once

#include <array>
#include <vector>

#include "planner/pad_section.h"

namespace prehensile {

struct RunLaw {
  Vec2 n, t;
  double mu = 0.0;        ///< of the widened cone
  std::array<Vec2, 2> w;  ///< its dual edges, mu n + t and mu n - t
  std::array<double, 2> back{};
  double jacobian = 0.0;  ///< |cross(w_0, w_1)|
  Vec2 low, high;         ///< [m] ends of the face that bound dtheta from either side
  /// [m] slack of the ends where the finger axis is at no distance from them, and what it
  /// grows by per metre of distance.
  std::array<double, 2> slack{}, slack_slope{};
};

struct RunLaws {
  double C = 0.0;      ///< [m^2]
  double reach = 0.0;  ///< [m] up to which distance of an end the slope of slack holds
  std::vector<RunLaw> contacts;  ///< as in Model::contacts
  bool empty() const { return contacts.empty(); }
};

/// Empty where the pads do not admit such a law, or pushes need the mechanics in space.
RunLaws run_laws(const Model& model);

}  // namespace prehensile
