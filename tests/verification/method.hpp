// What a verification problem is computed with, and the measures that the problems share.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "body_maker.hpp"

namespace scarp::verification {

/// The shape functions of grids.
inline constexpr std::array all_shapes{GridFunctions::linear, GridFunctions::b_spline, GridFunctions::gimp};

inline std::string name_of(GridFunctions shape) {
  return shape == GridFunctions::linear ? "linear" : shape == GridFunctions::gimp ? "gimp" : "b-spline";
}

/// The name of a test with a shape as its parameter.
inline constexpr auto label_of = [](const auto& its) {
  std::string name = name_of(its.param);
  std::erase(name, '-');
  return name;
};

/// A scheme with nothing in it that takes energy: no PIC share, no damping of waves.
inline Scheme undamped(Scheme scheme) {
  scheme.pic_time = std::numeric_limits<double>::infinity();
  scheme.damping = {0.0, 0};
  return scheme;
}

struct NamedScheme {
  const char* name;
  Scheme scheme;
};

/// The schemes of the step, undamped. (The points of apic take the nodes' velocities in every step all the same.)
inline std::vector<NamedScheme> all_schemes() {
  return {{"report", report_scheme()}, {"two-term", undamped(two_term_scheme())}, {"apic", undamped(apic_scheme())}};
}

/// Shape functions and the settings of the step.
struct Method {
  GridFunctions shape = GridFunctions::linear;
  QuadratureRule quadrature = QuadratureRule::corrected;
  Scheme scheme = report_scheme();
  double damping = 0;

  StepSettings settings() const {
    StepSettings s;
    s.quadrature = quadrature;
    s.scheme = scheme;
    s.damping = damping;
    return s;
  }
  std::string name() const {
    return name_of(shape) + (quadrature == QuadratureRule::points ? ", points" : ", corrected");
  }
};

/// Every shape function with every quadrature that makes a difference: GIMP has eq. 4 as printed only.
inline std::vector<Method> all_methods() {
  std::vector<Method> methods;
  for (const auto shape : all_shapes) {
    if (shape != GridFunctions::gimp) methods.push_back({shape, QuadratureRule::corrected});
    methods.push_back({shape, QuadratureRule::points});
  }
  return methods;
}

/// √(Σ w |f − f_exact|² / Σ w |f_exact|²)
class RelativeL2 {
 public:
  void add(double w, double f, double exact) {
    error2_ += w * (f - exact) * (f - exact);
    size2_ += w * exact * exact;
  }
  double value() const { return std::sqrt(error2_ / size2_); }

 private:
  double error2_ = 0, size2_ = 0;
};

/// Observed orders of convergence from errors of meshes that are each twice as fine as the one before.
inline std::vector<double> orders(const std::vector<double>& errors) {
  std::vector<double> result;
  for (std::size_t i = 1; i < errors.size(); ++i) result.push_back(std::log2(errors[i - 1] / errors[i]));
  return result;
}

/// "1.2e-3, 3.0e-4; orders 2.00"
inline std::string text_of(const std::vector<double>& errors) {
  std::string text;
  char number[32];
  for (const double e : errors) {
    std::snprintf(number, sizeof number, "%s%.2e", text.empty() ? "" : ", ", e);
    text += number;
  }
  const char* before = "; orders ";
  for (const double order : orders(errors)) {
    std::snprintf(number, sizeof number, "%s%.2f", before, order);
    text += number;
    before = ", ";
  }
  return text;
}

/// Young's modulus, Poisson's ratio and density of the elastic solid of a problem.
struct Solid {
  double E, nu, rho;

  double lambda() const { return E * nu / ((1 + nu) * (1 - 2 * nu)); }
  double mu() const { return E / (2 * (1 + nu)); }
  double M() const { return lambda() + 2 * mu(); }            ///< constrained modulus
  double wave_speed() const { return std::sqrt(M() / rho); }  ///< of compression, in the natural state
  AnyModel neo_hookean() const { return NeoHookean({E, nu}); }
};

}  // namespace scarp::verification
