// Softening over an internal length (docs/length.md): what a law loses with its accumulated plastic strain κ it loses
// with κ̂ instead, which grows as an average of κ over the soil around says (step/nonlocal.hpp). The law takes the
// growth of κ̂ as given. Nonlocal<Law> is the law so driven, with the state of the law, κ, κ̂ and dκ̂/dt.
//
// Bonds (Subloading, ViscoplasticSubloading), in place of eq. 36:
//
//   dR_b = c_b (R_bf − R_b) dκ̂,   s = dR_b/R_b (0 where p_c is at its floor)
//   dΛ = ⟨N:D:dε − s N:σ⟩ / (N:D:G + H₀),   dp_c = dΛ p_c' + s p_c,   da = dΛ a' + s a
//
// with H₀, p_c' and a' of R_b' = 0. Since s ≤ 0 the loss adds to loading: a point may flow without strain. It has to be
// in the consistency condition; taken between increments instead it does not keep R.
//
// Strength that falls with κ (the laws of elastoplastic.hpp): that of κ̂ at the end of the increment, with the return as
// it is. Compression positive.
#pragma once

#include <algorithm>
#include <concepts>
#include <variant>

#include "scarp/material/drucker_prager.hpp"
#include "scarp/material/mohr_coulomb.hpp"
#include "scarp/material/subloading.hpp"
#include "scarp/material/tresca.hpp"
#include "scarp/material/viscoplastic_subloading.hpp"
#include "scarp/material/von_mises.hpp"

namespace scarp {

/// κ over which a law loses nearly all that it loses with κ: what lies beyond matters to nobody else. 0: it loses
/// nothing. Of bonds e⁻³ = 5 % is left there.
inline double kappa_c(const Subloading& law) {
  return law.parameters().c_b > 0 ? 3.0 / law.parameters().c_b : 0.0;
}
inline double kappa_c(const ViscoplasticSubloading& law) {
  return kappa_c(law.slow_limit());
}
/// Of strengths it is where the residual value is reached.
inline double kappa_c(const Softening& strength) {
  return strength.active() ? strength.over : 0.0;
}
inline double kappa_c(const VonMises& law) {
  return kappa_c(law.parameters().s_u);
}
inline double kappa_c(const Tresca& law) {
  return kappa_c(law.parameters().s_u);
}
template <class Law>
requires requires(const Law& law) {
  law.parameters().phi.over;
}
inline double kappa_c(const Law& law) {
  const auto& p = law.parameters();
  return std::max({kappa_c(p.c), kappa_c(p.phi), kappa_c(p.psi)});
}

/// May the law soften over a length?
template <class Law>
concept Averaged = requires(const Law& law) {
  { kappa_c(law) } -> std::convertible_to<double>;
};

/// The subloading law, or its viscoplastic form, with a loss of bonds that is given.
template <class Law>
class Nonlocal {
 public:
  template <class T, int N>
  struct State : Law::template State<T, N> {
    T kappa;       ///< κ = ∫ ‖dε^p‖
    T kappa_hat;   ///< κ̂
    T kappa_rate;  ///< dκ̂/dt [1/time], kept by the law

    template <class F, class... States>
    static void each(F&& f, States&... s) {
      Law::template State<T, N>::each(f, s...);
      f(s.kappa...);
      f(s.kappa_hat...);
      f(s.kappa_rate...);
    }
  };

  explicit Nonlocal(const Law& law) : law_(law), held_(with_bonds_held(law)) {}

  template <class T, int N>
  Rate<State<T, N>, T> rate(const State<T, N>& s, const Sym<T, N>& deps, const T& dt) const;

  /// The pair's step, after the part of the increment that closes what is open.
  template <class Pair, class T, int N>
  Trial<State<T, N>, T> update(const State<T, N>& s, const Increment<T, N>& step, double tolerance) const {
    return after_closing<Pair>(*this, s, step, tolerance);
  }

  template <class T, int N>
  Mask<T> admissible(const State<T, N>& s) const {
    return law_.admissible(s);
  }
  template <class T, int N>
  T error_norm(const State<T, N>& s, const State<T, N>& e) const {
    const T of_law = law_.error_norm(s, e);
    return sqrt(of_law * of_law + e.kappa * e.kappa);
  }
  template <class T, int N>
  UpdateFlags<T> accept(State<T, N>& s, double tolerance) const {
    return law_.accept(s, tolerance);
  }
  template <class T, int N>
  T p_wave_modulus(const State<T, N>& s) const {
    return law_.p_wave_modulus(s);
  }

 private:
  /// The loss of bonds over an increment: dR_b, and s of the head of this file.
  template <class T>
  struct Loss {
    T dR_b, s;
  };
  template <class T, int N>
  Loss<T> loss(const State<T, N>& state, const T& dkappa_hat) const {
    const auto& c = bonds(law_).parameters();
    const T dR_b = T(c.c_b) * (T(c.R_bf) - state.R_b) * dkappa_hat;
    const T s = dR_b / state.R_b;
    return {dR_b, select(state.p_c <= T(c.p_c_floor * c.p_atm), max(T(0.0), s), s)};
  }

  static const Subloading& bonds(const Subloading& law) { return law; }
  static const Subloading& bonds(const ViscoplasticSubloading& law) { return law.slow_limit(); }
  /// The elastoplastic law with R_b' = 0, whose hardening is that of H₀.
  static Subloading with_bonds_held(const Law& law) {
    auto constants = bonds(law).parameters();
    constants.c_b = 0;
    return Subloading(constants);
  }

  Law law_;
  Subloading held_;
};

template <class Law>
template <class T, int N>
Rate<typename Nonlocal<Law>::template State<T, N>, T> Nonlocal<Law>::rate(const State<T, N>& s, const Sym<T, N>& deps,
                                                                          const T& dt) const {
  constexpr bool viscous = TimeDependent<Law>;
  const T R_min(held_.parameters().R_min), dkappa_hat = s.kappa_rate * dt;
  const auto lost = loss(s, dkappa_hat);
  const auto y = held_.image(s);
  const auto r = held_.hardening(s, y);
  const T loading = held_.elastic_normal_part(y, deps) - lost.s * held_.normal_part(y, s.sigma);

  Rate<State<T, N>, T> result;
  T dLambda;
  if constexpr (viscous) {
    // As in viscoplastic_subloading.hpp: what is not balanced, the overstress grows by.
    const T R_rate = held_.R_per_strain(law_.R_s(s, y.h.R)) * y.norm_g;
    dLambda = dt * law_.flow(s.overstress, y.h.R) / y.norm_g;
    const T growth = (loading - dLambda * held_.stiffness(s, y, r, R_rate)) / held_.normal_part(y, y.from_a);
    const Mask<T> above = (y.h.R > R_min) && ((s.overstress > T(0.0)) || (growth > T(0.0)));
    result.change.overstress = select(above, growth, T(0.0));
    result.sound = y.h.exists && (s.p_c > T(0.0)) && (y.K > T(0.0)) && (y.h.R < T(law_.parameters().R_m));
  } else {
    const T R_rate = held_.R_per_strain(y.h.R) * y.norm_g, resistance = held_.stiffness(s, y, r, R_rate);
    const Mask<T> plastic = (y.h.R > R_min) && (loading > T(0.0));
    dLambda = select(plastic, loading / resistance, T(0.0));
    result.sound = y.h.exists && (s.p_c > T(0.0)) && (y.K > T(0.0)) && ((resistance > T(0.0)) || !plastic);
  }
  held_.change(y, r, deps, dLambda, result.change);
  result.change.p_c = result.change.p_c + lost.s * s.p_c;
  result.change.a = result.change.a + lost.s * s.a;
  result.change.R_b = lost.dR_b;
  result.change.kappa = dLambda * y.norm_g;
  result.change.kappa_hat = dkappa_hat;
  result.change.kappa_rate = T(0.0);
  held_.open_where_parted(s, deps, result);
  return result;
}

namespace elastoplastic {

/// A law with the strength of one κ, whatever plastic strain it makes itself: what the return of a law asks of it.
template <class Law, class T>
class OfStrengthAt {
 public:
  OfStrengthAt(const Law& law, const T& kappa) : law_(law), kappa_(kappa) {}

  static constexpr bool softens() { return false; }
  const Elasticity& elasticity() const { return law_.elasticity(); }
  template <int N>
  auto resolve(const Sym<T, N>& trial) const {
    return law_.resolve(trial);
  }
  template <class At>
  auto correction(const At& at, const T&) const {
    return law_.correction(at, kappa_);
  }
  template <class At, int N>
  auto excess(const At& at, const T&, const Sym<T, N>& way) const {
    return law_.excess(at, kappa_, way);
  }
  template <class At, class C>
  auto compose(const At& at, const C& c) const {
    return law_.compose(at, c);
  }
  template <class State>
  T error_norm(const State& s, const State& e) const {
    return law_.error_norm(s, e);
  }
  template <class At>
  auto opening(const At& at, const T&) const {
    return law_.opening(at, kappa_);
  }
  template <class State>
  T p_wave_modulus(const State& s) const {
    return law_.p_wave_modulus(s);
  }

 private:
  const Law& law_;
  T kappa_;
};

}  // namespace elastoplastic

/// A law of elastoplastic.hpp with its strength at κ̂, which is given.
template <class Law>
requires std::derived_from<Law, ElastoplasticLaw<Law>> || std::derived_from<Law, ElastoplasticLaw<Law, PartingState>>
class Nonlocal<Law> {
 public:
  static constexpr bool depends_on_time = true;  ///< for κ̂ grows over time

  template <class T, int N>
  using Own = typename Law::template State<T, N>;
  template <class T, int N>
  struct State : Own<T, N> {  // κ is the law's own
    T kappa_hat;              ///< κ̂
    T kappa_rate;             ///< dκ̂/dt [1/time], kept by the law

    template <class F, class... States>
    static void each(F&& f, States&... s) {
      Own<T, N>::each(f, s...);
      f(s.kappa_hat...);
      f(s.kappa_rate...);
    }
  };

  explicit Nonlocal(const Law& law) : law_(law) {}

  template <class T, int N>
  Trial<State<T, N>, T> update(const State<T, N>& s, const Increment<T, N>& i, double) const {
    const T kappa_hat = s.kappa_hat + s.kappa_rate * i.dt;
    const elastoplastic::OfStrengthAt<Law, T> law(law_, kappa_hat);
    // Where strength falls below the stress, that returns first: the update supposes a start on the surface or inside.
    Own<T, N> start = s;
    const auto fallen = elastoplastic::accept(law, start);
    auto trial = elastoplastic::update(law, start, i.deps);
    trial.flags.sound = trial.flags.sound && fallen.sound;
    Trial<State<T, N>, T> r{{}, trial.error, trial.flags};
    static_cast<Own<T, N>&>(r.state) = trial.state;
    r.state.kappa_hat = kappa_hat;
    r.state.kappa_rate = s.kappa_rate;
    return r;
  }
  template <class T, int N>
  Mask<T> admissible(const State<T, N>& s) const {
    return law_.admissible(s);
  }
  template <class T, int N>
  T error_norm(const State<T, N>& s, const State<T, N>& e) const {
    return law_.error_norm(s, e);
  }
  template <class T, int N>
  UpdateFlags<T> accept(State<T, N>& s, double) const {
    return elastoplastic::accept(elastoplastic::OfStrengthAt<Law, T>(law_, s.kappa_hat), static_cast<Own<T, N>&>(s));
  }
  template <class T, int N>
  T p_wave_modulus(const State<T, N>& s) const {
    return law_.p_wave_modulus(s);
  }

 private:
  Law law_;
};

/// The place of κ among the columns of the state, counted from their end: before κ̂ and dκ̂/dt, and before the gap of a
/// law that has κ of its own.
template <class Law>
constexpr int kappa_from_end(const Law&) {
  return requires(typename Law::template State<double, 6> s) {
    s.kappa, s.gap;
  }
  ? 4 : 3;
}

/// How many numbers Nonlocal<Law> keeps of a point beside those of the law. The last two of its state are κ̂ and
/// dκ̂/dt in every law.
template <class Law>
constexpr int nonlocal_columns(const Law&) {
  if constexpr (Averaged<Law>) {
    return state_size<Nonlocal<Law>, 6>() - state_size<Law, 6>();
  } else {
    return 0;
  }
}

/// kappa_c() of any law; 0 where it has nothing to average.
template <class Any>
double kappa_c_of(const Any& any) {
  return std::visit(
      []<class Law>(const Law& law) {
        if constexpr (Averaged<Law>) {
          return kappa_c(law);
        } else {
          return 0.0;
        }
      },
      any);
}

}  // namespace scarp
