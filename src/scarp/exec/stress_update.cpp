#include "scarp/exec/stress_update.hpp"

#include <array>
#include <cmath>

#include "scarp/exec/parallel.hpp"
#include "scarp/material/integrate/lanes.hpp"
#include "scarp/tensor/batch.hpp"

namespace scarp::exec {
namespace {

constexpr int W = static_cast<int>(batch_lanes);
constexpr int chunk_points = 64 * W;

/// Lanes i ... i + count - 1 of a column; past the end of the column the last lane is repeated.
Batch load(const std::vector<double>& column, int i, int count) {
  if (count == W) return Batch::load_unaligned(column.data() + i);
  std::array<double, W> lanes;
  for (int l = 0; l < W; ++l) lanes[l] = column[i + std::min(l, count - 1)];
  return Batch::load_unaligned(lanes.data());
}

void store(const Batch& value, std::vector<double>& column, int i, int count) {
  if (count == W) {
    value.store_unaligned(column.data() + i);
    return;
  }
  std::array<double, W> lanes;
  value.store_unaligned(lanes.data());
  for (int l = 0; l < count; ++l) column[i + l] = lanes[l];
}

bool lane(const xsimd::batch_bool<double>& mask, int l) {
  return mask.get(static_cast<std::size_t>(l));
}

/// Time that a compression wave and the point itself need to cross the point's element; infinite without stiffness.
template <int Dim>
double crossing_time(const Points<Dim>& points, int p, double modulus, const std::vector<double>& element_size) {
  if (!(modulus > 0)) return std::numeric_limits<double>::infinity();
  double v2 = 0;
  for (int j = 0; j < Dim; ++j) v2 += points.v[j][p] * points.v[j][p];
  // Where a point stands for more than its volume, its stiffness does too.
  const double volume = points.volume[p] * std::max(1.0, points.weight[p]);
  const double c = std::sqrt(modulus * volume / points.mass[p]);
  return element_size[points.element[p]] / (c + std::sqrt(v2));
}

/// The stress update of one block with one law; the only text that knows both sign conventions: tension positive in the
/// arrays of the points, compression positive in the law.
template <class Model, int Dim>
class Sweep {
  static constexpr int N = sym_size<Dim>;
  template <class T>
  using State = typename Model::template State<T, N>;

 public:
  Sweep(const Model& model, Block<Dim>& block, double dt, const std::vector<double>& element_size,
        const IntegrationSettings& settings)
      : model_(model), block_(block), points_(block.points), dt_(dt), size_(element_size), settings_(settings) {}

  StressBooks operator()(int first, int last) {
    StressBooks books;
    Stragglers stragglers;
    for (int i = first; i < last; i += W) batch(i, std::min(W, last - i), books, stragglers);
    finish(stragglers, books);
    return books;
  }

 private:
  /// Points of a chunk whose increment is too large for one substep.
  struct Stragglers {
    std::array<int, chunk_points> point;
    int count = 0;
  };

  void batch(int i, int count, StressBooks& books, Stragglers& stragglers) {
    const State<Batch> old = load_state(i, count);
    Sym<Batch, N> deps;
    for (int c = 0; c < N; ++c) deps[c] = -load(points_.deps[c], i, count);
    Spin<Batch, N> spin;
    for (std::size_t c = 0; c < spin.w.size(); ++c) spin.w[c] = load(points_.spin[c], i, count);
    State<Batch> turned = old;
    rotate(model_, turned, Rotation<Batch, N>(spin));

    const auto trial =
        attempt<ModifiedEuler>(model_, turned, Increment<Batch, N>{deps, Batch(dt_)}, settings_.tolerance);
    const auto good = trial.notes.sound && (trial.error <= Batch(settings_.tolerance));
    store_state(select_state(good, trial.state, old), i, count);

    const Batch Omega = load(points_.weight, i, count) * load(points_.volume, i, count) *
                        (Batch(1.0) + Batch(0.5) * trace(deps));  // of mid-step
    std::array<double, W> work, modulus;
    (Omega * Batch(0.5) * dot(turned.sigma + trial.state.sigma, deps)).store_unaligned(work.data());
    model_.p_wave_modulus(trial.state).store_unaligned(modulus.data());
    const Batch eps_q = load(points_.eps_q, i, count) + Batch(0.81649658092772603273) * norm(deviator(deps));
    store(eps_q, points_.eps_q, i, count);

    for (int l = 0; l < count; ++l) {
      const int p = i + l;
      if (lane(good, l)) {
        const Notes<double> notes{lane(trial.notes.corrected, l), lane(trial.notes.on_floor, l),
                                  lane(trial.notes.separated, l), true};
        books.work += work[l];
        record(p, 1, notes, IntegrationEnd::done, books);
        time_step(p, modulus[l], books);
      } else {
        stragglers.point[stragglers.count++] = p;
      }
    }
  }

  /// Each with its own substeps, as many at once as a batch has lanes.
  void finish(const Stragglers& stragglers, StressBooks& books) {
    integrate_lanes<ModifiedEuler, Model, N>(
        model_, stragglers.count, [&](int i) { return turned_point(stragglers.point[i]); },
        [&](int i, const State<double>& end, const IntegrationReport& report) {
          const int p = stragglers.point[i];
          const auto start = turned_point(p);  // the columns still hold the start
          const Sym<double, N>& deps = start.whole.deps;
          books.work += points_.weight[p] * points_.volume[p] * (1 + 0.5 * trace(deps)) * 0.5 *
                        dot(start.state.sigma + end.sigma, deps);
          store_state(end, p);
          record(p, report.substeps, report.notes, report.end, books);
          time_step(p, model_.p_wave_modulus(end), books);
        },
        settings_, 0.5);
  }

  /// The state of a point, turned with the body, and its increment.
  Task<Model, N> turned_point(int p) const {
    Task<Model, N> task{load_state(p), {{}, dt_}};
    for (int c = 0; c < N; ++c) task.whole.deps[c] = -points_.deps[c][p];
    Spin<double, N> spin;
    for (std::size_t c = 0; c < spin.w.size(); ++c) spin.w[c] = points_.spin[c][p];
    rotate(model_, task.state, Rotation<double, N>(spin));
    return task;
  }

  void record(int p, int substeps, const Notes<double>& notes, IntegrationEnd end, StressBooks& books) {
    const bool failed = end != IntegrationEnd::done;
    points_.flags[p] =
        static_cast<std::uint8_t>((notes.separated ? flag_separated : 0) | (notes.on_floor ? flag_on_floor : 0) |
                                  (failed ? flag_failed : 0) | (notes.corrected ? flag_corrected : 0));
    points_.substeps[p] = static_cast<std::uint8_t>(std::min(substeps, 255));
    books.substeps += substeps;
    books.most_substeps = std::max(books.most_substeps, substeps);
    books.separated += notes.separated;
    books.on_floor += notes.on_floor;
    books.corrected += notes.corrected;
    if (failed && books.failures++ == 0) {
      books.failed_id = points_.id[p];
      books.failed_end = end;
    }
  }

  void time_step(int p, double modulus, StressBooks& books) const {
    if (!(modulus > 0)) ++books.no_stiffness;
    books.critical_dt = std::min(books.critical_dt, crossing_time(points_, p, modulus, size_));
  }

  State<Batch> load_state(int i, int count) const {
    State<Batch> s;
    const int columns = state_columns<N>(model_);
    int c = 0;
    for_each_component(
        [&](Batch& x) {
          x = c < N             ? -load(points_.sigma[c], i, count)
              : c - N < columns ? load(block_.state[c - N], i, count)
                                : Batch(0.0);
          ++c;
        },
        s);
    return s;
  }

  void store_state(const State<Batch>& s, int i, int count) {
    const int columns = state_columns<N>(model_);
    int c = 0;
    for_each_component(
        [&](const Batch& x) {
          if (c < N) {
            store(-x, points_.sigma[c], i, count);
          } else if (c - N < columns) {
            store(x, block_.state[c - N], i, count);
          }
          ++c;
        },
        s);
  }

  State<double> load_state(int p) const {
    State<double> s;
    with_state(block_, p, [&](const auto&, const auto& state) {
      if constexpr (std::is_same_v<std::decay_t<decltype(state)>, State<double>>) s = state;
    });
    return s;
  }

  void store_state(const State<double>& s, int p) {
    const int columns = state_columns<N>(model_);
    int c = 0;
    for_each_component(
        [&](double x) {
          if (c < N) {
            points_.sigma[c][p] = -x;
          } else if (c - N < columns) {
            block_.state[c - N][p] = x;
          }
          ++c;
        },
        s);
  }

  const Model& model_;
  Block<Dim>& block_;
  Points<Dim>& points_;
  double dt_;
  const std::vector<double>& size_;
  IntegrationSettings settings_;
};

}  // namespace

StressBooks& StressBooks::operator+=(const StressBooks& other) {
  work += other.work;
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

template <int Dim>
StressBooks update_stresses(Block<Dim>& block, double dt, const std::vector<double>& element_size,
                            const IntegrationSettings& settings) {
  return std::visit(
      [&]<class Model>(const Model& model) {
        Sweep<Model, Dim> sweep(model, block, dt, element_size, settings);
        return sum_over_chunks<StressBooks>(block.size(), chunk_points,
                                            [&](int first, int last) { return sweep(first, last); });
      },
      block.model);
}

template <int Dim>
double critical_time_step(const Block<Dim>& block, const std::vector<double>& element_size) {
  double dt = std::numeric_limits<double>::infinity();
  for (int i = 0; i < block.size(); ++i) {
    with_state(block, i, [&](const auto& model, const auto& state) {
      dt = std::min(dt, crossing_time(block.points, i, model.p_wave_modulus(state), element_size));
    });
  }
  return dt;
}

template StressBooks update_stresses<2>(Block<2>&, double, const std::vector<double>&, const IntegrationSettings&);
template double critical_time_step<2>(const Block<2>&, const std::vector<double>&);

}  // namespace scarp::exec
