#include "scarp/step/nonlocal.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

#include "scarp/exec/parallel.hpp"
#include "scarp/mesh/with_basis.hpp"
#include "scarp/step/body.hpp"
#include "scarp/step/chunks.hpp"

namespace scarp::step {
namespace {

constexpr double m = 2;  ///< share of the average; the rest is the point's own

/// The corners that values are kept at: all nodes of a mesh, or those of a box of cells of a grid around the soil.
template <int Dim>
class Corners {
 public:
  explicit Corners(const Body<Dim>& body, const VelocityField<Dim>& field) : mesh_(*body.mesh), active_(field.active) {
    if (!mesh_.grid) {
      size_ = mesh_.node_count();
      return;
    }
    low_ = mesh_.grid->cell(active_.element.front());
    std::array<int, Dim> high = low_;
    for (const int e : active_.element) {
      const auto at = mesh_.grid->cell(e);
      for (int d = 0; d < Dim; ++d) {
        low_[d] = std::min(low_[d], at[d]);
        high[d] = std::max(high[d], at[d]);
      }
    }
    size_ = 1;
    for (int d = 0; d < Dim; ++d) {
      along_[d] = high[d] - low_[d] + 2;
      size_ *= along_[d];
    }
  }

  int size() const { return size_; }
  const std::array<int, Dim>& along() const { return along_; }

  /// Number of local corner i of element e; of a grid they count x fastest.
  int of(int e, int i) const {
    if (!mesh_.grid) return mesh_.element_nodes(e)[i];
    const auto at = mesh_.grid->cell(e);
    int corner = 0;
    for (int d = Dim - 1; d >= 0; --d) corner = corner * along_[d] + at[d] - low_[d] + (i >> d & 1);
    return corner;
  }

  /// f(slot, local corner) for the active cells of a grid around a corner, in the order of the cells.
  template <class F>
  void for_cells_around(int corner, F&& f) const {
    std::array<int, Dim> at;
    for (int d = 0; d < Dim; ++d) {
      at[d] = corner % along_[d] + low_[d];
      corner /= along_[d];
    }
    for (int i = (1 << Dim) - 1; i >= 0; --i) {  // as the last corner of the first cell
      int e = 0;
      bool within = true;
      for (int d = Dim - 1; d >= 0; --d) {
        const int cell = at[d] - (i >> d & 1);
        within = within && cell >= 0 && cell < mesh_.grid->elements[d];
        e = e * mesh_.grid->elements[d] + cell;
      }
      if (within && active_.slot[e] >= 0) f(active_.slot[e], i);
    }
  }

 private:
  const Mesh<Dim>& mesh_;
  const ActiveElements& active_;
  std::array<int, Dim> low_{}, along_{};
  int size_ = 0;
};

/// f(K, at): element e has K corners (a constant), whose functions at point i are the array at(points, i).
template <int Dim, class F>
void with_functions(const Mesh<Dim>& mesh, int e, F&& f) {
  if (mesh.grid) {
    const detail::GridCell<Dim> cell(*mesh.grid, e);
    constexpr int K = 1 << Dim;
    f(std::integral_constant<int, K>{}, [&cell](const Points<Dim>& points, int i) {
      const auto s = cell.local(position_of(points, i));
      std::array<std::array<double, 2>, Dim> each;
      for (int d = 0; d < Dim; ++d) each[d] = {1 - s[d], s[d]};
      std::array<double, K> N;
      detail::products<Dim, 2>(each, N);
      return N;
    });
    return;
  }
  with_shape<Dim>(mesh.type_of(e), [&]<class Shape>(Shape) {
    using Basis = Linear<Shape>;
    const typename Basis::Cell cell(mesh, e);
    f(std::integral_constant<int, Basis::nodes>{}, [&cell](const Points<Dim>& points, int i) {
      std::array<double, Basis::nodes> N;
      if constexpr (Basis::stores_local) {
        Vec<Dim> xi;
        for (int d = 0; d < Dim; ++d) xi[d] = points.xi[d][i];
        cell.shape(xi, N);
      } else {
        cell.shape(cell.local(position_of(points, i)), N);
      }
      return N;
    });
  });
}

/// κ of the points of a block.
template <int Dim>
const Column& kappa_of(const Block<Dim>& block) {
  return block.state.end()[-std::visit([](const auto& law) { return kappa_from_end(law); }, block.model)];
}

/// Where the local corner i of the element in a slot sums up.
template <int Dim>
std::size_t place_of(const Body<Dim>& body, const VelocityField<Dim>& field, int slot, int i) {
  return 2 * static_cast<std::size_t>(body.mesh->grid ? (slot << Dim) + i : field.assembly.accumulators_of(slot)[i]);
}

/// Σ N κ′ Ω and Σ N Ω of each element.
template <int Dim>
void sum_elements(const Body<Dim>& body, VelocityField<Dim>& field) {
  Column& sums = field.averages.of_elements;
  sums.assign(
      2 * (body.mesh->grid ? static_cast<std::size_t>(field.active.size()) << Dim : field.assembly.accumulators()),
      0.0);
  for_each_chunk(field, [&](const exec::Chunk& chunk) {
    for (int slot = chunk.slots.first; slot < chunk.slots.last; ++slot) {
      with_functions(*body.mesh, field.active.element[slot], [&](auto K, const auto& at) {
        for (const auto& block : field.blocks) {
          if (!(block.length > 0)) continue;
          const double cap = kappa_c_of(block.model);
          const Column& kappa = kappa_of(block);
          for (int k = block.begin[slot]; k < block.begin[slot + 1]; ++k) {
            const int p = block.order[k];
            const auto N = at(block.points, p);
            const double volume = block.points.volume[p], strain = std::min(kappa[p], cap) * volume;
            for (int i = 0; i < K; ++i) {
              double* to = sums.data() + place_of(body, field, slot, i);
              to[0] += N[i] * strain;
              to[1] += N[i] * volume;
            }
          }
        }
      });
    }
  });
}

/// From elements to corners, in a fixed order.
template <int Dim>
void sum_corners(const Body<Dim>& body, VelocityField<Dim>& field, const Corners<Dim>& corners) {
  auto& averages = field.averages;
  const double* from = averages.of_elements.data();
  averages.sums.assign(2 * static_cast<std::size_t>(corners.size()), 0.0);
  const auto add = [&](int corner, std::size_t place) {
    for (std::size_t q = 0; q < 2; ++q) averages.sums[2 * static_cast<std::size_t>(corner) + q] += from[place + q];
  };
  if (body.mesh->grid) {
    exec::for_each(corners.size(), [&](int c) {
      corners.for_cells_around(c, [&](int slot, int i) { add(c, place_of(body, field, slot, i)); });
    });
  } else {
    exec::for_each(field.assembly.size(), [&](int k) {
      field.assembly.gather(
          k, [&](int accumulator) { add(field.assembly.node(k), 2 * static_cast<std::size_t>(accumulator)); });
    });
  }
}

/// G(Σ N κ′ Ω) / G(Σ N Ω) at all corners that have soil in reach, in the first of the two numbers.
template <int Dim>
void smooth(Averages<Dim>& averages, const typename Averages<Dim>::OfLength& of, const Corners<Dim>& corners) {
  averages.smoothed = averages.sums;
  averages.scratch.resize(averages.sums.size());
  if (const auto* grid = std::get_if<GridSmoothing<Dim>>(&of.smoothing)) {
    (*grid)(corners.along(), averages.smoothed, averages.scratch);
  } else {
    std::get<MeshSmoothing<Dim>>(of.smoothing)(averages.smoothed, averages.scratch);
  }
  double* values = averages.smoothed.data();
  exec::for_each(corners.size(), [values](int c) {
    const double volume = values[2 * static_cast<std::size_t>(c) + 1];
    double& kappa = values[2 * static_cast<std::size_t>(c)];
    kappa = volume > 0 ? kappa / volume : 0.0;
  });
}

/// How fast κ̂ of the points of a block grows over the time until the next average.
template <int Dim>
void set_rates(const Body<Dim>& body, VelocityField<Dim>& field, Block<Dim>& block, const Corners<Dim>& corners,
               double time) {
  const double cap = kappa_c_of(block.model);
  const double* averages = field.averages.smoothed.data();
  const std::size_t columns = block.state.size();
  const Column &kappa = kappa_of(block), &kappa_hat = block.state[columns - 2];
  Column& rate = block.state[columns - 1];
  for_each_chunk(field, [&](const exec::Chunk& chunk) {
    for (int slot = chunk.slots.first; slot < chunk.slots.last; ++slot) {
      if (block.begin[slot] == block.begin[slot + 1]) continue;
      const int e = field.active.element[slot];
      with_functions(*body.mesh, e, [&](auto K, const auto& at) {
        std::array<double, K> of_corner;
        for (int i = 0; i < K; ++i) of_corner[i] = averages[2 * static_cast<std::size_t>(corners.of(e, i))];
        for (int k = block.begin[slot]; k < block.begin[slot + 1]; ++k) {
          const int p = block.order[k];
          const auto N = at(block.points, p);
          double average = 0;
          for (int i = 0; i < K; ++i) average += N[i] * of_corner[i];
          const double own = std::min(kappa[p], cap);
          const double aim = (1 - m) * own + m * average + std::max(0.0, kappa[p] - cap);
          rate[p] = std::max(0.0, aim - kappa_hat[p]) / time;
        }
      });
    }
  });
}

/// The smoothing of each length that a block has, made once.
template <int Dim>
void prepare(const Body<Dim>& body, VelocityField<Dim>& field) {
  auto& lengths = field.averages.lengths;
  for (const auto& block : field.blocks) {
    const auto same = [&block](const auto& of) { return of.length == block.length; };
    if (!(block.length > 0) || std::any_of(lengths.begin(), lengths.end(), same)) continue;
    if (body.mesh->grid) {
      lengths.push_back({block.length, GridSmoothing<Dim>(body.mesh->grid->spacing, block.length)});
    } else {
      lengths.push_back({block.length, MeshSmoothing<Dim>(*body.mesh, block.length)});
    }
  }
}

/// The averages of one field.
template <int Dim>
void average_softening(const Body<Dim>& body, VelocityField<Dim>& field, double dt) {
  if (field.active.size() == 0) return;
  auto& averages = field.averages;
  if (++averages.steps < averages.every) return;
  averages.steps = 0;
  prepare(body, field);
  const Corners<Dim> corners(body, field);
  sum_elements(body, field);
  sum_corners(body, field, corners);
  for (const auto& of : averages.lengths) {
    smooth(averages, of, corners);
    for (auto& block : field.blocks) {
      if (block.length == of.length) set_rates(body, field, block, corners, averages.every * dt);
    }
  }
}

template <int Dim>
bool softens_over_length(const VelocityField<Dim>& field) {
  return std::any_of(field.blocks.begin(), field.blocks.end(), [](const auto& block) { return block.length > 0; });
}

}  // namespace

template <int Dim>
void average_softening(Body<Dim>& body, double dt) {
  for (auto& field : body.fields) {
    if (softens_over_length(field)) average_softening(body, field, dt);
  }
}

template <int Dim>
bool softens_over_length(const Body<Dim>& body) {
  return std::any_of(body.fields.begin(), body.fields.end(),
                     [](const auto& field) { return softens_over_length(field); });
}

template bool softens_over_length<2>(const Body<2>&);
template bool softens_over_length<3>(const Body<3>&);
template void average_softening<2>(Body<2>&, double);
template void average_softening<3>(Body<3>&, double);

}  // namespace scarp::step
