// The models of the list with the numbers 1, 5, ...: see conformance.hpp.
#include "conformance.hpp"

namespace scarp::test {

INSTANTIATE_TYPED_TEST_SUITE_P(Group1, Conformance, Group<1>::type, ModelName);

}  // namespace scarp::test
