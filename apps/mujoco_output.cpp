#include "apps/mujoco_output.h"

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/json_number.h"
#include "apps/option_checks.h"
#include "apps/plan_report.h"
#include "apps/table.h"
#include "io/scene_file.h"
#include "mjcf/mjcf.h"

namespace prehensile::apps {
namespace {

constexpr double kPosition = 1e-3;                         // [m]
constexpr double kAngle = 1.0 * std::numbers::pi / 180.0;  // [rad]

bool agrees(const mjcf::MujocoPush& push) {
  // Without a touch of the pusher there was no push that could agree.
  const bool is_untouched = push.force_error <= -1.0;
  return push.trouble.empty() && !is_untouched && push.position_error <= kPosition &&
         push.position_added <= kPosition && push.angle_error <= kAngle &&
         push.angle_added <= kAngle;
}

}  // namespace

void add_mjcf_option(CLI::App& command, std::string& file) {
  command
      .add_option("--mjcf", file, "also write scene and pushes for MuJoCo (MJCF, XML)")
      ->check(is_output());
}

std::string mjcf_text(const std::string& file, const Model& model,
                      const std::vector<PlannedPush>& pushes) {
  if (file.empty()) return {};
  try {
    return mjcf::file_text(model, pushes);
  } catch (const mjcf::NotCarried& error) {
    throw BadInput("--mjcf " + file + ": " + error.what());
  }
}

void add_mujoco_options(CLI::App& command, MujocoCheck& options) {
  CLI::Option* const wanted =
      command.add_flag("--mujoco", options.wanted,
                       "also replay the plan in MuJoCo: a second opinion, which shares "
                       "no code with the mechanics here");
  command
      .add_option(
          "--mujoco-speed-mm-s", options.speed_mm_s,
          "of the pad point that rubs most; 0: 2, and 0.2 where the loads of the pads "
          "shift")
      ->check(in_range(0.0, 100.0))
      ->capture_default_str()
      ->needs(wanted);
}

void check_mujoco_options(const MujocoCheck& options) {
  if (!options.wanted || mjcf::has_mujoco()) return;
  throw BadInput(
      "--mujoco: this build has no MuJoCo: expected one with PREHENSILE_MUJOCO=ON");
}

void check_carried(const MujocoCheck& options, const Model& model, const Plan& plan) {
  if (!options.wanted) return;
  try {
    mjcf::stage(model, plan.pushes, 1e-3 * options.speed_mm_s);
  } catch (const mjcf::NotCarried& error) {
    throw BadInput(std::string("--mujoco: ") + error.what());
  }
}

mjcf::MujocoReplay second_opinion(const Model& model, const Plan& plan,
                                  const MujocoCheck& options) {
  mjcf::MujocoOptions how{.speed = 1e-3 * options.speed_mm_s};
  const bool is_terminal = isatty(STDERR_FILENO) != 0;
  if (is_terminal) {
    how.on_push = [&plan](int push) {
      std::fprintf(stderr, "\rMuJoCo: %d of %zu pushes%s", push + 1, plan.pushes.size(),
                   push + 1 == static_cast<int>(plan.pushes.size()) ? "\n" : "");
    };
  }
  return mjcf::mujoco_replay(model, plan, how);
}

bool agrees(const mjcf::MujocoReplay& replay) {
  return std::all_of(replay.pushes.begin(), replay.pushes.end(),
                     [](const mjcf::MujocoPush& push) { return agrees(push); });
}

std::string describe(const Model& model, const Plan& plan,
                     const mjcf::MujocoReplay& replay) {
  std::string out = "MuJoCo " + mjcf::mujoco_version() +
                    text(" at %g mm/s: ", to_mm(replay.speed)) +
                    (agrees(replay) ? "agrees within 1 mm and 1 deg\n" : "DIFFERS\n");
  if (replay.pushes.empty()) return out + "no pushes to replay\n";
  Table table({"#", "pusher", "off mm", "off deg", "added mm", "added deg", "plan N",
               "MuJoCo N", "force %", "out of plane mm", "tilt deg"});
  for (std::size_t i = 0; i < replay.pushes.size(); ++i) {
    const mjcf::MujocoPush& push = replay.pushes[i];
    const PlannedPush& planned = plan.pushes[i];
    table.add({text("%zu", i + 1), contact_text(model, contact_of(planned.push)),
               text("%.3f", to_mm(push.position_error)),
               text("%.3f", to_deg(push.angle_error)),
               text("%.3f", to_mm(push.position_added)),
               text("%.3f", to_deg(push.angle_added)), text("%.2f", planned.push_force),
               text("%.2f", push.peak_force), text("%.2f", 100.0 * push.force_error),
               text("%.3f", to_mm(push.out_of_plane)), text("%.3f", to_deg(push.tilt))});
  }
  out += table.str();
  for (std::size_t i = 0; i < replay.pushes.size(); ++i) {
    if (replay.pushes[i].trouble.empty()) continue;
    out += text("push %zu: MuJoCo warns: ", i + 1) + replay.pushes[i].trouble + '\n';
  }
  if (replay.overhangs) {
    out +=
        "the pads overhang the face: there MuJoCo loses their points one by one, the "
        "mechanics their area\n";
  }
  return out;
}

nlohmann::ordered_json mujoco_json(const Plan& plan, const mjcf::MujocoReplay& replay) {
  nlohmann::ordered_json out = {
      {"version", mjcf::mujoco_version()}, {"agrees", agrees(replay)},
      {"speed", number(replay.speed)},     {"overhangs", replay.overhangs},
      {"in_space", replay.in_space},       {"pushes", nlohmann::ordered_json::array()}};
  for (std::size_t i = 0; i < replay.pushes.size(); ++i) {
    const mjcf::MujocoPush& push = replay.pushes[i];
    out["pushes"].push_back({{"agrees", agrees(push)},
                             {"end",
                              {{"x", number(push.end.X_HO.x)},
                               {"y", number(push.end.X_HO.y)},
                               {"theta", number(push.end.X_HO.theta)},
                               {"psi", number(push.end.psi)}}},
                             {"position_error", number(push.position_error)},
                             {"angle_error", number(push.angle_error)},
                             {"position_added", number(push.position_added)},
                             {"angle_added", number(push.angle_added)},
                             {"planned_force", number(plan.pushes[i].push_force)},
                             {"peak_force", number(push.peak_force)},
                             {"force_error", number(push.force_error)},
                             {"out_of_plane", number(push.out_of_plane)},
                             {"tilt", number(push.tilt)},
                             {"seconds", number(push.seconds)},
                             {"trouble", push.trouble}});
  }
  return out;
}

}  // namespace prehensile::apps
