#include "scarp/run/fields.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

#include "scarp/exec/stress_update.hpp"

namespace scarp::run {
namespace {

/// A point of the body, by block and index, in the order of the points' numbers: frames then list points in the same
/// order whatever the arrangement in memory.
struct Slot {
  int block, index;
};

template <int Dim>
std::vector<Slot> slots(const Body<Dim>& body) {
  std::vector<Slot> all;
  for (int b = 0; b < static_cast<int>(body.blocks.size()); ++b) {
    for (int i = 0; i < body.blocks[b].size(); ++i) all.push_back({b, i});
  }
  std::sort(all.begin(), all.end(), [&](const Slot& x, const Slot& y) {
    return body.blocks[x.block].points.id[x.index] < body.blocks[y.block].points.id[y.index];
  });
  return all;
}

/// Collects fields over the points in order.
template <int Dim>
class Collector {
 public:
  explicit Collector(const Body<Dim>& body) : body_(body), places_(slots(body)) {}

  /// value(points, i) → double
  template <class F>
  void scalar(const std::string& name, F&& value) {
    std::vector<double> data;
    data.reserve(places_.size());
    for (const auto& at : places_) data.push_back(value(body_.blocks[at.block].points, at.index));
    fields_.push_back({name, 1, std::move(data)});
  }

  /// component(points, i, j) → double
  template <class F>
  void vector(const std::string& name, F&& component) {
    std::vector<double> data;
    data.reserve(3 * places_.size());
    for (const auto& at : places_) {
      const auto& points = body_.blocks[at.block].points;
      for (int j = 0; j < 3; ++j) data.push_back(j < Dim ? component(points, at.index, j) : 0.0);
    }
    fields_.push_back({name, 3, std::move(data)});
  }

  void flag(const std::string& name, PointFlag bit) {
    std::vector<std::uint8_t> data;
    for (const auto& at : places_) data.push_back((body_.blocks[at.block].points.flags[at.index] & bit) ? 1 : 0);
    fields_.push_back({name, 1, std::move(data)});
  }

  /// value(block, i) → int
  template <class F>
  void integer(const std::string& name, F&& value) {
    std::vector<std::int32_t> data;
    for (const auto& at : places_) data.push_back(value(at.block, at.index));
    fields_.push_back({name, 1, std::move(data)});
  }

  /// A symmetric tensor from Mandel components; component(block, i, c) → double
  template <class F>
  void tensor(const std::string& name, F&& component) {
    std::vector<double> data;
    data.reserve(6 * places_.size());
    for (const auto& at : places_) {
      const Block<Dim>& block = body_.blocks[at.block];
      for (int c = 0; c < 6; ++c) {
        const double once = c < 3 ? 1.0 : 1.0 / sqrt2;
        data.push_back(c < sym_size<Dim> ? once * component(block, at.index, c) : 0.0);
      }
    }
    fields_.push_back({name, 6, std::move(data)});
  }

  /// What the models of the blocks declare; a name that several models have becomes one field.
  void model_fields();

  std::vector<io::Field> take() { return std::move(fields_); }

 private:
  static constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

  const Body<Dim>& body_;
  std::vector<Slot> places_;
  std::vector<io::Field> fields_;
};

template <int Dim>
void Collector<Dim>::model_fields() {
  // For each declared name: where each block keeps it (column of the state), or -1.
  std::map<std::string, std::pair<FieldKind, std::vector<int>>> state;
  std::map<std::string, std::vector<int>> derived;
  const std::vector<int> nowhere(body_.blocks.size(), -1);
  for (std::size_t b = 0; b < body_.blocks.size(); ++b) {
    const auto description = description_of(body_.blocks[b].model);
    int column = 0;
    for (const auto& info : description.state) {
      auto& entry = state.try_emplace(info.key, info.kind, nowhere).first->second;
      entry.second[b] = column;
      column += info.kind == FieldKind::tensor ? sym_size<Dim> : 1;
    }
    for (std::size_t k = 0; k < description.derived.size(); ++k) {
      derived.try_emplace(description.derived[k].key, nowhere).first->second[b] = static_cast<int>(k);
    }
  }
  auto column_of = [&](const std::vector<int>& columns, const Block<Dim>& block) {
    return columns[&block - body_.blocks.data()];
  };
  for (const auto& [name, entry] : state) {
    const auto& columns = entry.second;
    if (entry.first == FieldKind::tensor) {
      tensor(name, [&](const Block<Dim>& block, int i, int c) {
        const int first = column_of(columns, block);
        return first < 0 ? nothing : block.state[first + c][i];
      });
    } else {
      std::vector<double> data;
      for (const auto& at : places_) {
        data.push_back(columns[at.block] < 0 ? nothing : body_.blocks[at.block].state[columns[at.block]][at.index]);
      }
      fields_.push_back({name, 1, std::move(data)});
    }
  }
  std::map<std::string, std::vector<double>> values;
  for (const auto& at : places_) {
    exec::with_state(body_.blocks[at.block], at.index, [&](const auto& model, const auto& s) {
      const auto of_point = model.derived(s);
      for (const auto& [name, index] : derived) {
        values[name].push_back(index[at.block] < 0 ? nothing : of_point[index[at.block]]);
      }
    });
  }
  for (auto& [name, data] : values) fields_.push_back({name, 1, std::move(data)});
}

template <int Dim>
double mean_stress(const Points<Dim>& points, int i) {
  return -(points.sigma[0][i] + points.sigma[1][i] + points.sigma[2][i]) / 3;
}

template <int Dim>
double deviatoric_stress_of(const Points<Dim>& points, int i) {
  Sym<double, sym_size<Dim>> sigma;
  for (int c = 0; c < sym_size<Dim>; ++c) sigma[c] = points.sigma[c][i];
  return deviatoric_stress(sigma);
}

}  // namespace

template <int Dim>
std::vector<double> frame_positions(const Body<Dim>& body) {
  std::vector<double> positions;
  for (const auto& at : slots(body)) {
    const auto& points = body.blocks[at.block].points;
    for (int j = 0; j < 3; ++j) positions.push_back(j < Dim ? points.x[j][at.index] : 0.0);
  }
  return positions;
}

template <int Dim>
std::vector<io::Field> frame_fields(const Body<Dim>& body) {
  Collector<Dim> collect(body);
  collect.integer("id", [&](int b, int i) { return body.blocks[b].points.id[i]; });
  collect.integer("region", [](int b, int) { return b; });
  collect.vector("displacement", [](const Points<Dim>& p, int i, int j) { return p.u(j, i); });
  collect.vector("velocity", [](const Points<Dim>& p, int i, int j) { return p.v[j][i]; });
  collect.tensor("stress", [](const Block<Dim>& block, int i, int c) { return -block.points.sigma[c][i]; });
  collect.scalar("p", mean_stress<Dim>);
  collect.scalar("q", deviatoric_stress_of<Dim>);
  collect.scalar("eps_v", [](const Points<Dim>& p, int i) { return -std::log(p.volume[i] / p.initial_volume[i]); });
  collect.scalar("eps_q", [](const Points<Dim>& p, int i) { return p.eps_q[i]; });
  collect.scalar("volume", [](const Points<Dim>& p, int i) { return p.volume[i]; });
  collect.scalar("density", [](const Points<Dim>& p, int i) { return p.mass[i] / p.volume[i]; });
  collect.model_fields();
  collect.integer("substeps", [&](int b, int i) { return static_cast<int>(body.blocks[b].points.substeps[i]); });
  collect.flag("separated", flag_separated);
  collect.flag("on_floor", flag_on_floor);
  collect.flag("corrected", flag_corrected);
  collect.flag("failed", flag_failed);
  return collect.take();
}

template std::vector<double> frame_positions<2>(const Body<2>&);
template std::vector<double> frame_positions<3>(const Body<3>&);
template std::vector<io::Field> frame_fields<2>(const Body<2>&);
template std::vector<io::Field> frame_fields<3>(const Body<3>&);

}  // namespace scarp::run
