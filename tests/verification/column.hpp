// A column under its own weight, on a smooth base between smooth walls, at strains so small (1e-7) that its geometry
// does not change.
//
// At rest u_y = −(ρg/M)(Hy − y²/2), σ_yy = −ρg(H − y), σ_xx = σ_zz = ν/(1−ν) σ_yy, with the constrained modulus M.
// Weight that comes on at once at t = 0 makes u = u_static less the series that starts from it, of period 4H/c; half a
// period on, at t = 2H/c, the series has changed sign: displacement and stress are twice the static ones everywhere.
#pragma once

#include "method.hpp"

namespace scarp::verification {

struct ColumnErrors {
  double displacement = 0, stress = 0;  ///< relative L2 errors over the points, of u_y and σ_yy
  double inner_stress = 0;              ///< largest error of σ_yy in the middle half of the column, over ρgH
  double top = 0,
         base = 0;        ///< displacement of the highest and stress of the lowest points, parts of their static ones
  double unbalanced = 0;  ///< at the end, over the weight
};

class WeightColumn {
 public:
  static constexpr double H = 1;
  static constexpr Solid solid{1000, 0.3, 1000};

  /// n elements over the height; the mesh has a quarter as many above.
  WeightColumn(int n, int per_cell, const Method& method)
      : n_(n),
        per_cell_(per_cell),
        settings_(method.settings()),
        body_(on_grid({0, 0}, {2 * H / n, 1.25 * H}, {2, n + n / 4}, {0, -strain * solid.M() / (solid.rho * H)},
                      method.shape)) {
    add_box(body_, LinearElastic({solid.E, solid.nu}), solid.rho, {0, 0}, {2 * H / n, H}, {2 * per_cell, per_cell * n});
    locate_points(body_);
    fix(body_.conditions, body_.mesh->node_sets.at("bottom"), 1);
    for (const char* side : {"left", "right"}) fix(body_.conditions, body_.mesh->node_sets.at(side), 0);
  }

  /// Weight put on at once; how it is at t = 2H/c.
  ColumnErrors fall() {
    unbalanced_ = 0;
    const int steps = static_cast<int>(std::ceil(2 * n_ / safety));
    for (int s = 0; s < steps; ++s) advance(body_, 2 * H / (steps * solid.wave_speed()), settings_);
    return compare(2);
  }

  /// With damping until the unbalanced force is 1e-8 of the weight, or waves have crossed the column 200 times.
  ColumnErrors rest() {
    settings_.damping = 0.9;
    const double dt = safety * H / (n_ * solid.wave_speed());
    const int most = static_cast<int>(200 * n_ / safety);
    unbalanced_ = 1;
    for (int s = 0; s < most && unbalanced_ > 1e-8; ++s) {
      const auto totals = advance(body_, dt, settings_);
      unbalanced_ = totals.unbalanced_force / totals.weight;
    }
    return compare(1);
  }

 private:
  static constexpr double strain = 1e-7, safety = 0.4;

  /// With `times` the static solution.
  ColumnErrors compare(double times) const {
    const double h = H / n_, rho_g = strain * solid.M() / H;
    const auto exact = [&](double y) { return -times * rho_g * (H - y); };
    ColumnErrors errors;
    RelativeL2 displacement, stress;
    const auto& points = body_.blocks()[0].points;
    for (int p = 0; p < points.size(); ++p) {
      const double y = points.x_start[1][p], u = points.u(1, p), sigma = points.sigma[1][p];
      displacement.add(1, u, -times * rho_g / solid.M() * (H * y - y * y / 2));
      stress.add(1, sigma, exact(y));
      if (std::abs(y - H / 2) < H / 4) {
        errors.inner_stress = std::max(errors.inner_stress, std::abs(sigma - exact(y)) / (rho_g * H));
      }
      if (y > H - h / per_cell_) errors.top = u / (-rho_g / solid.M() * (H * y - y * y / 2));
      if (y < h / per_cell_) errors.base = sigma / (-rho_g * (H - y));
    }
    errors.displacement = displacement.value();
    errors.stress = stress.value();
    errors.unbalanced = unbalanced_;
    return errors;
  }

  int n_, per_cell_;
  StepSettings settings_;
  Body<2> body_;
  double unbalanced_ = 0;
};

}  // namespace scarp::verification
