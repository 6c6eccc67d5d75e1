// Changes the files of a copied office: its tag map, photos, mesh and tables.
#ifndef LUXFIT_TESTS_VALIDATION_CATALOGUE_SESSION_EDITS_H_
#define LUXFIT_TESTS_VALIDATION_CATALOGUE_SESSION_EDITS_H_

#include <Eigen/Core>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "tests/support/apps/office_copy.h"

namespace luxfit {

using Fields = std::vector<std::string>;

void EditTags(const support::OfficeCopy& office, const std::function<void(nlohmann::json& tags)>& edit);
// `tag`: its number in the map.
void MoveTag(const support::OfficeCopy& office, int tag, const Eigen::Vector3d& by_m);
// Keeps the tags for whose numbers `keeps` is true.
void KeepTags(const support::OfficeCopy& office, const std::function<bool(int)>& keeps);

// `edit` gets the 16-bit counts as 64-bit floats and leaves them so; they are cut at both ends and written back.
// `is_edited`: by view and state.
void EditPhotos(const support::OfficeCopy& office,
                const std::function<bool(const std::string& view, const std::string& state)>& is_edited,
                const std::function<void(cv::Mat& counts)>& edit);
void ExchangeFiles(const support::OfficeCopy& office, const std::string& a, const std::string& b);

// Leaves out the groups of the mesh whose name begins so.
void LeaveOutGroups(const support::OfficeCopy& office, const std::string& prefix);

// `edit` changes the fields id, x, y, z, nx, ny, nz, state, illuminance.
void EditReadings(const support::OfficeCopy& office, const std::function<void(Fields&)>& edit);
void MultiplyReadings(const support::OfficeCopy& office, double factor,
                      const std::function<bool(const Fields&)>& is_wrong);

}  // namespace luxfit

#endif  // LUXFIT_TESTS_VALIDATION_CATALOGUE_SESSION_EDITS_H_
