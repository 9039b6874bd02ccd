/// Every command of the documentation runs, ends with the exit code that the page states
/// (0 where it states none), and prints what the page shows.
///
/// A page is run from its top to its end in a scratch copy of what commands read, so that
/// later commands find the files of earlier ones and the tree stays as it is. Pictures
/// that a page makes for itself (docs/images) are compared with those that it shows.
#include <array>
#include <cctype>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "tests/apps/program.h"
#include "tests/docs/page.h"
#include "tests/docs/shown_output.h"

namespace prehensile::testing {
namespace {

namespace fs = std::filesystem;

enum class Run {
  kInFull,  ///< minutes or many seconds: with label `full` only
  kNever
};

struct Exception {
  std::string_view begins;  ///< the command
  Run run;
  std::string_view reason;
};

/// The commands of all pages that a default run leaves out. All others are run.
constexpr std::array kExceptions{
    Exception{"bash scripts/quickstart.sh", Run::kNever, "installs packages as root"},
    Exception{"bash scripts/test.sh", Run::kNever, "runs this test"},
    Exception{"cmake --install build/release", Run::kNever,
              "house.installed_package_serves_a_project does it"},
    Exception{"cd viewer && npm ci", Run::kNever, "needs the npm registry"},
    Exception{"ompl_benchmark_statistics", Run::kNever,
              "of another package; tests/apps/benchmark_test.cpp runs it where it is"},
    Exception{"build/release/benchmarks/bench_", Run::kNever,
              "minutes to hours; a test of its own runs each program with --quick"},
    Exception{"build/release/tests/", Run::kNever, "tests of label full themselves"},
    Exception{"prehensile benchmark benchmarks/suites/full.yaml", Run::kNever, "hours"},
    Exception{"prehensile benchmark report full.sqlite", Run::kNever, "after hours"},
    Exception{"prehensile benchmark benchmarks/suites/nominal.yaml", Run::kInFull,
              "minutes"},
    Exception{"prehensile benchmark report nominal.sqlite", Run::kInFull, "after them"},
    Exception{"prehensile benchmark benchmarks/suites/numerics.yaml", Run::kNever,
              "hours, and data of others"},
    Exception{"prehensile benchmark report numerics.sqlite", Run::kNever, "after hours"},
    Exception{"prehensile benchmark slurm", Run::kNever,
              "needs Slurm; tests/apps/benchmark_slurm_test.cpp runs it where it is"},
    Exception{"prehensile benchmark benchmarks/suites/quick.yaml -o", Run::kInFull,
              "550 problems"},
    Exception{"prehensile benchmark report quick.sqlite", Run::kInFull, "after them"},
    Exception{"prehensile calibrate problems/calibration/tip.yaml "
              "problems/calibration/tip_pushes.csv",
              Run::kInFull, "many seconds"},
    Exception{"prehensile check plan.json --mujoco", Run::kInFull,
              "many seconds; tests/apps/mujoco_test.cpp runs a short one"},
    Exception{"scripts/mujoco_table.sh", Run::kNever,
              "minutes; it makes the table that the page shows"},
    Exception{"node viewer/measure.mjs", Run::kNever, "needs Node, and times a machine"},
    Exception{"prehensile query sweep problems/tilted_hand.yaml --points 16 --json",
              Run::kInFull, "20,000 instants in space"},
};

/// The program is called in two ways: from the root of a clone, or from anywhere.
std::string_view without_folder(std::string_view command) {
  constexpr std::string_view kFolder = "build/release/";
  const bool is_program = command.starts_with("build/release/prehensile ");
  return is_program ? command.substr(kFolder.size()) : command;
}

const Exception* exception_of(const Command& command) {
  for (const Exception& exception : kExceptions) {
    if (without_folder(command.text).starts_with(exception.begins)) return &exception;
  }
  return nullptr;
}

/// What commands read, and the program where a reader has built it.
void make_scratch(const fs::path& scratch) {
  const fs::path root = PREHENSILE_SOURCE_DIR;
  fs::create_directories(scratch / "build/release");
  fs::create_directories(scratch / "docs/images");
  fs::create_directories(scratch / "benchmarks/results");
  fs::create_symlink(PREHENSILE_PROGRAM, scratch / "build/release/prehensile");
  fs::copy(root / "problems", scratch / "problems", fs::copy_options::recursive);
  fs::copy(root / "benchmarks/suites", scratch / "benchmarks/suites",
           fs::copy_options::recursive);
}

void compare_pictures(const fs::path& scratch) {
  for (const auto& entry : fs::directory_iterator(scratch / "docs/images")) {
    const fs::path shown =
        fs::path(PREHENSILE_SOURCE_DIR) / "docs/images" / entry.path().filename();
    ASSERT_TRUE(fs::exists(shown)) << shown << " is made and not there";
    EXPECT_EQ(difference(read_text(shown), read_text(entry.path())), "") << shown;
  }
}

void offer(const fs::path& page, const std::string& text) {
  const fs::path file = fs::path(PREHENSILE_BINARY_DIR) / "fresh" / page;
  fs::create_directories(file.parent_path());
  write_text(file, text);
  ADD_FAILURE() << "if what is printed is right, copy " << file << " over " << page;
}

void run_page(const fs::path& page, bool with_long_ones) {
  const Folder folder;
  const fs::path scratch = folder.path("clone");
  make_scratch(scratch);
  const std::string before =
      "exec 2>&1; PATH=\"$PWD/build/release:$PATH\" LC_ALL=C.UTF-8\n";
  const std::string text = text_of_page(page);
  std::vector<Printed> fresh;
  for (const Session& session : sessions_of(text)) {
    std::string printed;
    bool all_ran = true;
    for (const Command& command : session.commands) {
      const Exception* exception = exception_of(command);
      if (exception && (exception->run == Run::kNever || !with_long_ones)) {
        all_ran = false;
        continue;
      }
      const Outcome outcome = run_in_shell(before + command.text, scratch);
      EXPECT_EQ(outcome.exit_code, command.exit_code)
          << page.string() << ':' << command.line << ": " << command.text << '\n'
          << outcome.out;
      printed += outcome.out;
    }
    if (!session.shown || !all_ran) continue;
    const std::string off = difference(*session.shown, printed);
    if (off.empty()) continue;
    ADD_FAILURE() << page.string() << ':' << session.shown_line << '\n' << off;
    fresh.push_back({session.shown_line, without_progress(printed)});
  }
  if (!fresh.empty()) offer(page, with_fresh_output(text, fresh));
  compare_pictures(scratch);
}

std::vector<fs::path> pages_with_commands(bool with_long_ones) {
  std::vector<fs::path> found;
  for (const fs::path& page : pages()) {
    bool runs = false;
    for (const Session& session : sessions_of(text_of_page(page))) {
      for (const Command& command : session.commands) {
        const Exception* exception = exception_of(command);
        runs = runs || (with_long_ones ? exception && exception->run == Run::kInFull
                                       : !exception);
      }
    }
    if (runs) found.push_back(page);
  }
  return found;
}

std::string test_name(const ::testing::TestParamInfo<fs::path>& info) {
  std::string name;
  for (const char c : info.param.string()) name += std::isalnum(c) != 0 ? c : '_';
  return name;
}

class Commands : public ::testing::TestWithParam<fs::path> {};
class CommandsFull : public Commands {};

INSTANTIATE_TEST_SUITE_P(Of, Commands, ::testing::ValuesIn(pages_with_commands(false)),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Of, CommandsFull, ::testing::ValuesIn(pages_with_commands(true)),
                         test_name);

TEST_P(Commands, PrintWhatThePageShows) { run_page(GetParam(), false); }

TEST_P(CommandsFull, PrintWhatThePageShows) { run_page(GetParam(), true); }

TEST(Pages, LetNoCommandHide) {
  int commands = 0;
  for (const fs::path& page : pages()) {
    for (const std::string& fault : faults_of(text_of_page(page))) {
      ADD_FAILURE() << page.string() << ", " << fault;
    }
    for (const Session& session : sessions_of(text_of_page(page))) {
      commands += static_cast<int>(session.commands.size());
    }
  }
  EXPECT_GE(commands, 100);
}

TEST(Pages, NeedEveryException) {
  std::array<int, kExceptions.size()> used{};
  for (const fs::path& page : pages()) {
    for (const Session& session : sessions_of(text_of_page(page))) {
      for (const Command& command : session.commands) {
        const Exception* exception = exception_of(command);
        if (exception) ++used[static_cast<std::size_t>(exception - kExceptions.data())];
      }
    }
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    EXPECT_GT(used[i], 0) << kExceptions[i].begins << " is on no page";
  }
}

}  // namespace
}  // namespace prehensile::testing
