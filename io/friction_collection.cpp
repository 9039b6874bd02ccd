#include "io/friction_collection.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <string_view>

#include "io/document.h"
#include "io/gzip.h"

namespace prehensile {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// The numbers of a text one after the other, with the line they stand on.
class Numbers {
 public:
  Numbers(const std::string& text, const std::string& label)
      : text_(text), label_(label) {}

  /// `what` names the number in messages.
  double number(const char* what);
  int integer(const char* what, int least, int most);
  VectorXd vector(const char* what, int size);
  std::vector<int> integers(const char* what, int size, int least, int most);

  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw BadInput(label_ + ":" + std::to_string(line_) + ": " + found + ": expected " +
                   expected);
  }

 private:
  std::string_view word();

  std::string_view text_;
  std::string label_;
  std::size_t at_ = 0;
  int line_ = 1;
};

std::string_view Numbers::word() {
  while (at_ < text_.size() && is_space(text_[at_])) {
    if (text_[at_++] == '\n') ++line_;
  }
  const std::size_t start = at_;
  while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
  return text_.substr(start, at_ - start);
}

double Numbers::number(const char* what) {
  const std::string_view found = word();
  double value = 0.0;
  if (found.empty()) refuse("the file ends", what);
  if (!internal::to_number(found, value)) {
    refuse(internal::shown(found), std::string(what) + ", a finite number");
  }
  return value;
}

int Numbers::integer(const char* what, int least, int most) {
  const double value = number(what);
  const bool in_range = value >= least && value <= most;
  if (!in_range || static_cast<double>(static_cast<int>(value)) != value) {
    refuse(internal::number_text(value), std::string(what) + ", an integer from " +
                                             std::to_string(least) + " to " +
                                             std::to_string(most));
  }
  return static_cast<int>(value);
}

VectorXd Numbers::vector(const char* what, int size) {
  VectorXd values(size);
  for (double& value : values) value = number(what);
  return values;
}

std::vector<int> Numbers::integers(const char* what, int size, int least, int most) {
  std::vector<int> values(static_cast<std::size_t>(size));
  for (int& value : values) value = integer(what, least, most);
  return values;
}

/// Column by column: the collection holds one problem in both storages, and mixed ones
/// with their blocks once more, and only so do they agree.
MatrixXd dense_matrix(Numbers& in, int n) {
  in.integer("the number of rows again", n, n);
  in.integer("the number of columns again", n, n);
  MatrixXd M(n, n);
  for (double& entry : M.reshaped()) entry = in.number("an entry of the matrix");
  return M;
}

/// Rows, or columns, at which blocks end.
std::vector<int> block_ends(Numbers& in, int blocks, int n) {
  std::vector<int> ends =
      in.integers("where a block of rows or columns ends", blocks, 1, n);
  if (!std::is_sorted(ends.begin(), ends.end(), std::less_equal<>()) ||
      ends.back() != n) {
    in.refuse("block sizes that do not add up", "ends that rise to " + std::to_string(n));
  }
  ends.insert(ends.begin(), 0);
  return ends;
}

/// Blocks by rows: `starts[r]` is the number of the first one of block row r.
MatrixXd block_matrix(Numbers& in, int n) {
  const int most = n * n;
  const int blocks = in.integer("the number of blocks", 0, most);
  const int block_rows = in.integer("the number of block rows", 1, n);
  const int block_columns = in.integer("the number of block columns", 1, n);
  const std::vector<int> rows = block_ends(in, block_rows, n);
  const std::vector<int> columns = block_ends(in, block_columns, n);
  const int starts_count = in.integer("the number of row starts", 1, block_rows + 1);
  const int columns_count = in.integer("the number of column numbers", blocks, blocks);
  const std::vector<int> starts =
      in.integers("the first block of a row", starts_count, 0, blocks);
  const std::vector<int> column_of =
      in.integers("the column of a block", columns_count, 0, block_columns - 1);
  if (!std::is_sorted(starts.begin(), starts.end()) || starts.front() != 0 ||
      starts.back() != blocks) {
    in.refuse("row starts that do not fit", "numbers from 0 up to the number of blocks");
  }
  MatrixXd M = MatrixXd::Zero(n, n);
  for (int row = 0; row + 1 < starts_count; ++row) {
    for (int block = starts[row]; block < starts[row + 1]; ++block) {
      in.integer("the number of the block", block, block);
      const int column = column_of[block];
      for (int k = columns[column]; k < columns[column + 1]; ++k) {
        for (int i = rows[row]; i < rows[row + 1]; ++i) {
          M(i, k) = in.number("an entry of a block");
        }
      }
    }
  }
  return M;
}

/// A square matrix of n rows in one of the two storages.
MatrixXd matrix(Numbers& in, int n) {
  const int storage = in.integer("the storage, 0 dense or 1 blocks", 0, 1);
  const int rows = in.integer("the number of rows", 1, kLargestCollectionRows);
  const int columns = in.integer("the number of columns", 1, kLargestCollectionRows);
  if (rows != n || columns != n) {
    in.refuse("a matrix of " + std::to_string(rows) + " x " + std::to_string(columns),
              "a square one of " + std::to_string(n) + " rows");
  }
  return storage == 0 ? dense_matrix(in, n) : block_matrix(in, n);
}

}  // namespace

std::string read_collection_text(const std::filesystem::path& file) {
  std::string bytes = internal::read_text(file, kLargestCollectionFile);
  if (file.extension() != ".gz") return bytes;
  return internal::unpack_gzip(bytes, kLargestCollectionFile, file.string());
}

LinearComplementarityFile parse_linear_complementarity(const std::string& text,
                                                       const std::string& label) {
  Numbers in(text, label);
  const int n = in.integer("the number of rows", 1, kLargestCollectionRows);
  LinearComplementarityFile problem;
  problem.M = matrix(in, n);
  problem.q = in.vector("an entry of q", n);
  return problem;
}

MixedComplementarityFile parse_mixed_complementarity(const std::string& text,
                                                     const std::string& label) {
  Numbers in(text, label);
  in.integer("the first storage flag", 0, 1);
  in.integer("the second storage flag", 0, 1);
  const int free = in.integer("the number of equalities", 0, kLargestCollectionRows);
  const int pairs = in.integer("the number of pairs", 0, kLargestCollectionRows);
  const int n = free + pairs;
  if (n < 1 || n > kLargestCollectionRows) {
    in.refuse(std::to_string(n) + " rows",
              "1 to " + std::to_string(kLargestCollectionRows));
  }
  // Rows at which blocks of one kind begin, up to n, then the kind of each.
  std::vector<int> begins{in.integer("0, the first row of the first block", 0, 0)};
  while (begins.back() < n) {
    begins.push_back(in.integer("the first row of a block", begins.back() + 1, n));
  }
  MixedComplementarityFile problem;
  for (std::size_t block = 0; block + 1 < begins.size(); ++block) {
    const bool complementary = in.integer("the kind of a block", 0, 1) == 1;
    problem.complementary.resize(static_cast<std::size_t>(begins[block + 1]),
                                 complementary);
  }
  if (std::count(problem.complementary.begin(), problem.complementary.end(), true) !=
      pairs) {
    in.refuse("blocks that do not fit", std::to_string(pairs) + " pairs");
  }
  problem.M = matrix(in, n);
  problem.q = in.vector("an entry of q", n);
  return problem;
}

FrictionProblemFile parse_friction_problem(const std::string& text,
                                           const std::string& label) {
  Numbers in(text, label);
  FrictionProblemFile problem;
  problem.dimension = in.integer("the dimension", 2, 3);
  problem.contacts =
      in.integer("the number of contacts", 1, kLargestCollectionRows / problem.dimension);
  const int n = problem.dimension * problem.contacts;
  problem.W = matrix(in, n);
  problem.q = in.vector("an entry of q", n);
  for (int i = 0; i < problem.contacts; ++i) {
    const double mu = in.number("a coefficient of friction");
    if (mu < 0.0) in.refuse(internal::number_text(mu), "friction of at least 0");
    problem.mu.push_back(mu);
  }
  return problem;
}

}  // namespace prehensile
