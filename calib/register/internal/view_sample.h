// Samples a few views and tags that represent all, where many hypotheses are tested.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_VIEW_SAMPLE_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_VIEW_SAMPLE_H_

#include <vector>

#include "calib/register/internal/bundle/bundle_adjustment.h"

namespace luxfit {

// Returns the four views with most tags (at least two), each with its four largest.
std::vector<BundleView> SampleOf(const std::vector<BundleView>& views);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_VIEW_SAMPLE_H_
