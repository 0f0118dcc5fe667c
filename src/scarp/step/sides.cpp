#include "scarp/step/sides.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "scarp/base/error.hpp"
#include "scarp/exec/stress_update.hpp"
#include "scarp/mesh/build.hpp"
#include "scarp/mesh/near.hpp"
#include "scarp/mesh/shapes.hpp"
#include "scarp/step/phases.hpp"
#include "scarp/transfer/node_values.hpp"

namespace scarp {
namespace {

/// A face of an element on the side.
template <int Dim>
struct Face {
  std::vector<int> nodes;
  int element, axis;  ///< the axis that it lies across
};

/// The axis across which the nodes lie, or -1.
template <int Dim>
int axis_of(const Mesh<Dim>& mesh, const std::vector<int>& nodes, double tolerance) {
  for (int j = 0; j < Dim; ++j) {
    bool flat = true;
    for (const int n : nodes) flat = flat && std::abs(mesh.node(n)[j] - mesh.node(nodes[0])[j]) <= tolerance;
    if (flat) return j;
  }
  return -1;
}

/// The faces of elements all of whose nodes are chosen.
template <int Dim>
std::vector<Face<Dim>> faces_on(const Mesh<Dim>& mesh, const std::vector<int>& nodes) {
  ZeroPages<char> chosen(mesh.node_count()), on_face(mesh.node_count());
  for (const int n : nodes) chosen[n] = 1;
  std::map<std::vector<int>, int> times;  // that a face is met, by its nodes in order
  std::vector<Face<Dim>> faces;
  for_elements_near(mesh, box_around(mesh, nodes), [&](int e) {
    const auto local = mesh.element_nodes(e);
    with_shape<Dim>(mesh.type_of(e), [&]<class Shape>(Shape) {
      for (const auto& side : Shape::sides) {
        std::vector<int> its;
        for (const int i : side) its.push_back(local[i]);
        if (!std::all_of(its.begin(), its.end(), [&](int n) { return chosen[n] != 0; })) continue;
        faces.push_back({its, e, axis_of<Dim>(mesh, its, 1e-9 * mesh.size_of(e))});
        std::sort(its.begin(), its.end());
        ++times[its];
        for (const int n : its) on_face[n] = 1;
      }
    });
  });
  for (const int n : nodes) {
    bool good = on_face[n] != 0;
    for (const auto& face : faces) {
      if (std::find(face.nodes.begin(), face.nodes.end(), n) == face.nodes.end()) continue;
      auto sorted = face.nodes;
      std::sort(sorted.begin(), sorted.end());
      good = good && face.axis >= 0 && times[sorted] == 1;
    }
    if (good) continue;
    throw InputError("an absorbing side lies on flat sides of the mesh, each across an axis",
                     fmt::format("the node at ({:g})", fmt::join(mesh.node(n), ", ")),
                     "name a side such as nodes = \"left\", or leave absorbing out");
  }
  return faces;
}

/// What the points of an element are together.
struct Content {
  double Omega = 0, mass = 0, M = 0, G = 0;  ///< moduli times Ω
  bool unknown = false;                      ///< the moduli, that is
};

template <int Dim>
ZeroPages<Content> contents(const Body<Dim>& body, const VelocityField<Dim>& field) {
  ZeroPages<Content> of_element(body.mesh->element_count());
  for (const auto& block : field.blocks) {
    const auto& points = block.points;
    for (const int i : block.order) {  // by id in each element
      auto& its = of_element[points.element[i]];
      its.Omega += points.volume[i];
      its.mass += points.mass[i];
      exec::with_state(block, i, [&](const auto& model, const auto& state) {
        const double M = model.p_wave_modulus(state);
        its.M += points.volume[i] * M;
        if constexpr (requires { model.parameters().nu; }) {
          const double nu = model.parameters().nu;
          its.G += points.volume[i] * M * (0.5 - nu) / (1 - nu);  // of isotropic elasticity
        } else {
          its.unknown = true;
        }
      });
    }
  }
  return of_element;
}

/// Volume of an element; per radian in a body of revolution.
template <int Dim>
double volume_of(const Mesh<Dim>& mesh, int e) {
  if constexpr (Dim == 3) {
    return element_volume(mesh, e);
  } else {
    if (!mesh.axisymmetric) return element_area(mesh, e);
    // r at the centroid of the triangles that the element is made of, exactly.
    const auto n = mesh.element_nodes(e);
    double volume = 0;
    for (std::size_t i = 1; i + 1 < n.size(); ++i) {
      const auto &a = mesh.node(n[0]), &b = mesh.node(n[i]), &c = mesh.node(n[i + 1]);
      volume += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) * (a[0] + b[0] + c[0]) / 3;
    }
    return volume;
  }
}

/// The part of a face's area that is its node i's: an equal one, of a triangle's edge in a body of revolution that of
/// ∫ N_i r.
template <int Dim>
double node_area(const Mesh<Dim>& mesh, const std::vector<int>& nodes, std::size_t i) {
  const auto& a = mesh.node(nodes[0]);
  const auto& b = mesh.node(nodes[1]);
  if constexpr (Dim == 2) {
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    const double r = mesh.axisymmetric ? (a[0] + b[0] + mesh.node(nodes[i])[0]) / 3 : 1.0;
    return 0.5 * length * r;
  } else {
    double area = 0;
    for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
      const auto &p = mesh.node(nodes[k]), &q = mesh.node(nodes[k + 1]);
      Vec<3> cross;
      for (int j = 0; j < 3; ++j) {
        const int s = (j + 1) % 3, t = (j + 2) % 3;
        cross[j] = (p[s] - a[s]) * (q[t] - a[t]) - (p[t] - a[t]) * (q[s] - a[s]);
      }
      area += 0.5 * std::sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
    }
    return area / static_cast<double>(nodes.size());
  }
}

/// The longest side of the box around all points [m].
template <int Dim>
double larger_side(const VelocityField<Dim>& field) {
  double longest = 0;
  for (int j = 0; j < Dim; ++j) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& block : field.blocks) {
      for (const double x : block.points.x[j]) {
        low = std::min(low, x);
        high = std::max(high, x);
      }
    }
    longest = std::max(longest, high - low);
  }
  return longest;
}

/// δ of a side, as given or as the larger side of the soil.
template <int Dim>
double thickness_of(const Body<Dim>& body, const VelocityField<Dim>& field, const AbsorbingSide& side,
                    const std::vector<Face<Dim>>& faces) {
  double h = 0;
  for (const auto& face : faces) h = std::max(h, body.mesh->size_of(face.element));
  if (!side.thickness) return std::max(larger_side(field), 5 * h);
  const double thickness = *side.thickness;
  if (thickness == 0 || thickness >= 5 * h) return thickness;
  throw InputError(
      "the soil beyond an absorbing side is at least five elements thick, or its spring would be too stiff",
      fmt::format("thickness = {:g} beside elements of {:.3g}", thickness, h),
      "enlarge thickness, or give 0 for no spring");
}

/// A wall would take what the side is to absorb, but only where soil presses against it.
template <int Dim>
void refuse_walls(const Body<Dim>& body, const std::vector<Face<Dim>>& faces) {
  for (const auto& face : faces) {
    for (const int n : face.nodes) {
      if (body.conditions.normal[n] != face.axis) continue;
      throw InputError("an absorbing side is no wall with friction",
                       fmt::format("a wall of friction = {:g} at the node at ({:g}) of the side",
                                   body.conditions.friction[n], fmt::join(body.mesh->node(n), ", ")),
                       "leave out the wall or absorbing on that side");
    }
  }
}

}  // namespace

template <int Dim>
Sides<Dim> soil_beyond(const Body<Dim>& body, const VelocityField<Dim>& field, const AbsorbingSide& side) {
  const auto& mesh = *body.mesh;
  if (mesh.grid && mesh.grid->functions != GridFunctions::linear)
    throw InputError("absorbing sides are there for linear shape functions only", "GIMP or B-splines",
                     "choose shape = \"linear\" in [method]");
  const auto faces = faces_on(mesh, side.nodes);
  refuse_walls(body, faces);
  const double thickness = thickness_of(body, field, side, faces);
  const auto content = contents(body, field);
  Sides<Dim> sides;
  sides.of_node.resize(mesh.node_count());
  for (const auto& face : faces) {
    const auto& its = content[face.element];
    if (!(its.Omega > 0)) continue;
    if (its.unknown && !side.impedance)
      throw InputError("the law of the soil at an absorbing side does not tell its shear modulus", "no impedance",
                       "give impedance = [Z_p, Z_s] of the soil beyond, density times wave speed");
    const double rho = its.mass / its.Omega;
    const double G = !its.unknown ? its.G : 0.25 * its.M;  // ν = 1/3, to compare with what is given
    const std::array Z_soil{std::sqrt(rho * its.M / its.Omega), std::sqrt(rho * G / its.Omega)};
    const auto Z_beyond = side.impedance.value_or(Z_soil);
    const double fill = std::min(1.0, its.Omega / volume_of(mesh, face.element));
    for (std::size_t i = 0; i < face.nodes.size(); ++i) {
      const int n = face.nodes[i];
      if (sides.of_node[n] < 0) {
        sides.of_node.set(n, static_cast<int>(sides.node.size()));
        sides.node.emplace_back();
      }
      auto& node = sides.node[sides.of_node[n]];
      const double area = fill * node_area(mesh, face.nodes, i);
      for (int j = 0; j < Dim; ++j) {
        const int wave = j == face.axis ? 0 : 1;
        const double Z = Z_beyond[wave];
        node.C[j] += Z * area;
        node.C_soil[j] += Z_soil[wave] * area;
        if (thickness > 0) node.k[j] += Z * Z / rho * area / thickness;
      }
    }
  }
  return sides;
}

namespace {

/// Puts what is beyond the side in the place of the conditions that are to let go of its nodes, and lists these.
template <int Dim>
void take_over(const Body<Dim>& body, VelocityField<Dim>& field, const Sides<Dim>& beyond,
               const Conditions<Dim>& others, std::vector<int>& taken) {
  auto& sides = field.outside.sides;
  if (!sides.active()) sides.of_node.resize(body.mesh->node_count());
  for (int k = 0; k < field.assembly.size(); ++k) {
    const int n = field.assembly.node(k);
    if (!beyond.holds(n)) continue;
    const auto sums = step::gathered_sums(field, k);
    if (sums.mass() < field.least_mass) continue;
    if (sides.of_node[n] < 0) {
      sides.of_node.set(n, static_cast<int>(sides.node.size()));
      sides.node.emplace_back();
    }
    auto& node = sides.node[sides.of_node[n]];
    const auto& its = beyond.node[beyond.of_node[n]];
    node.mass = sums.mass();
    for (int j = 0; j < Dim; ++j) {
      node.C[j] += its.C[j];
      node.C_soil[j] += its.C_soil[j];
      node.k[j] += its.k[j];
      const bool let_go = (body.conditions.fixed[n] & ~others.fixed[n] & (1u << j)) != 0;
      if (let_go) node.R[j] = sums.internal_force(j) - sums.mass() * body.gravity[j];
    }
    node.find_gamma();
    taken.push_back(n);
  }
}

}  // namespace

template <int Dim>
void open_side(Body<Dim>& body, const StepSettings& settings, const AbsorbingSide& side,
               const Conditions<Dim>& others) {
  std::vector<int> taken;
  for (auto& field : body.fields) {
    const auto beyond = soil_beyond(body, field, side);
    prepare_threads(field);
    step::map_points_to_elements(body, field, settings);
    take_over(body, field, beyond, others, taken);
  }
  for (const int n : taken) body.conditions.fixed[n] &= others.fixed[n];
}

template Sides<2> soil_beyond<2>(const Body<2>&, const VelocityField<2>&, const AbsorbingSide&);
template Sides<3> soil_beyond<3>(const Body<3>&, const VelocityField<3>&, const AbsorbingSide&);
template void open_side<2>(Body<2>&, const StepSettings&, const AbsorbingSide&, const Conditions<2>&);
template void open_side<3>(Body<3>&, const StepSettings&, const AbsorbingSide&, const Conditions<3>&);

}  // namespace scarp
