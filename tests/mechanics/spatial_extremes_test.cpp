// Stiff and extreme data: the same instants, pushed to the edge one way at a time.
#include <iomanip>
#include <iostream>

#include <gtest/gtest.h>

#include "mechanics/spatial_instant.h"
#include "problems/extreme_spatial.h"
#include "tests/mechanics/spatial_cases.h"

namespace prehensile {
namespace {

using testing::told;

void run(int each) {
  std::cout << std::left << std::setw(56) << "extreme" << std::setw(10) << "solved"
            << std::setw(10) << "refused" << std::setw(10) << "out"
            << "wrong\n";
  for (const SpatialExtreme& extreme : spatial_extremes()) {
    int solved = 0;
    int refused = 0;
    int out = 0;
    int wrong = 0;
    for (int i = 0; i < each; ++i) {
      const SpatialProblem problem = extreme_spatial(
          extreme, 31, i, std::array{2, 4, 8, 16, 64}[i % 5], i % 2 == 0 ? 0.0 : 0.1);
      const SpatialInstant answer = solve_spatial(problem);
      if (answer.status == InstantStatus::kOutOfIterations) {
        ++out;
        continue;
      }
      if (answer.status == InstantStatus::kBadInput && extreme.group == "denormal") {
        ++refused;
        continue;
      }
      const SpatialCertificate certificate = certify(problem, answer);
      if (!certificate.holds()) {
        if (++wrong < 3) {
          ADD_FAILURE() << extreme.name << " " << i << " " << name(answer.status) << ": "
                        << told(certificate);
        }
        continue;
      }
      EXPECT_TRUE(!extreme.expected || extreme.expected(answer))
          << extreme.name << " " << i << " " << name(answer.status);
      ++(usable(answer.status) ? solved : refused);
    }
    std::cout << std::left << std::setw(56) << extreme.name << std::setw(10) << solved
              << std::setw(10) << refused << std::setw(10) << out << wrong << "\n";
    EXPECT_EQ(wrong, 0) << extreme.name;
    EXPECT_LE(out, 1 + extreme.allowed * each) << extreme.name;
  }
}

TEST(SpatialInstant, ExtremesEndWithEvidence) { run(16); }

TEST(SpatialInstant, FullExtremesEndWithEvidence) { run(300); }

}  // namespace
}  // namespace prehensile
