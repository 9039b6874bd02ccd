#include "primitives/linear_push.h"

#include "primitives/push_run.h"
#include "primitives/spatial_push_instant.h"

namespace prehensile {

bool is_in_space(const Model& model, const LinearPush& push,
                 const TransitionOptions& options) noexcept {
  if (options.friction_model == FrictionModel::kEllipsoid) return false;
  if (options.level != PushLevel::kChoose) return options.level == PushLevel::kSpace;
  return model.push_needs_space(model.contacts[push.contact]);
}

Transition follow(const Model& model, const Grasp& start, const LinearPush& push,
                  const Guard& guard, const TransitionOptions& options,
                  std::vector<Sample>* trace) noexcept {
  if (is_in_space(model, push, options)) {
    PushRun<SpatialPushInstant> run(model, start, push, guard, options, trace);
    Transition transition = run.run();
    transition.in_space = true;
    return transition;
  }
  TransitionOptions in_plane = options;
  if (model.has_soft_points()) in_plane.friction_model = FrictionModel::kEllipsoid;
  return PushRun<PushInstant>(model, start, push, guard, in_plane, trace).run();
}

}  // namespace prehensile
