// What a UMAT may do to the program (STOP, exit(), crashes), and arguments that it uses and scarp has no value for.
#include <gtest/gtest.h>

#include <cstdio>
#include <mutex>
#include <thread>

#include "scarp/material/umat_guard.hpp"
#include "umats.hpp"

namespace scarp::test {
namespace {

// In a process of its own each: after it the program may not go on for long. Several threads are in calls at once.
TEST(UmatDeathTest, WhatEndsTheProgramIsAnErrorThatNamesTheMaterial) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  for (const auto& [how, found] : std::vector<std::pair<double, std::string>>{{7, "ends the analysis; found it ended"},
                                                                              {8, "crashes; found segmentation fault"},
                                                                              {9, "crashes; found it aborted"},
                                                                              {10, "crashes; found segmentation"}}) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    if (how != 7) continue;  // crashes are left to the sanitizer
#endif
    for (const char* calls : {"serial", "parallel"}) {
      const auto end = [&, how = how] {
        const auto model = umat("elastic_c", {2e4, 0.3, how, -1}, {}, {{"cmname", "CLAY"}, {"calls", calls}});
        const auto s = start<4>(model, some_stress<4>());
        std::string text;
        std::vector<std::thread> threads;
        std::mutex one;
        for (int i = 0; i < 4; ++i) {
          threads.emplace_back([&] {
            const auto error = error_of(model, s);
            const std::scoped_lock lock(one);
            if (text.empty() || error.find("earlier call") == std::string::npos) text = error;
          });
        }
        for (auto& thread : threads) thread.join();
        std::fprintf(stderr, "%s\n", text.c_str());
        umat::end_program(3);
      };
      EXPECT_EXIT(end(), testing::ExitedWithCode(3), "the UMAT of the material CLAY.*" + found) << how << calls;
    }
  }
}

TEST(Umat, WhatIsNotPassedIsFoundWhereItIsUsed) {
  for (const auto& [how, used] :
       std::vector<std::pair<double, std::string>>{{1, "uses DFGRD0 or DFGRD1, which"},
                                                   {2, "uses COORDS, which"},
                                                   {3, "uses COORDS and DFGRD0 or DFGRD1, which"}}) {
    const auto problem = problem_of(umat("elastic_c", {2e4, 0.3, how}));
    EXPECT_EQ(problem.key, "model");
    EXPECT_NE(problem.what.find(used), std::string::npos) << problem.what;
  }
  EXPECT_EQ(problem_of(umat("elastic_c", {2e4, 0.3, 0})).what, "");
  // CELENT has a key of its own.
  const auto length = problem_of(umat("elastic_c", {2e4, 0.3, 5}));
  EXPECT_EQ(length.key, "celent");
  EXPECT_NE(length.what.find("uses CELENT"), std::string::npos) << length.what;
  const Values settings{{"library", library("elastic_c")}, {"constants", std::vector<double>{2e4, 0.3, 5}}};
  EXPECT_EQ(problem_of(std::get<Umat>(made("umat", {{"celent", 0.5}}, settings))).what, "");
  // What is used later only is NaN then.
  testing::internal::CaptureStderr();
  const auto model = umat("elastic_c", {2e4, 0.3, 4});
  auto s = start<4>(model, some_stress<4>());
  const auto report = integrate<ModifiedEuler>(model, s, Sym<double, 4>{{0, 1e-3, 0, 0}}, {1e-4, 1e-3});
  const auto text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(report.end, IntegrationEnd::unstable);
  EXPECT_NE(text.find("STRESS(1) = nan"), std::string::npos) << text;
  EXPECT_NE(text.find("DFGRD1, and CELENT without the key celent, are NaN"), std::string::npos) << text;
}

}  // namespace
}  // namespace scarp::test
