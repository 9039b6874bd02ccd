#include "tests/apps/program.h"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <sys/wait.h>

namespace prehensile::testing {

namespace fs = std::filesystem;

Outcome run_in_shell(const std::string& commands, const fs::path& folder) {
  const Folder aside;
  const std::string script = aside.path("script").string();
  const std::string out = aside.path("out").string();
  const std::string err = aside.path("err").string();
  // What a sanitizer finds is none of the program's own exit codes.
  write_text(script, "export ASAN_OPTIONS=\"exitcode=86:$ASAN_OPTIONS\"\ncd '" +
                         folder.string() + "'\n" + commands + '\n');
  const std::string call = "bash " + script + " >" + out + " 2>" + err + " </dev/null";
  const int status = std::system(call.c_str());
  Outcome outcome;
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  outcome.out = read_text(out);
  outcome.err = read_text(err);
  return outcome;
}

Outcome run_program(const std::string& arguments) {
  return run_in_shell(PREHENSILE_PROGRAM " " + arguments, PREHENSILE_SOURCE_DIR);
}

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

}  // namespace prehensile::testing
