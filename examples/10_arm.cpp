/// What a robot has to check before it moves: read an arm file back, look at the relative
/// motion of hand and pusher during each push, and follow it with the mechanics.
#include <cstdio>
#include <exception>

#include "io/arm_file.h"
#include "io/scene_file.h"
#include "planner/planner.h"

using namespace prehensile;

namespace {

/// The hand during one push, as the file has it.
std::vector<ArmPose> hand_during(const ArmMotion& motion, std::size_t push) {
  std::vector<ArmPose> poses;
  for (const ArmSample& sample : motion.samples) {
    const bool wanted =
        sample.phase == ArmPhase::kPush && sample.push == static_cast<int>(push);
    if (wanted) poses.push_back(sample.X_WH);
  }
  return poses;
}

int run(const char* scene_file, const char* arm_file) {
  const SceneFile file = read_scene(scene_file);
  const Model model = prepare(file.scene);
  const Plan plan = plan_regrasp(model);
  if (!plan.usable()) {
    std::printf("no plan: %s\n", plan.message.c_str());
    return 1;
  }
  ArmLimits limits;
  limits.push_speed = 0.01;
  const PlanFile written{file.scene, file.digest, plan};
  write_atomically(arm_file, arm_to_text(written, arm_motion(model, plan, limits), limits,
                                         ArmFormat::kCsv));

  const ArmMotion motion = read_arm_csv(arm_file);
  std::printf("%zu samples, %.2f s\n", motion.samples.size(), motion.samples.back().t);
  Grasp grasp = file.scene.start;
  for (std::size_t i = 0; i < plan.pushes.size(); ++i) {
    // The pusher stands still in W, so the poses of the hand alone say how it moves in
    // the hand. (Rolls move along z and are left out here.)
    const PushFromPoses found = push_from_poses(hand_during(motion, i), grasp.X_HO,
                                                as_linear(plan.pushes[i].push));
    std::printf("push %zu: %.2f mm, %.2f deg, straight within %.0f nm\n", i + 1,
                1e3 * found.push.travel, 57.29577951308232 * found.push.turn,
                1e9 * found.stray);
    const Transition done = apply(model, grasp, found.push);
    if (!done.completed()) {
      std::printf("the push of the file fails: %s\n", done.reason.data());
      return 1;
    }
    grasp = done.end;
  }
  const bool reached = reaches(*file.scene.goal, grasp);
  std::printf("the motion of the file %s the goal\n", reached ? "reaches" : "misses");
  return reached ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: 10_arm SCENE.yaml ARM.csv\n");
    return 2;
  }
  try {
    return run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
