// Keeps decoded photos from one stage of a run to the next, so that each is decoded once.
//
// A photo is kept while all kept ones fit into `max_bytes`; further ones are decoded where they are needed. One
// store serves one linearized session. Any thread may ask.
#ifndef LUXFIT_APPS_STAGES_LINEARIZE_PHOTO_STORE_H_
#define LUXFIT_APPS_STAGES_LINEARIZE_PHOTO_STORE_H_

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "calib/luminance/luminance.h"

namespace luxfit {

class PhotoStore {
 public:
  // 1 GB holds some 60 photos of 0.7 megapixels, each with its channels, variance and masks.
  explicit PhotoStore(double max_bytes = 1e9) : max_bytes_(max_bytes) {}

  // Returns the photo of that file; `decode` is called where it is not kept.
  std::shared_ptr<const LuminanceImage> Get(const std::string& file,
                                            const std::function<LuminanceImage()>& decode);

 private:
  const double max_bytes_;
  std::mutex mutex_;
  double bytes_ = 0;
  std::map<std::string, std::shared_ptr<const LuminanceImage>> kept_;
};

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_LINEARIZE_PHOTO_STORE_H_
