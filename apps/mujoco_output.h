/// Scenes and pushes for MuJoCo, and what it says about a plan.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "mjcf/mujoco_replay.h"

namespace CLI {
class App;
}

namespace prehensile::apps {

/// --mjcf FILE.
void add_mjcf_option(CLI::App& command, std::string& file);

/// What goes into `file`; empty if `file` is. Throws BadInput for what MJCF cannot carry.
std::string mjcf_text(const std::string& file, const Model& model,
                      const std::vector<PlannedPush>& pushes);

/// --mujoco of `check`.
struct MujocoCheck {
  bool wanted = false;
  double speed_mm_s = 0.0;  ///< 0: as the scene needs
};
void add_mujoco_options(CLI::App& command, MujocoCheck& options);

/// Throws BadInput where this build has no MuJoCo: before any work.
void check_mujoco_options(const MujocoCheck& options);

/// Throws BadInput, if MuJoCo is wanted, for what MJCF cannot carry: before any replay.
void check_carried(const MujocoCheck& options, const Model& model, const Plan& plan);

/// Replays what is carried; shows on a terminal how far it is.
mjcf::MujocoReplay second_opinion(const Model& model, const Plan& plan,
                                  const MujocoCheck& options);

/// Every push adds less than 1 mm and 1 deg to the difference from the plan, so does the
/// whole, the pusher touched, and MuJoCo had no trouble.
bool agrees(const mjcf::MujocoReplay& replay);

std::string describe(const Model& model, const Plan& plan,
                     const mjcf::MujocoReplay& replay);
nlohmann::ordered_json mujoco_json(const Plan& plan, const mjcf::MujocoReplay& replay);

}  // namespace prehensile::apps
