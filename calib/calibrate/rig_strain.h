// Tells how far images contradict cameras that are fixed to each other: how much worse the rig explains them than its
// cameras do, each calibrated alone with the same lens.
//
//   noise^2 = sum |r|^2 / (2 n - 6 poses)        px^2 per axis; corners in use
//   strain^2 = noise_together^2 - noise_alone^2
//
// Alone, every image has a pose of the target of its own; together, every set has one. Where the cameras are fixed and each set was
// taken at one moment, both noises are alike. The rig is strained where its strain exceeds the noise of its cameras alone.
#ifndef LUXFIT_CALIB_CALIBRATE_RIG_STRAIN_H_
#define LUXFIT_CALIB_CALIBRATE_RIG_STRAIN_H_

#include <vector>

#include "calib/calibrate/calibration.h"

namespace luxfit {

struct RigStrain {
  double together_px = 0, alone_px = 0;  // noise, per axis
  // Indices into the input's images: those of the set whose rms grows most.
  std::vector<int> worst_images;
  bool IsStrained() const;
};

// Returns the strain of a rig that converged. `rig` is what CalibrateCameras made of the input with these options. Where a
// camera alone is not determined, nothing can be said: the strain is then 0.
RigStrain StrainOf(const CalibrationInput& input, const Calibration& rig,
                   CalibrateCamerasOptions options = {});

// Returns the input of one camera of a rig.
CalibrationInput InputOfCamera(const CalibrationInput& rig, int camera);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_RIG_STRAIN_H_
