/// The pages of the documentation: their code blocks, and what a reader types of them.
///
/// A block is fenced and names its language. `sh`: commands, run by commands_test.cpp.
/// `text`: what the `sh` block right before it prints. `cpp`, `yaml`: to read.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace prehensile::testing {

struct Block {
  int line = 0;  ///< of the opening fence, from 1
  std::string language;
  std::vector<std::string> lines;
};

struct Command {
  int line = 0;
  std::string text;   ///< with the lines that it goes on over, and its here-document
  int exit_code = 0;  ///< as a comment at its end says: `# exit code 1`
};

/// What a reader types in one go, and what they are shown of it.
struct Session {
  std::vector<Command> commands;
  std::optional<std::string> shown;
  int shown_line = 0;
};

/// Every page, relative to the source tree.
std::vector<std::filesystem::path> pages();
std::string text_of_page(const std::filesystem::path& page);

std::vector<Block> blocks_of(const std::string& text);
std::vector<Session> sessions_of(const std::string& text);

/// What no reader of blocks understands, with its line: languages that are not known,
/// output without commands, commands outside `sh` blocks, fences without end.
std::vector<std::string> faults_of(const std::string& text);

/// What a session printed, in place of what stands in the `text` block of this line.
struct Printed {
  int shown_line = 0;
  std::string text;
};

/// The page with fresh output; blocks that leave lines out (`...`) stay as they are.
std::string with_fresh_output(const std::string& text,
                              const std::vector<Printed>& printed);

std::vector<std::string> lines_of(const std::string& text);

}  // namespace prehensile::testing
