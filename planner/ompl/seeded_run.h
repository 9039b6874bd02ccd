/// Seeds of OMPL's random numbers. Internal to the OMPL room.
#pragma once

#include <cstdint>
#include <mutex>

#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include "scene/split_mix.h"

namespace prehensile {

/// OMPL's seeds are never 0 and have 32 bits; neighbouring seeds give unrelated streams.
inline std::uint_fast32_t ompl_seed(std::uint64_t seed) {
  return static_cast<std::uint32_t>(split_mix(seed) >> 32) | 1U;
}

/// While it lives, OMPL's random numbers follow from the seed and its log is quiet.
///
/// Both belong to the whole process in OMPL, so one random planner runs at a time. Every
/// generator that OMPL makes takes its seed from one sequence; `setSeed` starts that
/// sequence again. Once a generator exists OMPL also logs an error saying that this is
/// useless, which holds for generators that exist already: here all of them are made
/// later.
class SeededRun {
 public:
  explicit SeededRun(std::uint64_t seed)
      : lock_(one_at_a_time()), log_(ompl::msg::getOutputHandler()) {
    ompl::msg::noOutputHandler();
    ompl::RNG::setSeed(ompl_seed(seed));
  }
  ~SeededRun() { ompl::msg::useOutputHandler(log_); }
  SeededRun(const SeededRun&) = delete;
  SeededRun& operator=(const SeededRun&) = delete;

 private:
  static std::mutex& one_at_a_time() {
    static std::mutex mutex;
    return mutex;
  }

  std::lock_guard<std::mutex> lock_;
  ompl::msg::OutputHandler* log_;
};

}  // namespace prehensile
