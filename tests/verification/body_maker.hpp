// Bodies for verification problems: a box of points in a grid, evenly spaced, without the filling of polygons.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <variant>
#include <vector>

#include "scarp/mesh/grid.hpp"
#include "scarp/step/step.hpp"

namespace scarp::verification {

/// A body on a grid over low..high (sizes in whole elements) with these shape functions; no points yet.
inline Body<2> on_grid(const Vec<2>& low, const Vec<2>& high, const std::array<int, 2>& elements, const Vec<2>& gravity,
                       GridFunctions shape = GridFunctions::linear) {
  return Body<2>(std::make_unique<const Mesh<2>>(make_grid(low, {high[0] - low[0], high[1] - low[1]}, elements, shape)),
                 gravity);
}

/// Where a point is and the area that it stands for.
struct Place {
  Vec<2> x;
  double area;
};

/// Adds a block of points at these places, at rest and in the natural state of their law, numbered on from those that
/// the body has. Call locate_points() when all blocks are in.
inline Block<2>& add_points(Body<2>& body, const AnyModel& model, double density, const std::vector<Place>& places) {
  Block<2> block("soil", model);
  resize(block, static_cast<int>(places.size()));
  const int first = body.point_count();
  auto& points = block.points;
  for (int p = 0; p < block.size(); ++p) {
    for (int j = 0; j < 2; ++j) points.x[j][p] = places[p].x[j];
    points.volume[p] = points.initial_volume[p] = places[p].area;
    points.mass[p] = density * places[p].area;
    points.id[p] = first + p;
  }
  if (std::holds_alternative<NeoHookean>(model)) {  // its state is b, and b = I
    for (int c = 0; c < 3; ++c) std::fill(block.state[c].begin(), block.state[c].end(), 1.0);
  }
  body.fields[0].blocks.push_back(std::move(block));
  return body.fields[0].blocks.back();
}

/// Adds a block that fills the box low..high with counts[0] × counts[1] points, as add_points() does.
inline Block<2>& add_box(Body<2>& body, const AnyModel& model, double density, const Vec<2>& low, const Vec<2>& high,
                         const std::array<int, 2>& counts) {
  std::vector<Place> places;
  const double dx = (high[0] - low[0]) / counts[0], dy = (high[1] - low[1]) / counts[1];
  for (int j = 0; j < counts[1]; ++j) {
    for (int i = 0; i < counts[0]; ++i) {
      places.push_back({{low[0] + (i + 0.5) * dx, low[1] + (j + 0.5) * dy}, dx * dy});
    }
  }
  return add_points(body, model, density, places);
}

inline AnyModel linear_elastic(double E, double nu) {
  return LinearElastic({E, nu});
}

/// Steps of equal length no longer than `safety` critical ones of the scheme until `end`, f(time, books) after each.
template <class F>
void run_until(Body<2>& body, double end, double safety, const StepSettings& settings, F&& f) {
  const double critical = critical_time_step(body, settings.scheme, settings.damping);
  const int steps = static_cast<int>(std::ceil(end / (safety * critical)));
  const double dt = end / steps;
  for (int s = 1; s <= steps; ++s) f(s * dt, advance(body, dt, settings));
}

}  // namespace scarp::verification
