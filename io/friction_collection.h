/// Reader of the public collection of complementarity and friction problems that the
/// Siconos project keeps for its numerical solvers: text, or text packed by gzip. Numbers
/// are separated by white space; matrices are square, dense or in sparse blocks, both
/// column by column (so a line of a dense matrix is a column); the normal component of a
/// contact comes first.
///
/// Nothing in a file is trusted: sizes are limited before memory is asked for, numbers
/// must be finite, counts must fit each other. Every fault throws BadInput with one
/// message: file, line, what was found and what was expected.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "io/scene_file.h"

namespace prehensile {

/// w = M z + q with 0 <= w, 0 <= z, w . z = 0.
struct LinearComplementarityFile {
  Eigen::MatrixXd M;
  Eigen::VectorXd q;
};

/// The same with equalities: where `complementary` is false, w = 0 and z is free.
struct MixedComplementarityFile {
  Eigen::MatrixXd M;
  Eigen::VectorXd q;
  std::vector<bool> complementary;  ///< per row
};

/// u = W r + q per contact, with Coulomb's law between u and r.
struct FrictionProblemFile {
  int dimension = 3;  ///< 2 or 3 components per contact
  int contacts = 0;
  Eigen::MatrixXd W;
  Eigen::VectorXd q;
  std::vector<double> mu;  ///< per contact, >= 0
};

/// Limits of what is read.
inline constexpr int kLargestCollectionRows = 2000;
inline constexpr std::size_t kLargestCollectionFile = 20'000'000;  // bytes, unpacked

/// Text of a file; one that ends in .gz is unpacked.
std::string read_collection_text(const std::filesystem::path& file);

/// From text; `label` stands for the file's name in messages. What follows the last
/// number that the format asks for (comments, known answers) is passed over.
LinearComplementarityFile parse_linear_complementarity(const std::string& text,
                                                       const std::string& label);
MixedComplementarityFile parse_mixed_complementarity(const std::string& text,
                                                     const std::string& label);
FrictionProblemFile parse_friction_problem(const std::string& text,
                                           const std::string& label);

}  // namespace prehensile
