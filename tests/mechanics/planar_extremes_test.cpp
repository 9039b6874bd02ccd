#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mechanics/planar_instant.h"
#include "problems/random_instants.h"
#include "tests/mechanics/instant_cases.h"

namespace prehensile {
namespace {

using testing::line_drive;
using testing::told;

// Stiff and extreme data: the same instants, pushed to the edge one way at a time.

struct Extreme {
  std::string what;
  std::function<void(RandomInstant&)> apply;
};

void scale_pads(RandomInstant& q, double factor) {
  for (int j = 0; j < q.grasp.count; ++j) {
    q.grasp.x[j] *= factor;
    q.grasp.y[j] *= factor;
  }
}

void scale_bounds(RandomInstant& q, double factor) {
  for (int j = 0; j < q.grasp.count; ++j) q.grasp.bound[j] *= factor;
}

void push_straight_past_centre(RandomInstant& q, double offset) {
  const Vec2 centre = -0.03 * q.drive.n_H + offset * q.drive.t_H();
  const double half = q.drive.count == 2 ? 0.01 : 0.0;
  q.drive = line_drive(centre, half, q.drive.n_H, q.drive.mu, 0.01 * q.drive.n_H);
  if (half == 0.0) q.drive.count = 1;
  q.grasp.w_g.setZero();
}

std::vector<Extreme> extremes() {
  std::vector<Extreme> all;
  const auto add = [&all](std::string what, std::function<void(RandomInstant&)> apply) {
    all.push_back({std::move(what), std::move(apply)});
  };
  for (const double mu : {0.0, 1e-6, 10.0, 1e3, 1e6}) {
    add("pusher friction " + std::to_string(mu), [=](auto& q) { q.drive.mu = mu; });
  }
  for (const double factor : {0.0, 1e-6, 1e3, 1e6, 1e12}) {
    add("weight x " + std::to_string(factor), [=](auto& q) { q.grasp.w_g *= factor; });
  }
  for (const double factor : {1e-12, 1e-6, 1e6}) {
    add("grip x " + std::to_string(factor), [=](auto& q) { scale_bounds(q, factor); });
  }
  for (const double factor : {1e-9, 1e-6, 1e-4, 1e-2}) {
    add("pads x " + std::to_string(factor), [=](auto& q) { scale_pads(q, factor); });
    add("pads without weight x " + std::to_string(factor), [=](auto& q) {
      scale_pads(q, factor);
      q.grasp.w_g.setZero();
    });
  }
  for (const double factor : {1e-9, 1e9}) {
    add("rate x " + std::to_string(factor), [=](auto& q) { q.drive.V_HP *= factor; });
  }
  for (const double approach : {0.0, 1e-9, -1e-9, -1e-3}) {
    add("along the face, approaching at " + std::to_string(approach), [=](auto& q) {
      const Vec2 v = 0.01 * q.drive.t_H() + approach * q.drive.n_H;
      q.drive.V_HP = {v.x(), v.y(), 0.0};
    });
  }
  add("receding", [](auto& q) { q.drive.V_HP = -q.drive.V_HP; });
  for (const double offset : {0.0, 1e-12, 1e-9, 1e-6, 1e-3}) {
    add("straight, off centre by " + std::to_string(offset),
        [=](auto& q) { push_straight_past_centre(q, offset); });
  }
  for (const double length : {0.0, 1e-9}) {
    add("line of length " + std::to_string(length),
        [=](auto& q) { q.drive.p_HC[1] = q.drive.p_HC[0] + length * q.drive.t_H(); });
  }
  add("turn about a pad point", [](auto& q) {
    const int j = q.grasp.count / 2;
    q.drive.V_HP = 0.5 * PlanarTwist(q.grasp.y[j], -q.grasp.x[j], 1.0);
  });
  add("turn beside the contact", [](auto& q) {
    const Vec2 p = q.drive.p_HC[0] + 1e-4 * q.drive.t_H();
    q.drive.V_HP = 0.5 * PlanarTwist(p.y(), -p.x(), 1.0);
  });
  add("far from the origin", [](auto& q) {
    const PlanarPose X{1e3, -2e3, 0.4};
    q.grasp = testing::moved(X, q.grasp);
    q.drive = testing::moved(X, q.drive);
  });
  return all;
}

TEST(PlanarInstant, ExtremesEndWithEvidence) {
  for (const Extreme& extreme : extremes()) {
    for (const int points : {1, 2, 4, 16}) {
      for (int i = 0; i < 150; ++i) {
        RandomInstant q = random_instant(31, i, {.points_per_pad = points});
        extreme.apply(q);
        const PlanarInstant answer = solve_planar(q.grasp, q.drive);
        const Certificate certificate = certify(q.grasp, q.drive, answer);
        EXPECT_TRUE(certificate.holds())
            << extreme.what << ", " << points << " points, " << i << ": "
            << name(answer.status) << " " << told(certificate);
      }
    }
  }
}

}  // namespace
}  // namespace prehensile
