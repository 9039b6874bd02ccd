/// Arm motions as files that robots read: CSV with everything, TUM lines and a YAML list
/// of poses. Frames, units, the order of quaternions and what the plan promises to
/// survive are written into each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/plan_file.h"
#include "planner/arm/arm_motion.h"

namespace prehensile {

enum class ArmFormat { kCsv, kTum, kYaml };

/// By the extension: .csv; .tum or .txt; .yaml or .yml. Throws BadInput for others.
ArmFormat arm_format(const std::filesystem::path& file);

/// The text of a file with the motion of this plan.
///
/// CSV: lines of comments ("# key: value"), a line of column names, then one line per
/// sample: t, phase, push (from 1), grip_force, hand_{x,y,z,qx,qy,qz,qw},
/// tool_{x,y,z,qx,qy,qz,qw}, force_{x,y,z}, moment_{x,y,z}, guard_force. Where two phases
/// meet, each has a sample of that time. TUM: comments and "t x y z qx qy qz qw" of the
/// tool, nothing else; samples at the same time only once. YAML: a map with the same
/// comments as fields and a list of samples.
std::string arm_to_text(const PlanFile& plan, const ArmMotion& motion,
                        const ArmLimits& limits, ArmFormat format);

/// Reads the CSV form back. Throws BadInput naming line and column: unknown or missing
/// columns, numbers that are none, times that fall, phases that do not exist,
/// quaternions that are not of unit length.
ArmMotion parse_arm_csv(const std::string& text, const std::string& label);
ArmMotion read_arm_csv(const std::filesystem::path& file);

}  // namespace prehensile
