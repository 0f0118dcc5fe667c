// A biaxial test in plane strain on bonded clay, 0.5 m × 1 m, whose bonds are lost in a band from a weak spot. How wide
// the band is, and so the load after the peak, is the mesh's without an internal length.
//
// The left side is a plane of symmetry, with the spot in its corner on the smooth base: one band, always the same one.
// On the right a medium as soft as water, under the same pressure as the clay, keeps that on its side. The platen is
// made of points so heavy that nothing slows them down; they come down at constant speed, and stretch sideways with the
// clay, as a platen without friction lets it. GIMP, for clay that leaves the lines of the grid makes noise with linear
// functions, and noise breaks bonds all over the specimen.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "../step/soils.hpp"
#include "body_maker.hpp"

namespace scarp::verification {

class Biaxial {
 public:
  static constexpr double width = 0.5, height = 1, beside = 0.25;  ///< of the specimen, and of the medium [m]
  static constexpr double p = 50, p_c = 600, R_b = 3;              ///< at the start [kPa]
  static constexpr double speed = 0.1;                             ///< of the platen [m/s]

  /// n elements over the width; softening over `length` [m]; p_c in the spot is smaller by the share `weakness`.
  Biaxial(int n, double length, double weakness = 0.1)
      : h_(width / n),
        body_(on_grid({0, 0}, {width + beside, height + thickness}, {n + cells(beside), cells(height + thickness)},
                      {0, 0}, GridFunctions::gimp)) {
    add(test::subloading(), rho, {0, 0}, {width, height}, length);
    add(linear_elastic(20, 0.0), rho, {width, 0}, {width + beside, height}, 0);
    add(linear_elastic(1e4, 0.0), 1e4 * rho, {0, height}, {width + beside, height + thickness}, 0);
    set_clay(weakness);
    for (auto& block : body_.blocks()) {
      auto& points = block.points;
      for (int i = 0; i < block.size(); ++i) {
        for (int c = 0; c < 3; ++c) points.sigma[c][i] = -p;
        points.v[1][i] = -speed * std::min(1.0, points.x[1][i] / height);  // no blow at the start
      }
    }
    locate_points(body_);
    const auto& sets = body_.mesh->node_sets;
    fix(body_.conditions, sets.at("bottom"), 1);
    for (const char* side : {"left", "right"}) fix(body_.conditions, sets.at(side), 0);
  }

  Body<2>& body() { return body_; }
  const Points<2>& clay() const { return body_.blocks()[0].points; }
  double strain() const { return time_ * speed / height; }

  /// Steps until the axial strain is this.
  void compress(double to) {
    StepSettings settings;
    settings.scheme = report_scheme(0.9);
    while (strain() < to) {
      if (steps_++ % 50 == 0) dt_ = 0.4 * critical_time_step(body_);
      time_ += dt_;
      advance(body_, dt_, settings);
      drive_platen();
    }
  }

  /// Load over the width at the start, less the pressure [kPa]: the mean of σ_yy over the sections.
  double q() const {
    double sum = 0;
    for (int i = 0; i < clay().size(); ++i) sum -= clay().sigma[1][i] * clay().volume[i];
    return sum / (height * (1 - strain())) / width - p;
  }

  /// ‖ε^p‖ of point i of the clay.
  double plastic(int i) const {
    double sum = 0;
    for (std::size_t c = epsp; c < epsp + 4; ++c) sum += body_.blocks()[0].state[c][i] * body_.blocks()[0].state[c][i];
    return std::sqrt(sum);
  }

  /// The area (∫ ‖ε^p‖)² / ∫ ‖ε^p‖² that plastic strain has gathered in, over the width [m]: of a band along its
  /// whole length in proportion to how wide it is.
  double band() const {
    double sum = 0, squares = 0;
    for (int i = 0; i < clay().size(); ++i) {
      sum += plastic(i) * clay().volume[i];
      squares += plastic(i) * plastic(i) * clay().volume[i];
    }
    return sum * sum / squares / width;
  }

 private:
  static constexpr double rho = 1.8, thickness = 0.1;  ///< of the platen [m]
  static constexpr std::size_t epsp = 8;               ///< columns of β and `a` come before

  int cells(double size) const { return static_cast<int>(std::lround(size / h_)); }

  void add(const AnyModel& law, double density, const Vec<2>& low, const Vec<2>& high, double length) {
    const std::array counts{2 * cells(high[0] - low[0]), 2 * cells(high[1] - low[1])};
    const auto points = add_box(body_, law, density, low, high, counts).points;
    body_.fields[0].blocks.pop_back();
    Block<2> block("soil", law, length);
    resize(block, points.size());
    block.points = points;
    body_.fields[0].blocks.push_back(std::move(block));
  }

  /// The state of the clay, and the weak spot in the corner.
  void set_clay(double weakness) {
    constexpr double spot = 0.1;
    auto& block = body_.blocks()[0];
    const auto& law = std::get<Subloading>(block.model);
    for (int i = 0; i < block.size(); ++i) {
      const double x = block.points.x[0][i], y = block.points.x[1][i];
      const double size = p_c * (1 - weakness * std::exp(-(x * x + y * y) / (spot * spot)));
      std::vector<Problem> problems;
      const auto s =
          law.initial_state<4>(isotropic<double, 4>(p), p, {{"R_b", R_b}, {"p_c", size}, {"a", 0.5}}, problems);
      std::size_t c = 0;
      for_each_component(
          [&](double value) {
            if (c >= 4) block.state[c - 4][i] = value;
            ++c;
          },
          s);
    }
  }

  void drive_platen() {
    double xv = 0, xx = 0;
    for (int i = 0; i < clay().size(); ++i) {
      if (clay().x[1][i] < (0.8 - strain()) * height) continue;
      xv += clay().x[0][i] * clay().v[0][i];
      xx += clay().x[0][i] * clay().x[0][i];
    }
    auto& platen = body_.blocks()[2].points;
    for (int i = 0; i < platen.size(); ++i) {
      const double x = platen.x[0][i];
      platen.v[0][i] = xv / xx * std::min(x, (width + beside - x) * width / beside);
      platen.v[1][i] = -speed;
    }
  }

  double h_;
  Body<2> body_;
  double time_ = 0, dt_ = 0;
  int steps_ = 0;
};

}  // namespace scarp::verification
