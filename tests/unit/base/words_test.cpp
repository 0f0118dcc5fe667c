// What was meant by a word that is not known.
#include "scarp/base/words.hpp"

#include <gtest/gtest.h>

namespace scarp {
namespace {

TEST(Words, NearestOne) {
  const std::set<std::string> constants{"E", "nu", "s_u", "s_u_residual"};
  EXPECT_EQ(nearest("su", constants), "s_u");  // nu is as near by letters
  EXPECT_EQ(nearest("sU", constants), "s_u");
  EXPECT_EQ(nearest("mu", constants), "nu");
  EXPECT_EQ(nearest("s_u_residul", constants), "s_u_residual");
  EXPECT_EQ(nearest("friction", constants), std::nullopt);
}

}  // namespace
}  // namespace scarp
