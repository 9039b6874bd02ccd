#include "benchmarks/siconos_peer.h"

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/LU>

#include "mechanics/linear_cone.h"

extern "C" {
#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
}

namespace prehensile::benchmarks {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// u = W r + q in units that make W about 1; what it takes to come back from r.
struct ForceProblem {
  LinearCone cone;
  MatrixXd H;  ///< rows n, t, o per contact
  MatrixXd inverse_inertia;
  MatrixXd W;
  VectorXd q, mu;
  double rate = 1.0;  ///< unit of u, in units of the cone
};

ForceProblem force_problem(const SpatialProblem& problem) {
  ForceProblem p;
  // Of four generators the first two are t and o.
  if (!pose_linear_cone(problem, 4, p.cone)) return p;
  const int n = p.cone.freedoms;
  const auto contacts = static_cast<Index>(p.cone.contact.size());
  p.inverse_inertia = p.cone.inertia.topLeftCorner(n, n).inverse();
  p.H.resize(3 * contacts, n);
  p.mu.resize(contacts);
  VectorXd known = VectorXd::Zero(3 * contacts);
  VectorXd compliance = VectorXd::Zero(3 * contacts);
  for (Index i = 0; i < contacts; ++i) {
    const LinearConeContact& contact = p.cone.contact[static_cast<std::size_t>(i)];
    p.H.row(3 * i) = contact.n.head(n).transpose();
    p.H.row(3 * i + 1) = contact.D.col(0).head(n).transpose();
    p.H.row(3 * i + 2) = contact.D.col(1).head(n).transpose();
    compliance[3 * i] = contact.compliance;
    known.segment<3>(3 * i) << contact.n_drive + contact.compliance * contact.preload,
        contact.D_drive[0], contact.D_drive[1];
    p.mu[i] = contact.mu;
  }
  p.W = p.H * p.inverse_inertia * p.H.transpose();
  p.W.diagonal() += compliance;
  p.q = p.H * (p.inverse_inertia * p.cone.load.head(n)) - known;
  p.rate = p.W.diagonal().mean();
  p.W /= p.rate;
  p.q /= p.rate;
  return p;
}

int code_of(SiconosSolver solver) {
  switch (solver) {
    case SiconosSolver::kProx:
      return SICONOS_FRICTION_3D_PROX;
    case SiconosSolver::kNsnFb:
      return SICONOS_FRICTION_3D_NSN_FB;
    case SiconosSolver::kNsnAc:
      return SICONOS_FRICTION_3D_NSN_AC;
    case SiconosSolver::kNsgs:
      break;
  }
  return SICONOS_FRICTION_3D_NSGS;
}

double process_time_us() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// In the child: solve and write (verdict, iterations, time, forces) to the pipe.
[[noreturn]] void solve_and_tell(ForceProblem& p, SiconosSolver solver, int seconds,
                                 int pipe) {
  ::alarm(static_cast<unsigned>(seconds));
  // The library has much to say.
  if (!std::freopen("/dev/null", "w", stdout) ||
      !std::freopen("/dev/null", "w", stderr)) {
    ::_exit(1);
  }
  const auto contacts = static_cast<int>(p.mu.size());
  // Relative to |q|. Rates follow from forces by the inverse of an inertia that is small
  // next to quasi-static, which costs three to six digits: with 1e-10 one answer of PROX
  // in five is off by more than 1e-6 there, and it takes no longer to 1e-13.
  constexpr double kTolerance = 1e-13;
  NumericsMatrix* const W =
      NM_create_from_data(NM_DENSE, 3 * contacts, 3 * contacts, p.W.data());
  FrictionContactProblem* const problem =
      frictionContactProblem_new_with_data(3, contacts, W, p.q.data(), p.mu.data());
  SolverOptions* const options = solver_options_create(code_of(solver));
  options->dparam[SICONOS_DPARAM_TOL] = kTolerance;
  if (solver == SiconosSolver::kNsgs) options->iparam[SICONOS_IPARAM_MAX_ITER] = 20000;
  VectorXd r = VectorXd::Zero(3 * contacts);
  VectorXd u = VectorXd::Zero(3 * contacts);
  const double start = process_time_us();
  const int verdict = fc3d_driver(problem, r.data(), u.data(), options);
  std::vector<double> told{static_cast<double>(verdict),
                           static_cast<double>(options->iparam[SICONOS_IPARAM_ITER_DONE]),
                           process_time_us() - start};
  told.insert(told.end(), r.begin(), r.end());
  const auto bytes = static_cast<ssize_t>(told.size() * sizeof(double));
  const bool sent = ::write(pipe, told.data(), static_cast<std::size_t>(bytes)) == bytes;
  ::_exit(sent ? 0 : 1);
}

std::vector<double> read_all(int pipe) {
  std::vector<double> told;
  double value = 0.0;
  char* const at = reinterpret_cast<char*>(&value);
  std::size_t have = 0;
  for (;;) {
    const ssize_t got = ::read(pipe, at + have, sizeof value - have);
    if (got <= 0) return told;
    have += static_cast<std::size_t>(got);
    if (have < sizeof value) continue;
    told.push_back(value);
    have = 0;
  }
}

SpatialAnswer answer_of(const SpatialProblem& problem, const ForceProblem& p,
                        const VectorXd& r) {
  const int n = p.cone.freedoms;
  const VectorXd v = p.inverse_inertia * (p.cone.load.head(n) + p.H.transpose() * r);
  SpatialAnswer answer;
  answer.given = r.allFinite();
  // The rates come first in the unknowns of the cone, and all we want from it is units.
  std::vector<double> z(static_cast<std::size_t>(p.cone.unknowns), 0.0);
  std::copy(v.begin(), v.end(), z.begin());
  const LinearConeForces rates = forces_of(problem, p.cone, 4, z);
  answer.V_HO = rates.V_HO;
  answer.jaw_rate = rates.jaw_rate;
  answer.force.resize(static_cast<std::size_t>(problem.count));
  Index next = 0;
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      answer.force[static_cast<std::size_t>(i)] = p.cone.force * r.segment<3>(3 * next++);
    }
  }
  return answer;
}

}  // namespace

const char* name(SiconosSolver solver) {
  switch (solver) {
    case SiconosSolver::kProx:
      return "siconos-prox";
    case SiconosSolver::kNsnFb:
      return "siconos-nsn-fb";
    case SiconosSolver::kNsnAc:
      return "siconos-nsn-ac";
    case SiconosSolver::kNsgs:
      break;
  }
  return "siconos-nsgs";
}

SiconosRun solve_siconos(const SpatialProblem& problem, SiconosSolver solver,
                         int seconds) {
  SiconosRun run;
  run.time_us = 1e6 * seconds;
  ForceProblem p = force_problem(problem);
  int ends[2];
  if (p.W.size() == 0 || ::pipe(ends) != 0) return run;
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    solve_and_tell(p, solver, seconds, ends[1]);
  }
  ::close(ends[1]);
  const std::vector<double> told = child > 0 ? read_all(ends[0]) : std::vector<double>{};
  ::close(ends[0]);
  if (child > 0) ::waitpid(child, nullptr, 0);
  if (told.size() != static_cast<std::size_t>(p.q.size()) + 3) return run;
  run.iterations = static_cast<int>(told[1]);
  run.time_us = told[2];
  run.answer =
      answer_of(problem, p, Eigen::Map<const VectorXd>(told.data() + 3, p.q.size()));
  return run;
}

bool siconos_is_built() { return true; }

}  // namespace prehensile::benchmarks
