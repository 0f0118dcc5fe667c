#include "ground.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <utility>

#include "scarp/mesh/build.hpp"
#include "scarp/mesh/grid.hpp"
#include "scarp/run/initial.hpp"

namespace scarp::bench {
namespace {

constexpr double density = 2.0;

/// Elements along each axis so that the soil has about this many points, `each` to an element.
template <int Dim>
int elements_along(int points, int each) {
  const auto count = [each](int n) { return each * std::pow(n - 4.0, Dim - 1) * (n - 2.0); };
  int n = 5;
  while (count(n + 1) <= points) ++n;
  return points - count(n) < count(n + 1) - points ? n : n + 1;
}

template <int Dim>
input::RegionInputOf<Dim> ground(int n, const AnyModel& model) {
  input::RegionInputOf<Dim> region;
  region.name = "ground";
  region.spacing = 0.5;
  const double low = 2, high = n - 2.0;
  if constexpr (Dim == 2) {
    region.polygon = {{low, 0}, {high, 0}, {high, high}, {low, high}};
    region.stress = {50, 100, 50, 0};
  } else {
    region.solid = make_box({low, low, 0}, {high, high, high});
    region.stress = {50, 50, 100, 0, 0, 0};
  }
  if (std::holds_alternative<Subloading>(model))
    region.initial = {{"R_b", 2.0}, {"OCR", 1.2}, {"a", 0.5}, {"beta", std::string("K0")}};
  return region;
}

Mesh<2> shaken(int n, ElementShape shape) {
  const double side = n;
  const Mesh<2> regular = make_grid({0, 0}, {side, side}, {n, n});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> move(-0.2, 0.2);
  Mesh<2> mesh;
  for (int i = 0; i < regular.node_count(); ++i) {
    Vec<2> x = regular.node(i);
    // The sides and the surface of the soil stay straight: its elements are full or empty.
    for (double& coordinate : x)
      if (coordinate > 2.5 && coordinate < side - 2.5) coordinate += move(random);
    mesh.lists.nodes.push_back(x);
  }
  mesh.lists.offsets.push_back(0);
  const auto add = [&](std::initializer_list<int> nodes) {
    mesh.lists.types.push_back(nodes.size() == 3 ? ElementType::T3 : ElementType::Q4);
    mesh.lists.connectivity.insert(mesh.lists.connectivity.end(), nodes);
    mesh.lists.offsets.push_back(static_cast<int>(mesh.lists.connectivity.size()));
  };
  for (int e = 0; e < regular.element_count(); ++e) {
    const auto c = regular.element_nodes(e);
    if (shape == ElementShape::quadrilaterals) {
      add({c[0], c[1], c[2], c[3]});
    } else if (random() % 2 == 0) {
      add({c[0], c[1], c[2]});
      add({c[0], c[2], c[3]});
    } else {
      add({c[0], c[1], c[3]});
      add({c[1], c[2], c[3]});
    }
  }
  complete(mesh);
  return mesh;
}

/// The places of an element's points, as weights of its corners.
std::vector<std::array<double, 4>> places(ElementType type) {
  constexpr double near = 0.75, far = 0.25, two_thirds = 2.0 / 3, sixth = 1.0 / 6;
  if (type == ElementType::T3)
    return {{two_thirds, sixth, sixth, 0}, {sixth, two_thirds, sixth, 0}, {sixth, sixth, two_thirds, 0}};
  std::vector<std::array<double, 4>> all;
  for (const auto& [x, y] : {std::pair{near, near}, {far, near}, {near, far}, {far, far}})
    all.push_back({x * y, (1 - x) * y, (1 - x) * (1 - y), x * (1 - y)});
  return all;
}

void add_point(Block<2>& block, int i, const Vec<2>& x, double volume) {
  auto& points = block.points;
  points.volume[i] = points.initial_volume[i] = volume;
  points.mass[i] = density * volume;
  points.id[i] = i;
  for (int j = 0; j < 2; ++j) points.x[j][i] = x[j];
}

/// Fills each element of the soil with its own points.
void fill_elements(const Mesh<2>& mesh, int n, Block<2>& block) {
  const double low = 2, high = n - 2.0;
  std::vector<std::pair<Vec<2>, double>> filling;
  for (int e = 0; e < mesh.element_count(); ++e) {
    const auto nodes = mesh.element_nodes(e);
    const auto all = places(mesh.type_of(e));
    bool soil = true;
    for (const int m : nodes) {
      const auto& x = mesh.node(m);
      soil = soil && x[0] >= low && x[0] <= high && x[1] <= high;
    }
    if (!soil) continue;
    for (const auto& weight : all) {
      Vec<2> x{};
      for (std::size_t k = 0; k < nodes.size(); ++k)
        for (int j = 0; j < 2; ++j) x[j] += weight[k] * mesh.node(nodes[k])[j];
      filling.push_back({x, element_area(mesh, e) / static_cast<double>(all.size())});
    }
  }
  resize(block, static_cast<int>(filling.size()));
  for (int i = 0; i < block.size(); ++i) add_point(block, i, filling[i].first, filling[i].second);
}

}  // namespace

template <int Dim>
input::CaseOf<Dim> grid_case(int points, const AnyModel& model) {
  const int n = elements_along<Dim>(points, 1 << Dim);
  input::CaseOf<Dim> input;
  typename input::MeshInputOf<Dim>::GridInput grid;
  grid.size.fill(n);
  grid.elements.fill(n);
  input.mesh.grid = grid;
  input.materials.push_back({"soil", model, density, {}, 0, {}});
  input.regions.push_back(ground<Dim>(n, model));
  input::BoundaryInput bottom;
  bottom.nodes = "bottom";
  bottom.fix_x = bottom.fix_y = true;
  bottom.fix_z = Dim == 3;
  input.boundaries.push_back(bottom);
  return input;
}

Body<2> mesh_body(int points, const AnyModel& model, ElementShape shape) {
  const int n = elements_along<2>(points, shape == ElementShape::triangles ? 6 : 4);
  Body<2> body(std::make_unique<const Mesh<2>>(shaken(n, shape)), input::Case::down(9.81));
  Block<2> block("ground", model);
  fill_elements(*body.mesh, n, block);
  run::set_initial_state<2>(block, ground<2>(n, model), Overburden({}, 9.81));
  body.fields[0].blocks.push_back(std::move(block));
  for (int j = 0; j < 2; ++j) fix(body.conditions, body.mesh->node_sets.at("bottom"), j);
  locate_points(body);
  return body;
}

template <int Dim>
void compress(Body<Dim>& body, double rate) {
  for (auto& block : body.blocks()) {
    auto& points = block.points;
    for (int i = 0; i < block.size(); ++i) points.v[Dim - 1][i] = -rate * points.x[Dim - 1][i];
  }
}

template input::CaseOf<2> grid_case<2>(int, const AnyModel&);
template input::CaseOf<3> grid_case<3>(int, const AnyModel&);
template void compress<2>(Body<2>&, double);
template void compress<3>(Body<3>&, double);

}  // namespace scarp::bench
