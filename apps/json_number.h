/// Numbers in JSON output: what is not finite becomes null.
#pragma once

#include <cmath>

#include <nlohmann/json.hpp>

namespace prehensile::apps {

inline nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value)
                              : nlohmann::ordered_json(nullptr);
}

template <typename Vector>
nlohmann::ordered_json numbers(const Vector& values) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (int i = 0; i < values.size(); ++i) out.push_back(number(values[i]));
  return out;
}

}  // namespace prehensile::apps
