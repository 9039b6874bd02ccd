#include "benchmarks/suite/slurm.h"

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/suite/small_suite.h"

namespace prehensile::suite {
namespace {

using testing::Folder;

TEST(Slurm, TasksAreWorthStarting) {
  EXPECT_EQ(number_of_tasks(10'000, 0.02, 10.0), 20);
  EXPECT_EQ(number_of_tasks(10, 0.02, 10.0), 1);
  EXPECT_EQ(number_of_tasks(5, 100.0, 10.0), 5);
  EXPECT_EQ(number_of_tasks(1'000'000, 1.0, 10.0), 1000);
}

TEST(Slurm, WordsStandForThemselves) {
  const Folder folder;
  for (const std::string word :
       {"plain", "two words", "it's", "$HOME `ls` \"x\" \\", "a*"}) {
    const std::string file = (folder / "out").string();
    ASSERT_EQ(std::system(("printf %s " + shell_word(word) + " > " + file).c_str()), 0);
    std::ifstream in(file);
    std::string back;
    std::getline(in, back);
    EXPECT_EQ(back, word);
  }
}

/// The scripts without Slurm: a program that only writes down how it was called.
TEST(Slurm, TasksRunOnceAndMergeWaitsForAll) {
  const Folder folder;
  const auto path = folder / "with space";
  std::filesystem::create_directories(path / "log");
  std::ofstream(path / "program")
      << "#!/bin/bash\necho \"$@\" >> calls\n"
         "while [ $# -gt 0 ]; do\n"
         "  if [ \"$1\" = -o ]; then touch \"$2\"; fi; shift\n"
         "done\n";
  std::filesystem::permissions(path / "program", std::filesystem::perms::owner_all);
  const SlurmJob job{.program = path / "program",
                     .suite = path / "suite.yaml",
                     .data = path,
                     .folder = path,
                     .name = "s",
                     .tasks = 2};
  std::ofstream(path / "array.sh") << array_script(job);
  std::ofstream(path / "merge.sh") << merge_script(job);
  const auto start = [&](const char* script, int task) {
    return std::system(("SLURM_ARRAY_TASK_ID=" + std::to_string(task) + " bash " +
                        shell_word((path / script).string()) + " > " +
                        shell_word((path / "said").string()) + " 2>&1")
                           .c_str());
  };
  const auto said = [&] {
    std::ifstream in(path / "said");
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(start("array.sh", 1), 0) << said();
  EXPECT_NE(start("merge.sh", 0), 0) << "the second shard is missing";
  EXPECT_NE(said().find("tasks 2:"), std::string::npos) << said();
  EXPECT_EQ(start("array.sh", 1), 0) << said();
  EXPECT_EQ(start("array.sh", 2), 0) << said();
  EXPECT_EQ(start("merge.sh", 0), 0) << said();
  EXPECT_EQ(start("merge.sh", 0), 0) << said();
  std::ifstream in(path / "calls");
  std::vector<std::string> calls;
  for (std::string line; std::getline(in, line);) calls.push_back(line);
  ASSERT_EQ(calls.size(), 3u) << "nothing is done twice";
  EXPECT_NE(calls[0].find("-o shard_1.sqlite.part --resume --shard 1/2"),
            std::string::npos);
  EXPECT_EQ(calls[2], "benchmark merge shard_1.sqlite shard_2.sqlite -o results.sqlite");
  EXPECT_TRUE(std::filesystem::exists(path / "shard_2.sqlite"));
  EXPECT_FALSE(std::filesystem::exists(path / "shard_2.sqlite.part"));
}

}  // namespace
}  // namespace prehensile::suite
