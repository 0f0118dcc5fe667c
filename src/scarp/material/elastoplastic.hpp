// What the linear-elastic, plastic laws share: a state of stress, plastic strain and its accumulated deviatoric part κ;
// strength that falls with κ; and the advance of a state by elastic predictor and return to the yield surface.
//
// A law of this kind is an ElastoplasticLaw of itself, and gives
//   softens()                does its strength depend on κ?
//   resolve(trial)           what of a trial stress does not depend on κ: invariants or principal values
//   correction(at, κ)        trial stress less the stress that it returns to on the surface of κ, see Correction
//   excess(at, κ, way)       of the stress beyond the surface, see Excess
//   compose(at, correction)  that difference as a tensor
//   error_norm(s, error)     what the error of a stress is measured by
//   K0()                     horizontal over vertical stress where nothing moves sideways
// and, where its points part from the body at an apex (PartingState, plastic_state.hpp),
//   opening(at, κ)           isotropic opening in the elastic strain that goes with a stress
#pragma once

#include <cmath>
#include <vector>

#include "scarp/material/description.hpp"
#include "scarp/material/increment.hpp"
#include "scarp/material/plastic_state.hpp"
#include "scarp/material/state.hpp"

namespace scarp {

/// Isotropic linear elasticity.
struct Elasticity {
  double K, G;

  static Elasticity from(double E, double nu) { return {E / (3.0 * (1.0 - 2.0 * nu)), E / (2.0 * (1.0 + nu))}; }
  double lame() const { return K - 2.0 / 3.0 * G; }

  template <class T, int N>
  Sym<T, N> stress(const Sym<T, N>& strain) const {
    return T(2.0 * G) * strain + isotropic<T, N>(T(lame()) * trace(strain));
  }
  template <class T, int N>
  Sym<T, N> strain(const Sym<T, N>& stress) const {
    return T(0.5 / G) * stress + isotropic<T, N>(T(1.0 / (9.0 * K) - 1.0 / (6.0 * G)) * trace(stress));
  }
};

/// A strength that falls in a straight line over κ from its peak to its residual value.
struct Softening {
  double peak, residual;
  double over;  ///< κ at which the residual value is reached; 0: the peak value stays

  bool active() const { return over > 0.0 && residual != peak; }
  double slope() const { return active() ? (residual - peak) / over : 0.0; }

  /// Formed from the residual value, which it meets to the last bit: a strength below zero, be it by rounding, is none.
  template <class T>
  T operator()(const T& kappa) const {
    return active() ? T(residual) + T((peak - residual) / over) * (T(over) - min(max(kappa, T(0.0)), T(over)))
                    : T(peak);
  }
};

/// The return of one trial stress; `Size` is what the law's compose() makes a tensor of.
template <class Size, class T>
struct Correction {
  Size size;
  T dkappa;         ///< √(2/3) ‖dev Δε^p‖ that goes with it
  Mask<T> plastic;  ///< the trial stress lies outside the surface
  Mask<T> parted;   ///< it returns to an apex at zero stress: the point separates from the body
};

/// A convex function of stress that is positive outside the surface, and its slope along a way in stress.
template <class T>
struct Excess {
  T f, df;
};

namespace elastoplastic {

/// Below this share of the stress, outside the surface is on it: rounding.
inline constexpr double on_surface = 1e-12;

template <class State, class T>
struct Returned {
  State state;
  Mask<T> plastic, parted, sound;
};

/// Elastic predictor and return with the strength of the end of the step, κ₁ = κ₀ + Δκ(κ₁): fully implicit (Simo &
/// Hughes, Computational Inelasticity, 1998, ch. 3). Δκ is nearly linear in κ₁, so that the secant method ends after
/// two or three steps; a strength that falls faster than the elastic unloading (Δκ' ≥ 1) has no stable answer.
template <class Law, class State, class T, int N, class At>
Returned<State, T> returned(const Law& law, const State& s, const Sym<T, N>& elastic, const At& at) {
  constexpr int most = 8;
  constexpr double enough = 1e-15;  // of κ
  const Sym<T, N> trial = s.sigma + elastic;
  auto c = law.correction(at, s.kappa);
  Mask<T> sound = c.dkappa < T(1.0);  // strain of 1 in an increment, or NaN: nonsense
  if (law.softens() && any(c.plastic)) {
    T kappa = s.kappa, miss = c.dkappa, step = c.dkappa;
    const T first = miss;
    for (int i = 0; i < most && any(abs(miss) > T(enough)); ++i) {
      kappa = kappa + step;
      c = law.correction(at, kappa);
      const T before = miss;
      miss = s.kappa + c.dkappa - kappa;
      if (i == 0) sound = sound && ((miss < first) || (first <= T(enough)));
      const T fall = before - miss;
      const Mask<T> ready = (abs(miss) <= T(enough)) || (abs(fall) < T(1e-300));
      step = select(ready, T(0.0), miss * step / select(ready, T(1.0), fall));
    }
    sound = sound && (abs(miss) <= T(1e-9) * c.dkappa + T(enough));
  }
  const Sym<T, N> back = law.compose(at, c);
  Returned<State, T> r;
  for (int i = 0; i < N; ++i) r.state.sigma[i] = select(c.plastic, trial[i] - back[i], trial[i]);
  const Sym<T, N> depsp = law.elasticity().strain(back);
  for (int i = 0; i < N; ++i) r.state.epsp[i] = select(c.plastic, s.epsp[i] + depsp[i], s.epsp[i]);
  r.state.kappa = select(c.plastic, s.kappa + c.dkappa, s.kappa);
  if constexpr (HasGap<State>) {
    r.state.gap = s.gap;
    if (any(c.parted)) {
      r.state.gap = select(c.parted, s.gap + max(T(0.0), law.opening(at, r.state.kappa)), s.gap);
      for (int i = 0; i < N; ++i) r.state.sigma[i] = select(c.parted, T(0.0), r.state.sigma[i]);
    }
  }
  r.plastic = c.plastic;
  r.parted = c.parted;
  r.sound = sound && (trace(r.state.sigma) == trace(r.state.sigma)) && (norm(back) < T(1e300));
  return r;
}

template <class Law, class State, class T, int N>
Returned<State, T> returned(const Law& law, const State& s, const Sym<T, N>& elastic) {
  return returned(law, s, elastic, law.resolve(s.sigma + elastic));
}

/// An increment up to the instant at which an open point touches again. All strain until then is plastic.
template <class State, class T>
struct Contact {
  State state;
  T share;  ///< of the increment
  T error;  ///< of the gap, where dilation falls on the way
  Mask<T> open;
};

template <class Law, class State, class T, int N>
Contact<State, T> to_contact(const Law& law, const State& s, const Sym<T, N>& elastic) {
  const Sym<T, N> deps = law.elasticity().strain(elastic);
  const T dkappa = T(sqrt_2_3) * norm(deviator(deps));
  const auto at = law.resolve(elastic);
  const T first = law.opening(at, s.kappa);
  Closing<T> closing(s.gap, first);
  Contact<State, T> r{s, closing.share, T(0.0), closing.open};
  // Where dilation falls with κ, the mean growth until contact: that in the middle of it, against that of its ends.
  for (int i = 0; law.softens() && i < 3; ++i) {
    const T middle = law.opening(at, s.kappa + T(0.5) * closing.share * dkappa);
    const T end = law.opening(at, s.kappa + closing.share * dkappa);
    const Closing<T> next(s.gap, middle);
    const T moved = abs(next.share - closing.share) * norm(deps) + abs(next.gap - closing.gap);
    r.error = select(closing.open, moved + abs(middle - T(0.5) * (first + end)), T(0.0));
    closing = next;
  }
  r.share = closing.share;
  for (int i = 0; i < N; ++i) r.state.sigma[i] = select(closing.open, T(0.0), s.sigma[i]);
  r.state.epsp = s.epsp + r.share * deps;
  r.state.kappa = s.kappa + r.share * dkappa;
  r.state.gap = closing.gap;
  return r;
}

/// returned() from a state that may be open.
template <class Law, class State, class T, int N>
Returned<State, T> stepped(const Law& law, const State& s, const Sym<T, N>& elastic) {
  if constexpr (HasGap<State>) {
    if (any(s.gap > T(0.0))) {
      const auto contact = to_contact(law, s, elastic);
      auto r = returned(law, contact.state, (T(1.0) - contact.share) * elastic);
      r.plastic = r.plastic || contact.open;
      r.parted = r.parted || (r.state.gap > T(0.0));
      return r;
    }
  }
  return returned(law, s, elastic);
}

/// Share of the increment after which plastic straining starts, for trial stresses that end outside the surface with
/// excess f and slope df there. Along the straight way the excess is convex, so that Newton's method comes down on its
/// last zero from above; four steps leave no more than a few percent of the plastic part below it.
template <class Law, class State, class T, int N>
T elastic_share(const Law& law, const State& s, const Sym<T, N>& elastic, const Mask<T>& plastic,
                const Excess<T>& end) {
  constexpr int steps = 4;
  constexpr double soon = 1.0 / 64;
  // Outside so soon, the last zero is as good as at the start. (The slope at the start would say less: on an edge of a
  // surface it has many.)
  const auto ahead = law.excess(law.resolve(s.sigma + T(soon) * elastic), s.kappa, elastic);
  const Mask<T> on = !plastic || (ahead.f > T(0.0));
  T share = select(on, T(0.0), T(1.0));
  if (all(on)) return share;
  auto e = end;
  for (int i = 0; i < steps; ++i) {
    const Mask<T> down = (e.f > T(0.0)) && (e.df > e.f);  // else the step leaves the increment
    share = select(on, T(0.0), select(down, share - e.f / select(down, e.df, T(1.0)), share));
    share = max(share, T(0.0));
    if (i + 1 < steps) e = law.excess(law.resolve(s.sigma + share * elastic), s.kappa, elastic);
  }
  return share;
}

/// The elastic part, and then the rest in one step and in two. Either has an error of second order in the increment
/// where the flow turns on the way (a step's direction is that of its end); it is twice as large in one step, so that
/// the difference is the error of the two, and twice the second less the first is better than both: what rests beside
/// the surface, of fourth order, returns to it. Where the flow does not turn the two agree, and the answer is exact.
template <class Law, class State, class T, int N>
Trial<State, T> update_closed(const Law& law, const State& s, const Sym<T, N>& elastic) {
  constexpr double rounding = 1e-13;
  const auto at_end = law.resolve(s.sigma + elastic);
  auto whole = returned(law, s, elastic, at_end);
  const Mask<T> none = no_lanes<T>(), plastic = whole.plastic;
  Trial<State, T> r{whole.state, T(0.0), {none, none, whole.parted, whole.sound}};
  if (!any(plastic)) return r;

  const T share = elastic_share(law, s, elastic, plastic, law.excess(at_end, s.kappa, elastic));
  const auto start = returned(law, s, share * elastic);
  const Sym<T, N> rest = (T(1.0) - share) * elastic;
  if (any(share > T(0.0))) whole = stepped(law, start.state, rest);
  const auto first = stepped(law, start.state, T(0.5) * rest);
  const auto second = stepped(law, first.state, T(0.5) * rest);
  State better = second.state, difference = advanced(second.state, T(-1.0), whole.state);
  r.error = law.error_norm(second.state, difference);
  const Mask<T> exact = !plastic || (r.error <= T(rounding));
  r.error = select(exact, T(0.0), r.error);
  r.state = select_state(!plastic, r.state, whole.state);
  r.flags.separated = plastic && whole.parted;
  r.flags.sound = r.flags.sound && whole.sound;
  if (all(exact)) return r;

  better = advanced(better, T(1.0), difference);
  better.kappa = max(better.kappa, s.kappa);
  if constexpr (HasGap<State>) {  // an open point stays without stress, a closed one without a gap
    better.gap = second.state.gap;
    better = select_state(second.state.gap > T(0.0), second.state, better);
  }
  const auto last = returned(law, better, Sym<T, N>::zero());
  r.state = select_state(exact, r.state, last.state);
  r.flags.separated = (exact && r.flags.separated) || (!exact && second.parted);
  r.flags.sound = r.flags.sound && (exact || (start.sound && first.sound && second.sound && last.sound));
  return r;
}

/// update_closed(), after the part of the increment that closes what is open.
template <class Law, class State, class T, int N>
Trial<State, T> update(const Law& law, const State& s, const Sym<T, N>& deps) {
  const Sym<T, N> elastic = law.elasticity().stress(deps);
  if constexpr (HasGap<State>) {
    if (any(s.gap > T(0.0))) {
      const auto contact = to_contact(law, s, elastic);
      auto r = update_closed(law, contact.state, (T(1.0) - contact.share) * elastic);
      if (law.softens()) {  // what the gap errs by, a closed point feels as strain
        State miss = advanced(s, T(-1.0), s);
        miss.gap = contact.error;
        const T stress = law.p_wave_modulus(s) * contact.error;
        miss.sigma[0] = select(r.state.gap > T(0.0), T(0.0), stress);
        r.error = r.error + law.error_norm(r.state, miss);
      }
      r.flags.separated = r.flags.separated || (r.state.gap > T(0.0));
      return r;
    }
  }
  return update_closed(law, s, elastic);
}

/// Pulls a state that is outside its yield surface onto it and notes that; leaves every other alone.
template <class Law, class State>
auto accept(const Law& law, State& s) {
  using T = std::decay_t<decltype(s.kappa)>;
  const auto on = returned(law, s, std::decay_t<decltype(s.sigma)>::zero());
  s = select_state(on.plastic, on.state, s);
  const Mask<T> none = no_lanes<T>();
  UpdateFlags<T> flags{on.plastic, none, on.parted, on.sound};
  if constexpr (HasGap<State>) flags.separated = flags.separated || (s.gap > T(0.0));
  return flags;
}

/// √(sum of squares) of the error of stress over `scale` and of the absolute ones of the plastic strain, κ and the gap.
template <class State, class T>
T error_norm(const State& e, const T& scale) {
  const T inverse = T(1.0) / scale;
  T sum = dot(e.sigma, e.sigma) * inverse * inverse + dot(e.epsp, e.epsp) + e.kappa * e.kappa;
  if constexpr (HasGap<State>) sum = sum + e.gap * e.gap;
  return sqrt(sum);
}

// What the laws' descriptions and initial values share.

ParameterInfo young();
ParameterInfo poisson();
/// Strain over which strength falls.
ParameterInfo softening_strain();
/// State, derived quantities and initial keys.
ModelDescription described(const std::string& name, const std::string& summary, std::vector<ParameterInfo> parameters);
/// The same with the gap.
ModelDescription described_parting(const std::string& name, const std::string& summary,
                                   std::vector<ParameterInfo> parameters);

/// A residual strength, `key`_residual, is no larger than the peak and is reached over some strain.
void check_softening(const std::string& key, const Softening& strength, std::vector<Problem>& problems);
/// Problem where the strength falls faster with κ than elastic unloading can follow, at `steepest`.
void check_slope(const std::string& key, double slope, double steepest, std::vector<Problem>& problems);

/// Dilation is no more than friction, and there is some strength, at the peak and at the end.
void check_frictional(const Softening& c, const Softening& phi, const Softening& psi, std::vector<Problem>& problems);

/// κ of the region's keys.
double initial_kappa(const Values& keys, std::vector<Problem>& problems);

/// The initial stress with these invariants lies outside the yield surface.
void refuse_outside(double q, double p, std::vector<Problem>& problems);

/// The state at `sigma`, closed; a problem where that lies outside the yield surface.
template <class State, class Law, int N>
State initial_state(const Law& law, const Sym<double, N>& sigma, const Values& keys, std::vector<Problem>& problems) {
  State s{};
  s.sigma = sigma;
  s.kappa = initial_kappa(keys, problems);
  const auto on = returned(law, s, Sym<double, N>::zero());
  if (norm(on.state.sigma - sigma) > 1e-9 * norm(sigma)) {
    refuse_outside(deviatoric_stress(sigma), mean(sigma), problems);
  }
  return s;
}

template <int N>
std::vector<double> derived(const PlasticState<double, N>& s) {
  return {trace(s.epsp), sqrt_2_3 * norm(deviator(s.epsp))};
}

}  // namespace elastoplastic

/// What every law of this kind does alike, for `Law` to inherit: class VonMises : public ElastoplasticLaw<VonMises>.
/// `S` is the kind of its state.
template <class Law, template <class, int> class S = PlasticState>
class ElastoplasticLaw {
 public:
  template <class T, int N>
  using State = S<T, N>;

  const Elasticity& elasticity() const { return elasticity_; }

  template <class T, int N>
  Trial<State<T, N>, T> update(const State<T, N>& s, const Increment<T, N>& i, double) const {
    return elastoplastic::update(law(), s, i.deps);
  }
  template <class T, int N>
  Mask<T> admissible(const State<T, N>& s) const {
    return trace(s.sigma) == trace(s.sigma);
  }
  template <class T, int N>
  UpdateFlags<T> accept(State<T, N>& s, double) const {
    return elastoplastic::accept(law(), s);
  }
  /// The elastic one, of unloading.
  template <class T, int N>
  T p_wave_modulus(const State<T, N>&) const {
    return T(elasticity_.K + 4.0 / 3.0 * elasticity_.G);
  }

  template <int N>
  State<double, N> initial_state(const Sym<double, N>& sigma, double, const Values& keys,
                                 std::vector<Problem>& problems) const {
    return elastoplastic::initial_state<State<double, N>>(law(), sigma, keys, problems);
  }
  template <int N>
  std::vector<double> derived(const State<double, N>& s) const {
    return elastoplastic::derived(s);
  }

 protected:
  ElastoplasticLaw(double E, double nu) : elasticity_(Elasticity::from(E, nu)) {}

  Elasticity elasticity_;

 private:
  const Law& law() const { return static_cast<const Law&>(*this); }
};

}  // namespace scarp
