/// Suite files: YAML, version 1. Every fault names file, line, field, value and what was
/// expected, as for scenes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/suite/suite.h"
#include "io/scene_file.h"

namespace prehensile::suite {

struct SuiteFile {
  Suite suite;
  std::string text;              ///< as read
  std::filesystem::path folder;  ///< where the files that it names lie
};

/// One word of letters, digits, _ - and ., at most 60 of them: what names are.
bool is_word(const std::string& text);

/// Reads a suite. `planners` are the names that entries may ask for. `folder`, unless
/// empty, stands for the suite's own folder as the place of the files that it names.
/// Throws BadInput.
SuiteFile read_suite(const std::filesystem::path& file,
                     const std::vector<std::string>& planners,
                     const std::filesystem::path& folder = {});

/// The same from text; `label` stands for the file's name in messages.
SuiteFile parse_suite(const std::string& text, const std::string& label,
                      const std::vector<std::string>& planners,
                      const std::filesystem::path& folder);

/// The JSON Schema of suite files, generated from the same field list as the reader.
std::string suite_schema();

}  // namespace prehensile::suite
