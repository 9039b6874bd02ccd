/// Programs of the system that tests ask: a browser, Node.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace prehensile::testing {

struct Ended {
  std::string out;
  int status = -1;  ///< as pclose tells
};

/// Everything that a command prints, and how it ended.
inline Ended run(const std::string& command) {
  Ended ended;
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return ended;
  std::array<char, 4096> part{};
  while (const std::size_t read = std::fread(part.data(), 1, part.size(), pipe)) {
    ended.out.append(part.data(), read);
  }
  ended.status = pclose(pipe);
  return ended;
}

}  // namespace prehensile::testing
