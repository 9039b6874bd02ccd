/// The inequalities of a sticking instant at the worst of a margin's box, but for the
/// torque radius: for friction of isotropic pads over F, f along the motion and m [m]
/// about the finger axis. Internal to the closed forms.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "mechanics/sticking.h"

namespace prehensile {

/// A f + side m >= B.
struct StickRow {
  double A = 0.0, B = 0.0;
};

struct StickRows {
  int edges = 0;                 ///< 2, or 3 without friction
  std::array<StickRow, 3> edge;  ///< of the friction cone: side 0
  StickRow end_a, end_b;         ///< [m] of the face: side -1 and 1
};

/// What gravity asks of the row n, t of the force at most, over F: n f_n + t f_t >= this,
/// while it may be turned by `tilt` [rad].
inline double asked_by_gravity(const StickContact& contact, double n, double t,
                               double tilt) noexcept {
  const double gamma_n = contact.gamma.dot(contact.n);
  const double gamma_t = contact.gamma.dot(contact.t);
  return -least_turned(-(n * gamma_n + t * gamma_t), n * gamma_t - t * gamma_n, tilt);
}

/// What gravity asks of the moment about an end of the face at most, over F [m]: side -1
/// about a, 1 about b; the ends as moved by the margin. Its lever about an end is that of
/// the centre of mass.
inline double asked_about_end(const StickContact& contact, const Vec2& end, double side,
                              const Margin& margin) noexcept {
  const Vec2 lever = contact.p_OCom - end;
  return margin.centre_of_mass * contact.gamma.norm() -
         least_turned(-side * cross(lever, contact.gamma), lever.dot(contact.gamma),
                      margin.tilt);
}

/// The greatest of it over the margin's weights.
inline double most_asked(double asked, const Margin& margin) noexcept {
  return asked * (asked > 0.0 ? margin.most_weight() : margin.least_weight());
}

/// The least friction is the worst because the normal force is positive. The moments are
/// affine in m/F, in the places of pusher, finger axis and centre of mass, so the worst
/// of each is known beforehand. The finger axis counts for the drag only. A margin does
/// not concern the ends of a point pusher.
inline StickRows stick_rows(const StickContact& contact, const Vec2& p_OF, const Vec2& e,
                            const Margin& margin) noexcept {
  const double mu = contact.mu * std::max(0.0, 1.0 - margin.friction);
  const double e_n = e.dot(contact.n);
  const double e_t = e.dot(contact.t);
  const auto edge = [&](double n, double t) {  // the row n, t of force >= 0
    return StickRow{least_turned(n * e_n + t * e_t, n * e_t - t * e_n, margin.tilt),
                    most_asked(asked_by_gravity(contact, n, t, margin.tilt), margin)};
  };
  StickRows rows;
  rows.edge[rows.edges++] = edge(mu, -1.0);
  rows.edge[rows.edges++] = edge(mu, 1.0);
  // The edges of a cone without width allow pulling.
  if (mu == 0.0) rows.edge[rows.edges++] = edge(1.0, 0.0);

  const Margin none = Margin::none();
  const Margin& of_ends = contact.is_point ? none : margin;
  const auto end = [&](double side, const Vec2& place) {
    const Vec2 lever = p_OF - place;
    const double moment =
        least_turned(side * cross(lever, e), lever.dot(e), of_ends.tilt) - of_ends.grasp;
    return StickRow{moment,
                    most_asked(asked_about_end(contact, place, side, of_ends), of_ends)};
  };
  rows.end_a = end(-1.0, contact.a + of_ends.place * contact.t);
  rows.end_b = end(1.0, contact.b - of_ends.place * contact.t);
  return rows;
}

/// The kappas with which the pusher recedes at both face ends, at worst over the margin:
/// an open gap, perhaps without end; lo > hi: none. The normal rate at x is e_n - kappa
/// s_x / c with s_x the place of x along t from the finger axis, uncertain; omega/|v| =
/// kappa / c holds for all members of the box.
inline KappaSet::Interval receding_kappas(const StickContact& contact, const Vec2& p_OF,
                                          const Vec2& e, const Margin& margin) noexcept {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  const double place = contact.is_point ? 0.0 : margin.place + margin.grasp;
  KappaSet::Interval gap{-kEndless, kEndless};
  const double rate =
      contact.c * least_turned(e.dot(contact.n), e.dot(contact.t), margin.tilt);
  for (const double s : {(contact.a - p_OF).dot(contact.t) + place,
                         (contact.b - p_OF).dot(contact.t) - place}) {
    if (s > 0.0) gap.lo = std::max(gap.lo, rate / s);
    if (s < 0.0) gap.hi = std::min(gap.hi, rate / s);
    if (s == 0.0 && rate >= 0.0) return {kEndless, -kEndless};
  }
  return gap;
}

}  // namespace prehensile
