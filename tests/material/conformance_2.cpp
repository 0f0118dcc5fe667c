// The models of the list with the numbers 2, 6, ...: see conformance.hpp.
#include "conformance.hpp"

namespace scarp::test {

INSTANTIATE_TYPED_TEST_SUITE_P(Group2, Conformance, Group<2>::type, ModelName);

}  // namespace scarp::test
