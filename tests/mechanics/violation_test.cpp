#include "mechanics/violation.h"

#include <gtest/gtest.h>

#include "mechanics/instant.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

TEST(Violation, TheWorstOfAllIsNotANumber) {
  EXPECT_TRUE(std::isnan(worse(kNan, 1.0)));
  EXPECT_TRUE(std::isnan(worse(1.0, kNan)));
  EXPECT_TRUE(std::isnan(worst_of({1.0, kNan, 2.0})));
  EXPECT_EQ(worst_of({-1.0, -2.0}), 0.0);
  EXPECT_EQ(worst_of({1.0, 3.0, 2.0}), 3.0);
}

TEST(Violation, SoIsTheTightestSlack) {
  EXPECT_TRUE(std::isnan(tighter(kNan, 1.0)));
  EXPECT_TRUE(std::isnan(tighter(1.0, kNan)));
  EXPECT_EQ(tighter(1.0, -2.0), -2.0);
  EXPECT_EQ(tighter(-2.0, 1.0), -2.0);
  EXPECT_EQ(tighter(kInfinity, 1.0), 1.0);
}

}  // namespace
}  // namespace prehensile
