// The models of the list with the numbers 0, 4, ...: see conformance.hpp.
#include "conformance.hpp"

namespace scarp::test {

INSTANTIATE_TYPED_TEST_SUITE_P(Group0, Conformance, Group<0>::type, ModelName);

// The list, against the tests that there are.
TEST(ConformanceList, NoModelIsLeftOut) {
  std::set<std::string> tested;
  const auto& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const std::string name = all.GetTestSuite(i)->name(), suite = "/Conformance/";
    const auto at = name.find(suite);
    if (at != std::string::npos) tested.insert(name.substr(at + suite.size()));
  }
  EXPECT_EQ(tested.size(), std::variant_size_v<AnyModel>);
}

}  // namespace scarp::test
