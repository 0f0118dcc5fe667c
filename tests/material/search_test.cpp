// A random search for increments that crash a law, make it answer nonsense or fail in silence: random constants within
// their bounds, random admissible states, random increments of 1e-6 to 1e-1, either scheme. Each case has a generator
// of its own, seeded by its number, so that a find is one case to run again. SCARP_SEARCH multiplies the number of
// cases: with 20 it is 10⁵ of the subloading model and 10⁴ of each other.
//
// The oracle is what every caller of integrate() counts on, whatever the law: all of the increment or a reason; numbers
// that are finite; a state that the law itself accepts without a correction; and that state inside its surface.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "samples.hpp"
#include "scarp/material/integrate/embedded.hpp"

namespace scarp::test {
namespace {

using Constants = std::map<std::string, double>;

class Random {
 public:
  explicit Random(unsigned seed) : generator(seed) {}

  double operator()(double low, double high) { return low + (high - low) * uniform_(generator); }
  /// Even over the decades.
  double decades(double low, double high) { return low * std::pow(high / low, uniform_(generator)); }
  /// `value`, but one time in eight the bound, which is a value of its own.
  double or_bound(double bound, double value) { return (*this)(0, 1) < 0.125 ? bound : value; }

  std::mt19937 generator;

 private:
  std::uniform_real_distribution<double> uniform_{0, 1};
};

Constants random_soil(Random& random) {
  const double kappa = random.decades(0.002, 0.05);
  return {{"kappa", kappa},
          {"lambda", kappa + random.decades(0.01, 0.3)},
          {"nu", random.or_bound(0, random(0, 0.49))},
          {"p_e", random.or_bound(0, random.decades(0.01, 50))},
          {"p_atm", 101.325}};
}

Constants random_subloading(Random& random) {
  auto c = random_soil(random);
  const double M_c = random(0.6, 1.8);
  c.insert({{"M_c", M_c},
            {"M", M_c * random(0.5, 1.2)},
            {"k", random.or_bound(1, random(0.52, 1))},
            {"alpha", random.or_bound(1, random(0.6, 1.5))},
            {"xi", random.or_bound(0, random(0, 0.3))},
            {"c_R", random.decades(0.5, 1000)},
            {"c_beta", random.or_bound(0, random(0, 50))},
            {"c_b", random.or_bound(0, random(0, 50))},
            {"c_a", random.or_bound(0, random(0, 50))},
            {"R_bf", random.or_bound(1, random(1, 2))},
            {"R_min", random.decades(0.001, 0.3)},
            {"delta", random.or_bound(0, random(0, 0.3))}});
  return c;
}

Constants random_plastic(const std::string& model, Random& random) {
  Constants c{{"E", random.decades(1e2, 1e6)},
              {"nu", random(-0.5, 0.49)},
              {"epsp_residual", random.or_bound(0, random.decades(0.003, 0.5))}};
  if (model == "von-mises" || model == "tresca") {
    c["s_u"] = random.decades(1, 200);
    c["s_u_residual"] = c["s_u"] * (c["epsp_residual"] > 0 ? random(0.1, 1) : 1);
    return c;
  }
  const bool falls = c["epsp_residual"] > 0;
  c["c"] = random.or_bound(0, random.decades(0.1, 100));
  c["phi"] = random(1, 50);
  c["psi"] = random.or_bound(0, c["phi"] * random(0, 1));
  c["c_residual"] = c["c"] * (falls ? random.or_bound(0, random(0, 1)) : 1);
  c["phi_residual"] = c["phi"] * (falls ? random(0.3, 1) : 1);
  c["psi_residual"] = falls ? std::min(c["psi"], c["phi_residual"]) * random(0, 1) : c["psi"];
  if (model == "mohr-coulomb") c["tension"] = random.or_bound(0, random.or_bound(1e30, random.decades(0.1, 100)));
  return c;
}

Constants random_constants(const std::string& model, Random& random) {
  if (model == "linear-elastic") return {{"E", random.decades(1e2, 1e6)}, {"nu", random(-0.9, 0.49)}};
  if (model == "neo-hookean") return {{"E", random.decades(1e2, 1e6)}, {"nu", random.or_bound(0, random(0, 0.49))}};
  if (model == "modified-cam-clay") {
    auto c = random_soil(random);
    c["M"] = random(0.5, 1.8);
    return c;
  }
  if (model == "subloading") return random_subloading(random);
  if (model == "viscoplastic-subloading") {
    auto c = random_subloading(random);
    c.insert({{"mu", random.decades(1e-2, 1e6)}, {"n", random.or_bound(1, random(1, 6))}, {"R_m", random(1.02, 3)}});
    return c;
  }
  return random_plastic(model, random);
}

/// A model with random constants; some sets are refused for what only shows between constants (too steep a softening).
template <class M>
M random_model(Random& random) {
  const std::string name = M::description().name;
  for (;;) {
    auto result = make_model(name, random_constants(name, random));
    if (result.model) return std::get<M>(*result.model);
  }
}

/// A stress in compression with any Lode angle.
Sym<double, 6> random_stress(Random& random) {
  const double p = random.decades(1, 1000);
  return isotropic<double, 6>(p) + (0.8 * p) * deviator(random_tensor<6>(random.generator));
}

/// A law's surfaces scale with stress: the same state at another pressure, down to the floor of p_c.
template <class State>
void scale(State& s, const Subloading::Parameters& c, Random& random) {
  const double factor = std::max(random.decades(0.003, 10), c.p_c_floor * c.p_atm / s.p_c);
  s.sigma = factor * s.sigma;
  s.a = factor * s.a;
  s.p_c *= factor;
}

LinearElastic::State<double, 6> random_start(const LinearElastic&, Random& random) {
  return {random_stress(random)};
}

NeoHookean::State<double, 6> random_start(const NeoHookean& model, Random& random) {
  NeoHookean::State<double, 6> s{Sym<double, 6>::zero(), isotropic<double, 6>(1)};
  for (int i = 0; i < 3; ++i) {
    s = model.update(s, as_increment(random_tensor<6>(random.generator, 0.2)), 1e-8).state;
  }
  return s;
}

Subloading::State<double, 6> random_start(const Subloading& model, Random& random) {
  auto s = random_state<6>(random.generator, model);
  scale(s, model.parameters(), random);
  return s;
}

ViscoplasticSubloading::State<double, 6> random_start(const ViscoplasticSubloading& model, Random& random) {
  const auto& slow = model.slow_limit();
  ViscoplasticSubloading::State<double, 6> s{random_start(slow, random), 0};
  const double room = slow.homothety(s).R - slow.parameters().R_min;
  s.overstress = std::max(0.0, random.or_bound(0, random(0, room)));
  return s;
}

ModifiedCamClay::State<double, 6> random_start(const ModifiedCamClay& model, Random& random) {
  const auto& c = model.parameters();
  const auto sigma = random_stress(random);
  const double through = model.p_c_through(sigma), p_c = through * random.or_bound(1, random.decades(1, 20));
  return {sigma, Sym<double, 6>::zero(), std::max(p_c, c.p_c_floor * c.p_atm)};
}

template <class M>
typename M::template State<double, 6> random_start(const M& model, Random& random) {
  // Half of them lie outside the surface, and come onto it, but for those whose friction falls faster at their
  // pressure than the elastic stress can.
  for (;;) {
    typename M::template State<double, 6> s{};
    s.sigma = random_stress(random);
    s.kappa = random.or_bound(0, random(0, 0.3));
    if (model.accept(s, 1e-4).sound) return s;
  }
}

/// Where the law knows of it, a point that has parted and opened.
template <class M, class State>
void part(const M& model, State& s, unsigned seed) {
  if constexpr (requires { s.gap; }) {
    Random random(seed);  // of its own: the other cases stay what they are
    auto open = s;
    open.sigma = Sym<double, 6>::zero();
    if constexpr (requires { open.a; }) open.a = open.sigma;
    if constexpr (requires { open.overstress; }) open.overstress = 0;
    open.gap = random.decades(1e-9, 1);
    if (model.admissible(open)) s = open;
  }
}

/// What of the state is not where its surfaces let it be, by the law's own equations; nothing where all is well.
template <class M, class State>
std::string beyond(const M&, const State&, const IntegrationSettings&) {
  return "";  // accept() says it
}
std::string beyond(const Subloading& m, const Subloading::State<double, 6>& s, double highest) {
  const auto& c = m.parameters();
  const double R = m.homothety(s).R;
  if (!(R >= 0 && R <= highest)) return fmt::format("R = {}", R);
  if (!(s.R_b >= 1)) return fmt::format("R_b − 1 = {}", s.R_b - 1);
  if (!(s.p_c >= c.p_c_floor * c.p_atm)) return fmt::format("p_c = {}", s.p_c);
  // Rounding of p over ‖s̄‖, which may be small.
  return std::abs(trace(s.beta)) < 1e-9 ? "" : fmt::format("tr beta = {}", trace(s.beta));
}
std::string beyond(const Subloading& m, const Subloading::State<double, 6>& s, const IntegrationSettings& settings) {
  return beyond(m, s, 1 + settings.tolerance);
}
std::string beyond(const ViscoplasticSubloading& m, const ViscoplasticSubloading::State<double, 6>& s,
                   const IntegrationSettings&) {
  const double R = m.slow_limit().homothety(s).R;
  if (!(s.overstress >= 0 && s.overstress <= R + 1e-12)) return fmt::format("overstress {} at R = {}", s.overstress, R);
  return beyond(m.slow_limit(), s, m.parameters().R_m);
}
std::string beyond(const ModifiedCamClay& m, const ModifiedCamClay::State<double, 6>& s,
                   const IntegrationSettings& settings) {
  const double f = m.yield(s.sigma, s.p_c) / (s.p_c * s.p_c);
  return f <= 2 * settings.tolerance ? "" : fmt::format("f = {} p_c²", f);
}

struct Figures {
  int done = 0;
  int failed[4] = {0, 0, 0, 0};  ///< by IntegrationEnd
  long substeps = 0;
  int most = 0;
};

/// What is wrong with the answer; nothing where all is well.
template <class M, class State>
std::string fault(const M& model, const State& before, const State& s, const IntegrationReport& report,
                  const IntegrationSettings& settings) {
  if constexpr (requires { s.gap; }) {
    if (!(s.gap >= 0) || (s.gap > 0 && norm(s.sigma) > 0))
      return fmt::format("gap {} at ‖σ‖ = {}", s.gap, norm(s.sigma));
  }
  bool finite = true, same = true;
  for_each_component(
      [&](const double& x, const double& y) {
        finite = finite && std::isfinite(x);
        same = same && x == y;
      },
      s, before);
  if (!finite) return "not finite";
  if (!model.admissible(s)) return "inadmissible";
  if (const auto what = beyond(model, s, settings); !what.empty()) return "beyond its surface: " + what;
  auto again = s;
  const auto flags = model.accept(again, settings.tolerance);
  if (!flags.sound) return "not accepted";
  // One that stands on the surface may be taken to it again, by rounding of the stress that came back to it.
  for_each_component([](double& x, const double& y) { x -= y; }, again, s);
  if (!(model.error_norm(s, again) < 1e-9)) return fmt::format("moved again, by {}", model.error_norm(s, again));
  const bool done = report.end == IntegrationEnd::done;
  if (done && (report.reached != 1 || !report.flags.sound)) return "done, but not all of it";
  if (!done && !(report.reached < 1)) return "all of it, but not done";
  if (!done && report.reached == 0 && !same) return "no part done, but the state has moved";
  return "";
}

template <class Pair, class M, class State>
void try_case(const M& model, const State& start, const Increment<double, 6>& increment,
              const IntegrationSettings& settings, const std::string& name, Figures& figures) {
  auto s = start;
  const auto report = integrate<Pair>(model, s, increment, settings);
  const auto wrong = fault(model, start, s, report, settings);
  EXPECT_EQ(wrong, "") << name << ", strain " << norm(increment.deps) << ", reached " << report.reached << ", end "
                       << static_cast<int>(report.end);
  ++figures.failed[static_cast<int>(report.end)];
  figures.substeps += report.substeps + report.rejected;
  figures.most = std::max(figures.most, report.substeps + report.rejected);
}

int times() {
  const char* text = std::getenv("SCARP_SEARCH");
  return text ? std::max(1, std::atoi(text)) : 1;
}

template <class M>
class Search : public testing::Test {};

template <class Variant>
struct Searched;
template <class... Models>
struct Searched<std::variant<Models...>> {
  template <class... Kept>
  struct List {
    using type = testing::Types<Kept...>;
    template <class M>
    using with = std::conditional_t<std::is_same_v<M, Umat>, List, List<Kept..., M>>;
  };
  template <class L, class... Rest>
  struct Fold {
    using type = typename L::type;
  };
  template <class L, class First, class... Rest>
  struct Fold<L, First, Rest...> : Fold<typename L::template with<First>, Rest...> {};
  using type = typename Fold<List<>, Models...>::type;
};
/// All models but umat, whose law is others'.
TYPED_TEST_SUITE(Search, Searched<AnyModel>::type);

TYPED_TEST(Search, NothingFailsInSilence) {
  const int cases = times() * (std::is_same_v<TypeParam, Subloading> ? 5000 : 500);
  const auto model_name = TypeParam::description().name;
  Figures euler, dormand;
  const auto clock = std::chrono::steady_clock::now();
  for (int i = 0; i < cases && !testing::Test::HasFatalFailure(); ++i) {
    Random random(static_cast<unsigned>(i));
    const auto model = random_model<TypeParam>(random);
    auto start = random_start(model, random);
    if (i % 8 == 0) part(model, start, static_cast<unsigned>(i));
    const auto way = random_tensor<6>(random.generator);
    const Increment<double, 6> increment{(random.decades(1e-6, 1e-1) / norm(way)) * way, random.decades(1e-4, 1e4)};
    const auto name = model_name + ", case " + std::to_string(i);
    try_case<ModifiedEuler>(model, start, increment, {1e-4, 1e-5}, name + ", modified-euler", euler);
    try_case<DormandPrince>(model, start, increment, {1e-6, 1e-5}, name + ", dormand-prince", dormand);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
  for (const auto* f : {&euler, &dormand}) {
    std::printf(
        "%-24s %-15s %7d cases: %d done, %d not converged, %d unstable, %d inadmissible; %.1f substeps, most %d\n",
        model_name.c_str(), f == &euler ? "modified-euler" : "dormand-prince", cases, f->failed[0], f->failed[1],
        f->failed[2], f->failed[3], double(f->substeps) / cases, f->most);
  }
  std::printf("%-24s %.2f s\n", model_name.c_str(), seconds);
}

}  // namespace
}  // namespace scarp::test
