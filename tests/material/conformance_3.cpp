// The models of the list with the numbers 3, 7, ...: see conformance.hpp.
#include "conformance.hpp"

namespace scarp::test {

INSTANTIATE_TYPED_TEST_SUITE_P(Group3, Conformance, Group<3>::type, ModelName);

}  // namespace scarp::test
