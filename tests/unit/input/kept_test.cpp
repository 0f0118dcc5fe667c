// The case that a folder of results keeps can be run there. Oracle: the files that a reader of both would open.
#include "scarp/input/kept.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "minimal.hpp"
#include "scarp/input/document.hpp"

namespace scarp::input::test {
namespace {

namespace fs = std::filesystem;

class Kept : public testing::Test {
 protected:
  Kept() : root_(fs::canonical(testing::TempDir()) / ("scarp_kept_" + std::to_string(getpid()))) {
    fs::create_directories(root_ / "project" / "case.out");
    fs::create_directories(root_ / "elsewhere");
  }
  ~Kept() override { fs::remove_all(root_); }

  fs::path project() const { return root_ / "project"; }
  std::string kept_in(const fs::path& folder, const std::string& text) const {
    return kept_text(text, (project() / "case.toml").string(), folder.string());
  }

  fs::path root_;
};

const std::string named = R"(# a case, with a "slope.msh" in a comment
title = "slope.msh"
[mesh]
file = "meshes/slope.msh"   # of slope.geo

[[material]]
name = "Ton" # größer
library = '../laws/soil.so'
[[region]]
name = "file"
place = { title = "größer", stl = "hill.stl" }
)";

TEST_F(Kept, NamesLeadOnFromAFolderWithinThatOfTheCase) {
  const std::string kept = kept_in(project() / "case.out", named);
  EXPECT_NE(kept.find("# a case, with a \"slope.msh\" in a comment\ntitle = \"slope.msh\"\n"), std::string::npos);
  EXPECT_NE(kept.find("file = \"../meshes/slope.msh\"   # of slope.geo\n"), std::string::npos) << kept;
  EXPECT_NE(kept.find("library = \"../../laws/soil.so\"\n"), std::string::npos) << kept;
  EXPECT_NE(kept.find("stl = \"../hill.stl\""), std::string::npos) << kept;
  EXPECT_NE(kept.find("name = \"file\"\n"), std::string::npos);
}

TEST_F(Kept, NamesAreAbsoluteInAFolderElsewhere) {
  const Node node = parse_text(kept_in(root_ / "elsewhere", named), "kept");
  const auto& mesh = std::get<Keys>(std::get<Keys>(node.value).at("mesh").value);
  EXPECT_EQ(std::get<std::string>(mesh.at("file").value), (project() / "meshes" / "slope.msh").string());
  EXPECT_EQ(std::get<std::string>(std::get<Keys>(node.value).at("title").value), "slope.msh");
}

TEST_F(Kept, WhatNeedsNoChangeStaysAsItIs) {
  EXPECT_EQ(kept_in(project(), named), named);  // its own folder
  EXPECT_EQ(kept_in(project() / "case.out", minimal), minimal);
  const std::string absolute = "[mesh]\nfile = \"/meshes/slope.msh\"\n";
  EXPECT_EQ(kept_in(root_ / "elsewhere", absolute), absolute);
}

// A text that a plain search does not find is written anew from the tree.
TEST_F(Kept, NamesWrittenInOtherWays) {
  for (const std::string text :
       {"[mesh]\nfile = \"\"\"a.msh\"\"\"\n", "[mesh]\nfile = \"\\u0061.msh\"\n", "mesh.file = \"a.msh\"\n",
        "[mesh]\n\"file\" = \"a.msh\"\n", "mesh = { file='a.msh' }\r\n"}) {
    const Node node = parse_text(kept_in(project() / "case.out", text), "kept");
    const auto& mesh = std::get<Keys>(std::get<Keys>(node.value).at("mesh").value);
    EXPECT_EQ(std::get<std::string>(mesh.at("file").value), "../a.msh") << text;
  }
}

}  // namespace
}  // namespace scarp::input::test
