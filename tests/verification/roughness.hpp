// A slope of nearly incompressible elastic soil that goes to rest under its weight: how rough its pressure is.
#pragma once

#include "ground.hpp"

namespace scarp::verification {

/// Height of a slope of 12 m: 4 m, from x = 5 m on falling to 2 m at 9 m.
inline double slope_top(double x) {
  return x < 5 ? 4 : x > 9 ? 2 : 4 - 0.5 * (x - 5);
}

/// Elements of size h, points `spacing` apart, or what makes a whole number of them; starts from the stress of level
/// ground under each point.
inline Body<2> soft_slope(Cells cells, double h, double spacing, double nu,
                          GridFunctions shape = GridFunctions::linear) {
  const std::array<int, 2> elements{static_cast<int>(std::lround(12 / h)), static_cast<int>(std::lround(5 / h))};
  Body<2> body(std::make_unique<const Mesh<2>>(cut_up(make_grid({0, 0}, {12, 5}, elements, shape), cells)),
               {0, -Soil::g});
  const double columns = std::round(12 / spacing), rows = std::round(4 / spacing);
  std::vector<Place> places;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Vec<2> x{(i + 0.5) * 12 / columns, (j + 0.5) * 4 / rows};
      if (x[1] < slope_top(x[0])) places.push_back({x, 12 / columns * 4 / rows});
    }
  }
  auto& points = add_points(body, linear_elastic(Soil::E, nu), Soil::rho, places).points;
  for (int p = 0; p < points.size(); ++p) {
    const double vertical = -Soil::rho * Soil::g * (slope_top(points.x[0][p]) - points.x[1][p]);
    for (int j = 0; j < 3; ++j) points.sigma[j][p] = vertical * (j == 1 ? 1 : nu / (1 - nu));
  }
  locate_points(body, true);
  const auto& sets = body.mesh->node_sets;
  for (int j = 0; j < 2; ++j) fix(body.conditions, sets.at("bottom"), j);
  for (const char* side : {"left", "right"}) fix(body.conditions, sets.at(side), 0);
  return body;
}

inline double pressure(const Points<2>& points, int p) {
  return -(points.sigma[0][p] + points.sigma[1][p] + points.sigma[2][p]) / 3;
}

/// a + b x + c y through the pressures of some points, by least squares about their centre.
class Plane {
 public:
  Plane(const Points<2>& points, const std::vector<int>& some) {
    const double n = static_cast<double>(some.size());
    for (const int p : some) {
      for (int j = 0; j < 2; ++j) centre_[j] += points.x[j][p] / n;
      a_ += pressure(points, p) / n;
    }
    double xx = 0, xy = 0, yy = 0, px = 0, py = 0;
    for (const int p : some) {
      const double x = points.x[0][p] - centre_[0], y = points.x[1][p] - centre_[1];
      xx += x * x;
      xy += x * y;
      yy += y * y;
      px += pressure(points, p) * x;
      py += pressure(points, p) * y;
    }
    const double det = xx * yy - xy * xy;
    b_ = (px * yy - py * xy) / det;
    c_ = (py * xx - px * xy) / det;
  }
  double at(const Vec<2>& x) const { return a_ + b_ * (x[0] - centre_[0]) + c_ * (x[1] - centre_[1]); }

 private:
  Vec<2> centre_{};
  double a_ = 0, b_ = 0, c_ = 0;
};

/// Root mean square, over the mean pressure, of what is left of the pressure of the points of an element beside a plane
/// through those of it and of all around, for the elements around which all are inside the soil.
inline double roughness(const Body<2>& body) {
  const auto& points = body.blocks()[0].points;
  const auto inside = [&](int e) {
    const int slot = body.fields[0].active.slot[e];
    return slot >= 0 && body.fields[0].buffers.inside[slot];
  };
  std::vector<std::vector<int>> points_in(body.mesh->element_count());
  for (int p = 0; p < points.size(); ++p) points_in[points.element[p]].push_back(p);
  double left2 = 0, sum = 0;
  int n = 0;
  for (int e = 0; e < body.mesh->element_count(); ++e) {
    const auto around = body.mesh->elements_around(e);
    if (!inside(e) || !std::all_of(around.begin(), around.end(), inside)) continue;
    auto near = points_in[e];
    for (const int other : around) near.insert(near.end(), points_in[other].begin(), points_in[other].end());
    const Plane plane(points, near);
    for (const int p : points_in[e]) {
      const double left = pressure(points, p) - plane.at(position_of(points, p));
      left2 += left * left;
      sum += pressure(points, p);
      ++n;
    }
  }
  return std::sqrt(left2 / n) / (sum / n);
}

/// The same of a slope that has had two seconds to come to rest with local damping: some ten periods of its shear.
inline double roughness_at_rest(const Scheme& scheme, Cells cells, double h, double spacing, double nu = 0.49,
                                GridFunctions shape = GridFunctions::linear) {
  auto body = soft_slope(cells, h, spacing, nu, shape);
  StepSettings settings;
  settings.scheme = scheme;
  settings.damping = 0.7;
  double unbalanced = 0;
  run_until(body, 2, 0.5, settings,
            [&](double, const StepTotals<2>& totals) { unbalanced = totals.unbalanced_force / totals.weight; });
  return unbalanced < 3e-3 ? roughness(body) : std::nan("");
}

}  // namespace scarp::verification
