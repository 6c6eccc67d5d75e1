// Finds the views that the images of a COLMAP model are, by their names.
//
// An image is the photo whose path ends as its name does, folder by folder, without the ending of the file: of
// left/0000.png and right/0000.png, the image left/0000.jpg is the first. Backslashes separate folders too. Where no
// photo's path does, an image may have the id of a view.
//
// Throws std::runtime_error where photos of several views fit a name equally.
#ifndef LUXFIT_APPS_STAGES_REGISTER_IMAGE_NAMES_H_
#define LUXFIT_APPS_STAGES_REGISTER_IMAGE_NAMES_H_

#include <map>
#include <string>
#include <vector>

namespace luxfit {

struct PhotoOfView {
  std::string file, view;
};

// Returns the views by the images' names; images that are no photo's are left out. `model` names the model in errors.
std::map<std::string, std::string> ViewsOfImages(const std::vector<std::string>& images,
                                                 const std::vector<PhotoOfView>& photos,
                                                 const std::string& model);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_REGISTER_IMAGE_NAMES_H_
