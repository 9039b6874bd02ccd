#include "apps/option_checks.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>

#include "apps/table.h"
#include "io/plan_file.h"
#include "io/scene_file.h"

namespace prehensile::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOutput = "output";

bool is_for_output(CLI::Option& option) {
  try {
    return option.get_validator(kOutput) != nullptr;
  } catch (const CLI::OptionNotFound&) {
    return false;
  }
}

bool are_same_file(const std::string& one, const std::string& other) {
  std::error_code absent;
  if (fs::equivalent(one, other, absent)) return true;
  const fs::path first = fs::weakly_canonical(one, absent);
  return !first.empty() && first == fs::weakly_canonical(other, absent);
}

}  // namespace

CLI::Validator in_range(double low, double high) {
  const std::string range = text("%g - %g", low, high);
  return {[low, high, range](std::string& given) {
            double value = 0.0;
            const bool is_number = CLI::detail::lexical_cast(given, value);
            // Not a number is neither below nor above.
            if (is_number && value >= low && value <= high) return std::string();
            return given + ": expected a number in [" + range + ']';
          },
          "FLOAT in [" + range + ']'};
}

CLI::Validator is_seed() {
  return {[](std::string& given) {
            std::uint64_t value = 0;
            const char* end = given.data() + given.size();
            const auto [rest, fault] = std::from_chars(given.data(), end, value);
            if (fault == std::errc() && rest == end) return std::string();
            return given + ": expected a whole number from 0 to 18446744073709551615";
          },
          ""};
}

CLI::Validator is_output() {
  return {[](std::string& given) {
            return given.empty() ? std::string("expected the name of a file to write")
                                 : std::string();
          },
          "", kOutput};
}

void check_outputs(CLI::App& command) {
  for (CLI::App* chosen : command.get_subcommands()) check_outputs(*chosen);
  std::vector<std::pair<std::string, const CLI::Option*>> outputs;
  for (CLI::Option* option : command.get_options()) {
    if (!is_for_output(*option)) continue;
    std::vector<std::string> files = option->results();
    if (files.empty()) files.push_back(option->get_default_str());
    for (const std::string& file : files) {
      if (!file.empty()) outputs.emplace_back(file, option);
    }
  }
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto& [file, writer] = outputs[i];
    check_writable(file);
    const auto refuse_if_named = [&, file = file](const std::string& other,
                                                  const CLI::Option& by) {
      if (!are_same_file(file, other)) return;
      throw BadInput(writer->get_name() + ": " + file + ": expected a file that " +
                     by.get_name() + " does not name, too");
    };
    for (std::size_t j = 0; j < i; ++j) {
      refuse_if_named(outputs[j].first, *outputs[j].second);
    }
    for (CLI::Option* option : command.get_options()) {
      if (is_for_output(*option)) continue;
      for (const std::string& input : option->results()) refuse_if_named(input, *option);
    }
  }
}

}  // namespace prehensile::apps
