/// The laws of the convex program of run_bound.h at a place: slacks, slopes and second
/// derivatives, of all pieces at once. Internal to the planner.
#pragma once

#include <array>

#include <Eigen/Core>

#include "planner/bounds/bordered_band.h"
#include "planner/bounds/run_program.h"

namespace prehensile {

/// Variables x of the program: u, z, tau of each piece; depth, du, share of the goal's
/// arc, dz, tau of the last; v [m, the share without unit], v being what every law may be
/// violated by.
struct RunIndex {
  static constexpr int kRest = 3 * kRunPieces;
  static constexpr int kRestU = kRest + 1;
  static constexpr int kShare = kRest + 2;
  static constexpr int kRestZ = kRest + 3;
  static constexpr int kRestTau = kRest + 4;
  static constexpr int kV = kRest + 5;
  static constexpr int kLastU = kRest - 3;  ///< from here on what the end depends on
};

using RunHessian = BorderedBand<RunIndex::kV + 1, 5>;
using RunVector = RunHessian::Vector;

using PieceValues = Eigen::Array<double, kRunPieces, 1>;

/// A number for each law: of each piece its length, both edges, four ends, both turns and
/// both borders; of the end those of the rest, the goal's and that v is not negative.
struct RunNumbers {
  static constexpr int kLaws = 11;
  static constexpr int kEndLaws = 30;
  std::array<PieceValues, kLaws> piece;
  Eigen::Array<double, kEndLaws, 1> end;
};

/// Calls `f` with one array after the other of these RunNumbers, the same of each.
template <typename F, typename... Numbers>
void for_each_law(const F& f, Numbers&&... numbers) {
  for (int i = 0; i < RunNumbers::kLaws; ++i) f(numbers.piece[i]...);
  f(numbers.end...);
}

/// No heap.
class RunSlopes {
 public:
  explicit RunSlopes(const RunProgram& program);  ///< must outlive it

  /// 1; 0: a law that the scene does not have, whose slack is 1.
  const RunNumbers& is_there() const { return is_there_; }
  /// What each law is met by: [m], of the ends of the face [m^2]; negative: violated.
  RunNumbers slacks_at(const RunVector& x) const;

  /// Slopes at x, and second derivatives times these multipliers.
  void linearise(const RunVector& x, const RunNumbers& y);

  /// Changes of the slacks, to first order.
  RunNumbers along(const RunVector& dx) const;
  /// Adds all slopes times these weights.
  void add_slopes(const RunNumbers& weights, RunVector& sum) const;
  /// Adds squares of the slopes times these weights, and the second derivatives.
  void add_squares(const RunNumbers& weights, RunHessian& hessian) const;

 private:
  /// What the laws of a piece depend on: its steps, u in its middle, tau and v.
  enum OfPiece { kDu, kDz, kMid, kTau, kViolated, kOfPiece };
  using PieceSlopes = std::array<PieceValues, kOfPiece>;
  static constexpr int kOfEnd = RunIndex::kV + 1 - RunIndex::kLastU;
  using End = Eigen::Array<double, RunNumbers::kEndLaws, 1>;

  void set_slopes_of_pieces();
  void set_slopes_of_end();
  End end_slacks_at(const RunVector& x) const;
  void linearise_end(const RunVector& x, const End& y);
  void add_squares_of_pieces(const RunNumbers& weights, RunHessian& hessian) const;
  void add_squares_of_end(const End& weights, RunHessian& hessian) const;

  const RunProgram& p_;
  RunNumbers is_there_;
  std::array<PieceValues, 2> beside_;  // of the program
  std::array<PieceSlopes, RunNumbers::kLaws> by_;
  Eigen::Matrix<double, RunNumbers::kEndLaws, kOfEnd> by_end_;
  PieceValues bend_uu_, bend_uz_, bend_zz_;  // second derivatives
  Eigen::Matrix<double, kOfEnd, kOfEnd> bend_of_end_;
};

/// Those that the dual knows (run_program.h).
RunMultipliers multipliers_of(const RunNumbers& numbers);

}  // namespace prehensile
