#include "tests/apps/program.h"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace prehensile::testing {

namespace fs = std::filesystem;

Outcome run_program(const std::string& arguments) {
  const Folder folder;
  const std::string out = folder.path("out").string();
  const std::string err = folder.path("err").string();
  const std::string command = std::string("cd " PREHENSILE_SOURCE_DIR " && ") +
                              PREHENSILE_PROGRAM " " + arguments + " >" + out + " 2>" +
                              err + " </dev/null";
  const int status = std::system(command.c_str());
  Outcome outcome;
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  outcome.out = read_text(out);
  outcome.err = read_text(err);
  return outcome;
}

Folder::Folder() {
  std::string name = (fs::temp_directory_path() / "prehensile-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary folder");
  path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
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
