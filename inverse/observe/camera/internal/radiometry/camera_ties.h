// Finds which cameras see the same surfaces in the same state, so that their sensitivities can be compared.
//
// Two cameras are tied where the elements that both see in one state lie on five patches or more, in two
// folds at least. Fewer may be furniture that the mesh lacks, and a single fold cannot be left out. Ties are
// transitive.
// In each group of tied cameras one is held: the first whose gain is stated, else the first. Stated gains tie
// groups to each other.
#ifndef LUXFIT_INVERSE_OBSERVE_CAMERA_INTERNAL_RADIOMETRY_CAMERA_TIES_H_
#define LUXFIT_INVERSE_OBSERVE_CAMERA_INTERNAL_RADIOMETRY_CAMERA_TIES_H_

#include <vector>

#include "forward/room/patches.h"
#include "inverse/observe/camera/self_calibration.h"

namespace luxfit {

// One entry for each camera. A camera without samples is its own reference, and tied.
struct CameraTies {
  std::vector<int> reference;  // the held camera of its group
  std::vector<bool> is_tied;   // whether its group is tied to a stated gain, or is that of the first camera
};

// `gain_is_stated`: one for each camera.
CameraTies TieCameras(const Patches& patches, const std::vector<PhotoSample>& samples,
                      const std::vector<bool>& gain_is_stated);

// Returns the samples of elements that only cameras of one group see. Others would compare what is not tied.
std::vector<PhotoSample> SamplesWithinGroups(const std::vector<PhotoSample>& samples,
                                             const std::vector<int>& reference);

// Returns the samples of elements that several cameras see.
std::vector<PhotoSample> SamplesSeenBySeveral(const std::vector<PhotoSample>& samples);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_CAMERA_INTERNAL_RADIOMETRY_CAMERA_TIES_H_
