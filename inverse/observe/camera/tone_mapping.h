// Finds cameras whose photos went through local tone mapping: the same light counts for less amid bright surroundings.
//
//   ln Y_evs = mu_es + c_vs - k b_evs + noise          views v of one element e in one state s
//
// Y: luminance; b: ln of the luminance around it in its photo (calib/luminance/surround.h); c: of the photo. mu falls out
// of the difference of two views, c of its median. A curve that is the same all over a photo, a wrong exposure and paint make
// k = 0. What else makes views disagree has the other sign: shine, veiling glare, vignetting, furniture that the mesh lacks and
// errors of the pose are bright where the surroundings are, and dark where those are.
//
// k is the slope over all pairs of views and states, by Tukey's biweight. Its sigma is the jackknife's over views. Of the sizes of
// b, the one of the largest k / sigma counts. A camera tone maps where k exceeds both kLeastToneMapping and five sigmas. It
// is not judged by fewer than three views, nor by fewer than 300 differences.
// Sources: Reinhard et al. (2010), "High dynamic range imaging", 2nd ed., ch. 8; Beaton and Tukey (1974) (biweight); own.
#ifndef LUXFIT_INVERSE_OBSERVE_CAMERA_TONE_MAPPING_H_
#define LUXFIT_INVERSE_OBSERVE_CAMERA_TONE_MAPPING_H_

#include <optional>
#include <vector>

#include "calib/luminance/surround.h"
#include "inverse/observe/observe.h"

namespace luxfit {

constexpr double kLeastToneMapping = 0.02;

struct ToneMapping {
  double strength = 0;  // k; 0: none
  double sigma = 0;     // of k
  int views = 0;
  // Robust spread of ln Y between two views as given, and by k.
  double difference = 0, difference_without = 0;

  bool IsFound() const { return strength > kLeastToneMapping && strength > 5 * sigma; }
};

// `surround`: b of each observation. Returns nothing for a camera that is not judged. `camera_of_view`: by view.
std::vector<std::optional<ToneMapping>> FindToneMapping(const std::vector<Observation>& observations,
                                                        const std::vector<Surround::Values>& surround,
                                                        const std::vector<int>& camera_of_view, int cameras);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_CAMERA_TONE_MAPPING_H_
