/// How the answer of a spatial instant changes with its question: push force and twist
/// against the friction of each finger and of the pusher, grip force, mass, place and
/// direction of the pusher. Exact, by differentiating the laws that the answer obeys; no
/// solver is called again. The planar twin is mechanics/sensitivity.h.
///
/// As long as no contact point changes its mode the answer is a smooth function of the
/// question. At a change of mode only one-sided derivatives exist, and differ;
/// `mode_slack` says how near that is. Finer pads have more points, and so more, smaller
/// kinks.
#pragma once

#include "mechanics/sensitivity.h"
#include "mechanics/spatial_instant.h"
#include "mechanics/spatial_model.h"

namespace prehensile {

/// A direction in which the question changes, per unit of some parameter. Normals,
/// tangents and inertia stay.
struct SpatialVariation {
  std::array<double, SpatialProblem::kMaxPatches> mu{};          ///< of each patch
  std::array<double, SpatialProblem::kMaxPatches> compliance{};  ///< of each patch
  std::array<double, SpatialProblem::kMaxPoints> preload{};
  std::array<double, SpatialProblem::kMaxPoints> x{}, y{}, z{};  ///< of the points
  double grip_force = 0.0;
  SpatialWrench w_g = SpatialWrench::Zero();
  SpatialTwist V_HP = SpatialTwist::Zero();
};

/// Change of the answer per unit of the same parameter.
struct SpatialSensitivity {
  SpatialTwist V_HO = SpatialTwist::Constant(kNan);
  std::array<double, 2> jaw_rate{kNan, kNan};
  SpatialWrench w_push = SpatialWrench::Constant(kNan);  ///< about the origin of H
  double push_force = kNan;
  bool valid() const { return V_HO.allFinite(); }
};

/// An answer prepared for differentiation.
class DifferentiatedSpatialInstant {
 public:
  /// Differentiable: kMoves, the motion determined by the modes of the points, and at
  /// most twelve rates that contacts hold at zero. Otherwise `is_differentiable` is false
  /// and every sensitivity is NaN. Of forces that the motion leaves open (the share of
  /// the ends of a line that sticks) only the sum changes as said. Solve with a tolerance
  /// of 1e-11 or less for full accuracy. Keeps references to `problem` and `answer`.
  DifferentiatedSpatialInstant(const SpatialProblem& problem,
                               const SpatialInstant& answer) noexcept;

  bool is_differentiable() const { return differentiable_; }

  /// How far the contact point that is nearest to a change of mode is from it: a force
  /// over F0, or a rate over the push rate (see SpatialInstant::residual). Near 0 the
  /// sensitivities hold on one side only.
  double mode_slack() const { return mode_slack_; }

  SpatialSensitivity along(const SpatialVariation& variation) const noexcept;

 private:
  static constexpr int kRates = 8;
  static constexpr int kMost = kRates + 12;
  using System = Eigen::Matrix<double, kMost, kMost>;
  using Column = Eigen::Matrix<double, kMost, 1>;
  using Laws = Eigen::Matrix<double, 4, 1>;  // along n, t, o and spin
  using Rows = Eigen::Matrix<double, 4, kRates>;

  struct Units {
    Vec3 centre = Vec3::Zero();
    double length = 1.0, force = 1.0, rate = 1.0;
  };
  /// What a contact point obeys at the answer, in units.
  struct Point {
    Rows H;                    // its rates by those of object and jaws
    Laws c, f;                 // rates and forces
    Laws slip = Laws::Zero();  // direction of slip; zero: sticks or open
    double mu = 0.0;
    double slip_speed = 0.0;
    double R = 0.0;
    int dimensions = 3;  // 4 with spin
    bool loaded = false;
    bool rigid = false;    // its normal rate stays zero
    bool sticks = false;   // its tangential rates stay zero
    bool springs = false;  // its normal force follows a foundation
  };
  Point point_at(const ContactPatch& patch, int i) const noexcept;
  Eigen::Matrix4d stiffness_of(const Point& point) const noexcept;
  Laws explicit_rates(const ContactPatch& patch, int i,
                      const SpatialVariation& variation) const noexcept;
  void see_mode(const Point& point) noexcept;
  void fill_system() noexcept;

  const SpatialProblem& problem_;
  const SpatialInstant& answer_;
  JawFreedoms jaws_;
  Units units_;
  System inverse_ = System::Zero();
  bool differentiable_ = false;
  double mode_slack_ = kNan;
};

/// The difference quotient of two questions that differ by `step` in some parameter; with
/// the same patches and points.
SpatialVariation variation_between(const SpatialProblem& below,
                                   const SpatialProblem& above, double step) noexcept;

/// How the question of a scene at a pose changes with a parameter. The compliance in
/// units V0 / F0 stays. Quasi-static. Takes heap: the scene is changed and asked again.
SpatialVariation spatial_variation_of(const Model& model, const PushContact& contact,
                                      double place, const PlanarPose& X_HO,
                                      const SpatialTwist& V_HP,
                                      const SpatialQuestionOptions& options,
                                      InstantParameter parameter);

}  // namespace prehensile
