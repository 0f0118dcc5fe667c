#include "scarp/run/initial.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "scarp/base/error.hpp"
#include "scarp/comm/alone.hpp"
#include "scarp/exec/stress_update.hpp"
#include "scarp/lab/k0.hpp"

namespace scarp::run {
namespace {

template <int Dim>
struct InitialStress {
  Sym<double, sym_size<Dim>> sigma;  ///< compression positive
  double vertical;
};

template <int Dim>
[[noreturn]] void refuse(const input::RegionInputOf<Dim>& region, const Problem& problem, const Vec<Dim>& x) {
  throw InputError(
      fmt::format("region \"{}\", initial state at ({:.4g}): {}", region.name, fmt::join(x, ", "), problem.what),
      problem.value, problem.remedy, region.position);
}

/// K0 at any vertical stress of a region: the user's number, or that of the model at the overconsolidation ratio that
/// OCR or POP gives there.
template <int Dim>
class RegionK0 {
 public:
  RegionK0(const Block<Dim>& block, const input::RegionInputOf<Dim>& region, const OverburdenOf<Dim>& overburden) {
    if (region.stress) return;
    if (region.K0) {
      number_ = *region.K0;
      return;
    }
    find_history(block, region);
    double least = std::numeric_limits<double>::infinity(), largest = 0;
    for (int i = 0; i < block.size(); ++i) {
      const double vertical = overburden.vertical_stress(position_of(block.points, i));
      largest = std::max(largest, vertical);
      if (vertical > 0) least = std::min(least, vertical);
    }
    least = comm::least_of_all(least);
    largest = comm::most_of_all(largest);
    if (!(largest > 0)) return;  // no weight, no stress
    const int count = 1 + static_cast<int>(std::ceil(std::log(largest / least) / std::log(1.5)));
    for (int k = 0; k < count; ++k) {
      const double vertical = count > 1 ? least * std::pow(largest / least, k / (count - 1.0)) : least;
      try {
        levels_.push_back({std::log(vertical), lab::K0Curve(block.model, vertical, OCR(vertical))(OCR(vertical))});
      } catch (const RunError& error) {
        throw InputError(fmt::format("region \"{}\": {}", region.name, error.problem()), error.value(), error.remedy(),
                         region.position);
      }
    }
  }

  double operator()(double vertical) const {
    if (levels_.empty() || !(vertical > 0)) return number_;
    const double x = std::log(vertical);
    std::size_t k = 1;
    while (k + 1 < levels_.size() && levels_[k].log_stress < x) ++k;
    if (k == levels_.size()) return levels_[0].K0;
    const auto &below = levels_[k - 1], &above = levels_[k];
    const double share = std::clamp((x - below.log_stress) / (above.log_stress - below.log_stress), 0.0, 1.0);
    return below.K0 + share * (above.K0 - below.K0);
  }

 private:
  void find_history(const Block<Dim>& block, const input::RegionInputOf<Dim>& region) {
    const bool historyless = std::visit(
        [](const auto& model) {
          return requires {
            model.K0();
          };
        },
        block.model);
    const auto number = [&](const char* key) -> std::optional<double> {
      const auto found = region.initial.find(key);
      if (found == region.initial.end()) return {};
      const auto* value = std::get_if<double>(&found->second);
      return value ? std::optional<double>(*value) : std::nullopt;
    };
    const auto ocr = number("OCR"), pop = number("POP");
    if (!historyless && !ocr && !pop) {
      throw InputError(
          fmt::format("K0 = \"model\" in region \"{}\" takes the history of the soil from OCR or POP", region.name),
          "neither", "give OCR or POP in initial, or K0 as a number", region.position);
    }
    ocr_ = std::max(1.0, ocr.value_or(1.0));
    pop_ = std::max(0.0, pop.value_or(0.0));
  }

  /// Largest vertical stress so far over the present one.
  double OCR(double vertical) const { return std::max(ocr_, 1.0 + pop_ / vertical); }

  double number_ = 0, ocr_ = 1, pop_ = 0;
  struct Level {
    double log_stress, K0;
  };
  std::vector<Level> levels_;  ///< vertical stress ascending, no further apart than a factor of 1.5
};

template <int Dim>
InitialStress<Dim> stress_at(const input::RegionInputOf<Dim>& region, const OverburdenOf<Dim>& overburden,
                             const RegionK0<Dim>& ratio, const Vec<Dim>& x) {
  constexpr int N = sym_size<Dim>, up = Dim - 1;
  if (region.stress) return {to_mandel<N>(*region.stress), (*region.stress)[up]};
  const double vertical = overburden.vertical_stress(x);
  const double K0 = ratio(vertical);
  auto sigma = isotropic<double, N>(K0 * vertical);
  sigma[up] = vertical;
  return {sigma, vertical};
}

}  // namespace

template <int Dim>
void set_initial_state(Block<Dim>& block, const input::RegionInputOf<Dim>& region,
                       const OverburdenOf<Dim>& overburden) {
  const RegionK0<Dim> K0(block, region, overburden);
  std::visit(
      [&](const auto& model) {
        for (int i = 0; i < block.size(); ++i) {
          const auto x = position_of(block.points, i);
          const auto stress = stress_at<Dim>(region, overburden, K0, x);
          std::vector<Problem> problems;
          const auto state =
              model.template initial_state<sym_size<Dim>>(stress.sigma, stress.vertical, region.initial, problems);
          if (!problems.empty()) refuse<Dim>(region, problems.front(), x);
          exec::store<Dim>(model, state, block, [i](double number, Column& column) { column[i] = number; });
        }
      },
      block.model);
  if (block.length > 0) {  // κ̂ starts at κ
    const int kappa = std::visit([](const auto& law) { return kappa_from_end(law); }, block.model);
    block.state.end()[-2] = block.state.end()[-kappa];
  }
}

template void set_initial_state<2>(Block<2>&, const input::RegionInputOf<2>&, const OverburdenOf<2>&);
template void set_initial_state<3>(Block<3>&, const input::RegionInputOf<3>&, const OverburdenOf<3>&);

}  // namespace scarp::run
