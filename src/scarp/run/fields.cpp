#include "scarp/run/fields.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "scarp/exec/parallel.hpp"
#include "scarp/exec/stress_update.hpp"

namespace scarp::run {
namespace {

/// A point of the body, by block and index, in the order of the points' numbers: frames then list points in the same
/// order whatever the arrangement in memory.
struct Slot {
  int block, index;
};

using Places = std::vector<Slot>;

template <int Dim>
Places places_of(const Body<Dim>& body) {
  constexpr int nowhere = -1;
  Places all(static_cast<std::size_t>(body.point_count()), {nowhere, 0});
  for (int b = 0; b < static_cast<int>(body.blocks().size()); ++b) {
    const auto& id = body.blocks()[b].points.id;
    for (std::size_t i = 0; i < id.size(); ++i) {
      const auto number = static_cast<std::size_t>(id[i]);
      if (number >= all.size()) all.resize(number + 1, {nowhere, 0});
      all[number] = {b, static_cast<int>(i)};
    }
  }
  std::erase_if(all, [](const Slot& at) { return at.block == nowhere; });  // of points that were taken out
  return all;
}

/// Collects fields over the points in order.
template <int Dim>
class Collector {
 public:
  explicit Collector(const Body<Dim>& body) : body_(body), places_(std::make_shared<const Places>(places_of(body))) {}

  std::size_t count() const { return places_->size(); }

  /// value(block number, i) → Value
  template <class Value, class F>
  void add(const std::string& name, F value) {
    fields_.push_back(field<Value>(name, 1, [value](int b, int i, int) { return value(b, i); }));
  }

  /// value(points, i) → double
  template <class F>
  void scalar(const std::string& name, F value) {
    add<double>(name, [this_body = &body_, value](int b, int i) { return value(this_body->blocks()[b].points, i); });
  }

  /// component(points, i, j) → double
  template <class F>
  io::Field vector(const std::string& name, F component) const {
    return field<double>(name, 3, [this_body = &body_, component](int b, int i, int j) {
      return j < Dim ? component(this_body->blocks()[b].points, i, j) : 0.0;
    });
  }

  /// An array of the points that is shown as it is (PointArray::shown).
  void shown(const std::string& key) {
    if (body_.blocks().empty()) return;
    Points<Dim>::each(body_.blocks()[0].points, [&]<class Member>(const PointArray& info, const Member&) {
      if (!info.shown || key != info.key) return;
      const auto of_block = members<Member>(key);
      if constexpr (std::is_same_v<Member, Column>) {
        add<double>(key, [of_block](int b, int i) { return (*of_block[b])[i]; });
      } else if constexpr (std::is_same_v<Member, std::array<Column, Dim>>) {
        add(field<double>(key, 3, [of_block](int b, int i, int j) { return j < Dim ? (*of_block[b])[j][i] : 0.0; }));
      } else if constexpr (!std::is_same_v<typename Member::value_type, Column>) {
        add<std::int32_t>(key, [of_block](int b, int i) { return (*of_block[b])[i]; });
      }
    });
  }

  void flag(const std::string& name, PointFlag bit) {
    add<std::uint8_t>(name, [this_body = &body_, bit](int b, int i) {
      return (this_body->blocks()[b].points.flags[i] & bit) ? 1 : 0;
    });
  }

  /// A symmetric tensor from Mandel components; component(block number, i, c) → double
  template <class F>
  void tensor(const std::string& name, F component) {
    fields_.push_back(field<double>(name, 6, [component](int b, int i, int c) {
      const double once = c < 3 ? 1.0 : 1.0 / sqrt2;
      return c < sym_size<Dim> ? once * component(b, i, c) : 0.0;
    }));
  }

  /// What the models of the blocks declare; a name that several models have becomes one field.
  void model_fields();

  /// κ̂ of soil that softens over a length, where there is some.
  void kappa_hat() {
    const auto blocks = body_.blocks();
    if (std::none_of(blocks.begin(), blocks.end(), [](const auto& block) { return block.length > 0; })) return;
    add<double>("kappa_hat", [body = &body_](int b, int i) {
      const auto& block = body->blocks()[b];
      return block.length > 0 ? block.state.end()[-2][i] : nothing;
    });
  }

  void add(io::Field&& field) { fields_.push_back(std::move(field)); }
  std::vector<io::Field> take() { return std::move(fields_); }

 private:
  static constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

  /// value(block number, i, component) → Value
  template <class Value, class F>
  io::Field field(const std::string& name, int components, F value) const {
    return {name, components,
            io::Copy<Value>([places = places_, components, value](std::size_t first, std::size_t last, Value* to) {
              for (std::size_t k = first; k < last; ++k) {
                const Slot at = (*places)[k];
                for (int c = 0; c < components; ++c) *to++ = static_cast<Value>(value(at.block, at.index, c));
              }
            })};
  }

  /// The array of this key of each block.
  template <class Member>
  std::vector<const Member*> members(const std::string& key) const {
    std::vector<const Member*> all;
    for (const auto& block : body_.blocks()) {
      Points<Dim>::each(block.points, [&]<class Other>(const PointArray& info, const Other& other) {
        if constexpr (std::is_same_v<Other, Member>) {
          if (key == info.key) all.push_back(&other);
        }
      });
    }
    return all;
  }

  void derived_fields(const std::map<std::string, std::vector<int>>& derived);

  const Body<Dim>& body_;
  std::shared_ptr<const Places> places_;
  std::vector<io::Field> fields_;
};

template <int Dim>
void Collector<Dim>::model_fields() {
  // For each declared name: where each block keeps it (column of the state), or -1.
  std::map<std::string, std::pair<FieldKind, std::vector<int>>> state;
  std::map<std::string, std::vector<int>> derived;
  const std::vector<int> nowhere(body_.blocks().size(), -1);
  for (std::size_t b = 0; b < body_.blocks().size(); ++b) {
    const auto description = description_of(body_.blocks()[b].model);
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
  for (const auto& [name, entry] : state) {
    const auto value = [body = &body_, columns = entry.second](int b, int i, int c) {
      return columns[b] < 0 ? nothing : body->blocks()[b].state[columns[b] + c][i];
    };
    if (entry.first == FieldKind::tensor) {
      tensor(name, value);
    } else {
      add<double>(name, [value](int b, int i) { return value(b, i, 0); });
    }
  }
  derived_fields(derived);
}

/// A point's derived quantities come all at once from its state: taken now, for all points. `derived` has for each name
/// its place among those of each block's model, or -1.
template <int Dim>
void Collector<Dim>::derived_fields(const std::map<std::string, std::vector<int>>& derived) {
  const std::size_t names = derived.size();
  const auto values = std::make_shared<std::vector<double>>(names * count(), nothing);
  exec::for_each(static_cast<int>(names > 0 ? count() : 0), [&](int k) {
    const Slot at = (*places_)[k];
    exec::with_state(body_.blocks()[at.block], at.index, [&](const auto& model, const auto& s) {
      const auto of_point = model.derived(s);
      double* to = values->data() + names * static_cast<std::size_t>(k);
      for (const auto& [name, index] : derived) {
        if (index[at.block] >= 0) *to = of_point[index[at.block]];
        ++to;
      }
    });
  });
  std::size_t number = 0;
  for (const auto& [name, index] : derived) {
    add({name, 1, io::Copy<double>([values, names, number](std::size_t first, std::size_t last, double* to) {
           for (std::size_t k = first; k < last; ++k) *to++ = (*values)[names * k + number];
         })});
    ++number;
  }
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
Frame frame_of(const Body<Dim>& body) {
  Collector<Dim> collect(body);
  const auto blocks = body.blocks();
  collect.shown("id");
  collect.template add<std::int32_t>("region", [](int b, int) { return b; });
  collect.add(collect.vector("displacement", [](const Points<Dim>& p, int i, int j) { return p.u(j, i); }));
  collect.shown("velocity");
  collect.tensor("stress", [=](int b, int i, int c) { return -blocks[b].points.sigma[c][i]; });
  collect.scalar("p", mean_stress<Dim>);
  collect.scalar("q", deviatoric_stress_of<Dim>);
  collect.scalar("eps_v", [](const Points<Dim>& p, int i) { return -std::log(p.volume[i] / p.initial_volume[i]); });
  collect.shown("eps_q");
  collect.shown("volume");
  collect.scalar("density", [](const Points<Dim>& p, int i) { return p.mass[i] / p.volume[i]; });  // eq. 15
  collect.model_fields();
  collect.kappa_hat();
  collect.shown("substeps");
  collect.flag("separated", flag_separated);
  collect.flag("on_floor", flag_on_floor);
  collect.flag("corrected", flag_corrected);
  collect.flag("failed", flag_failed);
  auto positions = collect.vector("Points", [](const Points<Dim>& p, int i, int j) { return p.x[j][i]; });
  return {collect.count(), std::move(positions), collect.take()};
}

template Frame frame_of<2>(const Body<2>&);
template Frame frame_of<3>(const Body<3>&);

}  // namespace scarp::run
