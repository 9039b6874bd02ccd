#include "mjcf/key_frames.h"

#include <array>

#include "mjcf/mjcf.h"

namespace prehensile::mjcf {
namespace {

using HandRates = std::array<double, kHandJoints>;

void add_key(XMLElement* frames, const std::string& name, const Stage& stage,
             const HandPose& hand, const Grasp& grasp, double grip,
             const HandRates& rates) {
  const Model& model = *stage.model;
  const PlanarPose& X_WH = hand.X_WH;
  const PlanarPose X_WO = compose(X_WH, grasp.X_HO);
  const auto slides = 2 * static_cast<std::size_t>(stage.points.count);
  std::vector<double> qpos{X_WH.x, X_WH.y, hand.z, X_WH.theta};
  qpos.insert(qpos.end(), slides, 0.0);
  qpos.insert(qpos.end(), {X_WO.x, X_WO.y, hand.z});
  for (const double q : wxyz(attitude(model, X_WO.theta, grasp.psi))) qpos.push_back(q);
  constexpr std::size_t kObjectRates = 6;
  std::vector<double> qvel(rates.begin(), rates.end());
  qvel.insert(qvel.end(), slides + kObjectRates, 0.0);
  XMLElement* key = child(frames, "key");
  set(key, "name", name);
  set(key, "qpos", text(qpos));
  set(key, "qvel", text(qvel));
  set(key, "ctrl", grip);
}

}  // namespace

void write_key_frames(XMLElement* root, const Stage& stage) {
  const Model& model = *stage.model;
  XMLElement* frames = child(root, "keyframe");
  if (stage.pushes.empty()) {
    const Grasp& start = model.scene.start;
    add_key(frames, "start", stage, {inverse(start.X_HO)}, start,
            model.scene.gripper.grip_force, {});
    return;
  }
  XMLElement* custom = child(root, "custom");
  for (std::size_t i = 0; i < stage.pushes.size(); ++i) {
    const PlannedPush& planned = stage.pushes[i];
    const std::string name = "push_" + std::to_string(i + 1);
    const double seconds = seconds_of(stage, planned);
    const HandPose from = hand_at(model, planned, 0.0);
    const HandPose to = hand_at(model, planned, 1.0);
    HandRates rates{};
    if (seconds > 0.0) {
      rates = {(to.X_WH.x - from.X_WH.x) / seconds, (to.X_WH.y - from.X_WH.y) / seconds,
               (to.z - from.z) / seconds, (to.X_WH.theta - from.X_WH.theta) / seconds};
    }
    add_key(frames, name, stage, from, planned.start, grip_force_of(model, planned.push),
            rates);
    XMLElement* numeric = child(custom, "numeric");
    set(numeric, "name", name + "_seconds");
    set(numeric, "data", seconds);
  }
}

}  // namespace prehensile::mjcf
