#include "scarp/step/smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scarp/exec/parallel.hpp"
#include "scarp/mesh/with_basis.hpp"

namespace scarp::step {
namespace {

/// exec::for_each() for few things that are much work each.
struct Nothing {
  Nothing& operator+=(const Nothing&) { return *this; }
};
template <class F>
void for_each_of_few(int count, int chunk, F&& f) {
  std::vector<Nothing> partial;
  Nothing total;
  exec::sum_over_chunks(count, chunk, partial, total, [&](int first, int last, Nothing&) {
    for (int i = first; i < last; ++i) f(i);
  });
}

/// f(basis, cell) for the linear functions of element e of a mesh that is no grid.
template <int Dim, class F>
void with_cell(const Mesh<Dim>& mesh, int e, F&& f) {
  with_shape<Dim>(mesh.type_of(e), [&]<class Shape>(Shape) {
    const typename Linear<Shape>::Cell cell(mesh, e);
    f(Linear<Shape>{}, cell);
  });
}

}  // namespace

template <int Dim>
double shape_variance(const Mesh<Dim>& mesh, int e) {
  if (mesh.grid) {
    double sum = 0;
    for (const double h : mesh.grid->spacing) sum += h * h / 6;
    return sum / Dim;
  }
  double volume = 0, sum = 0;
  const auto n = mesh.element_nodes(e);
  with_cell(mesh, e, [&]<class Basis>(Basis, const auto& cell) {
    cell.for_gauss([&](const Vec<Dim>& local, double dV) {
      std::array<double, Basis::nodes> N;
      cell.shape(local, N);
      Vec<Dim> x{};
      for (int i = 0; i < Basis::nodes; ++i) {
        for (int d = 0; d < Dim; ++d) x[d] += N[i] * mesh.node(n[i])[d];
      }
      volume += dV;
      for (int i = 0; i < Basis::nodes; ++i) {
        for (int d = 0; d < Dim; ++d) sum += dV * N[i] * (mesh.node(n[i])[d] - x[d]) * (mesh.node(n[i])[d] - x[d]);
      }
    });
  });
  return sum / (volume * Dim);
}

template <int Dim>
GridSmoothing<Dim>::GridSmoothing(const Vec<Dim>& spacing, double length) {
  for (int d = 0; d < Dim; ++d) {
    const double h = spacing[d], size2 = length * length - 2.0 / 3.0 * h * h;
    weights_[d].push_back(1);
    for (int i = 1; i * h < 2.5 * length && size2 > 0; ++i) weights_[d].push_back(std::exp(-i * h * (i * h) / size2));
  }
}

template <int Dim>
void GridSmoothing<Dim>::operator()(const std::array<int, Dim>& corners, Column& values, Column& scratch) const {
  const int row = 2 * corners[0];  // numbers beside each other
  int rows = 1;
  for (int d = 1; d < Dim; ++d) rows *= corners[d];
  int stride = 1;  // rows from a corner to the next one along the axis, beyond x
  for (int d = 0; d < Dim; ++d) {
    const auto& w = weights_[d];
    const int reach = static_cast<int>(w.size()) - 1, n = corners[d];
    for_each_of_few(rows, 16, [&](int r) {
      double* to = scratch.data() + static_cast<std::size_t>(r) * row;
      std::fill_n(to, row, 0.0);
      const int at = d == 0 ? 0 : r / stride % n;
      for (int i = -reach; i <= reach; ++i) {
        if (d > 0 && (at + i < 0 || at + i >= n)) continue;
        const double weight = w[std::abs(i)];
        const double* from = values.data() + (static_cast<std::ptrdiff_t>(r) + (d == 0 ? 0 : i * stride)) * row;
        const int shift = d == 0 ? 2 * i : 0;
        const int first = std::max(0, -shift), last = std::min(row, row - shift);
        for (int q = first; q < last; ++q) to[q] += weight * from[q + shift];
      }
    });
    values.swap(scratch);
    if (d > 0) stride *= n;
  }
}

namespace {

/// The rows of a symmetric sparse matrix while it is summed up.
using Row = std::vector<std::pair<int, double>>;

void add(Row& row, int column, double value) {
  for (auto& entry : row) {
    if (entry.first != column) continue;
    entry.second += value;
    return;
  }
  row.push_back({column, value});
}

/// Adds the part of element e to L and M.
template <int Dim>
void add_element(const Mesh<Dim>& mesh, int e, double length, std::vector<Row>& L, std::vector<double>& M) {
  const auto n = mesh.element_nodes(e);
  const double time = std::max(0.0, length * length / 4 - shape_variance(mesh, e));
  with_cell(mesh, e, [&]<class Basis>(Basis, const auto& cell) {
    cell.for_gauss([&](const Vec<Dim>& local, double dV) {
      std::array<double, Basis::nodes> N;
      std::array<Vec<Dim>, Basis::nodes> B;
      cell.gradients(local, N, B);
      for (int i = 0; i < Basis::nodes; ++i) {
        M[n[i]] += N[i] * dV;
        for (int j = 0; j < Basis::nodes; ++j) {
          if (i == j) continue;
          double BB = 0;
          for (int d = 0; d < Dim; ++d) BB += B[i][d] * B[j][d];
          add(L[n[i]], n[j], time * BB * dV);
        }
      }
    });
  });
}

}  // namespace

template <int Dim>
MeshSmoothing<Dim>::MeshSmoothing(const Mesh<Dim>& mesh, double length) {
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  std::vector<Row> L(nodes);  // without its diagonal: its rows add up to nothing
  std::vector<double> M(nodes, 0.0);
  for (int e = 0; e < mesh.element_count(); ++e) add_element(mesh, e, length, L, M);
  // All eigenvalues of M⁻¹ L are at most the largest sum of magnitudes in a row (Gershgorin). A stage is stable up to
  // two over it; 5 % less damp what alternates from node to node.
  double largest = 0;
  for (std::size_t i = 0; i < nodes; ++i) {
    double diagonal = 0, others = 0;
    for (const auto& entry : L[i]) {
      diagonal -= entry.second;
      others += std::abs(entry.second);
    }
    if (M[i] > 0) largest = std::max(largest, (std::abs(diagonal) + others) / M[i]);
  }
  while (1.9 * (stages_ * stages_ + stages_) / 2 * steps < largest) ++stages_;
  const double stage = 2.0 / (stages_ * stages_ + stages_) / steps;
  begin_.push_back(0);
  for (std::size_t i = 0; i < nodes; ++i) {
    per_volume_.push_back(M[i] > 0 ? 1 / M[i] : 0.0);
    for (const auto& entry : L[i]) {
      column_.push_back(entry.first);
      share_.push_back(-entry.second * per_volume_.back() * stage);
    }
    begin_.push_back(static_cast<int>(column_.size()));
  }
}

template <int Dim>
void MeshSmoothing<Dim>::operator()(Column& values, Column& scratch) const {
  const int nodes = static_cast<int>(per_volume_.size());
  exec::for_each(nodes, [&](int i) {
    for (const int q : {2 * i, 2 * i + 1}) values[q] *= per_volume_[i];
  });
  // Y_j = μ_j (Y_{j−1} − stage M⁻¹ L Y_{j−1}) + (1 − μ_j) Y_{j−2}, μ_j = (2j − 1)/j
  const auto stage = [&](double mu) {
    exec::for_each(nodes, [&](int i) {
      const double a = values[2 * i], b = values[2 * i + 1];
      double da = 0, db = 0;
      for (int l = begin_[i]; l < begin_[i + 1]; ++l) {
        const int j = 2 * column_[l];
        da += share_[l] * (values[j] - a);
        db += share_[l] * (values[j + 1] - b);
      }
      scratch[2 * i] = mu * (a + da) + (1 - mu) * scratch[2 * i];
      scratch[2 * i + 1] = mu * (b + db) + (1 - mu) * scratch[2 * i + 1];
    });
    values.swap(scratch);
  };
  std::fill(scratch.begin(), scratch.end(), 0.0);
  for (int step = 0; step < steps; ++step) {
    for (int j = 1; j <= stages_; ++j) stage((2.0 * j - 1) / j);
  }
}

template double shape_variance<2>(const Mesh<2>&, int);
template double shape_variance<3>(const Mesh<3>&, int);
template class GridSmoothing<2>;
template class GridSmoothing<3>;
template class MeshSmoothing<2>;
template class MeshSmoothing<3>;

}  // namespace scarp::step
