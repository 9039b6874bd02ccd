/// Laws over random cross-sections, and the residual that judges them.
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "tests/mechanics/cross_section_cases.h"
#include "tests/support/no_heap.h"

namespace prehensile {
namespace {

using testing::AnySection;
using testing::NoHeapScope;
using testing::Random;
using testing::units_of_force;

void expect_all_verified(std::uint64_t seed, int trials, double tolerance) {
  Random random(seed);
  std::map<InstantStatus, int> seen;
  for (int trial = 0; trial < trials; ++trial) {
    const AnySection section(random);
    const CrossSectionInstant now = solve_cross_section(section.model, section.drive);
    ++seen[now.status];
    const double residual = cross_section_residual(section.model, section.drive, now);
    ASSERT_LE(residual, tolerance) << trial << ": " << name(now.status);
  }
  for (const InstantStatus status :
       {InstantStatus::kMoves, InstantStatus::kHolds, InstantStatus::kNonuniqueForces,
        InstantStatus::kAmbiguous, InstantStatus::kDynamic, InstantStatus::kJammed}) {
    EXPECT_GT(seen[status], trials / 100) << name(status);
  }
  EXPECT_EQ(seen.size(), 6u);
}

TEST(CrossSection, EveryRandomSectionEndsVerified) {
  expect_all_verified(6, 100000, 1e-8);
}

TEST(CrossSection, EveryRandomSectionEndsVerifiedFull) {
  expect_all_verified(7, 2000000, 1e-7);
}

/// The same section seen from behind: z turned round, jaws exchanged.
AnySection mirrored(AnySection section) {
  std::swap(section.model.friction[0], section.model.friction[1]);
  section.drive.sheet_rate *= -1.0;
  if (section.model.jaw_mode != JawMode::kCoupled) {
    section.model.jaw_mode = section.model.jaw_mode == JawMode::kFixedJaw1
                                 ? JawMode::kFixedJaw2
                                 : JawMode::kFixedJaw1;
  }
  return section;
}

void expect_near(double a, double b, double unit) {
  if (std::isinf(a) || std::isinf(b)) {
    EXPECT_EQ(a, b);
  } else {
    EXPECT_NEAR(a / unit, b / unit, 1e-6);
  }
}

/// `to` is what `from` becomes under the stated factors; mirror turns z round.
void expect_image(const CrossSectionInstant& from, const CrossSectionInstant& to,
                  double rate, double force, double length, bool mirror) {
  ASSERT_EQ(from.status, to.status);
  EXPECT_EQ(from.motions_found, to.motions_found);
  if (!usable(from.status)) return;
  const double sign = mirror ? -1.0 : 1.0;
  const double V = std::abs(rate);
  expect_near(from.v_z * rate * sign, to.v_z, V);
  expect_near(from.v_u * rate, to.v_u, V);
  expect_near(from.roll_rate * sign * rate / length, to.roll_rate, V / length);
  expect_near(from.jaw_rate * rate, to.jaw_rate, V);
  double largest = 1e-3;
  for (int i = 0; i < 3; ++i) largest = std::max(largest, to.normal_force[i]);
  for (int i = 0; i < 3; ++i) {
    const int j = mirror && i != kSheet ? 1 - i : i;
    const double turned = mirror && i == kSheet ? -1.0 : 1.0;
    expect_near(from.normal_force[i] * force, to.normal_force[j], largest);
    expect_near(turned * from.tangential_force[i] * force, to.tangential_force[j],
                largest);
  }
  expect_near(from.sheet_force_low * force, to.sheet_force_low, largest);
  expect_near(from.sheet_force_high * force, to.sheet_force_high, largest);
}

TEST(CrossSection, InvariantUnderMirrorAndUnits) {
  Random random(8);
  for (int trial = 0; trial < 5000; ++trial) {
    const AnySection section(random);
    const CrossSectionInstant now = solve_cross_section(section.model, section.drive);
    if (now.status == InstantStatus::kAmbiguous) continue;  // which is first may change
    const AnySection turned = mirrored(section);
    expect_image(now, solve_cross_section(turned.model, turned.drive), 1.0, 1.0, 1.0,
                 true);

    const double force = random.log_in(1e-6, 1e6);
    const double rate = random.log_in(1e-6, 1e6);
    const double length = random.log_in(1e-3, 1e3);
    AnySection scaled = section;
    scaled.model.grip_force *= force;
    scaled.model.radius *= length;
    scaled.drive.weight *= force;
    scaled.drive.sheet_rate *= rate;
    expect_image(now, solve_cross_section(scaled.model, scaled.drive), rate, force,
                 length, false);
    if (HasFailure()) FAIL() << trial;
  }
}

/// One number of a right answer changed: the residual must see it.
TEST(CrossSection, ResidualRejectsMutatedAnswers) {
  Random random(10);
  std::map<InstantStatus, int> mutated;
  for (int trial = 0; trial < 5000; ++trial) {
    const AnySection section(random);
    const CrossSectionInstant right = solve_cross_section(section.model, section.drive);
    const double F = units_of_force(section.model, section.drive);
    if (F == 0.0) continue;
    const double V = std::abs(section.drive.sheet_rate);
    const double sign = random.chance(0.5) ? 1e-3 : -1e-3;
    std::vector<CrossSectionInstant> wrong;
    const auto mutate = [&](auto change) {
      wrong.push_back(right);
      change(wrong.back());
    };
    if (usable(right.status)) {
      for (int i = 0; i < 3; ++i) {
        mutate([&](CrossSectionInstant& w) { w.normal_force[i] += sign * F; });
        mutate([&](CrossSectionInstant& w) { w.tangential_force[i] += sign * F; });
      }
      for (int i = 0; i < 3; ++i) {
        mutate([&](CrossSectionInstant& w) { w.normal_force[i] = kNan; });
        mutate([&](CrossSectionInstant& w) { w.tangential_force[i] = kNan; });
      }
      for (double CrossSectionInstant::*number :
           {&CrossSectionInstant::v_z, &CrossSectionInstant::v_u,
            &CrossSectionInstant::jaw_rate, &CrossSectionInstant::push_force,
            &CrossSectionInstant::sheet_force_low,
            &CrossSectionInstant::sheet_force_high}) {
        mutate([&](CrossSectionInstant& w) { w.*number = kNan; });
      }
      mutate([&](CrossSectionInstant& w) {  // A force so small that it balances anyhow.
        w.status = InstantStatus::kJammed;
        w.evidence_forces = {{0.0, 0.0, 1e-12 * F}, {0.0, 0.0, sign * 1e-10 * F}};
      });
      mutate([&](CrossSectionInstant& w) { w.push_force += sign * F; });
      mutate([&](CrossSectionInstant& w) {
        w.sheet_force_high = w.normal_force[kSheet] - 1e-3 * F;
      });
      mutate([&](CrossSectionInstant& w) { w.roll_rate = kNan; });
      mutate([&](CrossSectionInstant& w) {
        w.mode[kSheet] = w.mode[kSheet] == ContactMode::kStick ? ContactMode::kSlip
                                                               : ContactMode::kStick;
      });
    }
    if (right.status == InstantStatus::kNonuniqueForces) {
      mutate([&](CrossSectionInstant& w) { w.sheet_force_low *= 0.9; });
      if (right.sheet_force_low <= 1e-4 * F) wrong.pop_back();
      mutate([&](CrossSectionInstant& w) { w.sheet_force_high += 1e-2 * F; });
      if (std::isinf(right.sheet_force_high)) wrong.pop_back();
      mutate([&](CrossSectionInstant& w) { w.v_u -= 1e-3 * V; });
      mutate([&](CrossSectionInstant& w) { w.status = InstantStatus::kAmbiguous; });
    }
    if (right.status == InstantStatus::kMoves) {
      mutate([&](CrossSectionInstant& w) { w.status = InstantStatus::kHolds; });
    }
    if (right.status == InstantStatus::kAmbiguous) {
      mutate([&](CrossSectionInstant& w) { w.other = w.motion(); });
      mutate([&](CrossSectionInstant& w) { w.other_forces.normal[kJaw1] += sign * F; });
    }
    if (right.status == InstantStatus::kDynamic) {
      for (double CrossSectionMotion::*rate :
           {&CrossSectionMotion::v_z, &CrossSectionMotion::v_u,
            &CrossSectionMotion::roll_rate, &CrossSectionMotion::jaw_rate}) {
        mutate([&](CrossSectionInstant& w) { w.evidence.*rate = kNan; });
      }
      mutate([&](CrossSectionInstant& w) {
        for (double* rate : {&w.evidence.v_z, &w.evidence.v_u, &w.evidence.roll_rate,
                             &w.evidence.jaw_rate})
          *rate *= -1.0;
      });
      mutate([&](CrossSectionInstant& w) { w.status = InstantStatus::kJammed; });
    }
    if (right.status == InstantStatus::kJammed) {
      for (int i = 0; i < 3; ++i) {
        mutate([&](CrossSectionInstant& w) { w.evidence_forces.normal[i] = kNan; });
        mutate([&](CrossSectionInstant& w) { w.evidence_forces.tangential[i] = kNan; });
      }
      mutate(
          [&](CrossSectionInstant& w) { w.evidence_forces.tangential[kSheet] *= -1.0; });
      mutate([&](CrossSectionInstant& w) { w.evidence_forces.normal[kSheet] += F; });
      mutate([&](CrossSectionInstant& w) { w.status = InstantStatus::kDynamic; });
    }
    for (std::size_t i = 0; i < wrong.size(); ++i) {
      const double residual =
          cross_section_residual(section.model, section.drive, wrong[i]);
      EXPECT_FALSE(residual <= 1e-6)
          << trial << " mutation " << i << " of " << name(right.status);
      ++mutated[right.status];
    }
    if (HasFailure()) return;
  }
  EXPECT_EQ(mutated.size(), 6u);
}

TEST(CrossSection, NoHeap) {
  Random random(11);
  std::vector<AnySection> sections;
  sections.reserve(200);
  for (int i = 0; i < 200; ++i) sections.emplace_back(random);
  double worst = 0.0;
  const NoHeapScope scope;
  for (const AnySection& section : sections) {
    const CrossSectionInstant now = solve_cross_section(section.model, section.drive);
    worst = std::max(worst, cross_section_residual(section.model, section.drive, now));
  }
  EXPECT_LE(scope.allocations(), 0);
  EXPECT_LE(worst, 1e-8);
}

}  // namespace
}  // namespace prehensile
