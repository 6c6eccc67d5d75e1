// A few views and tags that stand for all, where one question after another is put to them.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_VIEW_SAMPLE_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_VIEW_SAMPLE_H_

#include <vector>

#include "calib/register/internal/bundle_adjustment.h"

namespace luxfit {

// The four views with most tags (two or more), each with its four largest.
std::vector<BundleView> SampleOf(const std::vector<BundleView>& views);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_VIEW_SAMPLE_H_
