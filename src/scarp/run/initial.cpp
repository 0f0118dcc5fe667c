#include "scarp/run/initial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "scarp/base/error.hpp"
#include "scarp/lab/k0.hpp"

namespace scarp::run {
namespace {

struct InitialStress {
  Sym<double, 4> sigma;  ///< compression positive
  double vertical;
};

[[noreturn]] void refuse(const input::RegionInput& region, const Problem& problem, const Vec<2>& x) {
  throw InputError(
      fmt::format("region \"{}\", initial state at ({:.4g}, {:.4g}): {}", region.name, x[0], x[1], problem.what),
      problem.value, problem.remedy, region.position);
}

template <class State>
void store(Block<2>& block, int i, const State& state) {
  const int columns = static_cast<int>(block.state.size());
  int c = 0;
  for_each_component(
      [&](const double& value) {
        if (c < 4) {
          block.points.sigma[c][i] = -value;
        } else if (c - 4 < columns) {
          block.state[c - 4][i] = value;
        }
        ++c;
      },
      state);
}

/// K0 at any vertical stress of a region: the user's number, or that of the model at the overconsolidation ratio that
/// OCR or POP gives there.
class RegionK0 {
 public:
  RegionK0(const Block<2>& block, const input::RegionInput& region, const Overburden& overburden) {
    if (region.stress) return;
    if (region.K0) {
      number_ = *region.K0;
      return;
    }
    find_history(block, region);
    double least = 0, largest = 0;
    for (int i = 0; i < block.size(); ++i) {
      const double vertical = overburden.vertical_stress({block.points.x[0][i], block.points.x[1][i]});
      largest = std::max(largest, vertical);
      if (vertical > 0 && (least == 0 || vertical < least)) least = vertical;
    }
    if (!(least > 0)) return;  // no weight, no stress
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
  void find_history(const Block<2>& block, const input::RegionInput& region) {
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

InitialStress stress_at(const input::RegionInput& region, const Overburden& overburden, const RegionK0& ratio,
                        const Vec<2>& x) {
  if (region.stress) return {to_mandel<4>(*region.stress), (*region.stress)[1]};
  const double vertical = overburden.vertical_stress(x);
  const double K0 = ratio(vertical);
  return {Sym<double, 4>{{K0 * vertical, vertical, K0 * vertical, 0.0}}, vertical};
}

}  // namespace

void set_initial_state(Block<2>& block, const input::RegionInput& region, const Overburden& overburden) {
  const RegionK0 K0(block, region, overburden);
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
