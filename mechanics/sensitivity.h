/// How the answer of a planar instant changes with its question: push force and twist
/// against frictions, grip force, mass, place and direction of the pusher. Exact, by
/// differentiating the laws that the answer obeys; no solver is called again.
///
/// As long as no contact changes its mode the answer is a smooth function of the
/// question. At a change of mode only one-sided derivatives exist, and differ;
/// `mode_slack` says how near that is.
#pragma once

#include <string_view>

#include "mechanics/model.h"
#include "mechanics/planar_instant.h"

namespace prehensile {

/// A direction in which the question changes, per unit of some parameter.
struct PlanarVariation {
  std::array<double, PlanarGrasp::kCapacity> bound;  ///< of B_j; set up to grasp.count
  PlanarWrench w_g = PlanarWrench::Zero();
  double mu = 0.0;                                       ///< of the pusher's friction
  std::array<Vec2, 2> p_HC{Vec2::Zero(), Vec2::Zero()};  ///< of the pusher's points
  PlanarTwist V_HP = PlanarTwist::Zero();
};

/// Change of the answer per unit of the same parameter.
struct PlanarSensitivity {
  PlanarTwist V_HO = PlanarTwist::Constant(kNan);
  PlanarWrench w_push = PlanarWrench::Constant(kNan);
  double push_force = kNan;
  bool valid() const { return V_HO.allFinite(); }
};

/// An answer prepared for differentiation.
class DifferentiatedInstant {
 public:
  /// Differentiable: kMoves with every finger point slipping. Otherwise (the object turns
  /// about a pad point, holds, falls, ...) `is_differentiable` is false and every
  /// sensitivity is NaN. Keeps references to `grasp` and `drive`.
  DifferentiatedInstant(const PlanarGrasp& grasp, const PlanarDrive& drive,
                        const PlanarInstant& answer) noexcept;

  bool is_differentiable() const { return differentiable_; }

  /// How far the contact that is nearest to a change of mode is from it: a force over the
  /// capacity of the pads, or a rate over the push rate. Near 0 the sensitivities hold on
  /// one side only.
  double mode_slack() const { return mode_slack_; }

  PlanarSensitivity along(const PlanarVariation& variation) const noexcept;

 private:
  static constexpr int kMost = 7;  // twist, two normal and two tangential forces
  using System = Eigen::Matrix<double, kMost, kMost>;
  using Column = Eigen::Matrix<double, kMost, 1>;

  struct Row {
    int point = 0;
    Vec2 direction = Vec2::Zero();  // of the relative rate that stays zero
  };

  void add_rows() noexcept;
  void fill_system() noexcept;
  double nearest_mode_change() const noexcept;

  const PlanarGrasp& grasp_;
  const PlanarDrive& drive_;
  PlanarTwist u_ = PlanarTwist::Zero();
  PlanarWrench w_push_ = PlanarWrench::Zero();
  std::array<PusherPoint, 2> pusher_{};
  std::array<Row, 4> rows_;
  std::array<PlanarWrench, 4> columns_;  // wrench per unit of the force of each row
  int row_count_ = 0;
  System inverse_ = System::Zero();
  bool differentiable_ = false;
  double mode_slack_ = kNan;
};

/// Parameters of a scene that an instant depends on.
enum class InstantParameter {
  kFrictionJaw1,    ///< per unit of friction
  kFrictionJaw2,    ///< per unit of friction
  kGripForce,       ///< per N of each finger
  kMass,            ///< per kg; the centre of mass stays
  kPusherFriction,  ///< per unit of friction
  kPlace,           ///< per m along the face, the pusher's twist being the same
  kDirection,       ///< per rad by which the pusher's velocity turns
  kCount
};
std::string_view name(InstantParameter parameter);
/// Unit of the parameter: "1", "N", "kg", "m" or "rad".
std::string_view unit(InstantParameter parameter);

/// How the question at a pose changes with a parameter of its scene.
PlanarVariation variation_of(const Model& model, const PushContact& contact, double place,
                             const PlanarPose& X_HO, const PlanarTwist& V_HP,
                             InstantParameter parameter) noexcept;

}  // namespace prehensile
