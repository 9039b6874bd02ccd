/// A sequence that reaches a target grasp: read a scene, plan, replay the plan with the
/// exact mechanics, write it.
#include <cstdio>
#include <exception>

#include "io/plan_file.h"
#include "io/scene_file.h"
#include "planner/checks/replay.h"
#include "planner/planner.h"

using namespace prehensile;

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: 03_plan SCENE.yaml PLAN.json\n");
    return 2;
  }
  try {
    const SceneFile file = read_scene(argv[1]);
    const Model model = prepare(file.scene);

    PlanOptions options;
    options.seed = 7;  // same seed and budget, same plan
    const Plan plan = plan_regrasp(model, options);
    if (!plan.usable()) {
      std::printf("no plan: %s\n", plan.message.c_str());
      return 1;
    }
    for (const PlannedPush& push : plan.pushes) {
      std::printf("push to %.2f mm, %.2f mm, %.2f deg\n", 1e3 * push.end.X_HO.x,
                  1e3 * push.end.X_HO.y, 57.29577951308232 * push.end.X_HO.theta);
    }
    // The replay uses mechanics and primitives only: it knows nothing of the search.
    const Replay replayed = replay(model, plan);
    std::printf("replay %s\n", replayed.agrees ? "agrees" : "disagrees");
    write_atomically(argv[2], plan_to_json({file.scene, file.digest, plan}));
    return replayed.agrees ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
