// Reads the survey of the tags: a JSON list of {"id", "size_m", "center_m", "normal", "up"}.
//
// size_m is the side of the black square (m, > 0), and center_m its centre in the world (m). The normal
// points out of the surface, and up points to the top of the tag as AprilTag's own images show it. Both must
// be within 2 % of unit length and are normalised. up must be within 1.2 degrees of perpendicular to the
// normal and is made perpendicular. Further keys are ignored.
//
// Throws std::runtime_error("FILE:LINE: tag[i].key: expected ..., got ...; remedy") for anything else, for an
// empty list and for an id that two entries share.
//
// Source: docs/session-format.md, [tags].
#ifndef LUXFIT_APPS_SESSION_TAG_MAP_H_
#define LUXFIT_APPS_SESSION_TAG_MAP_H_

#include <string>
#include <vector>

#include "calib/targets/tags.h"

namespace luxfit {

std::vector<SurveyedTag> ReadTagMap(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_TAG_MAP_H_
