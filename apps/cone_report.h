/// Motion cones as text, JSON, CSV and picture.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "apps/cone_check.h"

namespace prehensile::apps {

struct ConeReport {
  const Model& model;
  Grasp grasp;
  int contact = 0;
  double place = 0.0;
  std::string question;  ///< one line for people
  UncertaintyBox box;
  int unusable = 0;       ///< members of the box that are no grasp at all
  bool in_space = false;  ///< the cone and its check are those of spatial instants
  MotionCone cone;
  ConeCheck check;
};

/// No motion sticks.
bool is_empty(const MotionCone& cone);

std::string describe(const ConeReport& report);
nlohmann::ordered_json to_json(const ConeReport& report);
std::string to_csv(const ConeReport& report);
std::string to_svg(const ConeReport& report);

}  // namespace prehensile::apps
