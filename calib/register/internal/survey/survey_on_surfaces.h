// Lays the tags of an inaccurate survey on the surfaces of the scene.
//
// A survey of 10 mm leaves all poses some millimetres off together: only the tags' surveyed places hold the
// frame. But tags are stickers on surfaces. Where the survey's sigma was found larger than given, each tag near
// a surface (calib/register/internal/survey/tag_surfaces.h) is moved onto it. The prior of its displacement d becomes
//   |(I - n n^T) d|^2 / sigma^2 + (n . d)^2 / given_sigma^2
// n: normal of the surface, sigma: the survey's sigma in the plane, estimated again. Surfaces of three
// directions hold the frame to a millimetre or so.
//
// Tags more than 4 sigma off their surface leave it one by one, the worst first, and keep their surveyed place:
// they may hang on something that the mesh lacks. At least half of the tags must stay. The result counts where
//   the displacements along the normals agree with the given sigma (chi-square, 99 %),
//   the photos determine one of these, and two more for each tag that was taken off,
//   with a tag off, the cameras move by at most 2 of their sigmas without surfaces (rms),
//   no view is lost.
// Among many tags, half of them agree by chance, and would carry the frame away: hence the middle two.
// Otherwise the verdict stays as it is.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_SURVEY_ON_SURFACES_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_SURVEY_ON_SURFACES_H_

#include "calib/register/internal/survey/survey_check.h"
#include "calib/register/registration.h"

namespace luxfit {

// The surface is that of the verdict's options.
TagsOnSurfaces LayTagsOnSurfaces(double given_sigma_m, SurveyVerdict& verdict);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_SURVEY_ON_SURFACES_H_
