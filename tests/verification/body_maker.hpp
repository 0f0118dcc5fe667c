// Bodies for verification problems: a box of points in a grid, evenly spaced, without the filling of polygons.
#pragma once

#include <memory>

#include "scarp/mesh/grid.hpp"
#include "scarp/step/step.hpp"

namespace scarp::verification {

/// A body on a grid over low..high (sizes in whole elements); no points yet.
inline Body<2> on_grid(const Vec<2>& low, const Vec<2>& high, const std::array<int, 2>& elements, const Vec<2>& gravity,
                       GridFunctions functions = GridFunctions::linear) {
  return Body<2>(
      std::make_unique<const Mesh<2>>(make_grid(low, {high[0] - low[0], high[1] - low[1]}, elements, functions)),
      gravity);
}

/// Adds a block that fills the box low..high with counts[0] × counts[1] points, at rest and without stress. Call
/// locate_points() when all blocks are in.
inline Block<2>& add_box(Body<2>& body, const AnyModel& model, double density, const Vec<2>& low, const Vec<2>& high,
                         const std::array<int, 2>& counts) {
  Block<2> block("box", model);
  resize(block, counts[0] * counts[1]);
  const double dx = (high[0] - low[0]) / counts[0], dy = (high[1] - low[1]) / counts[1];
  const int first = body.point_count();
  for (int j = 0; j < counts[1]; ++j) {
    for (int i = 0; i < counts[0]; ++i) {
      const int p = j * counts[0] + i;
      auto& points = block.points;
      points.x[0][p] = low[0] + (i + 0.5) * dx;
      points.x[1][p] = low[1] + (j + 0.5) * dy;
      points.volume[p] = points.initial_volume[p] = dx * dy;
      points.mass[p] = density * dx * dy;
      points.id[p] = first + p;
    }
  }
  body.blocks.push_back(std::move(block));
  return body.blocks.back();
}

inline AnyModel linear_elastic(double E, double nu) {
  return LinearElastic({E, nu});
}

/// Steps of equal length no longer than `safety` critical ones until `end`, f(time, books) after each.
template <class F>
void run_until(Body<2>& body, double end, double safety, const StepSettings& settings, F&& f) {
  const double critical = critical_time_step(body);
  const int steps = static_cast<int>(std::ceil(end / (safety * critical)));
  const double dt = end / steps;
  for (int s = 1; s <= steps; ++s) f(s * dt, advance(body, dt, settings));
}

}  // namespace scarp::verification
