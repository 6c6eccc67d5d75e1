// Bounds the sigmas that a registration states: an error within some sigmas says nothing where a sigma may be anything.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_POSITION_SIGMAS_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_POSITION_SIGMAS_H_

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstdio>

#include "calib/register/registration.h"

namespace luxfit::support {

// Expects the sigma of each camera's place, the root of the sum of its variances along the axes, above 0 and below
// `most_mm`. Prints the largest. The limits of the tests are 1.5 times what the normal equations of their rooms give.
inline void ExpectPositionSigmasBelow(double most_mm, const Registration& registration) {
  double largest_mm = 0;
  for (const RegisteredView& view : registration.views) {
    const double sigma_mm = 1000 * view.position_sigma_m.norm();
    largest_mm = std::max(largest_mm, sigma_mm);
    EXPECT_GT(sigma_mm, 0) << view.view;
    EXPECT_LT(sigma_mm, most_mm) << view.view;
  }
  std::printf("largest sigma of a camera's place %.2f mm, expected below %.2f mm\n", largest_mm, most_mm);
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_POSITION_SIGMAS_H_
