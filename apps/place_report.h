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

/// Slack against place of one contact at the best grip force.
struct PlaceCurve {
  std::string label;
  std::vector<double> place, nominal, robust;
};

/// Of every contact that can make the motion, but for points in space, which make it at
/// one place only.
std::vector<PlaceCurve> curves_of(const PlaceReport& report);

std::string to_csv(const std::vector<PlaceCurve>& curves);
std::string to_svg(const PlaceReport& report, const std::vector<PlaceCurve>& curves);

}  // namespace prehensile::apps
