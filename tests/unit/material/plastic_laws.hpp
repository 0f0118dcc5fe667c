// What the tests of the linear-elastic, plastic laws share: constants, with and without softening, and a start.
#pragma once

#include <cmath>
#include <map>
#include <string>

#include "material/samples.hpp"
#include "scarp/material/integrate/embedded.hpp"

namespace scarp::test::plastic {

template <class Model>
using State6 = typename Model::template State<double, 6>;
using Constants = std::map<std::string, double>;
constexpr IntegrationSettings sharp{1e-8, 1e-9};
inline const double degree = std::acos(-1.0) / 180;

/// The law with these constants, some changed.
template <class Model>
Model law(Constants constants, const Constants& changes = {}) {
  for (const auto& [key, value] : changes) constants[key] = value;
  return std::get<Model>(made(Model::description().name, constants));
}

inline const Constants clay{{"E", 2e4}, {"nu", 0.3}, {"s_u", 20}};
inline const Constants sand{{"E", 2e4}, {"nu", 0.3}, {"c", 5}, {"phi", 30}, {"psi", 10}};

inline const Constants soft_clay{{"s_u_residual", 10}, {"epsp_residual", 0.02}};
inline const Constants soft_sand{{"c_residual", 1}, {"phi_residual", 22}, {"epsp_residual", 0.04}};

/// At an isotropic stress.
template <class Model>
State6<Model> start(const Model&, double p) {
  State6<Model> s{};
  s.sigma = isotropic<double, 6>(p);
  return s;
}

}  // namespace scarp::test::plastic
