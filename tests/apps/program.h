/// Runs the `prehensile` program as a user does.
#pragma once

#include <filesystem>
#include <string>

namespace prehensile::testing {

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// `arguments` as typed in a shell; the working directory is the source tree.
Outcome run_program(const std::string& arguments);

/// A fresh folder that is removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path path(const std::string& name) const { return path_ / name; }
  bool empty() const { return std::filesystem::is_empty(path_); }

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace prehensile::testing
