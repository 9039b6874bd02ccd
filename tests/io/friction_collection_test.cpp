/// The reader of the solver collection: both storages, every kind of problem, packed
/// files, and one clear refusal for whatever is wrong.
#include "io/friction_collection.h"

#include <zlib.h>

#include <gtest/gtest.h>

#include "mechanics/lemke.h"
#include "tests/io/files.h"
#include "tests/support/random.h"

namespace prehensile::testing {
namespace {

using Eigen::MatrixXd;

// A line of a dense matrix is a column.
const char* const kDense =
    "2\n0\n2\n2\n2\t2\n 3.0e+00 -1.0\n 1 2\n-4 5\nno number: a comment\n";
const char* const kBlocks =
    "3\n1\n3\n3\n3\n2\n2\n1\t3\n1\t3\n3\n3\n0\t1\t3\n1\t0\t1\n"
    "0\n 7 8\n1\n 1 2\n2\n 3 4 5 6\n -1 -2 -3\n";
const char* const kMixed =
    "1\n1\n1\n2\n0 1 3\n0 1\n0\n3\n3\n3 3\n1 2 3\n4 5 6\n7 8 9\n10 11 12\nand more";
const char* const kFriction =
    "2\n2\n\n0\n4\n4\n4\t4\n1 0 0 0\n0 2 0 0\n0 0 3 0\n0 0 0 4\n-1 -2 -3 -4\n0.3 0\n0\n";

TEST(FrictionCollection, DenseMatricesAreReadColumnByColumn) {
  const auto problem = parse_linear_complementarity(kDense, "dense");
  MatrixXd expected(2, 2);
  expected << 3.0, 1.0, -1.0, 2.0;
  EXPECT_EQ(problem.M, expected);
  EXPECT_EQ(problem.q, Eigen::Vector2d(-4.0, 5.0));
}

TEST(FrictionCollection, BlocksStandWhereTheyBelong) {
  const auto problem = parse_linear_complementarity(kBlocks, "blocks");
  MatrixXd expected(3, 3);
  expected << 0.0, 7.0, 8.0, 1.0, 3.0, 5.0, 2.0, 4.0, 6.0;
  EXPECT_EQ(problem.M, expected);
  EXPECT_EQ(problem.q, Eigen::Vector3d(-1.0, -2.0, -3.0));
}

TEST(FrictionCollection, MixedProblemsNameTheirEqualities) {
  const auto problem = parse_mixed_complementarity(kMixed, "mixed");
  EXPECT_EQ(problem.complementary, (std::vector<bool>{false, true, true}));
  EXPECT_EQ(problem.M(1, 0), 2.0);
  EXPECT_EQ(problem.q, Eigen::Vector3d(10.0, 11.0, 12.0));
}

TEST(FrictionCollection, FrictionProblems) {
  const auto problem = parse_friction_problem(kFriction, "friction");
  EXPECT_EQ(problem.dimension, 2);
  EXPECT_EQ(problem.contacts, 2);
  EXPECT_EQ(problem.W.diagonal(), Eigen::Vector4d(1.0, 2.0, 3.0, 4.0));
  EXPECT_EQ(problem.mu, (std::vector<double>{0.3, 0.0}));
}

TEST(FrictionCollection, ReadProblemsCanBeSolved) {
  const auto problem = parse_linear_complementarity(kDense, "dense");
  const LcpSolution found = solve_lcp(problem.M, problem.q);
  EXPECT_EQ(found.status, LcpStatus::kSolved);
  EXPECT_LT(found.residual, 1e-14);
}

template <typename Parse>
void expect_refusals_of_every_beginning(const std::string& text, std::size_t whole,
                                        const Parse& parse) {
  for (std::size_t size = 0; size < whole; ++size) {
    const std::string message = message_of([&] { parse(text.substr(0, size), "file"); });
    if (message.empty()) {
      // Cut within the last number, which then reads as another one.
      EXPECT_GE(size + 3, whole);
    } else {
      EXPECT_TRUE(message.starts_with("file:")) << message;
      EXPECT_NE(message.find("expected"), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }
}

TEST(FrictionCollection, FilesThatEndEarlyAreRefused) {
  const std::string dense = kDense;
  expect_refusals_of_every_beginning(dense, dense.find("5\nno"),
                                     parse_linear_complementarity);
  expect_refusals_of_every_beginning(kBlocks, std::string(kBlocks).size() - 2,
                                     parse_linear_complementarity);
  const std::string mixed = kMixed;
  expect_refusals_of_every_beginning(mixed, mixed.find("12\nand"),
                                     parse_mixed_complementarity);
  const std::string friction = kFriction;
  expect_refusals_of_every_beginning(friction, friction.find("0\n0\n", 60),
                                     parse_friction_problem);
}

TEST(FrictionCollection, RefusalsSayWhatWasExpected) {
  const auto linear = [](const std::string& text) {
    return message_of([&] { parse_linear_complementarity(text, "a.dat"); });
  };
  EXPECT_EQ(linear(""), "a.dat:1: the file ends: expected the number of rows");
  EXPECT_EQ(linear("2\n0\n2\n2\n2 2\n1 nan\n"),
            "a.dat:6: nan: expected an entry of the matrix, a finite number");
  EXPECT_EQ(linear("2\n0\n2\n2\n2 2\n1 inf\n").substr(0, 12), "a.dat:6: inf");
  EXPECT_EQ(linear("1e9\n"),
            "a.dat:1: 1e+09: expected the number of rows, an "
            "integer from 1 to 2000");
  EXPECT_NE(linear("0\n"), "");
  EXPECT_NE(linear("-3\n"), "");
  EXPECT_NE(linear("2.5\n"), "");
  EXPECT_NE(linear("1e999\n"), "");
  EXPECT_NE(linear("2\n2\n2\n2\n"), "");  // column-compressed: not read
  EXPECT_EQ(linear("2\n0\n3\n2\n"),
            "a.dat:4: a matrix of 3 x 2: expected a square one of 2 rows");
  // Blocks: more than fit, ends that fall, columns and starts out of range.
  EXPECT_NE(linear("2\n1\n2\n2\n999999\n"), "");
  EXPECT_NE(linear("3\n1\n3\n3\n1\n2\n1\n3 2\n3\n"), "");
  EXPECT_NE(linear("3\n1\n3\n3\n1\n2\n1\n1 2\n3\n"), "");
  EXPECT_NE(linear("2\n1\n2\n2\n1\n1\n1\n2\n2\n2\n1\n0 1\n1\n0\n1 2 3 4\n1 1\n"), "");
  EXPECT_NE(linear("2\n1\n2\n2\n1\n1\n1\n2\n2\n2\n1\n1 1\n0\n0\n1 2 3 4\n1 1\n"), "");
  EXPECT_NE(linear("2\n1\n2\n2\n1\n1\n1\n2\n2\n2\n1\n0 1\n0\n5\n1 2 3 4\n1 1\n"), "");

  const auto mixed = [](const std::string& text) {
    return message_of([&] { parse_mixed_complementarity(text, "b.dat"); });
  };
  EXPECT_NE(mixed("1 1 0 0 0"), "");
  EXPECT_NE(mixed("1 1 1500 1500 0"), "");
  EXPECT_NE(mixed("1 1 1 1 0 0 2 0 1"), "");        // blocks that do not rise
  EXPECT_NE(mixed("1 1 1 1 0 2 1 0 2 2 2 2"), "");  // two pairs where one was announced
  EXPECT_NE(mixed("1 1 1 1 0 1 2 0 3"), "");

  const auto friction = [](const std::string& text) {
    return message_of([&] { parse_friction_problem(text, "c.dat"); });
  };
  EXPECT_NE(friction("4 1"), "");
  EXPECT_NE(friction("3 700"), "");
  EXPECT_EQ(friction("2 1 0 2 2 2 2 1 0 0 1 0 0 -0.1"),
            "c.dat:1: -0.1: expected friction of at least 0");
}

// Whatever a file holds: an answer that fits itself, or BadInput.
TEST(FrictionCollection, DamagedFilesNeverDoMoreThanBeRefused) {
  Random random(1);
  const std::string alphabet = "0123456789.-+e \n\tnaif";
  for (const char* const whole : {kDense, kBlocks, kMixed, kFriction}) {
    for (int trial = 0; trial < 3000; ++trial) {
      std::string text = whole;
      for (int change = 0; change <= random.below(3); ++change) {
        const int at = random.below(static_cast<int>(text.size()));
        text[at] = alphabet[random.below(static_cast<int>(alphabet.size()))];
      }
      message_of([&] {
        const auto problem = parse_linear_complementarity(text, "x");
        EXPECT_EQ(problem.M.rows(), problem.q.size());
        EXPECT_TRUE(problem.M.allFinite());
      });
      message_of([&] {
        const auto problem = parse_mixed_complementarity(text, "x");
        EXPECT_EQ(problem.M.rows(), static_cast<int>(problem.complementary.size()));
      });
      message_of([&] {
        const auto problem = parse_friction_problem(text, "x");
        EXPECT_EQ(problem.W.rows(), problem.dimension * problem.contacts);
      });
    }
  }
}

void write_packed(const std::filesystem::path& file, const std::string& text) {
  const gzFile out = gzopen(file.c_str(), "wb");
  ASSERT_NE(out, nullptr);
  ASSERT_EQ(gzwrite(out, text.data(), static_cast<unsigned>(text.size())),
            static_cast<int>(text.size()));
  gzclose(out);
}

TEST(FrictionCollection, PackedFilesAreUnpacked) {
  const Folder folder;
  write_packed(folder / "small.dat.gz", kDense);
  EXPECT_EQ(read_collection_text(folder / "small.dat.gz"), kDense);
  std::string large;
  for (int i = 0; i < 100000; ++i) large += std::to_string(i) + "\n";
  write_packed(folder / "large.dat.gz", large);
  EXPECT_EQ(read_collection_text(folder / "large.dat.gz"), large);
  std::ofstream(folder / "plain.dat") << kDense;
  EXPECT_EQ(read_collection_text(folder / "plain.dat"), kDense);
}

TEST(FrictionCollection, DamagedPackedFilesAreRefused) {
  const Folder folder;
  const auto refusal = [&](const std::string& bytes) {
    std::ofstream(folder / "x.dat.gz", std::ios::binary) << bytes;
    return message_of([&] { read_collection_text(folder / "x.dat.gz"); });
  };
  write_packed(folder / "good.dat.gz", kBlocks);
  const std::string good = text_of(folder / "good.dat.gz");
  EXPECT_EQ(refusal(good), "");
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_NE(refusal(good.substr(0, size)), "") << size;
  }
  EXPECT_NE(refusal(kBlocks), "");
  std::string damaged = good;
  damaged[good.size() - 6] ^= 0x55;  // the checksum
  EXPECT_NE(refusal(damaged), "");
  // 21 MB of zeros pack into 20 kB.
  write_packed(folder / "bomb.dat.gz", std::string(kLargestCollectionFile + 1, '0'));
  EXPECT_NE(message_of([&] {
              read_collection_text(folder / "bomb.dat.gz");
            }).find("unpacks to more than"),
            std::string::npos);
  EXPECT_NE(message_of([&] { read_collection_text(folder / "absent.dat"); }), "");
}

}  // namespace
}  // namespace prehensile::testing
