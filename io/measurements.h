/// Reader and writer of measurements: CSV with a header, one push or one reading of a
/// slip force per line. Units stand in the names of the columns (docs/files.md).
///
/// Nothing in a file is trusted: its size, its lines and cells are limited, numbers must
/// be finite and in range. Every fault names file, line, column, value and what was
/// expected, in one BadInput.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/scene_file.h"
#include "primitives/push_calibration.h"

namespace prehensile {

/// Either pushes or readings of slip forces; the other list is empty.
struct Measurements {
  std::vector<MeasuredPush> pushes;
  std::vector<SlipReading> readings;

  std::size_t size() const { return pushes.size() + readings.size(); }
};

inline constexpr std::size_t kLargestMeasurements = 2'000'000;  // bytes
inline constexpr std::size_t kMostMeasurements = 5000;          // lines

/// Reads a file; the model knows the names of pushers and faces. Throws BadInput.
Measurements read_measurements(const std::filesystem::path& file, const Model& model);

/// The same from text; `label` stands for the file's name in messages.
Measurements parse_measurements(const std::string& text, const std::string& label,
                                const Model& model);

/// Pushes in the same format, rounded to `decimals` after the point of mm, deg and N.
std::string pushes_to_csv(const std::vector<MeasuredPush>& pushes, const Model& model,
                          int decimals = 4);

}  // namespace prehensile
