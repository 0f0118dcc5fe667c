// Not part of a program: a model that lacks functions, which the compiler must name (tests/material/CMakeLists.txt).
#include "scarp/material/models.hpp"

namespace scarp {

struct Incomplete {
  static ModelDescription description();

  template <class T, int N>
  struct State {
    Sym<T, N> sigma;
    template <class F, class... States>
    static void each(F&& f, States&... s) {
      f(s.sigma...);
    }
  };
  template <class T, int N>
  Rate<State<T, N>, T> rate(const State<T, N>&, const Sym<T, N>&) const;
  template <class T, int N>
  Mask<T> admissible(const State<T, N>&) const;
};
static_assert(Model<Subloading> && Model<Umat> && !Model<Incomplete>);

using List = detail::OneOf<LinearElastic, Incomplete>::type;

}  // namespace scarp
