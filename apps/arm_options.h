/// The options of `plan` that write what the robot has to do.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/arm_file.h"

namespace CLI {
class App;
}

namespace prehensile::apps {

struct ArmOptions {
  std::vector<std::string> files;  ///< by extension: .csv, .tum, .yaml
  ArmLimits limits;
  double push_speed_mm = 20.0, approach_speed_mm = 30.0, transit_speed_mm = 100.0;
  double turn_speed_deg = 30.0;
  std::optional<double> clearance_mm;  ///< unset: the approach of the scene's obstacles,
                                       ///< or that of ArmLimits
};
void add_arm_options(CLI::App& command, ArmOptions& options);

/// Throws BadInput for a file whose format is unknown, before anything is planned.
void check_arm_files(const ArmOptions& options);

/// Writes every file; a line for people for each.
std::string write_arm_files(const ArmOptions& options, const Model& model,
                            const PlanFile& plan);

}  // namespace prehensile::apps
