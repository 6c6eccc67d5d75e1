// Tells at a grid of pixels whether other views agree with where a mesh puts them, to compare whole meshes.
//
// The same question as mesh_agreement.h, asked every kSampleCells cells: a hundredth of a second tells two meshes apart.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_SAMPLED_AGREEMENT_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_SAMPLED_AGREEMENT_H_

#include <vector>

#include "forward/room/visibility.h"
#include "inverse/furniture/signature_view.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {

struct PixelSample {
  int block = 0;          // of the pixel's view: pixels of one share their error
  double distance_m = 0;  // from the eye to the mesh; infinity: there is none
  bool is_compared = false, is_explained = false;
};

// Returns the samples of all views, in an order that is the same for every mesh.
std::vector<PixelSample> SampleAgreement(const RayScene& mesh, const std::vector<SignatureView>& views,
                                         double tolerance);

// Holds the share of pixels that each of two meshes explains, of those that the two put at different places.
struct ComparedMeshes {
  GroupScores a, b;  // 1: explained
  int pixels = 0;
};
ComparedMeshes CompareMeshes(const std::vector<PixelSample>& a, const std::vector<PixelSample>& b);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_SAMPLED_AGREEMENT_H_
