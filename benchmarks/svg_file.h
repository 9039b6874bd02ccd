/// The pictures that a benchmark writes.
#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace prehensile::benchmarks {

/// To a temporary beside `file`, which is then renamed; false, with a message, if that
/// fails.
inline bool write_svg(const std::filesystem::path& file, const std::string& svg) {
  const std::filesystem::path part = file.string() + ".part";
  {
    std::ofstream out(part, std::ios::binary);
    out << svg;
    out.flush();
    if (!out) {
      std::fprintf(stderr, "error: cannot write %s\n", file.c_str());
      return false;
    }
  }
  std::error_code error;
  std::filesystem::rename(part, file, error);
  if (error) std::fprintf(stderr, "error: cannot write %s\n", file.c_str());
  return !error;
}

}  // namespace prehensile::benchmarks
