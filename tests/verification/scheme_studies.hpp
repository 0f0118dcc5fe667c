// The part of `make validate` that sets the schemes of the step side by side: schemes.csv.
#pragma once

#include <fstream>
#include <functional>
#include <string>

#include "discs.hpp"
#include "flying_block.hpp"
#include "roughness.hpp"
#include "vortex.hpp"

namespace scarp::verification {

class SchemeStudies {
 public:
  explicit SchemeStudies(const std::string& folder) : file_(folder + "/schemes.csv") {
    file_ << "problem,scheme,n,quantity,value\n";
  }

  void all() {
    auto schemes = all_schemes();
    Scheme some = undamped(two_term_scheme());
    some.damping.share = 0.01;
    schemes.push_back({"two-term, waves damped by 0.01", some});
    schemes.push_back({"two-term, standard", two_term_scheme()});
    Scheme bare = undamped(two_term_scheme());
    bare.mean_dilatation = false;
    bare.lateness = 0;
    schemes.push_back({"two-term, no mean dilatation, not late", bare});
    for (const auto& its : schemes) {
      std::printf("%s\n", its.name);
      std::fflush(stdout);
      turning(its);
      colliding(its);
      vortex(its);
      block(its);
      rough(its);
      rest(its);
    }
  }

 private:
  /// f() or, where it breaks down, nothing.
  void attempt(const NamedScheme& its, const char* problem, int n, const std::function<void()>& f) {
    try {
      f();
    } catch (const std::exception& lost) {
      std::printf("  %s, n = %d, broke down: %s\n", problem, n, lost.what());
      row(its, problem, n, "broke down", 1);
    }
  }
  void row(const NamedScheme& its, const std::string& problem, int n, const char* quantity, double value) {
    char number[32];
    std::snprintf(number, sizeof number, "%.6e", value);
    file_ << '"' << problem << "\",\"" << its.name << "\"," << n << ',' << quantity << ',' << number << std::endl;
  }
  static Method with(const NamedScheme& its) {
    Method method;
    method.scheme = its.scheme;
    return method;
  }

  void energies(const NamedScheme& its, const char* problem, int n, const DiscRun& run) {
    double low = 1, high = 1;
    const double start = run.history.front().kinetic;
    for (const auto& at : run.history) {
      low = std::min(low, (at.kinetic + at.stored) / start);
      high = std::max(high, (at.kinetic + at.stored) / start);
    }
    row(its, problem, n, "lowest energy", low);
    row(its, problem, n, "highest energy", high);
    row(its, problem, n, "kinetic energy at the end", run.history.back().kinetic / start);
  }
  void turning(const NamedScheme& its) {
    for (const int n : {20, 40, 80}) {
      attempt(its, "turning disc", n, [&] {
        const auto run = turn_disc(n, with(its));
        row(its, "turning disc", n, "angular momentum kept",
            run.history.back().angular_momentum / run.history.front().angular_momentum);
        energies(its, "turning disc", n, run);
      });
    }
  }
  void colliding(const NamedScheme& its) {
    attempt(its, "colliding discs", 20, [&] { energies(its, "colliding discs", 20, collide(20, with(its))); });
  }
  void vortex(const NamedScheme& its) {
    const char* problem = "vortex, A = 1, 4 x 4 points";
    for (const int n : {20, 40, 80}) {
      attempt(its, problem, n, [&] {
        const auto errors = follow_vortex(1, n, 4, with(its));
        row(its, problem, n, "error of displacement", errors.displacement);
        row(its, problem, n, "error of stress", errors.stress);
      });
    }
  }
  void block(const NamedScheme& its) { row(its, "flying block", 4, "spin kept", fly(its.scheme).spin); }
  void rough(const NamedScheme& its) {
    for (const double h : {0.5, 0.25}) {
      const int n = static_cast<int>(12 / h);
      row(its, "slope, points in step", n, "roughness of p", roughness_at_rest(its.scheme, Cells::grid, h, h / 2));
      row(its, "slope, points out of step", n, "roughness of p",
          roughness_at_rest(its.scheme, Cells::grid, h, 0.4 * h));
    }
  }
  void rest(const NamedScheme& its) {
    constexpr int steps = 100000;
    for (const double spacing : {0.3, 0.37}) {
      for (const auto shape : all_shapes) {
        for (const auto cells : {Cells::grid, Cells::quads, Cells::triangles, Cells::mixed}) {
          if (cells != Cells::grid && shape != GridFunctions::linear) continue;
          char problem[96];
          std::snprintf(problem, sizeof problem, "ground at rest, %s, %s, points %g m apart", name_of(cells).c_str(),
                        name_of(shape).c_str(), spacing);
          attempt(its, problem, steps, [&] {
            auto body = ground<2>(cut_up(make_grid({0, 0}, {4, 2.5}, {8, 5}, shape), cells), {spacing, 2});
            const auto found = keep_at_rest(body, its.scheme, steps, 0.5);
            row(its, problem, steps, "kinetic energy of the first tenth", found.first);
            row(its, problem, steps, "growth", found.growth());
          });
        }
      }
    }
  }

  std::ofstream file_;
};

}  // namespace scarp::verification
