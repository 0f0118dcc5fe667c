// The studies of `make validate`: the verification problems on more meshes and with all shape functions, minutes
// instead of seconds. Writes errors.csv, discs.csv and schemes.csv into a folder; tools/figures/validate.py draws them
// and prints the tables of docs/verification.md.
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "biaxial.hpp"
#include "column.hpp"
#include "discs.hpp"
#include "manufactured.hpp"
#include "scarp/exec/parallel.hpp"
#include "scheme_studies.hpp"
#include "vortex.hpp"

namespace scarp::verification {
namespace {

class Studies {
 public:
  explicit Studies(const std::string& folder) : errors_(folder + "/errors.csv"), discs_(folder + "/discs.csv") {
    errors_ << "problem,shape,quadrature,per_cell,n,quantity,value\n";
    discs_ << "problem,shape,quadrature,flip,n,t,kinetic,stored,angular_momentum,momentum\n";
  }

  /// Softening with and without an internal length: curves, and the plastic strain at the end.
  static void biaxial(const std::string& folder) {
    std::ofstream curves(folder + "/biaxial.csv"), points(folder + "/biaxial_points.csv");
    curves << "length,n,strain,q,band\n";
    points << "length,n,x,y,plastic\n";
    char numbers[120];
    for (const double length : {0.0, 0.1}) {
      for (const int n : {10, 20, 30}) {
        std::printf("biaxial test, length %g, %d elements\n", length, n);
        std::fflush(stdout);
        Biaxial test(n, length);
        for (int k = 1; k <= 40; ++k) {
          test.compress(0.002 * k);
          std::snprintf(numbers, sizeof numbers, "%g,%d,%.4f,%.4f,%.4f\n", length, n, test.strain(), test.q(),
                        test.band());
          curves << numbers;
        }
        for (int i = 0; i < test.clay().size(); ++i) {
          std::snprintf(numbers, sizeof numbers, "%g,%d,%.5f,%.5f,%.5f\n", length, n, test.clay().x[0][i],
                        test.clay().x[1][i], test.plastic(i));
          points << numbers;
        }
      }
    }
  }

  void manufactured(const Method& method) {
    for (const Case& c :
         {Case{"manufactured, small strain", 2e-4, 2, 128}, Case{"manufactured, large strain", 0.1, 2, 64},
          Case{"manufactured, large strain", 0.1, 3, 64}, Case{"manufactured, large strain", 0.1, 4, 64}}) {
      for (int n = 8; n <= c.finest; n *= 2) {
        driven(c.name, method, c.per_cell, n, [&] { return follow_manufactured(c.A, n, c.per_cell, method); });
      }
    }
  }

  void vortex(const Method& method) {
    for (const Case& c :
         {Case{"vortex, A = 0.1", 0.1, 3, 80}, Case{"vortex, A = 1", 1, 3, 80}, Case{"vortex, A = 1", 1, 4, 160}}) {
      for (int n = 20; n <= c.finest; n *= 2) {
        driven(c.name, method, c.per_cell, n, [&] { return follow_vortex(c.A, n, c.per_cell, method); });
      }
    }
    for (int n = 20; n <= 80; n *= 2) {
      driven("vortex, A = 1, half the time step", method, 4, n, [&] { return follow_vortex(1, n, 4, method, 0.2); });
    }
  }

  void column(const Method& method) {
    for (int n = 4; n <= 64; n *= 2) {
      for (const bool rest : {true, false}) {
        const char* problem = rest ? "column at rest" : "column, sudden weight";
        WeightColumn column(n, 2, method);
        const auto e = rest ? column.rest() : column.fall();
        row(problem, method, 2, n, "displacement", e.displacement);
        row(problem, method, 2, n, "stress", e.stress);
        row(problem, method, 2, n, "inner stress", e.inner_stress);
        row(problem, method, 2, n, "top", e.top);
        row(problem, method, 2, n, "base", e.base);
        row(problem, method, 2, n, "unbalanced", e.unbalanced);
      }
    }
  }

  void discs(Method method) {
    for (const double flip : {1.0, 0.99, 0.9, 0.0}) {
      method.scheme = report_scheme(flip);
      history("colliding discs", method, 20, collide(20, method));
      history("turning disc", method, 20, turn_disc(20, method));
    }
    method.scheme = report_scheme();
    for (const int n : {40, 80}) history("turning disc", method, n, turn_disc(n, method));
  }

 private:
  struct Case {
    const char* name;
    double A;
    int per_cell, finest;
  };

  /// Errors of a run; nan where it broke down.
  void driven(const char* problem, const Method& method, int per_cell, int n,
              const std::function<DrivenErrors()>& run) {
    DrivenErrors errors{std::nan(""), std::nan("")};
    try {
      errors = run();
    } catch (const std::exception& lost) {
      std::printf("  %s, n = %d, %d x %d points, broke down: %s\n", problem, n, per_cell, per_cell, lost.what());
    }
    row(problem, method, per_cell, n, "displacement", errors.displacement);
    row(problem, method, per_cell, n, "stress", errors.stress);
  }

  void row(const char* problem, const Method& method, int per_cell, int n, const char* quantity, double value) {
    char number[32];
    std::snprintf(number, sizeof number, "%.6e", value);
    errors_ << '"' << problem << "\"," << name_of(method.shape) << ',' << text(method.quadrature) << ',' << per_cell
            << ',' << n << ',' << quantity << ',' << number << std::endl;
  }

  void history(const char* problem, const Method& method, int n, const DiscRun& run) {
    for (const auto& at : run.history) {
      char numbers[160];
      std::snprintf(numbers, sizeof numbers, "%g,%d,%.6g,%.8e,%.8e,%.8e,%.1e", method.scheme.flip, n, at.t, at.kinetic,
                    at.stored, at.angular_momentum, run.momentum);
      discs_ << problem << ',' << name_of(method.shape) << ',' << text(method.quadrature) << ',' << numbers << '\n';
    }
    discs_.flush();
  }

  static const char* text(QuadratureRule quadrature) {
    return quadrature == QuadratureRule::points ? "points" : "corrected";
  }

  std::ofstream errors_, discs_;
};

}  // namespace
}  // namespace scarp::verification

int main(int argc, char** argv) {
  using namespace scarp::verification;
  scarp::exec::wait_politely(argv);
  if (argc != 2 && !(argc == 3 && std::string(argv[2]) == "biaxial")) {
    std::fprintf(stderr, "usage: %s FOLDER [biaxial]\n", argv[0]);
    return 2;
  }
  Studies::biaxial(argv[1]);
  if (argc == 3) return 0;
  SchemeStudies(argv[1]).all();
  Studies studies(argv[1]);
  for (const Method& method : all_methods()) {
    std::printf("%s\n", method.name().c_str());
    std::fflush(stdout);
    studies.manufactured(method);
    studies.column(method);
    studies.vortex(method);
    studies.discs(method);
  }
}
