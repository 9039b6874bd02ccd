/// Results of suites as one HTML page.
#pragma once

#include <string>
#include <vector>

#include "apps/report_page.h"
#include "benchmarks/suite/summary.h"

namespace prehensile::apps {

/// A self-contained page: success, times, costs, failures, planners against each other,
/// and where all that comes from.
std::string benchmark_page(const suite::Results& results, const suite::Summary& summary);

/// What one number did from one file of results to the other.
enum class Change { kNone, kBetter, kWorse };
enum class Measure { kSuccess, kCost, kTime };

/// A line for each family and planner and each of success, cost and time that changed
/// beyond noise: a sign test on pairs of the same run, p among all tests of the list
/// below 0.01, and for times a median ratio off by more than 10 %.
struct Finding {
  Measure measure = Measure::kSuccess;
  Change change = Change::kNone;
  std::string words;
};
std::vector<Finding> findings(const suite::Results& before,
                              const std::vector<suite::Comparison>& comparisons);

std::string comparison_page(const suite::Results& before, const suite::Results& after,
                            const std::vector<suite::Comparison>& comparisons);

/// Charts of the page.
plot::Chart success_chart(const suite::Results& results, const suite::Summary& summary);
plot::Chart time_chart(const suite::Results& results, const suite::Summary& summary);
plot::Chart profile_chart(const suite::Results& results);
/// Best cost known over the best that any run found for that problem, and gap to the
/// bound [%], over processor time: median and quartiles of the runs that have a plan.
plot::Chart cost_chart(const suite::Results& results);
plot::Chart gap_chart(const suite::Results& results);

}  // namespace prehensile::apps
