// Stiff and extreme data: the same instants, pushed to the edge one way at a time.
#include <functional>
#include <iomanip>
#include <iostream>

#include <gtest/gtest.h>

#include "mechanics/spatial_instant.h"
#include "problems/random_spatial.h"
#include "tests/mechanics/spatial_cases.h"

namespace prehensile {
namespace {

using testing::told;

struct Extreme {
  std::string what;
  std::function<void(SpatialProblem&)> apply;
  double allowed = 0.01;  ///< share of instants that may run out of iterations
};

void set_mu(SpatialProblem& q, bool pads, double mu) {
  for (int k = 0; k < q.patch_count; ++k) {
    if ((q.patch[k].body != ContactBody::kPusher) == pads) q.patch[k].mu = mu;
  }
}

void scale_grip(SpatialProblem& q, double factor) {
  q.grip_force *= factor;
  for (int i = 0; i < q.count; ++i) q.preload[i] *= factor;
  for (int k = 0; k < q.patch_count; ++k) {
    q.patch[k].compliance /= std::max(factor, 1e-6);
  }
}

void scale_points(SpatialProblem& q, bool pads_only, double factor) {
  for (int k = 0; k < q.patch_count; ++k) {
    const ContactPatch& patch = q.patch[k];
    if (pads_only && patch.body == ContactBody::kPusher) continue;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      q.x[i] *= factor;
      q.y[i] *= factor;
      if (!pads_only) q.z[i] *= factor;
    }
  }
}

void scale_size(SpatialProblem& q, double factor) {
  scale_points(q, false, factor);
  q.w_g.tail<3>() *= factor;
}

void scale_rate(SpatialProblem& q, double factor) {
  q.V_HP *= factor;
  for (int k = 0; k < q.patch_count; ++k) q.patch[k].compliance *= factor;
}

/// Turns the second half of the pusher's push so that its normal all but equals a pad's.
void tilt_pusher(SpatialProblem& q, double angle) {
  ContactPatch& patch = q.patch[2];
  const Vec3 n = patch.n;
  patch.n = std::sin(angle) * n + std::cos(angle) * Vec3::UnitZ();
  patch.t = patch.n.cross(n).normalized();
  for (int i = patch.first + 1; i < patch.first + patch.count; ++i) {
    const Vec3 p = q.p_HC(i) - patch.n.dot(q.p_HC(i) - q.p_HC(patch.first)) * patch.n;
    q.x[i] = p.x();
    q.y[i] = p.y();
    q.z[i] = p.z();
  }
}

std::vector<Extreme> extremes() {
  std::vector<Extreme> all;
  const auto add = [&all](std::string what, std::function<void(SpatialProblem&)> apply,
                          double allowed = 0.01) {
    all.push_back({std::move(what), std::move(apply), allowed});
  };
  const auto number = [](double x) {
    std::ostringstream text;
    text << x;
    return text.str();
  };
  for (const double mu : {0.0, 1e-6, 10.0, 1e3}) {
    add(
        "pusher friction " + number(mu), [=](auto& q) { set_mu(q, false, mu); }, 0.04);
  }
  for (const double mu : {0.0, 1e-6, 3.0, 10.0, 100.0}) {
    const auto all_mu = [=](auto& q) {
      set_mu(q, true, mu);
      set_mu(q, false, mu);
    };
    add("all friction " + number(mu), all_mu, mu > 1.0 ? 0.1 : 0.01);
  }
  for (const double factor : {0.0, 1e-6, 1e-3, 1e3}) {
    add("weight x " + number(factor), [=](auto& q) { q.w_g *= factor; });
  }
  for (const double factor : {0.0, 1e-6, 1e6}) {
    add("grip x " + number(factor), [=](auto& q) { scale_grip(q, factor); });
  }
  for (const double factor : {1e-3, 10.0}) {
    add("size x " + number(factor), [=](auto& q) { scale_size(q, factor); });
  }
  for (const double factor : {1e-6, 1e-4, 1e-2}) {
    add(
        "pads x " + number(factor), [=](auto& q) { scale_points(q, true, factor); },
        0.12);
  }
  for (const double factor : {1e-9, 1e9}) {
    add("rate x " + number(factor), [=](auto& q) { scale_rate(q, factor); });
  }
  for (const double approach : {0.0, 1e-9, -1e-9}) {
    add("along the face, approaching at " + number(approach), [=](auto& q) {
      q.V_HP.template head<3>() = 0.01 * q.patch[2].t + approach * q.patch[2].n;
    });
  }
  add("receding", [](auto& q) { q.V_HP = -q.V_HP; });
  add("turning pusher",
      [](auto& q) { q.V_HP.template tail<3>() = Vec3(0.3, -0.2, 0.5); });
  for (const double angle : {1e-3, 1e-6, 1e-9}) {
    add(
        "pusher normal parallel to the grip within " + number(angle),
        [=](auto& q) { tilt_pusher(q, angle); }, 0.06);
  }
  add("pad points doubled", [](auto& q) {
    for (int k = 0; k < 2; ++k) {
      const ContactPatch& patch = q.patch[k];
      for (int i = 1; i < patch.count; i += 2) {
        q.x[patch.first + i] = q.x[patch.first + i - 1];
        q.y[patch.first + i] = q.y[patch.first + i - 1];
      }
    }
  });
  add("far from the origin", [](auto& q) {
    for (int i = 0; i < q.count; ++i) {
      q.x[i] += 100.0;
      q.y[i] -= 200.0;
    }
    const Vec3 p(100.0, -200.0, 0.0);
    q.w_g.template tail<3>() += p.cross(Vec3(q.w_g.template head<3>()));
  });
  return all;
}

void run(int each) {
  std::cout << std::left << std::setw(56) << "extreme" << std::setw(10) << "solved"
            << std::setw(10) << "refused" << std::setw(10) << "out"
            << "wrong\n";
  for (const Extreme& extreme : extremes()) {
    int solved = 0;
    int refused = 0;
    int out = 0;
    int wrong = 0;
    for (int i = 0; i < each; ++i) {
      SpatialProblem problem =
          random_spatial(31, i,
                         {.points_per_pad = std::array{2, 4, 8, 16}[i % 4],
                          .acceleration = i % 2 == 0 ? 0.0 : 0.1});
      extreme.apply(problem);
      const SpatialInstant answer = solve_spatial(problem);
      if (answer.status == InstantStatus::kOutOfIterations) {
        ++out;
        continue;
      }
      const SpatialCertificate certificate = certify(problem, answer);
      if (!certificate.holds()) {
        if (++wrong < 3) {
          ADD_FAILURE() << extreme.what << " " << i << " " << name(answer.status) << ": "
                        << told(certificate);
        }
        continue;
      }
      ++(usable(answer.status) ? solved : refused);
    }
    std::cout << std::left << std::setw(56) << extreme.what << std::setw(10) << solved
              << std::setw(10) << refused << std::setw(10) << out << wrong << "\n";
    EXPECT_EQ(wrong, 0) << extreme.what;
    EXPECT_LE(out, 1 + extreme.allowed * each) << extreme.what;
  }
}

TEST(SpatialInstant, ExtremesEndWithEvidence) { run(16); }

TEST(SpatialInstant, FullExtremesEndWithEvidence) { run(300); }

}  // namespace
}  // namespace prehensile
