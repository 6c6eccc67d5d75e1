#include "calib/lens/lens_family.h"

#include <gtest/gtest.h>

#include <string>

namespace luxfit {
namespace {

TEST(LensKindTest, EveryCoefficientHasAName) {
  for (const LensOps& ops : Lenses())
    EXPECT_EQ(ops.coefficient_names.size(), static_cast<std::size_t>(ops.coefficients)) << ops.key;
}

TEST(LensKindTest, NamesAreThoseOfSessionFilesAndReadInEitherCase) {
  for (const char* name : {"opencv4", "opencv12", "fisheye", "splined8"}) {
    const std::optional<LensKind> kind = LensKindOf(name);
    ASSERT_TRUE(kind) << name;
    EXPECT_EQ(ToString(*kind), name);
  }
  EXPECT_EQ(LensKindOf("OPENCV8"), LensKindOf("opencv8"));
  EXPECT_EQ(LensKindOf("SPLINED10"), LensKindOf("splined10"));
  EXPECT_EQ(LensKindOf("Fisheye"), LensKindOf("fisheye"));
  for (const char* name : {"opencv", "opencv6", "splined3", "fisheye4", "pinhole", ""})
    EXPECT_FALSE(LensKindOf(name)) << name;
}

}  // namespace
}  // namespace luxfit
