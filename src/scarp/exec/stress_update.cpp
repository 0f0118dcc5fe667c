#include "scarp/exec/stress_update.hpp"

#include <array>
#include <cmath>

#include "scarp/material/integrate/lanes.hpp"
#include "scarp/material/plastic_state.hpp"
#include "scarp/tensor/batch.hpp"

namespace scarp::exec {
namespace {

constexpr int W = lanes_of<Batch>;

/// The square of c/(k h) + |v|/h: its inverse is the time that a compression wave (with the factor k of the scheme) and
/// the point itself need to cross the point's element. `per_limit2` is 1/k² where that is the same for all points. One
/// text for all that ask, whatever comes with a point in its batch, which a compiler can round in one way only: a
/// product that is added to is fused, and that with 2 is exact.
[[gnu::always_inline]] inline Batch crossing_rate2(const WaveSettings& waves, double per_limit2, const Batch& modulus,
                                                   const Batch& per_mass, const Batch& speed2) {
  const Batch rate2 = modulus * per_mass, limit2 = waves.time > 0 ? waves.per_limit2(rate2) : Batch(per_limit2);
  return fma(rate2, limit2, speed2) + Batch(2.0) * sqrt(rate2 * limit2 * speed2);
}

/// The volume that each of some points will have when its gap has closed, over its present one.
template <class State>
Batch volumes_when_closed(const State& s) {
  if constexpr (HasGap<State>) {
    if (!any(s.gap > Batch(0.0))) return Batch(1.0);
    std::array<double, batch_lanes> share;
    s.gap.store_unaligned(share.data());
    for (double& x : share) x = volume_when_closed(x);
    return Batch::load_unaligned(share.data());
  }
  return Batch(1.0);
}

/// The modulus that bounds the time step.
template <class Model, class State>
Batch bounding_modulus(const Model& model, const State& s, const WaveSettings& waves) {
  const Batch modulus = model.p_wave_modulus(s);
  return waves.open_are_soft ? modulus * volumes_when_closed(s) : modulus;
}

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
         const WaveSettings& waves, StressTotals& totals)
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
        totals_(totals) {}

  void operator()(PointRange range, int at) {
    for_each_batch<Batch>(range, [&](const Lanes<Batch>& p, int first) { batch(p, at + first); });
    finish_stragglers();
    totals_.work += xsimd::hadd(work_);
    totals_.damping += xsimd::hadd(damping_);
    std::array<double, W> rate2;
    fastest2_.store_unaligned(rate2.data());
    const double most = std::max(most2_, *std::max_element(rate2.begin(), rate2.end()));
    if (most > 0) totals_.critical_dt = std::min(totals_.critical_dt, 1 / std::sqrt(most));
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
    const Batch rate2 = crossing_rate2(waves_, per_limit2_, modulus, increment(increments_.per_mass, at),
                                       increment(increments_.speed2, at));
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
      totals_.substeps += W;
      totals_.most_substeps = std::max(totals_.most_substeps, 1);
      return;
    }
    store_state(select_state(good, trial.state, old), p);
    for (int l = 0; l < p.count(); ++l) {
      if (done >> l & 1u) {
        const auto lane = static_cast<std::size_t>(l);
        totals_.work += work.get(lane);
        totals_.damping += damping.get(lane);
        record(p.point(l), 1,
               {trial.flags.corrected.get(lane), trial.flags.on_floor.get(lane), trial.flags.separated.get(lane), true},
               IntegrationEnd::done);
      } else {
        straggler(p.point(l), at + l);
      }
    }
    bound_time_step(trial.state, done, at);
  }

  /// σ* of the points whose trial is `good`, to its columns; returns what that damps. A separated point is felt as it
  /// is. Products are fused by hand: a compiler would do so for points that lie beside each other only.
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
      const Batch change = now.sigma[c] - rotated[c], before = p.load(ahead);
      rate = fma(fma(share, change, -before) - old[c], deps[c], rate);
      p.store(select(good, -fma(share, change, now.sigma[c]), before), to_.sigma_ahead[c]);
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
          totals_.work += increments_.volume[at] * 0.5 * dot(start.state.sigma + end.sigma, start.whole.deps);
          if (damped_) look_ahead(p, at, start, end, report);
          store_state(end, p);
          record(p, report.substeps, report.flags, report.end);
          State<Batch> in_all_lanes;
          for_each_component([](Batch& x, const double& y) { x = Batch(y); }, in_all_lanes, end);
          bound_time_step(in_all_lanes, 1, at);
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
    totals_.damping += increments_.volume[at] * 0.5 * rate;
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
    totals_.substeps += substeps;
    totals_.most_substeps = std::max(totals_.most_substeps, substeps);
    totals_.separated += flags.separated;
    totals_.on_floor += flags.on_floor;
    totals_.corrected += flags.corrected;
    if (!failed) return;
    ++totals_.failures;
    totals_.first_failed.keep_first({0, points_.id[p], end});
  }

  /// Of the points of a batch whose bits are set.
  void bound_time_step(const State<Batch>& s, unsigned which, int at) {
    const Batch modulus = bounding_modulus(model_, s, waves_);
    const Batch rate2 = crossing_rate2(waves_, per_limit2_, modulus, increment(increments_.per_mass, at),
                                       increment(increments_.speed2, at));
    for (int l = 0; l < W; ++l) {
      if (!(which >> l & 1u)) continue;
      const auto lane = static_cast<std::size_t>(l);
      if (modulus.get(lane) > 0) {
        most2_ = std::max(most2_, rate2.get(lane));
      } else {
        ++totals_.no_stiffness;
      }
    }
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
  StressTotals& totals_;
  std::array<Straggler, 64> stragglers_;
  int straggler_count_ = 0;
  Batch work_ = Batch(0.0), damping_ = Batch(0.0), fastest2_ = Batch(0.0);
  double most2_ = 0;  ///< of points that fastest2_ leaves out
};

}  // namespace

void StressTotals::add_counts(const StressTotals& other) {
  critical_dt = std::min(critical_dt, other.critical_dt);
  substeps += other.substeps;
  most_substeps = std::max(most_substeps, other.most_substeps);
  first_failed.keep_first(other.first_failed);
  failures += other.failures;
  corrected += other.corrected;
  separated += other.separated;
  on_floor += other.on_floor;
  no_stiffness += other.no_stiffness;
}

namespace {

/// One function for both, so that the compiler has one place to build each law's batch into.
template <int Dim>
[[gnu::noinline]] void update(const Block<Dim>& block, const UpdatedColumns<Dim>& to, PointRange range,
                              const PointIncrements<Dim>& increments, int at, double dt,
                              const IntegrationSettings& settings, StressTotals& totals, const WaveSettings& waves) {
  std::visit(
      [&]<class Model>(const Model& model) {
        if constexpr (Averaged<Model>) {
          if (block.length > 0) {
            const Nonlocal<Model> nonlocal(model);
            Update<Nonlocal<Model>, Dim>(nonlocal, block, to, increments, dt, settings, waves, totals)(range, at);
            return;
          }
        }
        Update<Model, Dim>(model, block, to, increments, dt, settings, waves, totals)(range, at);
      },
      block.model);
}

}  // namespace

template <int Dim>
void update_stresses(Block<Dim>& block, PointRange range, const PointIncrements<Dim>& increments, int at, double dt,
                     const IntegrationSettings& settings, StressTotals& totals, const WaveSettings& waves) {
  update(block, UpdatedColumns<Dim>(block), range, increments, at, dt, settings, totals, waves);
}

template <int Dim>
void trial_stresses(const Block<Dim>& block, TrialState<Dim>& trial, PointRange range,
                    const PointIncrements<Dim>& increments, int at, double dt, const IntegrationSettings& settings,
                    StressTotals& totals, const WaveSettings& waves) {
  update(block, UpdatedColumns<Dim>(trial), range, increments, at, dt, settings, totals, waves);
}

template <int Dim>
double critical_time_step(const Block<Dim>& block, const Mesh<Dim>& mesh, const ActiveElements& active,
                          const Column& weight, const Column& least_per_mass, const WaveSettings& waves) {
  const auto& points = block.points;
  const double per_limit2 = waves.per_limit2(1.0);
  double most2 = 0;
  std::visit(
      [&]<class Model>(const Model& model) {
        using State = typename Model::template State<Batch, sym_size<Dim>>;
        for_each_batch<Batch>({block.order.data(), block.size()}, [&](const Lanes<Batch>& p, int) {
          std::array<double, batch_lanes> per_mass{}, per_size2{};
          for (int l = 0; l < p.count(); ++l) {  // as nodes_to_points() has them
            const int i = p.point(l), e = points.element[i], slot = active.slot[e];
            per_size2[l] = 1 / (mesh.size_of(e) * mesh.size_of(e));
            const double stiffer = weight[slot] > 1 ? weight[slot] * per_size2[l] : per_size2[l];
            per_mass[l] = stiffer * points.volume[i] / points.mass[i];
            if (!least_per_mass.empty()) per_mass[l] = std::max(per_mass[l], least_per_mass[e]);
          }
          Batch v2(0.0);
          for (const auto& v : points.v) v2 = fma(p.load(v), p.load(v), v2);
          const auto load = [&](const Column& column) { return p.load(column); };
          const Batch modulus = bounding_modulus(model, loaded<Dim, State>(model, block, load), waves);
          const Batch rate2 = crossing_rate2(waves, per_limit2, modulus, Batch::load_unaligned(per_mass.data()),
                                             Batch::load_unaligned(per_size2.data()) * v2);
          for (int l = 0; l < p.count(); ++l) {
            const auto lane = static_cast<std::size_t>(l);
            if (modulus.get(lane) > 0) most2 = std::max(most2, rate2.get(lane));
          }
        });
      },
      block.model);
  return most2 > 0 ? 1 / std::sqrt(most2) : std::numeric_limits<double>::infinity();
}

template void update_stresses<2>(Block<2>&, PointRange, const PointIncrements<2>&, int, double,
                                 const IntegrationSettings&, StressTotals&, const WaveSettings&);
template void update_stresses<3>(Block<3>&, PointRange, const PointIncrements<3>&, int, double,
                                 const IntegrationSettings&, StressTotals&, const WaveSettings&);
template void trial_stresses<2>(const Block<2>&, TrialState<2>&, PointRange, const PointIncrements<2>&, int, double,
                                const IntegrationSettings&, StressTotals&, const WaveSettings&);
template void trial_stresses<3>(const Block<3>&, TrialState<3>&, PointRange, const PointIncrements<3>&, int, double,
                                const IntegrationSettings&, StressTotals&, const WaveSettings&);
template double critical_time_step<2>(const Block<2>&, const Mesh<2>&, const ActiveElements&, const Column&,
                                      const Column&, const WaveSettings&);
template double critical_time_step<3>(const Block<3>&, const Mesh<3>&, const ActiveElements&, const Column&,
                                      const Column&, const WaveSettings&);

}  // namespace scarp::exec
