/// Readers of the public pushing experiments that the mechanics is held against. The data
/// stays in its folder; nothing of it is part of the project.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "problems/pushed_plate.h"

namespace prehensile::benchmarks {

/// One push of a plate by a round tip, and what the plate did.
struct TipPush {
  std::string recording;  ///< pushes of one recording share plate, board and set-up
  int plate = 0;          ///< index in TipPushes::plates
  PlanarPose X_WO_start, X_WO_end;
  std::vector<TipPlaces> path;        ///< of the tip centre [m], in W
  std::vector<PlanarPose> published;  ///< end poses of published fitted models, if any
};

struct TipPushes {
  std::vector<Plate> plates;
  std::vector<TipPush> pushes;
};

/// One push by two fingers that move as one rigid body, on a plate that may follow it.
struct LinePush {
  std::string recording;
  TipPlaces fingers;           ///< at the start [m], in O, which is W at the start
  PlanarTwist V_OP;            ///< commanded twist in O, per unit of the push
  double turn = 0.0;           ///< [rad] commanded
  Vec2 centre = Vec2::Zero();  ///< [m] of the commanded rotation; unused if `turn` is 0
  PlanarPose commanded, measured;  ///< X_WO at the end
};

struct LinePushes {
  Plate plate;
  std::vector<LinePush> pushes;
};

/// Read from the folder of each set. Throw std::runtime_error with file, line and what is
/// wrong.
TipPushes read_pin_pushes(const std::filesystem::path& folder);
TipPushes read_mcube_pushes(const std::filesystem::path& folder, int points);
LinePushes read_line_pushes(const std::filesystem::path& folder);

}  // namespace prehensile::benchmarks
