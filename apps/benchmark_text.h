/// Results of suites as text, JSON and CSV.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "benchmarks/suite/summary.h"

namespace prehensile::apps {

/// A table for people, one line per family and planner, and one per planner.
std::string describe(const suite::Results& results, const suite::Summary& summary);

nlohmann::ordered_json to_json(const suite::Results& results,
                               const suite::Summary& summary);

/// One row with the names of its family and planner.
nlohmann::ordered_json to_json(const suite::Results& header, const suite::ResultRow& row);

/// Tables for other programs: every line ends with \n.
std::string summary_csv(const suite::Results& results, const suite::Summary& summary);
std::string runs_csv(const suite::Results& results);
std::string comparison_csv(const suite::Results& results,
                           const std::vector<suite::Comparison>& comparisons);

/// "wide_square" or "all".
std::string family_name(const suite::Results& results, int family);

/// What a group must reach: "success=0.99", or of one planner "push.success=0.99".
struct Floor {
  std::string planner;  ///< empty: every one
  std::string metric;   ///< success or decided
  double value = 0.0;
};
/// Throws BadInput.
Floor parse_floor(const std::string& text, const suite::Results& results);

/// A line for each total that misses the floor; empty: none does.
std::string missed(const Floor& floor, const suite::Results& results,
                   const suite::Summary& summary);

}  // namespace prehensile::apps
