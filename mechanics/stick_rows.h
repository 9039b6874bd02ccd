/// The inequalities of a sticking instant at the worst of a margin's box, but for the
/// torque radius: for friction of isotropic pads over F, f along the motion and m [m]
/// about the finger axis.
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

/// The least friction is the worst because the normal force is positive. The moments are
/// affine in m/F, in the places of pusher, finger axis and centre of mass, so the worst
/// of each is known beforehand. The finger axis counts for the drag only: of gravity the
/// lever about a face end is that of the centre of mass. A margin does not concern the
/// ends of a point pusher.
inline StickRows stick_rows(const StickContact& contact, const Vec2& p_OF, const Vec2& e,
                            const Margin& margin) noexcept {
  const auto worst = [&](double B) {  // over the weight
    return B > 0.0 ? margin.most_weight() * B : margin.least_weight() * B;
  };
  const double mu = contact.mu * std::max(0.0, 1.0 - margin.friction);
  const double e_n = e.dot(contact.n);
  const double e_t = e.dot(contact.t);
  const double gamma_n = contact.gamma.dot(contact.n);
  const double gamma_t = contact.gamma.dot(contact.t);
  const auto edge = [&](double n, double t) {  // the row n, t of force >= 0
    return StickRow{least_turned(n * e_n + t * e_t, n * e_t - t * e_n, margin.tilt),
                    worst(-least_turned(-(n * gamma_n + t * gamma_t),
                                        n * gamma_t - t * gamma_n, margin.tilt))};
  };
  StickRows rows;
  rows.edge[rows.edges++] = edge(mu, -1.0);
  rows.edge[rows.edges++] = edge(mu, 1.0);
  // The edges of a cone without width allow pulling.
  if (mu == 0.0) rows.edge[rows.edges++] = edge(1.0, 0.0);

  const Margin none = Margin::none();
  const Margin& of_ends = contact.is_point ? none : margin;
  const auto end = [&](double side, const Vec2& place) {
    const auto turned = [&](double sign, const Vec2& lever, const Vec2& vector) {
      return least_turned(sign * cross(lever, vector), lever.dot(vector), of_ends.tilt);
    };
    const double B = of_ends.centre_of_mass * contact.gamma.norm() -
                     turned(-side, contact.p_OCom - place, contact.gamma);
    return StickRow{turned(side, p_OF - place, e) - of_ends.grasp,
                    B > 0.0 ? of_ends.most_weight() * B : of_ends.least_weight() * B};
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
