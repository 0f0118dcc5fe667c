// What a user sees of a run where there is no terminal. Oracles: the times in words, and the lines of standard error.
#include "scarp/run/progress.hpp"

#include <gtest/gtest.h>

namespace scarp::run {
namespace {

TEST(Progress, TimesInWords) {
  EXPECT_EQ(duration_text(0), "0 s");
  EXPECT_EQ(duration_text(0.49), "0 s");
  EXPECT_EQ(duration_text(42), "42 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(59.6), "1 min 00 s");
  EXPECT_EQ(duration_text(190), "3 min 10 s");
  EXPECT_EQ(duration_text(3599.6), "1 h 00 min");
  EXPECT_EQ(duration_text(2 * 3600 + 5 * 60 + 59), "2 h 05 min");
  EXPECT_EQ(duration_text(100 * 3600), "100 h 00 min");
}

std::string said(bool quiet) {
  testing::internal::CaptureStderr();
  {
    Progress progress(quiet);
    progress.stage("rest", 0, 2, 30);
    progress.show(1, 1000, 0.1, 0.2);  // no more than a line in ten seconds
    progress.stage_ended("at rest at t = 3 s");
    progress.stage("cut", 1, 2, 30);
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, SaysWhichStageItIs) {
  EXPECT_EQ(said(false), "scarp: stage 1/2 rest\nscarp: stage 1/2 rest: at rest at t = 3 s\nscarp: stage 2/2 cut\n");
  EXPECT_EQ(said(true), "");
}

}  // namespace
}  // namespace scarp::run
