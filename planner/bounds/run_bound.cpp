#include "planner/bounds/run_bound.h"

#include <algorithm>

#include "planner/bounds/run_interior.h"

namespace prehensile {
namespace {

constexpr double kLastWeight = 1e-6;
constexpr int kMostSteps = 40;
constexpr double kNearlyOptimal = 5e-3;

}  // namespace

double run_bound(const RunQuestion& question) noexcept {
  const RunProgram program(question);
  if (!program.is_ahead) return 0.0;
  RunInterior search(program);
  const double last = kLastWeight * question.cap;
  double best = program.level.back();  // no way is shorter than it is deep
  for (int i = 0; i < kMostSteps && search.weight() > last; ++i) {
    if (!search.step(last)) break;
    best = std::max(best, dual_bound(program, search.multipliers()));
    if (best >= question.cap) return question.cap;
    // What may still be proved to be no less than the cap is worth more steps.
    const double value = search.objective();
    if (value < question.cap && value - best <= kNearlyOptimal * question.cap) break;
  }
  return std::min(best, question.cap);
}

bool run_path(const RunQuestion& question, RunPath& path) noexcept {
  constexpr double kMet = 1e-5;  // [m]
  const RunProgram program(question);
  if (!program.is_ahead) return false;
  RunInterior search(program);
  for (int i = 0; !search.is_central(question.weight); ++i) {
    if (i == kMostSteps || !search.step(question.weight)) return false;
    if (dual_bound(program, search.multipliers()) >= question.cap) return false;
  }
  const RunLaw& law = question.laws->contacts[question.contact];
  const auto place = [&](double depth, double lateral) -> Vec2 {
    return question.start - depth * law.n + lateral * law.t;
  };
  for (int k = 0; k + 1 < kRunPieces; ++k) {
    path.places[k] = place(program.level[k], search.lateral(k));
  }
  path.end = place(search.end_depth(), search.end_lateral());
  path.share = search.share();
  return search.violation() <= kMet;
}

}  // namespace prehensile
