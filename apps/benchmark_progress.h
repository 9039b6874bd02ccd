/// The live line of a suite on stderr.
#pragma once

#include <chrono>

#include "benchmarks/suite/run_suite.h"

namespace prehensile::apps {

class SuiteProgressLine {
 public:
  /// `interval` [s] between plain lines, where stderr is no terminal.
  explicit SuiteProgressLine(double interval);

  void show(const suite::RunProgress& progress);
  /// Clears the line.
  void end();
  double seconds() const;  ///< since the beginning

 private:
  using Clock = std::chrono::steady_clock;
  bool is_terminal_;
  bool is_shown_ = false;
  double interval_;
  double next_;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace prehensile::apps
