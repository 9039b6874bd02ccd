/// What every run of sticking pushes by one contact obeys, whatever its path: the
/// inequalities of the motion cone, summed over the path. Internal to the planner.
///
/// p is the place of the finger axis in O, dT = sqrt(|dp|^2 + (c dtheta)^2). The pads'
/// friction f (over F) deviates from the motion e = -dp/|dp| by what their section says
/// (pad_section.h). Divided by the force along e, the four inequalities of an instant
/// (two edges of the friction cone, two ends of the face) become, for constants that are
/// maxima over the section,
///     w_k.(-dp) >= -back_k dT                       k = 0, 1: w_k = mu' n +- t
///     C dtheta  >= cross(p - low, dp)  - slack_low
///     C dtheta  <= cross(p - high, dp) + slack_high
/// with a cone mu' widened by the greatest deviation (none of round pads), so that
/// back_k = 0 without gravity; a contact pressed on by gravity has back_k > 0, one that
/// has to lift some of the weight back_k < 0.
///
/// The pusher advances, at one end of the face at least, so that beside the face, where
/// both ends lie on one side of the finger axis, turning away from it is limited:
///     +-dtheta x distance of the finger axis from the face along it <= -n.dp + retreat
///     dT
/// where retreat dT is the most that the pusher may go back because gravity helps.
///
/// What survives a margin sticks for every member of its box: with the least friction, an
/// end of the face moved inwards, the motion turned towards an edge, the finger axis off
/// its place across the motion, which costs |dp| of it, and gravity at its worst. A
/// motion tilted about the begin of the plan moves the ends of the face (weak_contact.h).
///
/// The moment of the pads over C dtheta / |dp| is no constant: small for slow turning,
/// large for fast. Two sets of the laws of the ends take C from the one and from the
/// other; in the first the difference costs slack_k = a (dT - |dp|), in the second `low`
/// and `high` lie beyond the ends of the face, by what the moment may exceed C dtheta /
/// |dp|, per |dp|: inside the cone |dp| is at most sqrt(1 + mu'^2) times the advance
/// -n.dp, and where gravity lets the motion out of it, the rest costs some dT. With a
/// margin the one set is of the least torque radius, the other of the greatest.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "mechanics/sticking.h"
#include "planner/pads/pad_section.h"

namespace prehensile {

/// One end of a face: slack = (per_travel + slope x distance of p from it) dT + per_path
/// |dp|.
struct EndLaw {
  Vec2 place = Vec2::Zero();  ///< [m] low or high
  double per_travel = 0.0, slope = 0.0;
  double per_path = 0.0;  ///< <= 0
};

struct RunLaw {
  static constexpr int kSets = 2;
  Vec2 n, t;
  double mu = 0.0;        ///< of the widened cone
  std::array<Vec2, 2> w;  ///< its dual edges, mu n + t and mu n - t
  std::array<double, 2> back{};
  double jacobian = 0.0;         ///< |cross(w_0, w_1)|
  std::array<double, 2> face{};  ///< [m] least and greatest t.p of the face
  double level = 0.0;            ///< [m] n.p of the face
  double retreat() const { return std::max(0.0, 0.5 * (back[0] + back[1]) / mu); }
  std::array<std::array<EndLaw, 2>, kSets> end;  ///< of each set, low and high
};

struct RunLaws {
  std::array<double, RunLaw::kSets> C{};  ///< [m^2]
  double reach = 0.0;  ///< [m] up to which distance of an end the slope of slack holds
  std::vector<RunLaw> contacts;  ///< as in Model::contacts
  bool empty() const { return contacts.empty(); }
};

/// What of a margin the laws of a contact take up, which every push by it has to survive
/// (exact_check.h). Of a pusher that is a point its friction and tilt, without gravity:
/// that turns about such a pusher as the object does. No torque radius where the scene
/// has a point, as all laws of a scene have the same moments, and no tilt where it turns
/// the friction otherwise than the motion.
Margin margin_of_laws(const Model& model, const PushContact& contact,
                      const Margin& margin);

/// The laws over the ellipsoid, for which they are exact where the margin is none: those
/// of single instants, each contact with its own margin, of plans with this `begin` [m].
RunLaw ellipsoid_law(const StickContact& stick, const Margin& margin, const Vec2& begin);
std::array<double, RunLaw::kSets> ellipsoid_moments(double c, const Margin& margin);

/// Of runs that survive this margin, in plans that begin with the finger axis at `begin`
/// [m]. Empty where the pads do not admit such laws, or pushes need the mechanics in
/// space.
RunLaws run_laws(const Model& model, const Margin& margin, const Vec2& begin);

/// Of all runs that stick.
RunLaws run_laws(const Model& model);

}  // namespace prehensile
