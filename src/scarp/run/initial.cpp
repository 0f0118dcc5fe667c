#include "scarp/run/initial.hpp"

#include <fmt/format.h>

#include "scarp/base/error.hpp"

namespace scarp::run {
namespace {

struct InitialStress {
  Sym<double, 4> sigma;  ///< compression positive
  double vertical;
};

InitialStress stress_at(const input::RegionInput& region, const Overburden& overburden, double K0, const Vec<2>& x) {
  if (region.stress) return {to_mandel<4>(*region.stress), (*region.stress)[1]};
  const double vertical = overburden.vertical_stress(x);
  return {Sym<double, 4>{{K0 * vertical, vertical, K0 * vertical, 0.0}}, vertical};
}

[[noreturn]] void refuse(const input::RegionInput& region, const Problem& problem, const Vec<2>& x) {
  throw InputError(
      fmt::format("region \"{}\", initial state at ({:.4g}, {:.4g}): {}", region.name, x[0], x[1], problem.what),
      problem.value, problem.remedy, region.position);
}

template <class State>
void store(Block<2>& block, int i, const State& state) {
  int c = 0;
  for_each_component(
      [&](const double& value) {
        if (c < 4) {
          block.points.sigma[c][i] = -value;
        } else {
          block.state[c - 4][i] = value;
        }
        ++c;
      },
      state);
}

}  // namespace

void set_initial_state(Block<2>& block, const input::RegionInput& region, const Overburden& overburden) {
  const double K0 = region.K0.value_or(0);
  std::visit(
      [&](const auto& model) {
        for (int i = 0; i < block.size(); ++i) {
          const Vec<2> x{block.points.x[0][i], block.points.x[1][i]};
          const auto stress = stress_at(region, overburden, K0, x);
          std::vector<Problem> problems;
          const auto state = model.template initial_state<4>(stress.sigma, stress.vertical, region.initial, problems);
          if (!problems.empty()) refuse(region, problems.front(), x);
          store(block, i, state);
        }
      },
      block.model);
}

}  // namespace scarp::run
