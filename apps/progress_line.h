/// The live line of a long search on stderr: one line that is updated on a terminal,
/// plain lines elsewhere.
#pragma once

#include <string>

#include "planner/progress.h"

namespace prehensile::apps {

class ProgressLine {
 public:
  /// `interval` [s] between plain lines; a search that is faster shows nothing.
  explicit ProgressLine(double interval);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const SearchProgress& progress);

 private:
  bool is_terminal_;
  bool is_shown_ = false;
  double interval_;
  double next_;  ///< [s] of the search at which the next line is due
};

/// "search: best J 1.523, bound 1.400, gap 8.8 %, 1.2e+06 tests, 9.1e+05 tests/s, 1.3 s"
std::string progress_text(const SearchProgress& progress);

}  // namespace prehensile::apps
