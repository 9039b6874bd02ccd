#include "mechanics/cross_section.h"

#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

#include "tests/mechanics/cross_section_cases.h"

namespace prehensile {
namespace {

using testing::kJawModes;
using testing::Random;
using testing::units_of_force;

/// The domain of the closed forms: equal friction below 1, and a weight that the fingers
/// cannot carry.
struct HeavySection {
  CrossSectionModel model;
  CrossSectionDrive drive;
  double mu = 0.0;

  HeavySection(Random& random, JawMode mode) {
    mu = random.in(0.05, 0.95);
    model.radius = random.log_in(2e-3, 5e-2);
    model.grip_force = random.log_in(0.05, 50.0);
    model.friction = {mu, mu};
    model.jaw_mode = mode;
    drive.sheet_rate = random.log_in(1e-3, 1.0) * (random.chance(0.5) ? 1.0 : -1.0);
    drive.weight = 2.0 * mu * model.grip_force * random.in(1.01, 20.0);
  }

  bool downstream_is_fixed() const {
    return model.jaw_mode ==
           (drive.sheet_rate > 0.0 ? JawMode::kFixedJaw2 : JawMode::kFixedJaw1);
  }

  /// Traction of both slipping jaws: l_down - l_up = T and T = mu (l_up + l_down), with
  /// l_up + l_down = 2 N, l_up = N, or l_down = N.
  double traction() const {
    const double both = 2.0 * mu * model.grip_force;
    if (model.jaw_mode == JawMode::kCoupled) return both;
    return downstream_is_fixed() ? both / (1.0 - mu) : both / (1.0 + mu);
  }
  double load() const { return drive.weight + mu * traction(); }
  double threshold() const { return traction() / load(); }
};

TEST(CrossSection, RollsAboveTheThresholdWithTheForcesOfTheClosedForm) {
  Random random(1);
  for (int trial = 0; trial < 3000; ++trial) {
    HeavySection section(random, kJawModes[trial % 3]);
    const double threshold = section.threshold();
    EXPECT_NEAR(
        rolling_threshold(section.model, section.drive.sheet_rate, section.drive.weight),
        threshold, 1e-12 * threshold);
    section.drive.mu = threshold * (1.0 + 1e-5);
    const CrossSectionInstant now = solve_cross_section(section.model, section.drive);
    ASSERT_EQ(now.status, InstantStatus::kMoves) << trial;
    const double rate = section.drive.sheet_rate;
    const double unit = units_of_force(section.model, section.drive) + section.traction();
    EXPECT_NEAR(now.roll_rate * section.model.radius / rate, 1.0, 1e-9);
    EXPECT_NEAR(now.v_z / rate, 0.0, 1e-9);
    EXPECT_NEAR(now.v_u / rate, 0.0, 1e-9);
    const double sign = rate > 0.0 ? 1.0 : -1.0;
    EXPECT_NEAR(now.tangential_force[kSheet] / unit, sign * section.traction() / unit,
                1e-9);
    EXPECT_NEAR(now.normal_force[kSheet] / unit, section.load() / unit, 1e-9);
    EXPECT_EQ(now.mode[kSheet], ContactMode::kStick);
    EXPECT_EQ(now.mode[kJaw1],
              rate > 0.0 ? ContactMode::kSlipMinus : ContactMode::kSlipPlus);
    EXPECT_LE(cross_section_residual(section.model, section.drive, now), 1e-9);
  }
}

/// Forces on a still object over a slipping sheet with normal force l, by hand: the least
/// slack of the jaws' cones. No solver, no rows.
double slack_at_rest(const HeavySection& section, double l) {
  const double N = section.model.grip_force;
  const double traction = section.drive.mu * l;  // mirrored so that the sheet moves to +z
  double up = N;
  double down = N;
  if (section.model.jaw_mode == JawMode::kCoupled) {
    up = N - 0.5 * traction;
    down = N + 0.5 * traction;
  } else if (section.downstream_is_fixed()) {
    down = N + traction;
  } else {
    up = N - traction;
  }
  const double t_up = 0.5 * (section.drive.weight - l + traction);
  const double t_down = 0.5 * (section.drive.weight - l - traction);
  return std::min(
      {up, down, section.mu * up - std::abs(t_up), section.mu * down - std::abs(t_down)});
}

/// Ends of the range of l with slack, by a dense scan and bisection.
std::optional<std::array<double, 2>> range_at_rest(const HeavySection& section,
                                                   double high, int steps) {
  const auto end_between = [&](double inside, double outside) {
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (inside + outside);
      (slack_at_rest(section, middle) >= 0.0 ? inside : outside) = middle;
    }
    return inside;
  };
  double first = -1.0;
  double last = -1.0;
  for (int i = 0; i <= steps; ++i) {
    const double l = high * i / steps;
    if (slack_at_rest(section, l) < 0.0) continue;
    if (first < 0.0) first = l;
    last = l;
  }
  if (first < 0.0) return {};
  const double step = high / steps;
  return std::array{first > 0.0 ? end_between(first, first - step) : 0.0,
                    end_between(last, last + step)};
}

TEST(CrossSection, SlidesBelowTheThresholdWithTheForceRangeOfTheClosedForm) {
  Random random(2);
  for (int trial = 0; trial < 3000; ++trial) {
    HeavySection section(random, JawMode::kCoupled);
    section.drive.mu = section.threshold() * (1.0 - 1e-5);
    const CrossSectionInstant now = solve_cross_section(section.model, section.drive);
    ASSERT_EQ(now.status, InstantStatus::kNonuniqueForces) << trial;
    EXPECT_EQ(now.roll_rate, 0.0);
    EXPECT_EQ(now.mode[kSheet], section.drive.sheet_rate > 0.0 ? ContactMode::kSlipMinus
                                                               : ContactMode::kSlipPlus);
    const double both = 2.0 * section.mu * section.model.grip_force;
    const double W = section.drive.weight;
    const double mu_e = section.drive.mu;
    const double low = (W - both) / (1.0 - mu_e * (1.0 + section.mu));
    const double high = (W + both) / (1.0 + mu_e * (1.0 - section.mu));
    EXPECT_NEAR(now.sheet_force_low / W, low / W, 1e-6) << trial;
    EXPECT_NEAR(now.sheet_force_high / W, high / W, 1e-6) << trial;
  }
}

TEST(CrossSection, ForceRangeOfEveryJawModeMatchesAScan) {
  Random random(3);
  int compared = 0;
  for (int trial = 0; trial < 600; ++trial) {
    HeavySection section(random, kJawModes[trial % 3]);
    section.drive.weight *= random.chance(0.3) ? 0.1 : 1.0;  // light ones too
    section.drive.mu = section.threshold() * random.in(0.05, 0.95);
    const CrossSectionInstant now = solve_cross_section(section.model, section.drive);
    if (now.status != InstantStatus::kNonuniqueForces) continue;
    EXPECT_EQ(now.roll_rate, 0.0);
    if (!std::isfinite(now.sheet_force_high)) {
      EXPECT_GE(slack_at_rest(section, 1e6 * section.load()), 0.0);
      continue;
    }
    const auto range = range_at_rest(section, 1.2 * now.sheet_force_high, 20000);
    ASSERT_TRUE(range) << trial;
    EXPECT_NEAR((*range)[0], now.sheet_force_low, 1e-6 * now.sheet_force_high) << trial;
    EXPECT_NEAR((*range)[1], now.sheet_force_high, 1e-6 * now.sheet_force_high) << trial;
    ++compared;
  }
  EXPECT_GT(compared, 400);
}

TEST(CrossSection, StandsStillBelowTheThresholdInEveryJawMode) {
  Random random(4);
  for (int trial = 0; trial < 3000; ++trial) {
    HeavySection section(random, kJawModes[trial % 3]);
    section.drive.mu = section.threshold() * (1.0 - 1e-5);
    const CrossSectionInstant now = solve_cross_section(section.model, section.drive);
    ASSERT_EQ(now.status, InstantStatus::kNonuniqueForces) << trial;
    EXPECT_EQ(now.roll_rate, 0.0);
    EXPECT_EQ(now.v_z, 0.0);
    EXPECT_LE(cross_section_residual(section.model, section.drive, now), 1e-9);
  }
}

TEST(CrossSection, FingersThatCanCarryTheObjectMakeRollingAmbiguous) {
  Random random(5);
  for (int trial = 0; trial < 1000; ++trial) {
    HeavySection section(random, kJawModes[trial % 3]);
    section.drive.weight =
        2.0 * section.mu * section.model.grip_force * random.in(0.01, 0.99);
    section.drive.mu = section.threshold() * random.in(1.001, 3.0);
    const CrossSectionInstant now = solve_cross_section(section.model, section.drive);
    ASSERT_EQ(now.status, InstantStatus::kAmbiguous) << trial;
    EXPECT_GE(now.motions_found, 2);
    const double turn = section.drive.sheet_rate / section.model.radius;
    EXPECT_NEAR(now.roll_rate / turn, 1.0, 1e-9) << "the motion that rolls comes first";
    EXPECT_EQ(now.other.roll_rate, 0.0);
    EXPECT_LE(cross_section_residual(section.model, section.drive, now), 1e-9);
  }
}

TEST(CrossSection, FrictionlessAndLockedJaws) {
  CrossSectionModel model{.radius = 0.01, .grip_force = 2.0, .friction = {0.0, 0.0}};
  // Nothing resists the roll, so any friction of the sheet is enough.
  CrossSectionInstant now = solve_cross_section(model, {1e-6, 0.01, 1.0});
  EXPECT_EQ(now.status, InstantStatus::kMoves);
  EXPECT_NEAR(now.roll_rate, 1.0, 1e-12);
  EXPECT_NEAR(now.push_force, 1.0, 1e-12);
  // Without any friction at all nothing fixes the roll rate.
  EXPECT_EQ(solve_cross_section(model, {0.0, 0.01, 1.0}).status,
            InstantStatus::kAmbiguous);
  // A jaw with friction above 1 locks: no friction of the sheet rolls the object.
  model.friction = {1.2, 1.2};
  EXPECT_EQ(rolling_threshold(model, 0.01, 10.0),
            std::numeric_limits<double>::infinity());
  for (const double mu : {0.1, 0.3, 0.5, 0.8, 1.5, 5.0}) {
    now = solve_cross_section(model, {mu, 0.01, 10.0});
    EXPECT_TRUE(usable(now.status)) << mu;
    EXPECT_EQ(now.roll_rate, 0.0) << mu;
  }
  // With its position held as well the downstream jaw and the sheet wedge the object.
  model.jaw_mode = JawMode::kFixedJaw2;
  EXPECT_EQ(solve_cross_section(model, {1.5, 0.01, 10.0}).status, InstantStatus::kJammed);
}

TEST(CrossSection, GravityThatLifts) {
  const CrossSectionModel model{
      .radius = 0.01, .grip_force = 2.0, .friction = {0.5, 0.5}};
  // The jaws hold up to 2 mu N = 2 N.
  EXPECT_TRUE(usable(solve_cross_section(model, {0.4, 0.01, -1.9}).status));
  const CrossSectionInstant falls = solve_cross_section(model, {0.4, 0.01, -2.1});
  EXPECT_EQ(falls.status, InstantStatus::kDynamic);
  EXPECT_GT(falls.evidence.v_u, 0.0);
  EXPECT_EQ(rolling_threshold(model, 0.01, -2.1),
            std::numeric_limits<double>::infinity());
}

TEST(CrossSection, UnequalJawFriction) {
  Random random(9);
  int rolled = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    HeavySection section(random, kJawModes[trial % 3]);
    section.model.friction = {random.in(0.0, 0.95), random.in(0.0, 0.95)};
    section.drive.weight = 2.5 * section.model.grip_force;
    const double threshold =
        rolling_threshold(section.model, section.drive.sheet_rate, section.drive.weight);
    if (!std::isfinite(threshold)) continue;
    section.drive.mu = threshold * (1.0 + 1e-5);
    const CrossSectionInstant above = solve_cross_section(section.model, section.drive);
    section.drive.mu = threshold * (1.0 - 1e-5);
    const CrossSectionInstant below = solve_cross_section(section.model, section.drive);
    const double turn = section.drive.sheet_rate / section.model.radius;
    ASSERT_TRUE(usable(above.status) && usable(below.status)) << trial;
    EXPECT_NEAR(above.roll_rate / turn, 1.0, 1e-9) << trial;
    EXPECT_LT(below.roll_rate / turn, 1.0 - 1e-9) << trial;
    ++rolled;
  }
  EXPECT_GT(rolled, 2000);
}

/// Paper Fig. 9 and section VII-C: pure rolling needs much friction of the support and a
/// loose grip; otherwise the support slides.
TEST(CrossSection, RollsAboveAFrictionAndBelowAGrip) {
  CrossSectionModel model{.radius = 0.02, .grip_force = 1.0, .friction = {0.4, 0.4}};
  const double weight = 3.0;
  const auto rolls = [&](double mu) {
    return solve_cross_section(model, {mu, 0.05, weight}).roll_rate > 0.0;
  };
  int changes = 0;
  for (int i = 1; i < 150; ++i) changes += rolls(0.01 * i) != rolls(0.01 * (i + 1));
  EXPECT_EQ(changes, 1);
  EXPECT_FALSE(rolls(0.05));
  EXPECT_TRUE(rolls(1.5));
  changes = 0;
  bool before = true;
  for (int i = 1; i < 75; ++i) {  // the fingers carry the object from 3.75 N on
    model.grip_force = 0.05 * i;
    const bool now = rolls(0.5);
    changes += now != before;
    before = now;
  }
  EXPECT_EQ(changes, 1);
  EXPECT_FALSE(before);
}

TEST(CrossSection, RefusesBadNumbers) {
  const CrossSectionModel model{
      .radius = 0.01, .grip_force = 1.0, .friction = {0.5, 0.5}};
  const CrossSectionDrive drive{0.9, 0.01, 1.0};
  const auto status = [](const CrossSectionModel& m, const CrossSectionDrive& d) {
    return solve_cross_section(m, d).status;
  };
  EXPECT_EQ(status(model, drive), InstantStatus::kAmbiguous);
  for (const double bad : {0.0, -1.0, double{kNan}}) {
    CrossSectionModel m = model;
    m.radius = bad;
    EXPECT_EQ(status(m, drive), InstantStatus::kBadInput);
  }
  for (const double bad : {-1.0, double{kNan}, std::numeric_limits<double>::infinity()}) {
    CrossSectionModel m = model;
    m.grip_force = bad;
    EXPECT_EQ(status(m, drive), InstantStatus::kBadInput);
    m = model;
    m.friction[1] = bad;
    EXPECT_EQ(status(m, drive), InstantStatus::kBadInput);
    EXPECT_EQ(status(model, {bad, 0.01, 1.0}), InstantStatus::kBadInput);
  }
  EXPECT_EQ(status(model, {0.5, 0.0, 1.0}), InstantStatus::kBadInput);
  EXPECT_EQ(status(model, {0.5, 0.01, kNan}), InstantStatus::kBadInput);
  EXPECT_TRUE(std::isnan(
      cross_section_residual(model, {0.5, 0.01, kNan}, CrossSectionInstant{})));
}

}  // namespace
}  // namespace prehensile
