// Not part of a program: a basis that lacks a function, which the compiler must name (tests/unit/mesh/CMakeLists.txt).
#include "scarp/mesh/basis_concept.hpp"
#include "scarp/mesh/with_basis.hpp"

namespace scarp {

struct Incomplete : Linear<T3> {
  class Cell {
   public:
    Cell(const Mesh<2>& mesh, int e);
    Vec<2> local(const Vec<2>& x) const;
    bool inside(const Vec<2>& xi, double tolerance) const;
    bool inside(const Vec<2>& xi, const std::array<double, 3>& tolerance) const;
    void shape(const Vec<2>& xi, std::array<double, 3>& N) const;
    void integrals(double& V, std::array<Vec<2>, 3>& g) const;
    template <class F>
    void for_gauss(F&& f) const;
  };
};
static_assert(Basis<Linear<T3>> && Basis<GridGimp<3>> && !Basis<Incomplete>);
static_assert(basis::is_complete<Incomplete>());

}  // namespace scarp
