// Finds the surface of the scene on which a surveyed tag hangs.
//
// A tag hangs on a triangle that is parallel to it (normals within 10 degrees, of either sign), that contains
// the projection of its surveyed centre, and that is within reach of it. Where such triangles lie at two
// distances, a desk's top and its underside say, the tag may hang on either: it has no surface.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_TAG_SURFACES_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_TAG_SURFACES_H_

#include <optional>

#include "calib/register/feature_model.h"
#include "calib/register/registration.h"
#include "calib/targets/tags.h"

namespace luxfit {

struct TagSurfaceSearch {
  double reach_m = 0.03;   // from the surveyed centre, along the normal
  double sigma_m = 0.001;  // of a tag's distance from its surface; triangles within it are one surface
};

// Returns the plane of that surface: its normal on the tag's side, through the projected centre. Triangles
// without area do not count. Throws std::invalid_argument for triangles whose vertices do not exist.
std::optional<SurfacePlane> SurfaceUnderTag(const SurveyedTag& tag, const TriangleSurface& surface,
                                            const TagSurfaceSearch& search);

// Returns the tag moved along the plane's normal onto it. It is turned there as well where the two differ by
// more than a degree; less is rounding of the survey or of the mesh.
SurveyedTag LaidOn(const SurfacePlane& plane, SurveyedTag tag);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_TAG_SURFACES_H_
