#include "primitives/step_control.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace prehensile {
namespace {

constexpr double kNever = StepControl::kNever;

TEST(StepControl, LastStepEndsExactly) {
  StepControl control(1e-6, 0.3, 1e-6);
  double s = 0.0;
  int steps = 0;
  while (s < 1.0 && steps < 10) {
    const double h = control.next(s, kNever);
    ASSERT_TRUE(control.accepts(h, 1e-12));
    s = h == 1.0 - s ? 1.0 : s + h;
    ++steps;
  }
  EXPECT_EQ(s, 1.0);
  EXPECT_EQ(steps, 4);
  EXPECT_EQ(control.next(0.0, 0.05), 0.05);
}

TEST(StepControl, RefusedStepsShrinkUntilTheErrorFits) {
  StepControl control(1e-6, 1.0, 1e-9);
  double h = control.next(0.0, kNever);
  int refused = 0;
  // A method of fourth order with an error of 1 at full length.
  while (!control.accepts(h, std::pow(h, 5))) {
    const double shorter = control.next(0.0, kNever);
    EXPECT_LT(shorter, h);
    h = shorter;
    ASSERT_LT(++refused, 10);
  }
  EXPECT_LE(std::pow(h, 5), 1e-6 * std::max(h, 0.05));
  EXPECT_GT(control.next(h, kNever), 0.5 * h);
}

TEST(StepControl, StepsAsShortAsEventsAreTakenWhateverTheirError) {
  StepControl control(1e-6, 1.0, 1e-6);
  EXPECT_TRUE(control.accepts(1e-6, 1.0));
  EXPECT_FALSE(control.accepts(2e-6, 1.0));
}

TEST(StepControl, NoLastStepIsShortForNoReason) {
  StepControl control(1e-6, 1.0, 1e-6);
  ASSERT_FALSE(control.accepts(1.0, 1e-4));
  const double h = control.next(0.0, kNever);
  EXPECT_LT(h, 0.5);
  const double s = 1.0 - 1.2 * h;
  EXPECT_EQ(control.next(s, kNever), 1.0 - s);
  EXPECT_EQ(control.next(s, h), h);  // not beyond what the step may be
  control.land(h);
  EXPECT_EQ(control.next(s, kNever), h);
  EXPECT_EQ(control.next(1.0 - 1.5 * h, kNever), h);
}

TEST(StepControl, ForgetsRefusalsWhereAnotherMotionBegins) {
  StepControl control(1e-6, 0.2, 1e-6);
  ASSERT_FALSE(control.accepts(0.2, 1.0));
  EXPECT_LT(control.next(0.0, kNever), 0.1);
  control.renew();
  EXPECT_EQ(control.next(0.0, kNever), 0.2);
}

TEST(StepControl, LandsOnce) {
  StepControl control(1e-6, 0.2, 1e-6);
  control.land(0.013);
  EXPECT_EQ(control.next(0.0, kNever), 0.013);
  EXPECT_TRUE(control.accepts(0.013, 0.0));
  EXPECT_EQ(control.next(0.013, kNever), 0.2);
}

TEST(StepControl, ClosesInOnABlockAndStopsBeforeIt) {
  const double location = 1e-6;
  StepControl control(1e-6, 0.2, location);
  const double wall = 0.7312345;
  double s = 0.0;
  int steps = 0;
  for (bool stopped = false; !stopped && steps < 100; ++steps) {
    const double h = control.next(s, kNever);
    if (s + h > wall) {
      stopped = control.is_at_block(s, s + h);
    } else {
      s += h;
      control.passed(s);
    }
  }
  EXPECT_LT(steps, 60);
  EXPECT_LE(s, wall);
  EXPECT_NEAR(s, wall, 2.0 * location);
}

TEST(StepControl, FindsThatABlockIsGone) {
  StepControl control(1e-6, 0.2, 1e-6);
  ASSERT_FALSE(control.is_at_block(0.0, 0.1));
  double s = 0.0;
  for (int i = 0; i < 60 && s < 1.0; ++i) {
    const double h = control.next(s, kNever);
    s = h == 1.0 - s ? 1.0 : s + h;
    control.passed(s);
  }
  EXPECT_EQ(s, 1.0);
}

}  // namespace
}  // namespace prehensile
