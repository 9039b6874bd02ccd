/// Runs the `prehensile` program as a user does.
#pragma once

#include <filesystem>
#include <string>

#include "tests/support/folder.h"

namespace prehensile::testing {

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Commands for bash, run in `folder`; the exit code is that of the last.
Outcome run_in_shell(const std::string& commands, const std::filesystem::path& folder);

/// `arguments` as typed in a shell; the working directory is the source tree.
Outcome run_program(const std::string& arguments);

std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace prehensile::testing
