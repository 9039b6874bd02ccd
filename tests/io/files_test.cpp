/// Writing: in full or not at all.
#include "tests/io/files.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <gtest/gtest.h>

#include "io/plan_file.h"

namespace prehensile::testing {
namespace {

namespace fs = std::filesystem;

int entries(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), {}));
}

TEST(WriteAtomically, WritesAndReplaces) {
  const Folder folder;
  const fs::path file = folder / "plan.json";
  write_atomically(file, "one");
  EXPECT_EQ(text_of(file), "one");
  write_atomically(file, std::string(1'000'000, 'x'));
  EXPECT_EQ(text_of(file).size(), 1'000'000u);
  EXPECT_EQ(entries(file.parent_path()), 1);
}

TEST(WriteAtomically, FilesHaveTheUsualPermissions) {
  const Folder folder;
  const mode_t before = ::umask(027);
  write_atomically(folder / "plan.json", "text");
  ::umask(before);
  struct stat status {};
  ASSERT_EQ(::stat((folder / "plan.json").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(WriteAtomically, FollowsALinkAndKeepsIt) {
  const Folder folder;
  write_atomically(folder / "file", "old");
  fs::create_symlink("file", folder / "link");
  write_atomically(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(text_of(folder / "file"), "new");
}

TEST(WriteAtomically, RefusesWhatIsNoFile) {
  const Folder folder;
  fs::create_directory(folder / "folder");
  const std::string directory =
      message_of([&] { write_atomically(folder / "folder", "text"); });
  EXPECT_NE(directory.find("a directory: expected a new file or one to replace"),
            std::string::npos)
      << directory;
  const std::string device = message_of([] { write_atomically("/dev/null", "text"); });
  EXPECT_EQ(device,
            "/dev/null: a device, pipe or socket: expected a new file or one to replace");
  struct stat status {};
  ASSERT_EQ(::stat("/dev/null", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
}

TEST(WriteAtomically, AMissingFolderIsNamed) {
  const Folder folder;
  const fs::path file = folder / "absent" / "plan.json";
  EXPECT_EQ(message_of([&] { write_atomically(file, "text"); }),
            file.string() + ": cannot be written: No such file or directory");
  EXPECT_TRUE(folder.empty());
}

/// A limit on the size of files stands for a full disk, in a process of its own.
TEST(WriteAtomically, ADiskWithoutRoomLeavesTheOldFileAndNothingElse) {
  const Folder folder;
  const fs::path file = folder / "plan.json";
  write_atomically(file, "old");
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::string message =
        message_of([&] { write_atomically(file, std::string(100'000, 'x')); });
    ::_exit(message == file.string() + ": cannot be written: File too large" ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(text_of(file), "old");
  EXPECT_EQ(entries(file.parent_path()), 1);
}

/// Root may write everywhere, so it asks as a user without rights.
TEST(WriteAtomically, AFolderThatMayNotBeWrittenIsRefused) {
  const Folder folder;
  const fs::perms read_only = fs::perms::owner_read | fs::perms::owner_exec |
                              fs::perms::others_read | fs::perms::others_exec;
  fs::create_directory(folder / "closed");
  fs::permissions(folder / "closed", read_only);
  fs::permissions((folder / "closed").parent_path(),
                  fs::perms::others_read | fs::perms::others_exec, fs::perm_options::add);
  const fs::path file = folder / "closed" / "plan.json";
  const std::string expected = file.string() + ": cannot be written: Permission denied";
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    constexpr uid_t kNobody = 65534;
    if (::geteuid() == 0 && ::seteuid(kNobody) != 0) ::_exit(2);
    ::_exit(message_of([&] { write_atomically(file, "text"); }) == expected ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  EXPECT_EQ(entries(folder / "closed"), 0);
}

/// Whenever the writer is killed, the file is the old or the new one.
TEST(WriteAtomically, AKilledWriterLeavesAWholeFile) {
  const Folder folder;
  const fs::path file = folder / "plan.json";
  const std::string one(3'000'000, '1');
  const std::string two(3'000'000, '2');
  write_atomically(file, one);
  for (int i = 0; i < 10; ++i) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (;;) {
        write_atomically(file, two);
        write_atomically(file, one);
      }
    }
    ::usleep(1000 * (1 + i));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const std::string text = text_of(file);
    EXPECT_TRUE(text == one || text == two);
  }
}

}  // namespace
}  // namespace prehensile::testing
