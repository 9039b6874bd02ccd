/// Places for wanted motions as text, JSON, CSV and picture.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "primitives/place.h"

namespace prehensile::apps {

struct PlaceReport {
  const Model& model;
  std::string question;  ///< one line for people
  std::string scene;     ///< as typed, for the commands that repeat the push
  WantedMotion wanted;
  PlaceOptions options;
  PlaceAnswer answer;
  NearestMotion nearest;  ///< where the wanted motion was not found
};

std::string describe(const PlaceReport& report);
nlohmann::ordered_json to_json(const PlaceReport& report);

/// Margin against place, for every contact that can make the motion.
std::string to_csv(const PlaceReport& report);
std::string to_svg(const PlaceReport& report);

}  // namespace prehensile::apps
