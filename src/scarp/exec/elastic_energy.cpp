#include "scarp/exec/elastic_energy.hpp"

#include "scarp/exec/stress_update.hpp"

namespace scarp::exec {
namespace {

/// ½ σ : C⁻¹ : σ = p²/2K + s : s/4G, with K and G from M = K + 4G/3 and ν.
template <class State>
double energy_density(const State& s, double M, double nu) {
  const double K = M * (1 + nu) / (3 * (1 - nu)), G = M * (1 - 2 * nu) / (2 * (1 - nu));
  const double p = trace(s.sigma) / 3;
  const double all2 = dot(s.sigma, s.sigma);
  return p * p / (2 * K) + (all2 - 3 * p * p) / (4 * G);
}

}  // namespace

template <int Dim>
double elastic_energy(const Block<Dim>& block, PointRange range) {
  double energy = 0;
  std::visit(
      [&]<class Model>(const Model& model) {
        if constexpr (requires { model.parameters().nu; }) {
          for (int k = 0; k < range.count; ++k) {
            const int i = range.order[k];
            const auto s = state_of<Dim>(block, model, i);
            const double M = model.p_wave_modulus(s);
            if (M > 0) energy += block.points.volume[i] * energy_density(s, M, model.parameters().nu);
          }
        }
      },
      block.model);
  return energy;
}

template double elastic_energy<2>(const Block<2>&, PointRange);
template double elastic_energy<3>(const Block<3>&, PointRange);

}  // namespace scarp::exec
