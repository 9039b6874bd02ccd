/// The parts of bench_truth: what each asks of the data sets.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/truth_data.h"

namespace prehensile::benchmarks {

struct TruthOptions {
  std::filesystem::path data;
  std::string set;        ///< a set, or "calibrated", "few", "intervals"; empty: all
  std::string recording;  ///< only those whose name holds this text
  int points = 48;        ///< of a plate that lies flat
  int every = 1;          ///< one of so many contact positions, or pushes
  int samples = 60;       ///< of a box of uncertainty
  std::string file;
};

inline constexpr double kMcubeFriction = 0.25;           ///< as in the published models
inline constexpr double kMcubeFrictionRegistered = 0.2;  ///< of steel on steel, for
                                                         ///< corrected tips
inline constexpr double kMcubeTipRadius = 4.75e-3;       ///< [m]

/// The mcube pushes that the options select, with their contact positions: pushes of one
/// recording that follow each other and start from the same place in O, at several
/// angles.
struct McubePushes {
  TipPushes data;
  std::vector<int> position;            ///< of each push, from 0 in each recording
  std::vector<double> push_angle;       ///< [deg] of each, from the inward normal, >= 0
  std::vector<std::string> recordings;  ///< in the order of the file
};
McubePushes select_mcube(const TruthOptions& options);

/// End of a push whose tip frame lies off by `tip_offset` [m]; counts steps without an
/// answer.
PlanarPose predicted_end(const Plate& plate, const TipPush& push, SupportModel model,
                         const Tips& tips, const Vec2& tip_offset, int& failures,
                         double step = 2.5e-4);

/// Place of the tip frame in the object frame's world, from pushes that end in contact:
/// there the measured distance of tip and outline is the tip radius. Kinematics alone.
Vec2 tip_offset(const TipPushes& data, const std::vector<const TipPush*>& pushes);

/// The offset of each push's recording, estimated from the recording's other half.
std::vector<Vec2> offsets_of_other_half(const TipPushes& data);

/// Friction and radial pressure of each recording fitted on the even contact positions,
/// tested on the odd ones; then the other way round.
void run_mcube_calibrated(const TruthOptions& options, std::FILE* csv);

/// The same from 6 to 50 pushes of each recording.
void run_mcube_few(const TruthOptions& options, std::FILE* csv);

/// Intervals of a box times factors learnt on some shapes, tested on the others.
void run_mcube_intervals(const TruthOptions& options, std::FILE* csv);

}  // namespace prehensile::benchmarks
