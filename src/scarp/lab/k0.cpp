#include "scarp/lab/k0.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scarp/base/error.hpp"
#include "scarp/material/integrate/embedded.hpp"

namespace scarp::lab {
namespace {

constexpr int vertical_axis = 1;
/// The history starts at this share of its largest stress; what it starts from is forgotten on the way.
constexpr double start_share = 1e-3;
/// Growth of the vertical stress in one increment, as the elastic stiffness says.
constexpr double growth = 0.02;

template <class Model>
void strain(const Model& model, typename Model::template State<double, 4>& s, double sign) {
  Sym<double, 4> deps = Sym<double, 4>::zero();
  deps[vertical_axis] = sign * growth * s.sigma[vertical_axis] / model.p_wave_modulus(s);
  const auto report = integrate<ModifiedEuler>(model, s, deps, {1e-6, 1e-6});
  if (report.end != IntegrationEnd::done || !(s.sigma[vertical_axis] > 0)) {
    throw RunError("the model fails in the one-dimensional history that K0 is taken from",
                   fmt::format("at a vertical stress of {:.4g}", s.sigma[vertical_axis]),
                   "give K0 as a number, or a smaller OCR or POP");
  }
}

double ratio(const Sym<double, 4>& sigma) {
  return sigma[0] / sigma[vertical_axis];
}

}  // namespace

K0Curve::K0Curve(const AnyModel& any, double vertical, double largest_OCR) {
  std::visit(
      [&](const auto& model) {
        if constexpr (requires { model.K0(); }) {
          points_ = {{0.0, model.K0()}};
        } else if constexpr (requires { model.slow_limit(); }) {
          *this = K0Curve(model.slow_limit(), vertical, largest_OCR);  // the soil had all the time that it needs
        } else {
          const double largest = vertical * largest_OCR;
          std::vector<Problem> problems;
          const auto start = isotropic<double, 4>(start_share * largest);
          auto s =
              model.template initial_state<4>(start, start[vertical_axis], model.normally_consolidated(), problems);
          if (!problems.empty()) throw RunError(problems[0].what, problems[0].value, problems[0].remedy);
          while (s.sigma[vertical_axis] < largest) strain(model, s, 1.0);
          const double top = s.sigma[vertical_axis];
          points_.push_back({0.0, ratio(s.sigma)});
          while (points_.back().log_OCR < std::log(largest_OCR)) {
            strain(model, s, -1.0);
            points_.push_back({std::log(top / s.sigma[vertical_axis]), ratio(s.sigma)});
          }
        }
      },
      any);
}

double K0Curve::operator()(double OCR) const {
  const double x = std::log(OCR);
  const auto above = std::lower_bound(points_.begin(), points_.end(), x,
                                      [](const Point& point, double value) { return point.log_OCR < value; });
  if (above == points_.begin()) return above->K0;
  if (above == points_.end()) return points_.back().K0;
  const auto below = above - 1;
  const double share = (x - below->log_OCR) / (above->log_OCR - below->log_OCR);
  return below->K0 + share * (above->K0 - below->K0);
}

}  // namespace scarp::lab
