/// What options of the command line must be, beyond what CLI11 asks of them.
#pragma once

#include <CLI/CLI.hpp>

namespace prehensile::apps {

/// A number from `low` to `high`; CLI::Range lets nan pass.
CLI::Validator in_range(double low, double high);

/// A whole number, of digits only, that fits into 64 bits: others CLI11 wraps around.
CLI::Validator is_seed();

/// Of options that name a file to write: a name. The rest is left to `check_outputs`.
CLI::Validator is_output();

/// Before any work: throws BadInput where a file to write, of those that were named to a
/// command, could not be written, or another option of it names the same file.
void check_outputs(CLI::App& command);

}  // namespace prehensile::apps
