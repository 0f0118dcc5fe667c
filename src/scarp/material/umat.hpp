// Another's model: a compiled Abaqus UMAT (Fortran or C) from a shared library. The conventions of both sides, what the
// routine is given and what it is not are in docs/models/umat.md; the interface is that of the Abaqus User Subroutines
// Reference, "UMAT".
//
// The routine does its own integration: its answer is taken as exact (error 0), so the tolerance has no hold on it. It
// can ask for a shorter increment by PNEWDT < 1.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "scarp/material/description.hpp"
#include "scarp/material/increment.hpp"
#include "scarp/material/state.hpp"
#include "scarp/material/umat_library.hpp"
#include "scarp/tensor/batch.hpp"

namespace scarp {

class Umat {
 public:
  static constexpr int most_statev = 64;          ///< largest NSTATV
  static constexpr bool depends_on_time = true;   ///< for all that is known of it
  static constexpr double shortest_time = 1e-10;  ///< DTIME of an increment over no time: routines divide by it

  /// How a variable of STATEV turns with the body: not at all; as a stress; as a strain with engineering shear.
  enum class Kind { scalar, tensor, strain };

  /// One variable of STATEV. Its values are the routine's own, signs too; tensors are kept in Mandel components.
  struct Variable {
    std::string name;
    Kind kind;
    std::vector<double> initial;  ///< empty: zero; else a number, or tensor components xx, yy, zz, xy(, yz, zx)
  };

  struct Parameters {
    std::shared_ptr<umat::Library> library;
    std::string cmname;             ///< CMNAME
    std::vector<double> constants;  ///< PROPS
    std::vector<Variable> state;    ///< in the order of STATEV
    double wave_modulus = 0;        ///< [stress]; 0: from DDSDDE
    double celent = 1;              ///< CELENT
    bool one_at_a_time = true;      ///< no two calls at once
  };

  /// Compression positive, `values` apart. Of `values` only as many are in use as the state that was declared takes.
  template <class T, int N>
  struct State {
    Sym<T, N> sigma;
    Sym<T, N> strain;                   ///< total strain that turned with the body: STRAN
    T modulus;                          ///< largest diagonal term of DDSDDE so far, or the constant [stress]
    T time;                             ///< TIME(2) [s]
    T increments;                       ///< KINC − 1
    std::array<T, most_statev> values;  ///< STATEV

    template <class F, class... States>
    static void each(F&& f, States&... s) {
      f(s.sigma...);
      f(s.strain...);
      f(s.modulus...);
      f(s.time...);
      f(s.increments...);
      for (std::size_t k = 0; k < most_statev; ++k) f(s.values[k]...);
    }
  };

  explicit Umat(Parameters parameters);

  static ModelDescription description();
  ModelDescription own_description() const;
  /// Opens the library. Problems: what is wrong with a key, and a library or routine that is not there.
  static std::optional<Umat> from_values(const std::map<std::string, double>& constants, const Values& settings,
                                         std::vector<Problem>& problems, std::vector<Problem>& warnings);

  const Parameters& parameters() const { return *parameters_; }

  /// NSTATV where a tensor has N components.
  template <int N>
  int statev_size() const {
    return N == 4 ? size4_ : size6_;
  }
  template <int N>
  int state_columns() const {
    return N + 3 + statev_size<N>();
  }

  /// Turns the tensors of STATEV with the body.
  template <class T, int N>
  void rotate_own(State<T, N>& s, const Rotation<T, N>& turn) const {
    std::size_t at = 0;
    for (const auto& variable : parameters_->state) {
      if (variable.kind == Kind::scalar) {
        ++at;
        continue;
      }
      Sym<T, N> tensor;
      for (std::size_t c = 0; c < N; ++c) tensor.c[c] = s.values[at + c];
      tensor = turn(tensor);
      for (std::size_t c = 0; c < N; ++c) s.values[at + c] = tensor.c[c];
      at += N;
    }
  }

  /// One call of the routine. Not sound where it asks for a shorter increment or answers with NaN or infinity. Throws
  /// RunError where it ends the analysis (XIT) or writes beyond the STATEV that was declared.
  template <int N>
  Trial<State<double, N>, double> update(const State<double, N>& s, const Increment<double, N>& i, double) const;

  /// The same for each lane in turn.
  template <int N>
  Trial<State<Batch, N>, Batch> update(const State<Batch, N>& s, const Increment<Batch, N>& i, double tolerance) const {
    constexpr std::size_t size = sizeof(State<double, N>) / sizeof(double);
    std::array<std::array<double, batch_lanes>, size> table;
    std::array<std::array<double, batch_lanes>, N> deps;
    std::array<double, batch_lanes> dt, sound;
    std::size_t row = 0;
    for_each_component([&](const Batch& x) { x.store_unaligned(table[row++].data()); }, s);
    for (int c = 0; c < N; ++c) i.deps[c].store_unaligned(deps[static_cast<std::size_t>(c)].data());
    i.dt.store_unaligned(dt.data());
    for (std::size_t lane = 0; lane < batch_lanes; ++lane) {
      State<double, N> one;
      Increment<double, N> part{{}, dt[lane]};
      row = 0;
      for_each_component([&](double& x) { x = table[row++][lane]; }, one);
      for (std::size_t c = 0; c < N; ++c) part.deps.c[c] = deps[c][lane];
      const auto trial = update(one, part, tolerance);
      row = 0;
      for_each_component([&](const double& x) { table[row++][lane] = x; }, trial.state);
      sound[lane] = trial.flags.sound ? 1.0 : 0.0;
    }
    Trial<State<Batch, N>, Batch> trial;
    row = 0;
    for_each_component([&](Batch& x) { x = Batch::load_unaligned(table[row++].data()); }, trial.state);
    trial.error = Batch(0.0);
    const Mask<Batch> none = Batch(0.0) != Batch(0.0);
    trial.flags = {none, none, none, Batch::load_unaligned(sound.data()) > Batch(0.5)};
    return trial;
  }

  template <class T, int N>
  Mask<T> admissible(const State<T, N>& s) const {
    return s.sigma[0] == s.sigma[0];
  }

  template <class T, int N>
  T error_norm(const State<T, N>&, const State<T, N>&) const {
    return T(0.0);
  }

  template <class T, int N>
  UpdateFlags<T> accept(State<T, N>& s, double) const {
    const Mask<T> nan = s.sigma[0] != s.sigma[0], none = no_lanes<T>();
    return {none, none, none, !nan};
  }

  /// The largest term on the diagonal of DDSDDE that the point has met, K + 4G/3 where the law is isotropic. It does
  /// not fall when the tangent does: unloading would meet the elastic stiffness again.
  template <class T, int N>
  T p_wave_modulus(const State<T, N>& s) const {
    return s.modulus;
  }

  /// Asks the routine once, without strain, whether it takes the initial state; its DDSDDE gives the first modulus.
  template <int N>
  State<double, N> initial_state(const Sym<double, N>& sigma, double vertical, const Values& keys,
                                 std::vector<Problem>& problems) const;

  /// Initial values for soil that was never loaded: those of the declaration.
  Values normally_consolidated() const { return {}; }

  template <int N>
  std::vector<double> derived(const State<double, N>&) const {
    return {};
  }

 private:
  /// What is wrong with an answer.
  struct Fault {
    enum class Kind { none, cut_back, not_finite, overrun } kind = Kind::none;
    const char* array = "";  ///< where, with the index as in Fortran
    int index = 0;
    double value = 0;

    std::string text() const;
  };

  /// What stands in the arguments that scarp has no value for: NaN, so that it shows when a routine uses them.
  struct NotPassed {
    double coords = std::numeric_limits<double>::quiet_NaN();   ///< all of COORDS
    double stretch = std::numeric_limits<double>::quiet_NaN();  ///< the diagonals of DFGRD0 and DFGRD1; beside it 0,
                                                                ///< or NaN with it
  };

  template <int N>
  Fault call(const State<double, N>& s, const Increment<double, N>& i, State<double, N>& next,
             const NotPassed& blank) const;
  /// The arguments of NotPassed that an answer depends on, "" for none.
  template <int N>
  std::string not_passed_but_used(const State<double, N>& start) const;
  /// "the UMAT of CLAY (umat.so)"
  std::string title() const;
  template <int N>
  void check_start(const State<double, N>& start, std::vector<Problem>& problems, double& modulus) const;

  std::shared_ptr<const Parameters> parameters_;
  std::vector<double> props_;  ///< PROPS and, behind them, NaN: a constant too few shows
  int size4_ = 0, size6_ = 0;
};

}  // namespace scarp
