/// Plan files: JSON, version 1. Self-contained: the scene travels inside (as its complete
/// YAML text), so that `check PLAN.json` needs nothing else.
#pragma once

#include <filesystem>
#include <string>

#include "io/scene_file.h"
#include "planner/plan.h"

namespace prehensile {

struct PlanFile {
  Scene scene;
  std::string scene_digest;
  Plan plan;
};

/// The whole plan as JSON text; numbers round-trip exactly.
std::string plan_to_json(const PlanFile& file);

/// Parses and validates; throws BadInput with file, line or field, value and expectation.
PlanFile read_plan(const std::filesystem::path& file);
PlanFile parse_plan(const std::string& text, const std::string& label);

/// Writes text to a temporary beside `file`, then renames it; throws BadInput with the
/// reason of the system, leaving no file behind.
void write_atomically(const std::filesystem::path& file, const std::string& text);

/// For commands that work long before they write: throws BadInput where
/// `write_atomically` could not begin.
void check_writable(const std::filesystem::path& file);

/// The JSON Schema of plan files.
std::string plan_schema();

}  // namespace prehensile
