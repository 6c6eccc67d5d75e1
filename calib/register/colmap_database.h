// Tag corners as features of COLMAP's database, beside those that COLMAP extracted itself.
//
// White walls have no texture: the corners of tags are then the features. Each image's corners are appended
// to its keypoints (with descriptors of zeros, which match nothing), and those of one tag seen in two images
// to the matches that COLMAP has found for the two. All matches of the database are returned as text for
// `colmap matches_importer --match_type raw`, which verifies them together; the database's own are removed,
// for COLMAP passes over pairs that have some.
//
// Throws std::runtime_error naming the database where it cannot be read or written or is not COLMAP's.
// Source: COLMAP 3.8 documentation, "Database format".
#ifndef LUXFIT_CALIB_REGISTER_COLMAP_DATABASE_H_
#define LUXFIT_CALIB_REGISTER_COLMAP_DATABASE_H_

#include <map>
#include <string>
#include <vector>

#include "calib/targets/tags.h"

namespace luxfit {

// `tags_of_image` by the image's name in the database; a tag that an image shows twice is left out there.
// Returns the match list: "NAME NAME", a line of two keypoint indices per match, an empty line.
std::string AddTagsToColmapDatabase(const std::string& path,
                                    const std::map<std::string, std::vector<TagDetection>>& tags_of_image);

// Numbers the images in the order of their names. COLMAP numbers them as its threads finish them, and what it
// makes of them depends on the numbers. To be called before there are matches.
void NumberColmapImagesByName(const std::string& path);

// What COLMAP has numbered an image and its camera, by the image's name: models of known poses need both.
struct ColmapImageIds {
  int image = 0, camera = 0;
};
std::map<std::string, ColmapImageIds> ReadColmapImageIds(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_COLMAP_DATABASE_H_
