/// How uncertain one push is: every source of uncertainty under its own name, and the
/// interval that they make together. Text, JSON, CSV and picture.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "apps/spread.h"

namespace prehensile::apps {

struct SpreadReport {
  std::string question;         ///< one line for people
  double level = 0.9;           ///< of the intervals
  std::string box_source;       ///< who says how wide the boxes are
  UncertaintyBox mechanics;     ///< frictions, forces, pressure, masses
  UncertaintyBox registration;  ///< places, directions, pose of the object in the hand
  Ensemble from_mechanics, from_registration, from_both;
  double floor_share = 0.0;    ///< of the motion: friction differs from spot to spot
  double scatter = 0.0;        ///< [m] that a calibration could not explain
  double scatter_angle = 0.0;  ///< [rad] likewise
  std::array<double, kDeviations> factor{1.0, 1.0, 1.0};
  bool has_factor = false;    ///< false: no factor is known, and none is used
  std::string factor_source;  ///< the data behind the factors

  /// The stated interval of a coordinate: quantiles of both boxes together, the floor in
  /// quadrature, times the factor, about the median.
  SpreadInterval interval(int part) const;
  double floor(int part) const;
};

std::string describe(const SpreadReport& report);
nlohmann::ordered_json to_json(const SpreadReport& report);
std::string to_csv(const SpreadReport& report);
std::string to_svg(const SpreadReport& report);

}  // namespace prehensile::apps
