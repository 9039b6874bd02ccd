// The traps in the paper's equations, each with a number that shows it.

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "apps/paper_report.h"
#include "apps/table.h"
#include "mechanics/planar_instant.h"
#include "scene/pad_quadrature.h"

namespace prehensile::apps {
namespace {

using Rows = std::vector<std::vector<std::string>>;

void add(Rows& rows, const std::string& where, const std::string& printed,
         const std::string& instead, const std::string& shown) {
  rows.push_back(
      {"<span class=\"where\">" + where + "</span><br/>" + printed, instead, shown});
}

/// Velocities of k points of a plane patch as a linear map of a rigid motion (3k x 6).
Eigen::MatrixXd motion_of(const std::vector<Vec3>& points) {
  Eigen::MatrixXd map(3 * points.size(), 6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i];
    Eigen::Matrix<double, 3, 6> rows;
    rows << 1, 0, 0, 0, p.z(), -p.y(),  //
        0, 1, 0, -p.z(), 0, p.x(),      //
        0, 0, 1, p.y(), -p.x(), 0;
    map.middleRows<3>(static_cast<Eigen::Index>(3 * i)) = rows;
  }
  return map;
}

/// Rows that vanish on every rigid motion of the patch: its rigidity constraints.
Eigen::MatrixXd rigidity_of(const Eigen::MatrixXd& motion) {
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(motion.transpose());
  return lu.kernel().transpose();
}

void add_rigidity(ReportPage& page, Rows& rows) {
  const std::vector<Vec3> points = {{0.01, 0.01, 0.0},
                                    {-0.01, 0.01, 0.0},
                                    {-0.01, -0.01, 0.0},
                                    {0.01, -0.01, 0.0},
                                    {0.0, 0.004, 0.0}};
  const Eigen::MatrixXd motion = motion_of(points);
  const Eigen::MatrixXd rigidity = rigidity_of(motion);
  // Relative rates by eq. (10): of the object's motion minus that of the finger.
  Eigen::MatrixXd rates(motion.rows(), 12);
  rates << motion, -motion;
  add(rows, "IV-D, after eq. (5)",
      "3k − m − 4 independent constraints keep the k points of a patch rigid.",
      "They follow from eq. (10): two rigid bodies at rest have a rigid relative rate. "
      "Added, they make the constraints rank deficient. Left out.",
      "k = 5 points of a plane: " +
          page.number("t.rigid.rows", static_cast<double>(rigidity.rows()), "%.0f") +
          " constraints; on all rates of eq. (10) they are " +
          page.number("t.rigid.residual", (rigidity * rates).cwiseAbs().maxCoeff(),
                      "%.1e") +
          ". For a point (k = 1, m = 0) the count is " +
          page.number("t.rigid.point", 3.0 * 1 - 0 - 4, "%.0f") + ".");
}

void add_patch_loads(ReportPage& page, const PaperScenes& scenes, Rows& rows) {
  const auto& disc = std::get<DiscPad>(scenes.slide.scene.gripper.pad);
  const ContactPoints points = pad_points(disc, {}, 16);
  double nearest = 1e300;
  double farthest = 0.0;
  double mean = 0.0;
  for (int j = 0; j < points.count; ++j) {
    const double r = std::hypot(points.x[j], points.y[j]);
    nearest = std::min(nearest, r);
    farthest = std::max(farthest, r);
    mean += points.weight[j] * r;
  }
  const double capacity = 0.5 * 20.0 * 1e3;  // [N mm] per metre of lever: mu N
  add(rows, "IV-D, eq. (6)", "Only the sum of a patch’s normal forces is given.",
      "For more than three points (a line: two) the split is free, and with it the "
      "torsional friction and often the motion. A preloaded elastic foundation makes it "
      "unique (pressure law <em>foundation</em>).",
      "One pad of 16 points can resist torsion with " +
          page.number("t.loads.least", capacity * nearest, "%.1f") + " to " +
          page.number("t.loads.most", capacity * farthest, "%.1f") +
          " N mm; loaded evenly with " +
          page.number("t.loads.even", capacity * mean, "%.1f") + " N mm.");
  const RectanglePad square{{0.02, 0.02}};
  const ContactPoints even = pad_points(square, {}, 64);
  double torque = 0.0;
  for (int j = 0; j < even.count; ++j)
    torque += even.weight[j] * std::hypot(even.x[j], even.y[j]);
  add(rows, "IV-D, Fig. 4", "Points evenly distributed over a patch, up to its corners.",
      "Corner points hold too much torsion. Points of a quadrature are used.",
      "A square of four corner points resists " +
          page.number("t.corners.ratio", 0.01 * std::sqrt(2.0) / torque, "%.3f") +
          " times the torsion of an even pressure.");
}

void add_cost(ReportPage& page, Rows& rows) {
  // The products of eq. (3) and (4) in (lambda_n, xi, beta, a) of one point with one
  // generator: mu lambda_n xi - beta xi + xi beta + a beta.
  const double mu = 0.5;
  Eigen::Matrix4d cost = Eigen::Matrix4d::Zero();
  cost(0, 1) = cost(1, 0) = 0.5 * mu;
  cost(2, 3) = cost(3, 2) = 0.5;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(cost);
  add(rows, "VI-B",
      "A quadratic cost over a convex set: its minimum is where complementarity holds.",
      "The set is convex, the cost is not: a local solver may stop at a positive cost. "
      "No answer is given here without its certificate.",
      "Of one point and one generator (μ = 0.5) the cost has eigenvalues from " +
          page.number("t.cost.least", eigen.eigenvalues()[0], "%.2f") + " to " +
          page.number("t.cost.most", eigen.eigenvalues()[3], "%.2f") + ".");
}

}  // namespace

void add_traps(ReportPage& page, const PaperScenes& scenes) {
  page.heading("traps", "Traps in the equations");
  Rows rows = {{"as printed", "what holds", "a number that shows it"}};
  const double mu = scenes.slide.scene.gripper.friction[0];
  const double grip = scenes.slide.scene.gripper.grip_force;
  add(rows, "IV-A, eq. (1)", "λ<sub>t</sub>² + λ<sub>o</sub>² ≤ μ λ<sub>n</sub>²",
      "μ² λ<sub>n</sub>² on the right, as eq. (2) has it.",
      "At μ = 0.5 and 20 N the printed cone would allow " +
          page.number("t.cone.printed", std::sqrt(mu) * grip, "%.2f") +
          " N of friction instead of " + page.number("t.cone.right", mu * grip, "%.2f") +
          " N.");
  // A pusher that moves along the face as well, and that the object sticks to.
  const Model& model = scenes.slide;
  const PushContact& contact = model.contacts[0];
  const PlanarPose& X_HO = model.scene.start.X_HO;
  const double along_face = 0.01 * std::sin(0.1);
  const PlanarInstant stick =
      solve_planar(grasp_at(model, X_HO, contact.g_O),
                   drive_at(contact, 0.0, X_HO, {0.01 * std::cos(0.1), along_face, 0.0}));
  add(rows, "VI-A", "The dissipation condition with the acceleration of the object.",
      "With the relative rate at the contact, as in eq. (4).",
      "Pushed 0.1 rad askew the object moves along the face at " +
          page.number("t.rate.object", 1e3 * (along_face + stick.pusher[0].slip_rate),
                      "%.3f") +
          " mm/s and against the pusher at " +
          page.number("t.rate.relative", 1e3 * stick.pusher[0].slip_rate, "%.3f") +
          " mm/s: the contact sticks, which the printed condition forbids.");
  // A line patch that turns about p1 = 0: p2 = +10 mm, p_j = -10 mm.
  const double turning = 1.0;
  const double p2 = 0.01;
  const double pj = -0.01;
  const double printed = turning * p2 / p2 * std::abs(pj);
  add(rows, "IV-D, eq. (5)", "Rates along a line interpolated by distances.",
      "By signed places: a distance is wrong on the far side of p<sub>1</sub>.",
      "A line that turns at 1 rad/s: 10 mm behind p<sub>1</sub> the printed rate is " +
          page.number("t.line.printed", 1e3 * printed, "%+.0f") +
          " mm/s, the right one " +
          page.number("t.line.right", 1e3 * turning * pj, "%+.0f") + " mm/s.");
  add_rigidity(page, rows);
  CrossSectionModel section = *scenes.roll.cross_section;
  section.grip_force = 3.0;
  const CrossSectionInstant roll =
      solve_cross_section(section, {0.9, 0.01, 9.81 * scenes.roll.mass});
  add(rows, "IV-D, eq. (6), and V-C",
      "Each finger’s normal forces sum to the grip force, and the fingers stand still.",
      "Pushed along the closing direction the jaws differ by the traction of the "
      "support. "
      "Jaw modes say which sum is held: coupled jaws hold that of both.",
      "Rolling at 3 N the jaws carry " +
          page.number("t.jaws.one", roll.normal_force[kJaw1], "%.3f") + " and " +
          page.number("t.jaws.two", roll.normal_force[kJaw2], "%.3f") +
          " N: they differ by the traction of " +
          page.number("t.jaws.traction", roll.tangential_force[kSheet], "%.3f") + " N.");
  add_cost(page, rows);
  add_patch_loads(page, scenes, rows);
  page.table(rows, "traps");
}

}  // namespace prehensile::apps
