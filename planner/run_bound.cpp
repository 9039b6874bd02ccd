#include "planner/run_bound.h"

#include <algorithm>

#include "planner/run_barrier.h"

namespace prehensile {
namespace {

constexpr double kFirstWeight = 0.03;  // of the barrier, relative to the cap
constexpr double kLastWeight = 1e-6;
constexpr double kPathWeight = 1e-4;  // for paths: inside the laws, not on their border
constexpr double kReduction = 0.2;
constexpr double kNearlyOptimal = 5e-3;

}  // namespace

double run_bound(const RunQuestion& question) noexcept {
  const RunProgram program(question);
  if (!program.is_ahead) return 0.0;
  RunBarrier barrier(program);
  barrier.start();
  double best = program.level.back();  // no way is shorter than it is deep
  double weight = kFirstWeight * question.cap;
  while (weight > kLastWeight * question.cap) {
    if (!barrier.centre(weight)) break;
    best = std::max(best, dual_bound(program, barrier.multipliers()));
    if (best >= question.cap) return question.cap;
    // What may still be proved to be no less than the cap is worth more steps.
    const double value = barrier.objective();
    if (value < question.cap && value - best <= kNearlyOptimal * question.cap) break;
    weight *= kReduction;
  }
  return std::min(best, question.cap);
}

bool run_path(const RunQuestion& question, RunPath& path) noexcept {
  constexpr double kMet = 1e-5;  // [m]
  const RunProgram program(question);
  if (!program.is_ahead) return false;
  RunBarrier barrier(program);
  barrier.start();
  const double last = std::max(kPathWeight * question.cap, question.last_weight);
  double weight = kFirstWeight * question.cap;
  while (weight > last) {
    if (!barrier.centre(weight)) return false;
    if (dual_bound(program, barrier.multipliers()) >= question.cap) return false;
    weight *= kReduction;
  }
  const RunLaw& law = question.laws->contacts[question.contact];
  const auto place = [&](double depth, double lateral) -> Vec2 {
    return question.start - depth * law.n + lateral * law.t;
  };
  for (int k = 0; k + 1 < kRunPieces; ++k) {
    path.places[k] = place(program.level[k], barrier.lateral(k));
  }
  path.end = place(barrier.end_depth(), barrier.end_lateral());
  path.share = barrier.share();
  return barrier.violation() <= kMet;
}

}  // namespace prehensile
