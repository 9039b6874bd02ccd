/// The numbers are those of the published generator.
#include "scene/split_mix.h"

#include <gtest/gtest.h>

namespace prehensile {
namespace {

// The first outputs for the seed 1234567 that the reference implementation prints.
TEST(SplitMix, DrawsThePublishedNumbers) {
  std::uint64_t state = 1234567;
  for (const std::uint64_t published :
       {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
        4593380528125082431u, 16408922859458223821u}) {
    EXPECT_EQ(split_mix(state), published);
    state += kSplitMixStride;
  }
}

}  // namespace
}  // namespace prehensile
