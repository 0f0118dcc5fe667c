#include "scarp/step/step.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "scarp/base/error.hpp"

namespace scarp {
namespace {

constexpr int node_chunk = 256, point_chunk = 1024;

struct Nothing {
  Nothing& operator+=(const Nothing&) { return *this; }
};

/// Numbers that are summed together.
template <std::size_t N>
struct Tally {
  std::array<double, N> sum{};
  Tally& operator+=(const Tally& other) {
    for (std::size_t i = 0; i < N; ++i) sum[i] += other.sum[i];
    return *this;
  }
};

template <int Dim>
transfer::Range points_of(const Block<Dim>& block, int slot) {
  return {block.order.data() + block.begin[slot], block.begin[slot + 1] - block.begin[slot]};
}

/// Is the element inside the soil, so that it is full? Then all elements around it hold points.
bool inside_the_soil(const Body<2>& body, int e) {
  for (const int neighbour : body.mesh->elements_around(e)) {
    if (body.active.slot[neighbour] < 0) return false;
  }
  return true;
}

template <class Shape>
transfer::Quadrature quadrature_of(const Body<2>& body, const NodePositions<Shape>& x_i, int slot) {
  transfer::PointIntegrals<Shape> sums;
  for (const auto& block : body.blocks) transfer::add_points<Shape>(x_i, block.points, points_of(block, slot), sums);
  return transfer::full_element<Shape>(x_i, sums);
}

/// Step 1: every element adds up mass, momentum and internal force for its own local nodes from its own points.
void map_points_to_elements(Body<2>& body, Quadrature choice) {
  exec::sweep_elements<Nothing>(*body.mesh, body.active, [&]<class Shape>(Shape, int slot, int e) {
    const auto x_i = node_positions<Shape>(*body.mesh, e);
    auto& quadrature = body.quadrature[slot];
    const bool corrected = choice == Quadrature::corrected && inside_the_soil(body, e);
    quadrature = corrected ? quadrature_of<Shape>(body, x_i, slot) : transfer::Quadrature{};
    std::array<transfer::NodeSums<2>, Shape::nodes> sums{};
    for (auto& block : body.blocks)
      transfer::points_to_nodes<Shape>(x_i, quadrature, block.points, points_of(block, slot), sums);
    std::copy(sums.begin(), sums.end(), body.sums[slot].begin());
    return Nothing{};
  });
}

/// Step 2: what a node receives from the elements around it.
transfer::NodeSums<2> assembled(const Body<2>& body, int n) {
  transfer::NodeSums<2> sum;
  exec::gather(body.incidence, body.active, n, [&](int slot, int i) {
    const auto& part = body.sums[slot][i];
    sum.m += part.m;
    for (int j = 0; j < 2; ++j) {
      sum.p[j] += part.p[j];
      sum.F_int[j] += part.F_int[j];
    }
  });
  return sum;
}

/// Step 3: a_n = (F_grav − F_int) / m_n (eq. 5) with local damping against the motion, and the conditions.
Node<2> accelerated(const Body<2>& body, int n, const transfer::NodeSums<2>& sum, double dt, double damping) {
  Node<2> node;
  node.m = sum.m;
  for (int j = 0; j < 2; ++j) {
    const double F = sum.m * body.gravity[j] - sum.F_int[j];
    node.v[j] = sum.p[j] / sum.m;
    node.F_damping[j] = node.v[j] == 0 ? 0 : -std::copysign(damping * std::abs(F), node.v[j]);
    node.a[j] = (F + node.F_damping[j]) / sum.m;
  }
  const auto reaction = constrain_acceleration<2>(body.conditions, n, node.m, node.v, dt, node.a);
  node.F_friction = reaction.friction;
  node.held = reaction.held;
  for (int j = 0; j < 2; ++j) {
    if (node.held & (1u << j)) node.F_damping[j] = 0;
  }
  return node;
}

/// Steps 2 and 3 for all active nodes.
void accelerate_nodes(Body<2>& body, double dt, const StepSettings& settings, StepBooks<2>& books) {
  const int count = static_cast<int>(body.nodes.size());
  const auto forces = exec::sum_over_chunks<Tally<2>>(count, node_chunk, [&](int first, int last) {
    Tally<2> tally;
    for (int k = first; k < last; ++k) {
      const int n = body.nodes[k];
      const auto sum = assembled(body, n);
      Node<2>& node = body.node[n];
      node = sum.m < body.least_mass ? Node<2>{} : accelerated(body, n, sum, dt, settings.damping);
      for (int j = 0; j < 2; ++j) {
        if (!(node.held & (1u << j))) tally.sum[0] += std::abs(node.m * node.a[j] - node.F_damping[j]);
        tally.sum[1] += std::abs(node.m * body.gravity[j]);
      }
    }
    return tally;
  });
  books.unbalanced_force = forces.sum[0];
  books.weight = forces.sum[1];
}

/// Steps 4 and 5: velocities of the points, then their momentum again for the local nodes.
void update_velocities(Body<2>& body, double dt, const StepSettings& settings, StepBooks<2>& books) {
  const auto taken = exec::sweep_elements<Tally<1>>(*body.mesh, body.active, [&]<class Shape>(Shape, int slot, int e) {
    const auto n = body.mesh->element_nodes(e);
    std::array<transfer::NodeMotion<2>, Shape::nodes> motion;
    for (int i = 0; i < Shape::nodes; ++i) {
      const Node<2>& node = body.node[n[i]];
      motion[i] = {node.a, {node.v[0] + node.a[0] * dt, node.v[1] + node.a[1] * dt}};
      constrain_velocity<2>(body.conditions, n[i], node.held, motion[i].v);
    }
    std::array<Vec<2>, Shape::nodes> momentum{};
    Tally<1> pic;
    for (auto& block : body.blocks) {
      pic.sum[0] +=
          transfer::update_velocities<Shape>(motion, dt, settings.flip, block.points, points_of(block, slot), momentum);
    }
    std::copy(momentum.begin(), momentum.end(), body.momentum[slot].begin());
    return pic;
  });
  books.dissipation_pic = taken.sum[0];
}

/// Step 5, end: v_n^{t+dt} = p_n / m_n (eq. 8) with the conditions. Forces at nodes work on ½ (v^t + v^{t+dt}): with
/// that the change of the points' kinetic energy is theirs to the last bit.
void velocities_of_nodes(Body<2>& body, double dt, StepBooks<2>& books) {
  const auto work =
      exec::sum_over_chunks<Tally<2>>(static_cast<int>(body.nodes.size()), node_chunk, [&](int first, int last) {
        Tally<2> tally;
        for (int k = first; k < last; ++k) {
          const int n = body.nodes[k];
          Node<2>& node = body.node[n];
          if (node.m < body.least_mass) continue;
          Vec<2> p{};
          exec::gather(body.incidence, body.active, n, [&](int slot, int i) {
            for (int j = 0; j < 2; ++j) p[j] += body.momentum[slot][i][j];
          });
          for (int j = 0; j < 2; ++j) {
            const double v = p[j] / node.m, path = 0.5 * (node.v[j] + v) * dt;
            tally.sum[0] -= node.F_damping[j] * path;
            tally.sum[1] -= node.F_friction[j] * path;
            node.v[j] = v;
          }
          constrain_velocity<2>(body.conditions, n, node.held, node.v);
        }
        return tally;
      });
  books.dissipation_damping = work.sum[0];
  books.dissipation_friction = work.sum[1];
}

/// Steps 6, 8, 9 and 10: strain and spin increments, volumes, displacements and positions of the points.
void strain_and_move(Body<2>& body, double dt, StepBooks<2>& books) {
  const auto moved = exec::sweep_elements<Tally<2>>(*body.mesh, body.active, [&]<class Shape>(Shape, int slot, int e) {
    const auto x_i = node_positions<Shape>(*body.mesh, e);
    const auto n = body.mesh->element_nodes(e);
    std::array<Vec<2>, Shape::nodes> v_i;
    for (int i = 0; i < Shape::nodes; ++i) v_i[i] = body.node[n[i]].v;
    Tally<2> sum;
    for (auto& block : body.blocks) {
      const auto part =
          transfer::nodes_to_points<Shape>(x_i, body.quadrature[slot], v_i, dt, block.points, points_of(block, slot));
      for (int j = 0; j < 2; ++j) sum.sum[j] += part[j];
    }
    return sum;
  });
  for (int j = 0; j < 2; ++j) books.work_gravity += body.gravity[j] * moved.sum[j];
}

/// Step 11 for the points of one block.
struct Found {
  SearchCounts counts;
  std::int64_t changed = 0;
  int lost = -1;  ///< first point outside the mesh

  Found& operator+=(const Found& other) {
    counts += other.counts;
    changed += other.changed;
    if (lost < 0) lost = other.lost;
    return *this;
  }
};

Found find_elements(const Locator<2>& locator, Points<2>& points) {
  return exec::sum_over_chunks<Found>(points.size(), point_chunk, [&](int first, int last) {
    Found found;
    for (int i = first; i < last; ++i) {
      const auto place = locator.find({points.x[0][i], points.x[1][i]}, points.element[i], found.counts);
      if (place.element < 0 && found.lost < 0) found.lost = i;
      found.changed += place.element != points.element[i];
      points.element[i] = place.element;
      for (int j = 0; j < 2; ++j) points.xi[j][i] = place.xi[j];
    }
    return found;
  });
}

void remove_lost(Block<2>& block, StepBooks<2>& books) {
  const auto& points = block.points;
  std::vector<std::uint8_t> gone(points.element.size());
  for (int i = 0; i < block.size(); ++i) {
    gone[i] = points.element[i] < 0;
    if (!gone[i]) continue;
    ++books.removed;
    books.removed_mass += points.mass[i];
    books.removed_energy += 0.5 * points.mass[i] * (points.v[0][i] * points.v[0][i] + points.v[1][i] * points.v[1][i]);
  }
  remove_points(block, gone);
}

/// Step 11: the new element of every point; points are put in order again when enough of them have moved.
void find_new_elements(Body<2>& body, const StepSettings& settings, StepBooks<2>& books) {
  std::int64_t changed = 0;
  for (auto& block : body.blocks) {
    const auto found = find_elements(body.locator, block.points);
    books.search += found.counts;
    changed += found.changed;
    if (found.lost < 0) continue;
    const auto& points = block.points;
    if (!settings.remove_leaving) {
      throw RunError(fmt::format("point {} of region \"{}\" has left the mesh", points.id[found.lost], block.name),
                     fmt::format("({:.6g}, {:.6g}), with velocity ({:.4g}, {:.4g})", points.x[0][found.lost],
                                 points.x[1][found.lost], points.v[0][found.lost], points.v[1][found.lost]),
                     "extend the mesh, or let such points be removed with leaving = \"remove\" in [method]");
    }
    remove_lost(block, books);
  }
  if (changed == 0) return;
  body.out_of_place += static_cast<int>(changed);
  reorder(body);
  // Sweeps by element reach out of order for these points; a tenth of them is where putting all in order again pays.
  if (10 * static_cast<std::int64_t>(body.out_of_place) > body.point_count()) {
    arrange_in_order(body.blocks);
    body.out_of_place = 0;
  }
}

}  // namespace

template <>
void book_motion<2>(const Body<2>& body, StepBooks<2>& books) {
  Tally<4> total;
  double fastest2 = 0;
  for (const auto& block : body.blocks) {
    const auto& points = block.points;
    struct Motion : Tally<4> {
      double fastest2 = 0;
      Motion& operator+=(const Motion& other) {
        Tally<4>::operator+=(other);
        fastest2 = std::max(fastest2, other.fastest2);
        return *this;
      }
    };
    const auto motion = exec::sum_over_chunks<Motion>(points.size(), point_chunk, [&](int first, int last) {
      Motion part;
      for (int i = first; i < last; ++i) {
        const double m = points.mass[i], v_x = points.v[0][i], v_y = points.v[1][i], v2 = v_x * v_x + v_y * v_y;
        part.sum[0] += m;
        part.sum[1] += m * v_x;
        part.sum[2] += m * v_y;
        part.sum[3] += 0.5 * m * v2;
        part.fastest2 = std::max(part.fastest2, v2);
      }
      return part;
    });
    total += motion;
    fastest2 = std::max(fastest2, motion.fastest2);
  }
  books.mass = total.sum[0];
  books.momentum = {total.sum[1], total.sum[2]};
  books.kinetic_energy = total.sum[3];
  books.max_velocity = std::sqrt(fastest2);
}

template <>
StepBooks<2> advance<2>(Body<2>& body, double dt, const StepSettings& settings) {
  StepBooks<2> books;
  map_points_to_elements(body, settings.quadrature);  // step 1, eqs 1–4
  accelerate_nodes(body, dt, settings, books);        // steps 2 and 3, eq. 5
  update_velocities(body, dt, settings, books);       // steps 4 and 5, eqs 6 and 7
  velocities_of_nodes(body, dt, books);               // step 5, eq. 8
  strain_and_move(body, dt, books);                   // steps 6, 8, 9 and 10, eqs 9–11 and 14–19
  for (auto& block : body.blocks) {                   // step 7, eqs 12, 13 and section 3
    books.stress += exec::update_stresses(block, dt, body.mesh->size, settings.integration);
  }
  books.work_stress = books.stress.work;
  find_new_elements(body, settings, books);  // step 11
  book_motion(body, books);
  return books;
}

template <>
double critical_time_step<2>(const Body<2>& body) {
  double dt = std::numeric_limits<double>::infinity();
  for (const auto& block : body.blocks) dt = std::min(dt, exec::critical_time_step(block, body.mesh->size));
  return dt;
}

}  // namespace scarp
