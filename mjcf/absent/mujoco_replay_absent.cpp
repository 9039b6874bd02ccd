#include <stdexcept>

#include "mjcf/mujoco_replay.h"

namespace prehensile::mjcf {

MujocoReplay mujoco_replay(const Model&, const Plan&, const MujocoOptions&) {
  throw std::runtime_error("this build has no MuJoCo");
}

std::string load_error(const std::string&) { return "this build has no MuJoCo"; }

bool has_mujoco() { return false; }

std::string mujoco_version() { return {}; }

}  // namespace prehensile::mjcf
