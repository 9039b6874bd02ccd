/// `plan` and `check` around the planner: margins, samples, arm files, interruptions,
/// explanations.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/program.h"

namespace prehensile::testing {
namespace {

using nlohmann::json;

const std::string kScene = "problems/published/tee_21.yaml";
const std::string kUncertain =
    " --set \"uncertainty={friction: 0.2, start_position: 0.001, pusher_tilt_deg: 1}\"";

/// Plans into a file of this folder.
Outcome planned(const Folder& folder, const std::string& arguments) {
  return run_program("plan " + arguments + " -o " + folder.path("plan.json").string());
}

json plan_of(const Folder& folder) {
  return json::parse(read_text(folder.path("plan.json")));
}

TEST(PlanOptions, MarginsAreTheUsualOneNoneOrTheScenes) {
  const Folder folder;
  ASSERT_EQ(planned(folder, kScene).exit_code, 0);
  EXPECT_EQ(plan_of(folder).at("promise"), "margin");
  EXPECT_GT(plan_of(folder).at("margin").at("tilt"), 0.0);
  ASSERT_EQ(planned(folder, kScene + " --nominal").exit_code, 0);
  EXPECT_EQ(plan_of(folder).at("promise"), "nominal");
  EXPECT_EQ(plan_of(folder).at("margin").at("friction"), 0.0);
  EXPECT_FALSE(plan_of(folder).at("margin").contains("tilt"));
  ASSERT_EQ(planned(folder, kScene + " --robust" + kUncertain).exit_code, 0);
  EXPECT_EQ(plan_of(folder).at("promise"), "scene uncertainty");
  EXPECT_NEAR(plan_of(folder).at("margin").at("friction").get<double>(), 0.2, 1e-12);
  const Outcome checked = run_program("check " + folder.path("plan.json").string());
  EXPECT_EQ(checked.exit_code, 0) << checked.out;
  EXPECT_EQ(planned(folder, kScene + " --robust").exit_code, 2);
  EXPECT_EQ(planned(folder, kScene + " --robust --nominal").exit_code, 2);
  ASSERT_EQ(planned(folder, kScene + " --no-help-of-gravity").exit_code, 0);
  EXPECT_EQ(plan_of(folder).at("margin").at("gravity"), "must not help");
  EXPECT_EQ(run_program("check " + folder.path("plan.json").string()).exit_code, 0);
  EXPECT_EQ(planned(folder, kScene + " --margin 2 --nominal").exit_code, 2);
}

/// A box that nothing survives: the plan is there, and says what it is.
TEST(PlanOptions, ANominalPlanIsMarkedAsSuch) {
  const Folder folder;
  const std::string impossible =
      kScene +
      " --set \"uncertainty={friction: 0.9, grip_force: 0.6, start_position: "
      "0.02, pusher_tilt_deg: 20}\" --robust --budget 300000";
  const Outcome outcome = planned(folder, impossible);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("NOMINAL ONLY"), std::string::npos) << outcome.out;
  const json plan = plan_of(folder);
  EXPECT_EQ(plan.at("promise"), "nominal only");
  EXPECT_EQ(plan.at("status"), "reached goal");
  EXPECT_TRUE(plan.contains("explanation"));
  EXPECT_EQ(run_program("check " + folder.path("plan.json").string()).exit_code, 0);
}

TEST(PlanOptions, FailuresAreExplained) {
  const Folder folder;
  const std::string one_wall =
      kScene +
      " --set \"pushers=[{name: wall, line: {}, friction: 0.5, position: [-0.2, "
      "0], normal_deg: 0}]\" --budget 300000";
  const Outcome outcome = planned(folder, one_wall);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("one more pusher"), std::string::npos) << outcome.out;
  const json explanation = plan_of(folder).at("explanation");
  EXPECT_FALSE(explanation.at("text").get<std::string>().empty());
  EXPECT_FALSE(explanation.at("stopped_by").empty());
  EXPECT_FALSE(explanation.at("changes").empty());
  EXPECT_EQ(planned(folder, one_wall + " --no-advice").exit_code, 1);
  EXPECT_FALSE(plan_of(folder).contains("explanation"));
}

/// An option that the explanation names makes the scene solvable.
TEST(PlanOptions, TheNamedOptionHelps) {
  const Folder folder;
  const std::string weak = kScene + " --set gripper.grip_force=3";
  ASSERT_EQ(planned(folder, weak).exit_code, 1);
  const json change = plan_of(folder).at("explanation").at("changes").at(0);
  const std::string option = change.at("option");
  ASSERT_EQ(planned(folder, kScene + ' ' + option).exit_code, 0) << option;
  EXPECT_NEAR(plan_of(folder).at("cost").get<double>(), change.at("cost").get<double>(),
              1e-9);
}

/// A plan for a part of the margin is that which this part alone gives.
TEST(PlanOptions, APartOfTheMarginIsMarkedAsSuch) {
  const Folder folder;
  const std::string scene = "problems/slide_then_pivot.yaml";
  const Outcome whole = planned(folder, scene);
  EXPECT_EQ(whole.exit_code, 0);
  const json part = plan_of(folder);
  ASSERT_EQ(part.at("promise"), "part of the margin");
  EXPECT_NE(whole.out.find("planned for (part of the margin)"), std::string::npos);
  EXPECT_NE(part.at("message").get<std::string>().find("50 % of it"), std::string::npos);
  EXPECT_TRUE(part.contains("explanation"));
  EXPECT_EQ(run_program("check " + folder.path("plan.json").string()).exit_code, 0);

  ASSERT_EQ(planned(folder, scene + " --margin 0.5").exit_code, 0);
  const json alone = plan_of(folder);
  EXPECT_EQ(alone.at("promise"), "margin");
  EXPECT_EQ(alone.at("margin"), part.at("margin"));
  EXPECT_EQ(alone.at("pushes"), part.at("pushes"));
}

TEST(PlanOptions, ArmFilesAreWrittenByExtension) {
  const Folder folder;
  std::string files;
  for (const char* name : {"arm.csv", "arm.tum", "arm.yaml"}) {
    files += " --arm " + folder.path(name).string();
  }
  ASSERT_EQ(planned(folder, kScene + files + " --clearance-mm 20").exit_code, 0);
  EXPECT_NE(read_text(folder.path("arm.csv")).find("# clearance: 0.02\n"),
            std::string::npos);
  EXPECT_NE(read_text(folder.path("arm.tum")).find("quaternion_order: xyzw"),
            std::string::npos);
  EXPECT_EQ(read_text(folder.path("arm.yaml")).rfind("format: prehensile arm", 0), 0u);
  const Outcome bad = planned(folder, kScene + " --arm arm.xml");
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_NE(bad.err.find(".csv, .tum or .yaml"), std::string::npos) << bad.err;
  const std::string slow =
      kScene + " --push-speed-mm-s 0.001 --arm " + folder.path("slow.csv").string();
  const Outcome endless = planned(folder, slow);
  EXPECT_EQ(endless.exit_code, 2);
  EXPECT_NE(endless.err.find("--arm-rate-hz"), std::string::npos) << endless.err;
  EXPECT_EQ(read_text(folder.path("slow.csv")), "");
  const std::string none = folder.path("none.csv").string();
  EXPECT_EQ(planned(folder, kScene + " --set goal.x=0.3 --arm " + none).exit_code, 1);
  EXPECT_EQ(read_text(none), "");
}

TEST(PlanOptions, AnArmThatCarriesTheObjectThroughAPusherIsWarnedOf) {
  const Folder folder;
  const std::string arm = " --arm " + folder.path("arm.csv").string();
  const Outcome apart = planned(folder, kScene + arm);
  EXPECT_EQ(apart.exit_code, 0);
  EXPECT_EQ(apart.err, "");
  const Outcome through =
      planned(folder, kScene + " --set 'pushers.1.position=[0, 0]'" + arm);
  EXPECT_EQ(through.exit_code, 0);
  EXPECT_EQ(through.err.rfind("warning: the arm would carry the object through floor (at "
                              "0.00 s, approach of push 1)",
                              0),
            0U)
      << through.err;
  EXPECT_EQ(std::count(through.err.begin(), through.err.end(), '\n'), 1) << through.err;
}

/// What refuses the motion leaves no plan behind either, and what no plan could make
/// right is refused before the search.
TEST(PlanOptions, ArmLimitsAreRefusedBeforeAnythingIsWritten) {
  const Folder folder;
  const std::string arm = " --arm " + folder.path("arm.csv").string();
  const std::string endless = "expected at most 1000000 samples";
  const auto refuse = [&](const std::string& arguments, const std::string& words) {
    const Outcome outcome = planned(folder, arguments + arm);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path("plan.json"))) << arguments;
    EXPECT_FALSE(std::filesystem::exists(folder.path("arm.csv"))) << arguments;
  };
  refuse(kScene + " --push-speed-mm-s 0.001 --arm-rate-hz 1000", endless);
  refuse(kScene + " --transit-speed-mm-s 0.001 --clearance-mm 0.001", endless);
  refuse(kScene + " --turn-speed-deg-s 0.001 --arm-rate-hz 1000", endless);
  // Not even a budget of one would end in time, if it were searched.
  const std::string unsolved = " --set goal.x=0.3 --budget 1000000000";
  refuse(kScene + unsolved + " --approach-speed-mm-s 0.001", endless);
  refuse("problems/confined/post_in_the_way.yaml --clearance-mm 900",
         "obstacles.approach");
}

TEST(CheckSamples, AreTheSameForAnyNumberOfJobs) {
  const Folder folder;
  ASSERT_EQ(planned(folder, kScene + " --nominal").exit_code, 0);
  const std::string check = "check " + folder.path("plan.json").string() +
                            " --json --samples 300 --seed 4 --vary "
                            "friction=0.5,grasp_mm=2,tilt_deg=2,mass=0.1";
  const Outcome one = run_program(check + " --jobs 1");
  const Outcome three = run_program(check + " --jobs 3");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(one.out, three.out);
  const json samples = json::parse(one.out).at("samples");
  EXPECT_EQ(samples.at("draws"), 300);
  const double share = samples.at("success").at("share");
  EXPECT_GT(share, 0.0);
  EXPECT_LT(share, 1.0);
  EXPECT_LT(samples.at("success").at("low").get<double>(), share);
  EXPECT_GT(samples.at("success").at("high").get<double>(), share);
  ASSERT_FALSE(samples.at("influences").empty());
  double last = 1.0;
  for (const json& influence : samples.at("influences")) {
    EXPECT_LE(influence.at("difference").get<double>(), last);
    last = influence.at("difference");
  }
  EXPECT_NE(run_program(check + " --seed 5").out, one.out);
}

TEST(CheckSamples, ExitCodeFollowsTheShareAskedFor) {
  const Folder folder;
  ASSERT_EQ(planned(folder, kScene).exit_code, 0);
  const std::string check = "check " + folder.path("plan.json").string();
  const Outcome inside = run_program(check + " --samples 300 --at-least 1");
  EXPECT_EQ(inside.exit_code, 0) << inside.out;
  EXPECT_NE(inside.out.find("300 of 300"), std::string::npos) << inside.out;
  const std::string slippery = check + " --samples 100 --vary friction=0.9,grasp_mm=5";
  EXPECT_EQ(run_program(slippery + " --at-least 0.999").exit_code, 1);
  EXPECT_EQ(run_program(slippery).exit_code, 0);
  EXPECT_EQ(run_program(check + " --at-least 0.5").exit_code, 2);
  EXPECT_EQ(run_program(check + " --samples 0").exit_code, 2);
  EXPECT_EQ(run_program(check + " --samples 9 --vary nonsense=1").exit_code, 2);
}

/// A share of 57 of 100 is 0.57, though 0.57 * 100 is a little more than 57.
TEST(CheckSamples, AShareIsReachedExactly) {
  const Folder folder;
  ASSERT_EQ(planned(folder, kScene).exit_code, 0);
  int compared = 0;
  for (int seed = 1; seed <= 40 && compared < 3; ++seed) {
    const std::string check =
        "check " + folder.path("plan.json").string() +
        " --samples 100 --vary friction=0.9,grasp_mm=5 --json --seed " +
        std::to_string(seed);
    const auto successes = [](const Outcome& out) {
      return json::parse(out.out).at("samples").at("success").at("count").get<int>();
    };
    const int count = successes(run_program(check));
    if (0.01 * count * 100 <= count) continue;  // not one that rounds up
    ++compared;
    const std::string share = (count < 10 ? "0.0" : "0.") + std::to_string(count);
    EXPECT_EQ(run_program(check + " --at-least " + share).exit_code, 0) << share;
    EXPECT_EQ(run_program(check + " --at-least " + share + "01").exit_code, 1) << share;
  }
  EXPECT_GT(compared, 0);
}

TEST(CheckSamples, UseTheDistributionOfTheScene) {
  const Folder folder;
  const std::string normal =
      " --set \"uncertainty={spread: normal, sigmas: 3, friction: 0.05, pusher_place: "
      "0.0005}\"";
  ASSERT_EQ(planned(folder, kScene + " --robust" + normal).exit_code, 0);
  const Outcome out = run_program("check " + folder.path("plan.json").string() +
                                  " --json --samples 500 --at-least 0.99");
  ASSERT_EQ(out.exit_code, 0) << out.out;
  EXPECT_EQ(json::parse(out.out).at("samples").at("spread"), "normal");
}

/// The program in the background, with what it says on stderr in a file.
class Running {
 public:
  Running(std::vector<std::string> arguments, const std::filesystem::path& err)
      : err_(err) {
    std::vector<char*> argv;
    arguments.insert(arguments.begin(), PREHENSILE_PROGRAM);
    argv.reserve(arguments.size() + 1);
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    EXPECT_EQ(posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
  }

  /// Waits until stderr holds this text; false if the program ends before.
  bool waits_for(const std::string& text) {
    while (read_text(err_).find(text) == std::string::npos) {
      if (waitpid(pid_, &status_, WNOHANG) != 0) {
        ended_ = true;
        return false;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
  }

  void interrupt() const { kill(pid_, SIGINT); }

  int exit_code() {
    if (!ended_) waitpid(pid_, &status_, 0);
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
  }

 private:
  std::filesystem::path err_;
  pid_t pid_ = -1;
  int status_ = 0;
  bool ended_ = false;
};

const std::string kLongSearch = PREHENSILE_SOURCE_DIR "/tests/apps/long_search.yaml";

TEST(Interrupt, KeepsTheBestPlanFound) {
  const Folder folder;
  const std::string plan = folder.path("plan.json").string();
  Running running({"plan", kLongSearch, "--improve", "--progress-s", "0.05", "-o", plan},
                  folder.path("err"));
  ASSERT_TRUE(running.waits_for("best J"));
  running.interrupt();
  EXPECT_EQ(running.exit_code(), 0);
  const json written = json::parse(read_text(plan));
  EXPECT_EQ(written.at("status"), "reached goal");
  EXPECT_NE(written.at("message").get<std::string>().find("stopped"), std::string::npos);
  EXPECT_EQ(run_program("check " + plan).exit_code, 0);
}

/// Another start and goal, round pads, less friction: nothing is found, for seconds.
TEST(Interrupt, WithoutAPlanTheExitCodeSaysSo) {
  const Folder folder;
  const std::string plan = folder.path("plan.json").string();
  std::vector<std::string> arguments = {"plan", kLongSearch,    "-o",
                                        plan,   "--progress-s", "0.05"};
  for (const char* value :
       {"gripper.pad={disc: {radius: 0.009}}", "pushers.0.friction=0.3",
        "pushers.1.friction=0.3", "pushers.2.friction=0.3", "start.x=0.0328173245",
        "start.y=-0.0280371628", "goal.x=-0.0183390355", "goal.y=-0.0007123559",
        "goal.theta=0.4850718014"}) {
    arguments.insert(arguments.end(), {"--set", value});
  }
  Running running(arguments, folder.path("err"));
  ASSERT_TRUE(running.waits_for("no plan yet"));
  const auto begin = std::chrono::steady_clock::now();
  running.interrupt();
  EXPECT_EQ(running.exit_code(), 1);
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(waited.count(), 10.0);
  EXPECT_EQ(json::parse(read_text(plan)).at("status"), "stopped");
}

/// Fast searches are silent; slow ones write plain lines where there is no terminal.
TEST(ProgressLines, ArePlainAndOnlyForLongSearches) {
  const Folder folder;
  EXPECT_EQ(planned(folder, kScene).err, "");
  const Outcome slow = planned(
      folder,
      "tests/apps/long_search.yaml --improve --budget 4000000 --json --progress-s 0.1");
  EXPECT_EQ(slow.exit_code, 0);
  EXPECT_TRUE(json::accept(slow.out));
  EXPECT_EQ(slow.err.find('\r'), std::string::npos);
  EXPECT_NE(slow.err.find("tests/s"), std::string::npos);
}

}  // namespace
}  // namespace prehensile::testing
