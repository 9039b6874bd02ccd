/// The judges of pages can say no.
#include "tests/docs/shown_output.h"

#include <gtest/gtest.h>

#include "tests/docs/page.h"

namespace prehensile::testing {
namespace {

TEST(ShownOutput, ComparesWordsAndNumbers) {
  EXPECT_EQ(difference("force 12.35 N\n", "force   12.35 N\n"), "");
  EXPECT_EQ(difference("force 12.35 N\n", "force 12.36 N\n"), "");
  EXPECT_NE(difference("force 12.35 N\n", "force 12.38 N\n"), "");
  EXPECT_NE(difference("force 12.35 N\n", "force -12.35 N\n"), "");
  EXPECT_NE(difference("force 12.35 N\n", "Force 12.35 N\n"), "");
  EXPECT_NE(difference("3 pushes\n", "4 pushes\n"), "");
  EXPECT_NE(difference("0 pushes\n", "1 pushes\n"), "");
  EXPECT_NE(difference("force nan N\n", "force 1 N\n"), "");
}

TEST(ShownOutput, LeavesOutTimesRestsAndDots) {
  EXPECT_EQ(difference("planned in 12.1 ms\n", "planned in 31.7 ms\n"), "");
  EXPECT_NE(difference("moved by 12.1 mm\n", "moved by 31.7 mm\n"), "");
  EXPECT_EQ(
      difference("name  force  time us\na 2.5 17\n", "name force time us\na 2.5 99\n"),
      "");
  EXPECT_NE(
      difference("name  force  time us\na 2.5 17\n", "name force time us\na 2.9 17\n"),
      "");
  EXPECT_NE(
      difference("name  force  mass g\na 2.5 17\n", "name force mass g\na 2.5 99\n"), "");
  EXPECT_EQ(difference("worst 3.2e-11\n", "worst 8.1e-10\n"), "");
  EXPECT_NE(difference("worst 3.2e-11\n", "worst 8.1e-05\n"), "");
  EXPECT_EQ(difference("a\n", "search: no plan yet, 2e+05 tests/s, 1.0 s\na\n"), "");
  EXPECT_EQ(difference("a\n...\nd\n", "a\nb\nc\nd\n"), "");
  EXPECT_EQ(difference("a\n...\n", "a\nb\nc\nd\n"), "");
  EXPECT_NE(difference("a\n...\ne\n", "a\nb\nc\nd\n"), "");
  EXPECT_NE(difference("a\n", "a\nb\n"), "");
  EXPECT_NE(difference("a\nb\n", "a\n"), "");
}

TEST(Page, TakesCommandsApart) {
  const auto sessions = sessions_of(
      "```sh\n# why\none \\\n  --two\ncat > f <<'END'\nx: 1\nEND\nthree  # exit code 2\n"
      "```\n\n```text\nout\n```\n\n```sh\nfour\n```\nprose\n");
  ASSERT_EQ(sessions.size(), 2u);
  ASSERT_EQ(sessions[0].commands.size(), 3u);
  EXPECT_EQ(sessions[0].commands[0].text, "one \\\n  --two");
  EXPECT_EQ(sessions[0].commands[1].text, "cat > f <<'END'\nx: 1\nEND");
  EXPECT_EQ(sessions[0].commands[2].exit_code, 2);
  EXPECT_EQ(sessions[0].commands[2].line, 8);
  EXPECT_EQ(sessions[0].shown, "out\n");
  EXPECT_FALSE(sessions[1].shown);
}

TEST(Page, TakesFreshOutput) {
  const std::string page =
      "# A\n\n```sh\none\n```\n\n```text\nold\nlines\n```\n\n```sh\ntwo\n```\n\n"
      "```text\nb\n...\n```\nend\n";
  const auto sessions = sessions_of(page);
  ASSERT_EQ(sessions.size(), 2u);
  const std::string fresh = with_fresh_output(
      page, {{sessions[0].shown_line, "new\n"}, {sessions[1].shown_line, "x\n"}});
  EXPECT_EQ(sessions_of(fresh)[0].shown, "new\n");
  EXPECT_EQ(sessions_of(fresh)[1].shown, "b\n...\n");
  EXPECT_TRUE(fresh.ends_with("```\nend\n"));
}

TEST(Page, LetsNoCommandHide) {
  EXPECT_TRUE(faults_of("text\n\n```sh\nprehensile plan a\n```\n").empty());
  EXPECT_EQ(faults_of("    prehensile plan a\n").size(), 1u);
  EXPECT_EQ(faults_of("```cpp\nbuild/release/prehensile plan a\n```\n").size(), 1u);
  EXPECT_EQ(faults_of("```\nls\n```\n").size(), 1u);
  EXPECT_EQ(faults_of("```sh\nls\n```\nprose\n\n```text\nout\n```\n").size(), 1u);
  EXPECT_EQ(faults_of("```sh\nls\n").size(), 1u);
}

}  // namespace
}  // namespace prehensile::testing
