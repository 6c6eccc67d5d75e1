#include "apps/report/shown_paths.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace luxfit {
namespace {

using nlohmann::json;

const std::vector<std::string> kFolders = {"/home/me/my office", "/home/me/out"};

TEST(ShownPathsTest, PathsKeepWhatFollowsTheirFolder) {
  EXPECT_EQ(WithoutFolders("/home/me/my office/photos/a.png", kFolders), "photos/a.png");
  EXPECT_EQ(WithoutFolders("read /home/me/my office/tags.json twice", kFolders), "read tags.json twice");
}

TEST(ShownPathsTest, OtherAbsolutePathsKeepTheirNames) {
  EXPECT_EQ(WithoutFolders("/srv/a/lamp.ies", kFolders), "lamp.ies");
  EXPECT_EQ(WithoutFolders("/usr/bin/luxfit run s/a.toml -o '/home/me/out'", kFolders),
            "luxfit run s/a.toml -o 'out'");
}

TEST(ShownPathsTest, OtherTextsStay) {
  for (const char* text : {"0.3 lm/W, 2 m/s", "photos/a.png", "before / after", "</script>", "/", ""})
    EXPECT_EQ(WithoutFolders(text, kFolders), text);
}

TEST(ShownPathsTest, KeysAndNestedTextsAreShown) {
  const json data = {{"inputs", {{"/home/me/out/a.csv", "0f"}}}, {"list", {"/srv/x/b.ies", 1, nullptr}}};
  EXPECT_EQ(JsonWithoutFolders(data, kFolders),
            (json{{"inputs", {{"a.csv", "0f"}}}, {"list", {"b.ies", 1, nullptr}}}));
}

TEST(ShownPathsTest, TheCommonFolderHoldsAllFiles) {
  EXPECT_EQ(CommonFolder({"/a/rig/left/01.png", "/a/rig/left/02.png"}), "/a/rig/left");
  EXPECT_EQ(CommonFolder({"/a/rig/left/01.png", "/a/rig/leftover/01.png"}), "/a/rig");
  EXPECT_EQ(CommonFolder({"/a/01.png", "/b/01.png"}), "");
  EXPECT_EQ(CommonFolder({}), "");
}

}  // namespace
}  // namespace luxfit
