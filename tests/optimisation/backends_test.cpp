/// The libraries are in the build if its options say so. Other tests pass over what is
/// not built; this one sees to it that they do not do so by mistake.
#include <gtest/gtest.h>

#include "optimisation/nonlinear_program.h"

namespace prehensile {
namespace {

TEST(Backends, AreThoseOfTheBuildOptions) {
  EXPECT_EQ(nlopt_is_built(), PREHENSILE_WITH_NLOPT != 0);
  EXPECT_EQ(ipopt_is_built(), PREHENSILE_WITH_IPOPT != 0);
}

}  // namespace
}  // namespace prehensile
