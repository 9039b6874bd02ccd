/// Planar questions of every kind, and false answers made from right ones, which a
/// certificate must reject.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mechanics/instant.h"
#include "problems/random_instants.h"

namespace prehensile::testing {

/// False answers that were looked at, by the status of the right one.
using ForgedCounts = std::map<InstantStatus, int>;

inline void expect_every_status(ForgedCounts forged) {
  for (const InstantStatus status :
       {InstantStatus::kMoves, InstantStatus::kHolds, InstantStatus::kSeparated,
        InstantStatus::kAmbiguous, InstantStatus::kDynamic}) {
    EXPECT_GT(forged[status], 200) << name(status);
  }
}

/// A random instant whose pusher advances, moves along its face (exactly, or almost), or
/// recedes.
inline RandomInstant instant_of_any_drive(std::uint64_t seed, int i, int points) {
  RandomInstant q = random_instant(seed, i, {.points_per_pad = points});
  PlanarDrive& drive = q.drive;
  const double rate = drive.V_HP.head<2>().norm();
  const double side = i % 2 ? 1.0 : -1.0;
  const double along = std::atan2(drive.n_H.y(), drive.n_H.x()) + side * std::acos(0.0);
  const auto slide = [&](double towards) {
    const double angle = along - side * towards;
    drive.V_HP = {rate * std::cos(angle), rate * std::sin(angle), 0.0};
  };
  switch (i / 2 % 8) {
    case 0:
      slide(0.0);
      break;
    case 1:
      slide(1e-9);
      break;
    case 2:
      slide(-1e-9);
      break;
    case 3:
      drive.V_HP = -drive.V_HP;
      break;
    default:
      break;
  }
  return q;
}

struct Forgery {
  std::string what;
  PlanarInstant answer;
};

/// `units`: capacity [N], lever of the pads [m], push rate [m/s].
struct ForgeryUnits {
  double force, length, rate;
};

inline std::vector<Forgery> forgeries(const PlanarInstant& right, const PlanarWrench& w_g,
                                      const ForgeryUnits& units) {
  std::vector<Forgery> all;
  const auto add = [&](std::string what, auto change) {
    all.push_back({std::move(what), right});
    change(all.back().answer);
  };
  const auto claim = [&](InstantStatus status) {
    add("claims " + std::string(name(status)),
        [&](PlanarInstant& a) { a.status = status; });
  };
  using enum InstantStatus;
  for (const InstantStatus status : {kNotRun, kOutOfIterations, kBadInput, kJammed}) {
    claim(status);
  }
  if (right.status == kDynamic) {
    for (const InstantStatus status : {kMoves, kHolds, kSeparated, kAmbiguous}) {
      claim(status);
    }
    add("falls upwards", [](PlanarInstant& a) { a.evidence = -a.evidence; });
    add("falls nowhere", [](PlanarInstant& a) { a.evidence.setZero(); });
    for (int k = 0; k < 3; ++k) {
      add("falls by NaN", [&](PlanarInstant& a) { a.evidence[k] = kNan; });
    }
    return all;
  }

  for (int k = 0; k < 3; ++k) {
    add("twist NaN", [&](PlanarInstant& a) { a.V_HO[k] = kNan; });
    add("push NaN", [&](PlanarInstant& a) { a.w_push[k] = kNan; });
  }
  add("push force NaN", [](PlanarInstant& a) { a.push_force = kNan; });
  for (int i = 0; i < right.pusher_count; ++i) {
    add("load NaN", [&](PlanarInstant& a) { a.pusher[i].normal_force = kNan; });
    add("friction NaN", [&](PlanarInstant& a) { a.pusher[i].tangential_force = kNan; });
    add("gap rate NaN", [&](PlanarInstant& a) { a.pusher[i].normal_rate = kNan; });
    add("slip rate NaN", [&](PlanarInstant& a) { a.pusher[i].slip_rate = kNan; });
    add("mode without sense",
        [&](PlanarInstant& a) { a.pusher[i].mode = ContactMode::kSlip; });
    if (right.pusher[i].normal_force > 1e-3 * units.force) {
      add("open under load",
          [&](PlanarInstant& a) { a.pusher[i].mode = ContactMode::kOpen; });
    }
  }
  for (int j = 0; j < right.finger_count; ++j) {
    add("finger NaN", [&](PlanarInstant& a) { a.finger[j].force[j % 2] = kNan; });
  }
  add("no pusher", [](PlanarInstant& a) { a.pusher_count = 0; });
  add("another pusher", [](PlanarInstant& a) { a.pusher_count = 3 - a.pusher_count; });

  const auto is_ambiguous = [&](std::string what, const PlanarTwist& other,
                                const PlanarTwist& evidence) {
    add("ambiguous by " + std::move(what), [&](PlanarInstant& a) {
      a.status = kAmbiguous;
      a.other = other;
      a.evidence = evidence;
    });
  };
  const PlanarTwist none = PlanarTwist::Constant(kNan);
  const PlanarTwist odd = units.rate * PlanarTwist(0.6, 0.8, 0.9 / units.length);
  is_ambiguous("nothing", none, none);
  is_ambiguous("itself", right.V_HO, none);
  is_ambiguous("any twist", 100.0 * odd, none);
  is_ambiguous("a nearby twist", right.V_HO + 1e-3 * odd, none);
  is_ambiguous("no twist", none, PlanarTwist::Zero());

  const bool held = usable(right.status);
  const bool moves = units.rate * 1e-3 < right.V_HO.head<2>().norm();
  if (held) {
    // A translation, so small that its square is zero; gravity may be next to nothing.
    const Vec2 f = w_g.head<2>();
    const Vec2 down = f.norm() > 0.0 ? Vec2(f.normalized()) : Vec2(1.0, 0.0);
    for (const double size : {units.rate, 1e-170, 1e-300}) {
      if (f.norm() > 0.99 * units.force) continue;
      const PlanarTwist fall(size * down.x(), size * down.y(), 0.0);
      is_ambiguous("a fall that friction stops", none, fall);
      add("falls though held", [&](PlanarInstant& a) {
        a.status = kDynamic;
        a.evidence = fall;
      });
    }
  }
  const bool unheld = right.evidence.allFinite();
  if (moves || unheld) {
    for (const InstantStatus status : {kHolds, kSeparated}) claim(status);
  }
  if (unheld || (!held && !moves)) claim(kMoves);
  if (right.status == kMoves) claim(kNonuniqueForces);
  if (right.status == kHolds) claim(kMoves);
  if (right.status == kSeparated) {
    claim(kMoves);
    bool apart = true;  // By more than the accuracy of the certificate.
    for (int i = 0; i < right.pusher_count; ++i) {
      apart = apart && right.pusher[i].normal_rate > 1e-5 * units.rate;
    }
    if (apart) claim(kHolds);
  }
  return all;
}

}  // namespace prehensile::testing
