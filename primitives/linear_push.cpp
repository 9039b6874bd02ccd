#include "primitives/linear_push.h"

#include "primitives/push_run.h"

namespace prehensile {

Transition follow(const Model& model, const Grasp& start, const LinearPush& push,
                  const Guard& guard, const TransitionOptions& options,
                  std::vector<Sample>* trace) noexcept {
  return PushRun(model, start, push, guard, options, trace).run();
}

}  // namespace prehensile
