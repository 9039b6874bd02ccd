#include "tests/docs/page.h"

#include <algorithm>
#include <array>
#include <regex>
#include <set>
#include <sstream>

#include "tests/apps/program.h"

namespace prehensile::testing {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFence = "```";

bool looks_like_a_command(const std::string& line) {
  static const std::regex kCommand(
      R"(^\s*(\$ )?(\S*/)?(prehensile|cmake|ctest|bash|npm|apt-get|export|bench_\w+|\w+_tests|ompl_\w+)( .*)?$)");
  return std::regex_match(line, kCommand);
}

/// The word that ends a here-document of this line, or nothing.
std::string here_document(const std::string& line) {
  static const std::regex kHere(R"(<<\s*'?(\w+)'?)");
  std::smatch match;
  return std::regex_search(line, match, kHere) ? match[1].str() : std::string();
}

int stated_exit_code(const std::string& text) {
  static const std::regex kCode(R"(#\s*exit code (\d+))");
  std::smatch match;
  return std::regex_search(text, match, kCode) ? std::stoi(match[1]) : 0;
}

std::vector<Command> commands_of(const Block& block) {
  std::vector<Command> commands;
  for (std::size_t i = 0; i < block.lines.size(); ++i) {
    const std::string& line = block.lines[i];
    if (line.empty() || line.starts_with('#')) continue;
    Command command{block.line + 1 + static_cast<int>(i), line, 0};
    while (block.lines[i].ends_with('\\') && i + 1 < block.lines.size()) {
      command.text += '\n' + block.lines[++i];
    }
    const std::string end = here_document(command.text);
    while (!end.empty() && block.lines[i] != end && i + 1 < block.lines.size()) {
      command.text += '\n' + block.lines[++i];
    }
    command.exit_code = stated_exit_code(command.text);
    commands.push_back(command);
  }
  return commands;
}

int line_after(const Block& block) {
  return block.line + 2 + static_cast<int>(block.lines.size());
}

/// Nothing but empty lines between a block and the line of the next.
bool follows(const std::vector<std::string>& lines, const Block& block,
             const Block& next) {
  for (int i = line_after(block); i < next.line; ++i) {
    if (!lines[static_cast<std::size_t>(i - 1)].empty()) return false;
  }
  return true;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

}  // namespace

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<fs::path> pages() {
  const fs::path root = PREHENSILE_SOURCE_DIR;
  std::vector<fs::path> found;
  for (const char* folder : {"docs", "problems", "benchmarks", "examples", "viewer"}) {
    for (auto entry = fs::recursive_directory_iterator(root / folder);
         entry != fs::recursive_directory_iterator(); ++entry) {
      if (entry->path().filename() == "node_modules") entry.disable_recursion_pending();
      if (entry->path().extension() != ".md") continue;
      found.push_back(fs::relative(entry->path(), root));
    }
  }
  found.emplace_back("README.md");
  std::sort(found.begin(), found.end());
  return found;
}

std::string text_of_page(const fs::path& page) {
  return read_text(fs::path(PREHENSILE_SOURCE_DIR) / page);
}

std::vector<Block> blocks_of(const std::string& text) {
  std::vector<Block> blocks;
  bool inside = false;
  int number = 0;
  for (const std::string& line : lines_of(text)) {
    ++number;
    if (line.starts_with(kFence)) {
      if (!inside) blocks.push_back({number, line.substr(kFence.size()), {}});
      inside = !inside;
    } else if (inside) {
      blocks.back().lines.push_back(line);
    }
  }
  return blocks;
}

std::vector<Session> sessions_of(const std::string& text) {
  const std::vector<std::string> lines = lines_of(text);
  const std::vector<Block> blocks = blocks_of(text);
  std::vector<Session> sessions;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i].language != "sh") continue;
    Session session;
    session.commands = commands_of(blocks[i]);
    if (i + 1 < blocks.size() && blocks[i + 1].language == "text" &&
        follows(lines, blocks[i], blocks[i + 1])) {
      session.shown = joined(blocks[i + 1].lines);
      session.shown_line = blocks[i + 1].line;
    }
    sessions.push_back(session);
  }
  return sessions;
}

std::vector<std::string> faults_of(const std::string& text) {
  static const std::set<std::string> kLanguages = {"sh", "text", "cpp", "cmake", "yaml"};
  std::vector<std::string> faults;
  const auto fault = [&faults](int line, const std::string& what) {
    faults.push_back("line " + std::to_string(line) + ": " + what);
  };
  const std::vector<std::string> lines = lines_of(text);
  const std::vector<Block> blocks = blocks_of(text);
  std::set<int> in_commands;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Block& block = blocks[i];
    if (!kLanguages.contains(block.language)) {
      fault(block.line,
            "language \"" + block.language + "\", expected sh, text, cpp, cmake or yaml");
    }
    const bool is_output =
        i > 0 && blocks[i - 1].language == "sh" && follows(lines, blocks[i - 1], block);
    if (block.language == "text" && !is_output) {
      fault(block.line, "output without the commands that print it right before");
    }
    const bool runs = block.language == "sh";
    for (int k = block.line; runs && k < line_after(block); ++k) in_commands.insert(k);
    if (line_after(block) > static_cast<int>(lines.size()) + 1) {
      fault(block.line, "a fence without end");
    }
  }
  bool inside = false;
  for (int i = 1; i <= static_cast<int>(lines.size()); ++i) {
    const std::string& line = lines[static_cast<std::size_t>(i - 1)];
    if (line.starts_with(kFence)) inside = !inside;
    const bool is_code = inside || line.starts_with("    ");
    if (is_code && !in_commands.contains(i) && looks_like_a_command(line)) {
      fault(i, "a command outside sh blocks: " + line);
    }
  }
  return faults;
}

std::string with_fresh_output(const std::string& text,
                              const std::vector<Printed>& printed) {
  std::vector<std::string> lines = lines_of(text);
  const std::vector<Block> blocks = blocks_of(text);
  for (auto block = blocks.rbegin(); block != blocks.rend(); ++block) {
    const auto fresh = std::ranges::find(printed, block->line, &Printed::shown_line);
    const bool whole = std::ranges::find(block->lines, "...") == block->lines.end();
    if (fresh == printed.end() || !whole) continue;
    const auto first = lines.begin() + block->line;
    const auto next = lines.erase(first, first + static_cast<long>(block->lines.size()));
    const std::vector<std::string> output = lines_of(fresh->text);
    lines.insert(next, output.begin(), output.end());
  }
  return joined(lines);
}

}  // namespace prehensile::testing
