#include "scarp/exec/stress_update.hpp"

#include <array>
#include <cmath>

#include "scarp/material/integrate/lanes.hpp"
#include "scarp/material/plastic_state.hpp"
#include "scarp/tensor/batch.hpp"

namespace scarp::exec {
namespace {

constexpr int W = lanes_of<Batch>;

/// The stress update of points of one block with one law; the only text that knows both sign conventions: tension
/// positive in the arrays of the points, compression positive in the law.
template <class Model, int Dim>
class Update {
  static constexpr int N = sym_size<Dim>;
  template <class T>
  using State = typename Model::template State<T, N>;

 public:
  /// From the columns of `block` to those of `to`, which may be the same.
  Update(const Model& model, const Block<Dim>& block, const UpdatedColumns<Dim>& to,
         const PointIncrements<Dim>& increments, double dt, const IntegrationSettings& settings,
         const WaveSettings& waves, StressBooks& books)
      : model_(model),
        block_(block),
        points_(block.points),
        to_(to),
        increments_(increments),
        dt_(dt),
        settings_(settings),
        waves_(waves),
        damped_(waves.damped()),
        per_limit2_(waves.per_limit2(1.0)),
        books_(books) {}

  void operator()(PointRange range, int at) {
    for_each_batch<Batch>(range, [&](const Lanes<Batch>& p, int first) { batch(p, at + first); });
    finish_stragglers();
    books_.work += xsimd::hadd(work_);
    books_.damping += xsimd::hadd(damping_);
    std::array<double, W> rate2;
    fastest2_.store_unaligned(rate2.data());
    const double most = *std::max_element(rate2.begin(), rate2.end());
    if (most > 0) books_.critical_dt = std::min(books_.critical_dt, 1 / std::sqrt(most));
  }

 private:
  /// A point, and where its strains are.
  struct Straggler {
    int point, at;
  };

  void batch(const Lanes<Batch>& p, int at) {
    const State<Batch> old = p.whole() ? load_state(WholeLanes<Batch>(p.point(0))) : load_state(p);
    fetch_ahead(p.point(0) + W);
    Sym<Batch, N> deps;
    for (int c = 0; c < N; ++c) deps[c] = -increment(increments_.deps[c], at);
    Spin<Batch, N> spin;
    for (std::size_t c = 0; c < spin.w.size(); ++c) spin.w[c] = increment(increments_.spin[c], at);
    State<Batch> rotated = old;
    rotate(model_, rotated, Rotation<Batch, N>(spin));  // eq. 12 and eq. 13, exact

    const auto trial =
        attempt<ModifiedEuler>(model_, rotated, Increment<Batch, N>{deps, Batch(dt_)}, settings_.tolerance);
    const auto good = trial.flags.sound && (trial.error <= Batch(settings_.tolerance));
    p.store(p.load(points_.eps_q) + Batch(sqrt_2_3) * norm(deviator(deps)), to_.eps_q);

    const unsigned present = first_bits(p.count()), done = bits_of(good) & present;
    Batch damping(0.0);
    if (damped_) {
      damping = p.whole() ? look_ahead(WholeLanes<Batch>(p.point(0)), old.sigma, rotated.sigma, trial, good, deps, at)
                          : look_ahead(p, old.sigma, rotated.sigma, trial, good, deps, at);
    }
    const Batch work = increment(increments_.volume, at) * Batch(0.5) * dot(rotated.sigma + trial.state.sigma, deps);
    const Batch modulus = model_.p_wave_modulus(trial.state);
    const auto stiff = modulus > Batch(0.0);
    const Batch rate2 = crossing_rate2(modulus, at);
    const unsigned noted = bits_of(trial.flags.corrected || trial.flags.on_floor || trial.flags.separated || !stiff);
    if (done == first_bits(W) && (noted & present) == 0) [[likely]] {
      const auto keep = [&](const auto& lanes) {
        store_state(trial.state, lanes);
        lanes.store(std::uint8_t{0}, to_.flags);
        lanes.store(std::uint8_t{1}, to_.substeps);
      };
      if (p.whole()) [[likely]] {
        keep(WholeLanes<Batch>(p.point(0)));
      } else {
        keep(p);
      }
      work_ += work;
      damping_ += damping;
      fastest2_ = max(fastest2_, rate2);
      books_.substeps += W;
      books_.most_substeps = std::max(books_.most_substeps, 1);
      return;
    }
    store_state(select_state(good, trial.state, old), p);
    for (int l = 0; l < p.count(); ++l) {
      if (done >> l & 1u) {
        const auto lane = static_cast<std::size_t>(l);
        books_.work += work.get(lane);
        books_.damping += damping.get(lane);
        record(p.point(l), 1,
               {trial.flags.corrected.get(lane), trial.flags.on_floor.get(lane), trial.flags.separated.get(lane), true},
               IntegrationEnd::done);
        bound_time_step(modulus.get(lane) * closed_share(trial.state, lane), at + l);
      } else {
        straggler(p.point(l), at + l);
      }
    }
  }

  /// σ* of the points whose trial is `good`, to its columns; returns what that damps. A separated point is felt as it
  /// is.
  template <class Lanes>
  [[gnu::always_inline]] Batch look_ahead(const Lanes& p, const Sym<Batch, N>& old, const Sym<Batch, N>& rotated,
                                          const Trial<State<Batch>, Batch>& trial, const Mask<Batch>& good,
                                          const Sym<Batch, N>& deps, int at) {
    const auto& now = trial.state;
    const Batch share = select(trial.flags.separated, Batch(0.0),
                               share_ahead(model_.p_wave_modulus(now), increment(increments_.per_mass, at)));
    Batch rate(0.0);
    for (int c = 0; c < N; ++c) {
      const auto& ahead = points_.sigma_ahead[c];
      if (ahead.empty()) continue;
      const Batch change = share * (now.sigma[c] - rotated[c]), before = p.load(ahead);
      rate = fma(change - before - old[c], deps[c], rate);
      p.store(select(good, -(now.sigma[c] + change), before), to_.sigma_ahead[c]);
    }
    return increment(increments_.volume, at) * Batch(0.5) * rate;
  }

  /// β/dt, from c²/h² = modulus · per_mass.
  template <class T>
  T share_ahead(const T& modulus, const T& per_mass) const {
    if (waves_.time > 0) return T(waves_.time / dt_);
    const T rate2 = modulus * per_mass;
    return select(rate2 > T(0.0), T(waves_.share / dt_) / sqrt(rate2), T(0.0));
  }

  /// A point whose increment is too large for one substep.
  void straggler(int p, int at) {
    stragglers_[straggler_count_++] = {p, at};
    if (straggler_count_ == static_cast<int>(stragglers_.size())) finish_stragglers();
  }

  /// Each with its own substeps, as many at once as a batch has lanes.
  void finish_stragglers() {
    integrate_lanes<ModifiedEuler, Model, N>(
        model_, straggler_count_, [&](int i) { return rotated_point(stragglers_[i]); },
        [&](int i, const State<double>& end, const IntegrationReport& report) {
          const auto [p, at] = stragglers_[i];
          const auto start = rotated_point(stragglers_[i]);  // the block's columns still hold the start
          books_.work += increments_.volume[at] * 0.5 * dot(start.state.sigma + end.sigma, start.whole.deps);
          if (damped_) look_ahead(p, at, start, end, report);
          store_state(end, p);
          record(p, report.substeps, report.flags, report.end);
          bound_time_step(model_.p_wave_modulus(end) * closed_share(end), at);
        },
        settings_, 0.5);
    straggler_count_ = 0;
  }

  /// The same for one point, of which the block's columns still hold the start.
  void look_ahead(int p, int at, const Task<Model, N>& start, const State<double>& end,
                  const IntegrationReport& report) {
    const bool follows = report.end == IntegrationEnd::done && !report.flags.separated;
    const double share = follows ? share_ahead(model_.p_wave_modulus(end), increments_.per_mass[at]) : 0.0;
    double rate = 0;
    for (int c = 0; c < N; ++c) {
      const auto& ahead = points_.sigma_ahead[c];
      if (ahead.empty()) continue;
      const double change = share * (end.sigma[c] - start.state.sigma[c]);
      rate += (change - ahead[p] + points_.sigma[c][p]) * start.whole.deps[c];
      to_.sigma_ahead[c][p] = -(end.sigma[c] + change);
    }
    books_.damping += increments_.volume[at] * 0.5 * rate;
  }

  /// The state of a point, rotated with the body, and its increment.
  Task<Model, N> rotated_point(const Straggler& straggler) const {
    const auto [p, at] = straggler;
    Task<Model, N> task{load_state(p), {{}, dt_}};
    for (int c = 0; c < N; ++c) task.whole.deps[c] = -increments_.deps[c][at];
    Spin<double, N> spin;
    for (std::size_t c = 0; c < spin.w.size(); ++c) spin.w[c] = increments_.spin[c][at];
    rotate(model_, task.state, Rotation<double, N>(spin));
    return task;
  }

  void record(int p, int substeps, const UpdateFlags<double>& flags, IntegrationEnd end) {
    const bool failed = end != IntegrationEnd::done;
    to_.flags[p] =
        static_cast<std::uint8_t>((flags.separated ? flag_separated : 0) | (flags.on_floor ? flag_on_floor : 0) |
                                  (failed ? flag_failed : 0) | (flags.corrected ? flag_corrected : 0));
    to_.substeps[p] = static_cast<std::uint8_t>(std::min(substeps, 255));
    books_.substeps += substeps;
    books_.most_substeps = std::max(books_.most_substeps, substeps);
    books_.separated += flags.separated;
    books_.on_floor += flags.on_floor;
    books_.corrected += flags.corrected;
    if (failed && books_.failures++ == 0) {
      books_.failed_id = points_.id[p];
      books_.failed_end = end;
    }
  }

  /// Ω of a point over what it has now, when it will have stiffness: what is open has none before it has closed.
  double closed_share(const State<double>& s) const { return waves_.open_are_soft ? volume_when_closed(s) : 1; }
  double closed_share(const State<Batch>& s, std::size_t lane) const {
    if constexpr (HasGap<State<Batch>>) {
      if (waves_.open_are_soft) return volume_when_closed(s.gap.get(lane));
    }
    return 1;
  }

  /// The square of c/(k h) + |v|/h: its inverse is the time that a compression wave (with the factor k of the scheme)
  /// and the point itself need to cross the point's element.
  Batch crossing_rate2(const Batch& modulus, int at) const {
    const Batch rate2 = modulus * increment(increments_.per_mass, at), v2 = increment(increments_.speed2, at);
    const Batch c2 = rate2 * (waves_.time > 0 ? waves_.per_limit2(rate2) : Batch(per_limit2_));
    return c2 + v2 + Batch(2.0) * sqrt(c2 * v2);
  }
  void bound_time_step(double modulus, int at) {
    if (!(modulus > 0)) {
      ++books_.no_stiffness;
      return;
    }
    const double rate2 = modulus * increments_.per_mass[at];
    const double rate = std::sqrt(rate2 * waves_.per_limit2(rate2)) + std::sqrt(increments_.speed2[at]);
    books_.critical_dt = std::min(books_.critical_dt, 1 / rate);
  }

  [[gnu::always_inline]] static Batch increment(const Column& column, int at) {
    return Batch::load_unaligned(column.data() + at);
  }

  /// Asks memory for the state of the points from i on, which come next as a rule: the law computes for longer than
  /// that takes, and the processor does not follow as many columns by itself.
  /// Inline, for g++ takes a function of such requests for one without effect.
  [[gnu::always_inline]] void fetch_ahead(int i) const {
    const auto at = static_cast<std::size_t>(std::min(i, block_.size() - 1));
    for (const auto& column : points_.sigma) __builtin_prefetch(column.data() + at, 1);
    for (const auto& column : block_.state) __builtin_prefetch(column.data() + at, 1);
    for (const auto& column : points_.sigma_ahead) {
      if (!column.empty()) __builtin_prefetch(column.data() + at, 1);
    }
    __builtin_prefetch(points_.eps_q.data() + at, 1);
  }

  template <class Lanes>
  State<Batch> load_state(const Lanes& p) const {
    return loaded<Dim, State<Batch>>(model_, block_, [&](const Column& column) { return p.load(column); });
  }
  template <class Lanes>
  void store_state(const State<Batch>& s, const Lanes& p) {
    store<Dim>(model_, s, to_.sigma, to_.state, [&](const Batch& x, Column& column) { p.store(x, column); });
  }
  State<double> load_state(int p) const { return state_of<Dim>(block_, model_, p); }
  void store_state(const State<double>& s, int p) {
    store<Dim>(model_, s, to_.sigma, to_.state, [p](double x, Column& column) { column[p] = x; });
  }

  const Model& model_;
  const Block<Dim>& block_;
  const Points<Dim>& points_;
  UpdatedColumns<Dim> to_;
  const PointIncrements<Dim>& increments_;
  double dt_;
  const IntegrationSettings& settings_;
  const WaveSettings& waves_;
  bool damped_;
  double per_limit2_;  ///< 1/k², where that is the same for all points
  StressBooks& books_;
  std::array<Straggler, 64> stragglers_;
  int straggler_count_ = 0;
  Batch work_ = Batch(0.0), damping_ = Batch(0.0), fastest2_ = Batch(0.0);
};

}  // namespace

StressBooks& StressBooks::operator+=(const StressBooks& other) {
  work += other.work;
  damping += other.damping;
  critical_dt = std::min(critical_dt, other.critical_dt);
  substeps += other.substeps;
  most_substeps = std::max(most_substeps, other.most_substeps);
  if (failures == 0 && other.failures > 0) {
    failed_id = other.failed_id;
    failed_end = other.failed_end;
  }
  failures += other.failures;
  corrected += other.corrected;
  separated += other.separated;
  on_floor += other.on_floor;
  no_stiffness += other.no_stiffness;
  return *this;
}

namespace {

/// One function for both, so that the compiler has one place to build each law's batch into.
template <int Dim>
[[gnu::noinline]] void update(const Block<Dim>& block, const UpdatedColumns<Dim>& to, PointRange range,
                              const PointIncrements<Dim>& increments, int at, double dt,
                              const IntegrationSettings& settings, StressBooks& books, const WaveSettings& waves) {
  std::visit(
      [&]<class Model>(const Model& model) {
        if constexpr (Averaged<Model>) {
          if (block.length > 0) {
            const Nonlocal<Model> nonlocal(model);
            Update<Nonlocal<Model>, Dim>(nonlocal, block, to, increments, dt, settings, waves, books)(range, at);
            return;
          }
        }
        Update<Model, Dim>(model, block, to, increments, dt, settings, waves, books)(range, at);
      },
      block.model);
}

}  // namespace

template <int Dim>
void update_stresses(Block<Dim>& block, PointRange range, const PointIncrements<Dim>& increments, int at, double dt,
                     const IntegrationSettings& settings, StressBooks& books, const WaveSettings& waves) {
  update(block, UpdatedColumns<Dim>(block), range, increments, at, dt, settings, books, waves);
}

template <int Dim>
void trial_stresses(const Block<Dim>& block, TrialState<Dim>& trial, PointRange range,
                    const PointIncrements<Dim>& increments, int at, double dt, const IntegrationSettings& settings,
                    StressBooks& books, const WaveSettings& waves) {
  update(block, UpdatedColumns<Dim>(trial), range, increments, at, dt, settings, books, waves);
}

template <int Dim>
double critical_time_step(const Block<Dim>& block, const Mesh<Dim>& mesh, const ActiveElements& active,
                          const Column& weight, const Column& least_per_mass, const WaveSettings& waves) {
  const auto& points = block.points;
  double dt = std::numeric_limits<double>::infinity();
  for (int i = 0; i < block.size(); ++i) {
    with_state(block, i, [&](const auto& model, const auto& state) {
      const double modulus = model.p_wave_modulus(state) * (waves.open_are_soft ? volume_when_closed(state) : 1);
      if (!(modulus > 0)) return;
      double v2 = 0;
      for (int j = 0; j < Dim; ++j) v2 += points.v[j][i] * points.v[j][i];
      const int e = points.element[i];
      const int slot = active.slot[e];
      const double h = mesh.size_of(e), least = least_per_mass.empty() ? 0.0 : least_per_mass[slot] * h * h;
      const double per_mass = std::max(std::max(1.0, weight[slot]) * points.volume[i] / points.mass[i], least);
      const double c2 = modulus * per_mass;
      dt = std::min(dt, h / (std::sqrt(c2 * waves.per_limit2(c2 / (h * h))) + std::sqrt(v2)));
    });
  }
  return dt;
}

template void update_stresses<2>(Block<2>&, PointRange, const PointIncrements<2>&, int, double,
                                 const IntegrationSettings&, StressBooks&, const WaveSettings&);
template void update_stresses<3>(Block<3>&, PointRange, const PointIncrements<3>&, int, double,
                                 const IntegrationSettings&, StressBooks&, const WaveSettings&);
template void trial_stresses<2>(const Block<2>&, TrialState<2>&, PointRange, const PointIncrements<2>&, int, double,
                                const IntegrationSettings&, StressBooks&, const WaveSettings&);
template void trial_stresses<3>(const Block<3>&, TrialState<3>&, PointRange, const PointIncrements<3>&, int, double,
                                const IntegrationSettings&, StressBooks&, const WaveSettings&);
template double critical_time_step<2>(const Block<2>&, const Mesh<2>&, const ActiveElements&, const Column&,
                                      const Column&, const WaveSettings&);
template double critical_time_step<3>(const Block<3>&, const Mesh<3>&, const ActiveElements&, const Column&,
                                      const Column&, const WaveSettings&);

}  // namespace scarp::exec
