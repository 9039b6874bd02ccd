/// The solvers on the public collection of complementarity problems that the Siconos
/// project keeps for its own: one CSV line per file, refusals included.
///
/// FOLDER holds the folders lcp, mlcp, fc2d, fc3d (any of them). Linear and mixed
/// problems go to the pivoting solver. Friction problems whose matrix has at most eight
/// dimensions (one body, or a small mechanism) go to the exact solver on circular cones.
/// Each ends solved, with a residual of at most 1e-8 against the file's own matrix, or
/// refused with the reason. Friction problems of more freedoms, and any other folder, are
/// named as out of scope.
///
/// Usage: bench_collection FOLDER [-o FILE]
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include "benchmarks/csv_file.h"
#include "benchmarks/measure.h"
#include "benchmarks/natural_map.h"
#include "io/friction_collection.h"
#include "mechanics/mixed_lemke.h"
#include "mechanics/row_contacts.h"

namespace prehensile::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr double kAccepted = 1e-8;
constexpr LcpOptions kPatient{.starts = 20};

struct Run {
  std::string kind;
  std::string file;
  int rows = 0;
  int contacts = 0;
  std::string verdict;  // solved, refused, not read, out of scope
  std::string reason;
  double residual = std::numeric_limits<double>::quiet_NaN();
  int pivots = 0;  ///< or Newton steps
  double time_us = std::numeric_limits<double>::quiet_NaN();
};

const char* reason_of(LcpStatus status) {
  switch (status) {
    case LcpStatus::kSolved:
      return "";
    case LcpStatus::kInfeasible:
      return "no z >= 0 meets the inequalities (proof checked)";
    case LcpStatus::kRay:
      return "every start ended on a ray";
    case LcpStatus::kPivotLimit:
      return "out of pivots";
    case LcpStatus::kInaccurate:
      return "spoilt by rounding";
    case LcpStatus::kNotRun:
    case LcpStatus::kBadInput:
      break;
  }
  return "bad input";
}

void set_verdict(LcpStatus status, double residual, Run& run) {
  run.residual = residual;
  run.reason = reason_of(status);
  if (status == LcpStatus::kSolved && !(residual <= kAccepted)) {
    run.reason = "residual above 1e-8";
  }
  run.verdict = run.reason.empty() ? "solved" : "refused";
}

void run_linear(const std::string& text, Run& run) {
  const LinearComplementarityFile problem = parse_linear_complementarity(text, run.file);
  run.rows = static_cast<int>(problem.q.size());
  LcpSolution found;
  run.time_us = time_us([&] { found = solve_lcp(problem.M, problem.q, kPatient); }, 3);
  run.pivots = found.pivots;
  set_verdict(found.status, found.residual, run);
}

void run_mixed(const std::string& text, Run& run) {
  const MixedComplementarityFile file = parse_mixed_complementarity(text, run.file);
  run.rows = static_cast<int>(file.q.size());
  ComplementarityProblem problem;
  problem.variables = run.rows;
  for (int i = 0; i < run.rows; ++i) {
    problem.add_row(file.complementary[i] ? i : ComplementarityProblem::kEquality,
                    file.q[i]);
    for (int k = 0; k < run.rows; ++k) problem.add(i, k, file.M(i, k));
  }
  PivotingResult found;
  run.time_us = time_us([&] { found = solve_by_pivoting(problem, kPatient); }, 3);
  run.pivots = found.pivots;
  set_verdict(found.status, found.residual, run);
}

/// u = W r + q as rows over rates: W = G M^-1 G' with a basis of its range for G. Says
/// why not, if not.
std::string state_by_rows(const FrictionProblemFile& file, RowProblem& rows) {
  if (file.contacts > RowProblem::kMaxContacts) {
    return "more contacts than the solver has room for";
  }
  const double size = file.W.cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return "matrix of zeros";
  // Columns of both W and W', because systems with gyroscopic terms are not symmetric.
  Eigen::MatrixXd both(file.W.rows(), 2 * file.W.cols());
  both << file.W, file.W.transpose();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(both);
  qr.setThreshold(1e-9);
  const auto rank = qr.rank();
  if (rank > RowProblem::kMaxRates) {
    return "out of scope: " + std::to_string(rank) + " freedoms; the solver has " +
           std::to_string(RowProblem::kMaxRates) + " rates";
  }
  const Eigen::MatrixXd basis =
      Eigen::MatrixXd(qr.householderQ()).leftCols(rank) * std::sqrt(size);
  const Eigen::MatrixXd mobility = basis.transpose() * file.W * basis / (size * size);
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(mobility);
  if (!lu.isInvertible())
    return "matrix of no mechanical system: forces and rates "
           "span different spaces";
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      0.5 * (mobility + mobility.transpose()));
  if (!(eigen.eigenvalues()[0] > 0.0)) return "matrix not positive semidefinite";
  rows.rates = static_cast<int>(rank);
  rows.count = file.contacts;
  rows.inertia.topLeftCorner(rank, rank) = lu.inverse();
  const int d = file.dimension;
  for (int i = 0; i < file.contacts; ++i) {
    rows.G[i].setZero();
    rows.G[i].topLeftCorner(d, rank) = basis.middleRows(d * i, d);
    rows.b[i].setZero();
    rows.b[i].head(d) = file.q.segment(d * i, d);
    rows.mu[i] = file.mu[i];
    rows.compliance[i] = rows.preload[i] = 0.0;
  }
  return "";
}

/// Of the forces alone, with the file's own matrix: |r - P(r - (u + mu |u_t| n))| in
/// forces of u's size, over the contacts.
double residual_of(const FrictionProblemFile& file, const RowSolution& found) {
  const int d = file.dimension;
  Eigen::VectorXd r(file.q.size());
  for (int i = 0; i < file.contacts; ++i) r.segment(d * i, d) = found.r[i].head(d);
  const Eigen::VectorXd u = file.W * r + file.q;
  const double rate = std::max(file.q.cwiseAbs().maxCoeff(), 1e-300);
  const double force = rate / file.W.diagonal().maxCoeff();
  double worst = 0.0;
  for (int i = 0; i < file.contacts; ++i) {
    Vec3 r_i = Vec3::Zero();
    Vec3 u_i = Vec3::Zero();
    r_i.head(d) = r.segment(d * i, d) / force;
    u_i.head(d) = u.segment(d * i, d) / rate;
    u_i[0] += file.mu[i] * u_i.tail<2>().norm();
    worst = std::max(worst, (r_i - projected_on_cone(r_i - u_i, file.mu[i])).norm());
  }
  return worst;
}

/// One body, or any system of at most eight freedoms: the iteration of the spatial
/// solver on its rows. Others are named with their size.
void run_friction(const std::string& text, Run& run) {
  const FrictionProblemFile problem = parse_friction_problem(text, run.file);
  run.rows = static_cast<int>(problem.q.size());
  run.contacts = problem.contacts;
  RowProblem rows;
  run.reason = state_by_rows(problem, rows);
  run.verdict = "refused";
  if (run.reason.starts_with("out of scope")) run.verdict = "out of scope";
  if (!run.reason.empty()) return;
  RowSolution found;
  const SpatialSolveOptions options{.tolerance = 1e-10};
  run.time_us = time_us([&] { found = solve_rows(rows, options); }, 3);
  run.pivots = found.iterations;
  if (found.status != InstantStatus::kMoves) {
    run.reason = "no answer found";
    run.residual = found.residual;
    return;
  }
  run.residual = residual_of(problem, found);
  run.reason = run.residual <= kAccepted ? "" : "residual above 1e-8";
  run.verdict = run.reason.empty() ? "solved" : "refused";
  if (run.reason.empty()) run.reason = std::to_string(rows.rates) + " freedoms";
}

Run run_file(const std::string& kind, const fs::path& file) {
  Run run;
  run.kind = kind;
  run.file = file.filename().string();
  try {
    const std::string text = read_collection_text(file);
    if (kind == "lcp") {
      run_linear(text, run);
    } else if (kind == "mlcp") {
      run_mixed(text, run);
    } else {
      run_friction(text, run);
    }
  } catch (const BadInput& bad) {
    run.verdict = "not read";
    run.reason = bad.what();
  }
  return run;
}

bool is_known(const std::string& kind) {
  return kind == "lcp" || kind == "mlcp" || kind == "fc2d" || kind == "fc3d";
}

/// Sorted by name; nothing hidden.
std::vector<fs::path> entries(const fs::path& folder, bool folders) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with('.')) continue;
    if (entry.is_directory() == folders) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<Run> run_folder(const fs::path& root) {
  std::vector<Run> runs;
  for (const fs::path& folder : entries(root, true)) {
    const std::string kind = folder.filename().string();
    if (!is_known(kind)) {
      runs.push_back({.kind = kind,
                      .file = kind,
                      .verdict = "out of scope",
                      .reason = "not lcp, mlcp, fc2d or fc3d"});
      continue;
    }
    for (const fs::path& file : entries(folder, false)) {
      runs.push_back(run_file(kind, file));
    }
  }
  return runs;
}

void write_csv(const std::vector<Run>& runs, std::FILE* out) {
  std::fputs(
      "kind,file,rows,contacts,verdict,residual,pivots,time_us,reason,compiler,cpu\n",
      out);
  const std::string compiler = field(compiler_name());
  const std::string cpu = field(cpu_name());
  for (const Run& run : runs) {
    std::string reason = field(run.reason);
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    std::fprintf(out, "%s,%s,%d,%d,%s,%.3g,%d,%.4g,%s,%s,%s\n", field(run.kind).c_str(),
                 field(run.file).c_str(), run.rows, run.contacts, run.verdict.c_str(),
                 run.residual, run.pivots, run.time_us, reason.c_str(), compiler.c_str(),
                 cpu.c_str());
  }
}

void write_table(const std::vector<Run>& runs, std::FILE* out) {
  std::fprintf(out, "%-6s%-36s%6s%6s  %-13s%10s%8s%11s  %s\n", "kind", "file", "rows",
               "cont.", "verdict", "residual", "pivots", "us", "reason");
  std::vector<std::pair<std::string, int>> counts;
  for (const Run& run : runs) {
    std::fprintf(out, "%-6s%-36s%6d%6d  %-13s%10.1e%8d%11.1f  %s\n", run.kind.c_str(),
                 run.file.c_str(), run.rows, run.contacts, run.verdict.c_str(),
                 run.residual, run.pivots, run.time_us, run.reason.c_str());
    const std::string key = run.kind + " " + run.verdict;
    const auto known = std::find_if(counts.begin(), counts.end(), [&](const auto& count) {
      return count.first == key;
    });
    if (known == counts.end()) {
      counts.emplace_back(key, 1);
    } else {
      ++known->second;
    }
  }
  for (const auto& [key, count] : counts) {
    std::fprintf(out, "%s: %d\n", key.c_str(), count);
  }
}

int run(int count, char** arguments) {
  const bool writes = count == 4 && std::string(arguments[2]) == "-o";
  if ((count != 2 && !writes) || !fs::is_directory(arguments[1])) {
    std::fputs("usage: bench_collection FOLDER [-o FILE]\n", stderr);
    return 2;
  }
  CsvFile csv(writes ? arguments[3] : nullptr);
  if (!csv.get()) return 2;
  const std::vector<Run> runs = run_folder(arguments[1]);
  write_csv(runs, csv.get());
  const bool written = csv.close();
  write_table(runs, stderr);
  return written ? 0 : 1;
}

}  // namespace
}  // namespace prehensile::benchmarks

int main(int count, char** arguments) {
  return prehensile::benchmarks::run(count, arguments);
}
