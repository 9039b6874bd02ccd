/// Sums over the points of a patch, the only loops of the spatial solver. Internal to the
/// mechanics layer.
///
/// Four points go side by side in a fixed order, without branches, so the sums are the
/// same on every processor. All points of a patch share a frame, so that forces and
/// stiffness are summed in local coordinates (see spatial_scaled.h) and turned into the
/// hand frame once per patch.
#pragma once

#include "mechanics/spatial_scaled.h"

namespace prehensile {

/// Forces of all points, by lanes.
struct SpatialForces {
  alignas(32) ScaledSpatial::Column n, t, o;
  alignas(32) ScaledSpatial::Column s;  ///< spin moment / spin radius; soft patches only
};

/// Local wrench of a patch and - d wrench / d local rates.
struct PatchSums {
  LocalRates wrench;
  /// Symmetric: (v_n, w_t, w_o) for K_nn, (v_t, v_o, w_n) for K_tt, upper triangles by
  /// rows.
  std::array<double, 6> K_nn, K_tt;
  std::array<double, 9> K_tn;  ///< friction follows the normal force; by rows
};

namespace spatial_kernels {

using Lanes = Eigen::Array<double, ScaledSpatial::kLanes, 1>;
using Column = Eigen::Map<const Lanes, Eigen::Aligned32>;
using MutableColumn = Eigen::Map<Lanes, Eigen::Aligned32>;

inline constexpr double kTiny = 1e-200;  ///< keeps 0/0 away
inline constexpr double kHuge = 1e290;   ///< turns any positive number into 1, by min

/// Rates of the points at (a, b).
struct PointRates {
  Lanes n, t, o;
  PointRates(const Lanes& a, const Lanes& b, const LocalRates& y)
      : n(y[0] + y[1] * b - y[2] * a), t(y[3] - y[5] * b), o(y[4] + y[5] * a) {}
};

/// Projected forces at local rates y, written to `force`, and their sums. `r` is the
/// proximal step.
template <bool kSoft, bool kGiven>
PatchSums project(const ScaledSpatial& problem, const ScaledPatch& patch,
                  const LocalRates& y, const SpatialForces& centre, double r,
                  SpatialForces& force) {
  const double per_r = 1.0 / r;
  const double per_normal = 1.0 / (r + patch.R);
  const double spin = kSoft ? patch.e * y[5] * per_r : 0.0;
  const double e = patch.e;
  Lanes fn = Lanes::Zero(), mt = fn, mo = fn, ft = fn, fo = fn, mn = fn;
  Lanes k1 = fn, kb = fn, ka = fn, kbb = fn, kab = fn, kaa = fn;
  Lanes tt = fn, to = fn, oo = fn, tm = fn, om = fn, mm = fn;
  Lanes c00 = fn, c01 = fn, c02 = fn, c10 = fn, c11 = fn, c12 = fn;
  Lanes c20 = fn, c21 = fn, c22 = fn;
  const int last = patch.first + patch.padded;
  for (int j = patch.first; j < last; j += ScaledSpatial::kLanes) {
    const Lanes a = Column(&problem.a[j]);
    const Lanes b = Column(&problem.b[j]);
    const Lanes l0 = Column(&problem.preload[j]);
    const PointRates c(a, b, y);
    Lanes ln, k;
    if constexpr (kGiven) {
      ln = l0;
      k.setZero();
    } else {
      ln = ((r * Column(&centre.n[j]) - c.n + patch.R * l0) * per_normal).max(0.0);
      k = (ln * kHuge).min(1.0) * per_normal;
    }
    const Lanes yt = Column(&centre.t[j]) - c.t * per_r;
    const Lanes yo = Column(&centre.o[j]) - c.o * per_r;
    Lanes square = yt * yt + yo * yo + kTiny;
    Lanes ys = fn;
    if constexpr (kSoft) {
      ys = Column(&centre.s[j]) - spin;
      square += ys * ys;
    }
    const Lanes per_size = square.sqrt().inverse();
    const Lanes ratio = (patch.mu * ln * per_size).min(1.0);
    const Lanes slips = ((1.0 - ratio) * kHuge).min(1.0);
    const Lanes lt = ratio * yt;
    const Lanes lo = ratio * yo;
    MutableColumn(&force.n[j]) = ln;
    MutableColumn(&force.t[j]) = lt;
    MutableColumn(&force.o[j]) = lo;
    fn += ln;
    mt += b * ln;
    mo -= a * ln;
    ft += lt;
    fo += lo;
    mn += a * lo - b * lt;

    const Lanes d = ratio * per_r;
    const Lanes ut = yt * per_size;
    const Lanes uo = yo * per_size;
    const Lanes q = slips * d;
    const Lanes dtt = d - q * ut * ut;
    const Lanes dto = -q * ut * uo;
    const Lanes doo = d - q * uo * uo;
    tt += dtt;
    to += dto;
    oo += doo;
    const Lanes pt = a * dto - b * dtt;
    const Lanes po = a * doo - b * dto;
    tm += pt;
    om += po;
    mm += a * po - b * pt;
    Lanes us = fn;
    if constexpr (kSoft) {
      const Lanes ls = ratio * ys;
      MutableColumn(&force.s[j]) = ls;
      mn += e * ls;
      us = ys * per_size;
      const Lanes dts = -q * ut * us;
      const Lanes dos = -q * uo * us;
      tm += e * dts;
      om += e * dos;
      mm += e * (e * (d - q * us * us) + 2.0 * (a * dos - b * dts));
    }
    if constexpr (!kGiven) {
      const Lanes kpb = k * b;
      const Lanes kpa = k * a;
      k1 += k;
      kb += kpb;
      ka += kpa;
      kbb += kpb * b;
      kab += kpb * a;
      kaa += kpa * a;
      const Lanes g = slips * (patch.mu * k);
      const Lanes gt = g * ut;
      const Lanes go = g * uo;
      Lanes gm = a * go - b * gt;
      if constexpr (kSoft) gm += e * g * us;
      c00 += gt;
      c01 += gt * b;
      c02 -= gt * a;
      c10 += go;
      c11 += go * b;
      c12 -= go * a;
      c20 += gm;
      c21 += gm * b;
      c22 -= gm * a;
    }
  }
  PatchSums sums;
  sums.wrench[0] = fn.sum();
  sums.wrench[1] = mt.sum();
  sums.wrench[2] = mo.sum();
  sums.wrench[3] = ft.sum();
  sums.wrench[4] = fo.sum();
  sums.wrench[5] = mn.sum();
  sums.K_tt = {tt.sum(), to.sum(), tm.sum(), oo.sum(), om.sum(), mm.sum()};
  if constexpr (kGiven) {
    sums.K_nn.fill(0.0);
    sums.K_tn.fill(0.0);
  } else {
    sums.K_nn = {k1.sum(), kb.sum(), -ka.sum(), kbb.sum(), -kab.sum(), kaa.sum()};
    sums.K_tn = {c00.sum(), c01.sum(), c02.sum(), c10.sum(), c11.sum(),
                 c12.sum(), c20.sum(), c21.sum(), c22.sum()};
  }
  return sums;
}

/// Distance of forces and rates from the laws of contact, whatever the force centres;
/// the largest over the points. Step 1 in units (F0, V0).
inline double distance_from_laws(const ScaledSpatial& problem, const ScaledPatch& patch,
                                 const LocalRates& y, const SpatialForces& force) {
  Lanes worst = Lanes::Zero();
  const double spin = patch.e * y[5];
  for (int j = patch.first; j < patch.first + patch.padded; j += ScaledSpatial::kLanes) {
    const Lanes a = Column(&problem.a[j]);
    const Lanes b = Column(&problem.b[j]);
    const Lanes ln = Column(&force.n[j]);
    const Lanes lt = Column(&force.t[j]);
    const Lanes lo = Column(&force.o[j]);
    const PointRates c(a, b, y);
    if (!patch.given) {
      const Lanes gap = c.n + patch.R * (ln - Column(&problem.preload[j]));
      // Padding carries nothing, whatever its rate.
      const Lanes open = (ln - gap).max(0.0);
      Lanes off = (ln - open).abs();
      const int real = patch.first + patch.count - j;
      for (int i = std::max(0, real); i < ScaledSpatial::kLanes; ++i) off[i] = 0.0;
      worst = worst.max(off);
    }
    const Lanes yt = lt - c.t;
    const Lanes yo = lo - c.o;
    Lanes square = yt * yt + yo * yo + kTiny;
    Lanes ys = Lanes::Zero();
    if (patch.soft) {
      ys = Column(&force.s[j]) - spin;
      square += ys * ys;
    }
    const Lanes ratio = (patch.mu * ln / square.sqrt()).min(1.0);
    const Lanes et = lt - ratio * yt;
    const Lanes eo = lo - ratio * yo;
    Lanes off = et * et + eo * eo;
    if (patch.soft) {
      const Lanes es = Column(&force.s[j]) - ratio * ys;
      off += es * es;
    }
    worst = worst.max(off.sqrt());
  }
  return worst.maxCoeff();
}

}  // namespace spatial_kernels
}  // namespace prehensile
