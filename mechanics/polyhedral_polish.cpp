#include "mechanics/polyhedral_polish.h"

#include <Eigen/QR>

namespace prehensile {
namespace {

/// A contact force as origin + columns * (its free coordinates), and the directions in
/// which its rate is prescribed: as many as there are free coordinates.
struct ContactForce {
  Vec2 r;
  Vec2 origin = Vec2::Zero();
  Eigen::Matrix2d columns = Eigen::Matrix2d::Zero();
  int free = 0;
  Vec2 start = Vec2::Zero();  // of the free coordinates
  Eigen::Matrix2d normals = Eigen::Matrix2d::Zero();
  Vec2 rates = Vec2::Zero();  // prescribed along the normals
  int first = 0;              // index of the first free coordinate in the linear system

  Vec2 force(const Eigen::VectorXd& x) const {
    Vec2 f = origin;
    for (int i = 0; i < free; ++i) f += columns.col(i) * x[first + i];
    return f;
  }
};

/// Of each pair the larger side, in its unit, is the one that is not zero.
ContactForce finger_pattern(const PolyhedralInstant& q, const PolyhedralUnknowns& z,
                            std::span<const double> values, int j) {
  const PlanarTwist u(values[0], values[1], values[2]);
  const Vec2 c = point_velocity(u, q.r[j]);
  const double xi = values[z.xi(j)];
  const double bound = q.bound[j];
  Vec2 f = Vec2::Zero();
  double sum = 0.0;
  int loaded = 0;
  int largest = 0;
  for (int k = 0; k < z.generators; ++k) {
    const double beta = values[z.beta(j, k)];
    f += beta * q.d[k];
    sum += beta;
    if (beta > bound * (xi + q.d[k].dot(c))) ++loaded;
    if (beta > values[z.beta(j, largest)]) largest = k;
  }
  const auto beta_of = [&](int k) {
    return values[z.beta(j, (k + z.generators) % z.generators)];
  };
  ContactForce force;
  force.r = q.r[j];
  const bool slips = bound * xi > bound - sum;
  if (slips && loaded <= 1) {
    force.origin = bound * q.d[largest];
  } else if (slips && loaded == 2) {
    const int step = beta_of(largest + 1) > beta_of(largest - 1) ? 1 : -1;
    const Vec2 edge = q.d[(largest + step + z.generators) % z.generators] - q.d[largest];
    force.origin = bound * q.d[largest];
    force.columns.col(0) = bound * edge;
    force.free = 1;
    force.start[0] = beta_of(largest + step) / bound;
    force.normals.col(0) = edge.normalized();
  } else {
    force.columns.setIdentity();
    force.free = 2;
    force.start = f;
    force.normals.setIdentity();
  }
  return force;
}

ContactForce pusher_pattern(const PolyhedralInstant& q, const PolyhedralUnknowns& z,
                            std::span<const double> values, int i) {
  const PlanarTwist u(values[0], values[1], values[2]);
  const Vec2 rate = q.pusher_rate(i, u);
  const double lambda_n = values[z.lambda_n(i)];
  const Vec2 prescribed = point_velocity(q.V_HP, q.p[i]);
  ContactForce force;
  force.r = q.p[i];
  if (rate.x() > lambda_n) return force;  // open

  force.free = 1;
  force.start[0] = lambda_n;
  force.normals.col(0) = q.n;
  force.rates[0] = q.n.dot(prescribed);
  force.columns.col(0) = q.n;
  if (!z.pusher_friction) return force;
  const double beta[2] = {values[z.pusher_beta(i, 0)], values[z.pusher_beta(i, 1)]};
  const double xi = values[z.pusher_xi(i)];
  if (xi > q.mu * lambda_n - beta[0] - beta[1]) {
    force.columns.col(0) += (beta[0] > beta[1] ? q.mu : -q.mu) * q.t;
  } else {
    force.free = 2;
    force.start[1] = beta[0] - beta[1];
    force.columns.col(1) = q.t;
    force.normals.col(1) = q.t;
    force.rates[1] = q.t.dot(prescribed);
  }
  return force;
}

/// The linear equations of a pattern: eq. (8), and the prescribed rates.
struct LinearLaws {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  Eigen::VectorXd start;
};

LinearLaws linear_laws(const PolyhedralInstant& q, const PlanarTwist& u,
                       const std::vector<ContactForce>& contacts, int count) {
  LinearLaws laws{Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count),
                  Eigen::VectorXd::Zero(count)};
  laws.start.head<3>() = u;
  laws.A.topLeftCorner<3, 3>() = -q.inertia;
  PlanarWrench known = q.w_g;
  for (const ContactForce& contact : contacts) {
    known += wrench_of(contact.r, contact.origin);
    for (int i = 0; i < contact.free; ++i) {
      const int index = contact.first + i;
      laws.A.block<3, 1>(0, index) = wrench_of(contact.r, contact.columns.col(i));
      laws.A.block<1, 3>(index, 0) =
          wrench_of(contact.r, contact.normals.col(i)).transpose();
      laws.b[index] = contact.rates[i];
      laws.start[index] = contact.start[i];
    }
  }
  laws.b.head<3>() = -known;
  return laws;
}

}  // namespace

PolyhedralAnswer polished(const PolyhedralInstant& q, std::span<const double> values) {
  const PolyhedralUnknowns z(q);
  std::vector<ContactForce> contacts;
  contacts.reserve(z.points + z.pushers);
  for (int j = 0; j < z.points; ++j) contacts.push_back(finger_pattern(q, z, values, j));
  for (int i = 0; i < z.pushers; ++i) contacts.push_back(pusher_pattern(q, z, values, i));
  int count = 3;
  for (ContactForce& contact : contacts) {
    contact.first = count;
    count += contact.free;
  }
  const LinearLaws laws =
      linear_laws(q, {values[0], values[1], values[2]}, contacts, count);
  // Least change rather than inverse: forces of points at rest are not unique.
  const Eigen::VectorXd x =
      laws.start + laws.A.completeOrthogonalDecomposition().solve(
                       Eigen::VectorXd(laws.b - laws.A * laws.start));

  PolyhedralAnswer answer;
  answer.u = x.head<3>();
  for (int j = 0; j < z.points; ++j) answer.f.push_back(contacts[j].force(x));
  for (int i = 0; i < z.pushers; ++i) {
    const Vec2 f = contacts[z.points + i].force(x);
    answer.lambda_n[i] = q.n.dot(f);
    answer.lambda_t[i] = q.t.dot(f);
  }
  return answer;
}

}  // namespace prehensile
