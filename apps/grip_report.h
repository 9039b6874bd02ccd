/// The range of grip forces of a push, for people and for programs.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "primitives/grip_range.h"

namespace prehensile::apps {

std::string grip_text(const Model& model, const GripRange& range);
nlohmann::ordered_json grip_json(const GripRange& range);

}  // namespace prehensile::apps
