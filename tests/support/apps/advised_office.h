// The office from some of its photos, and which of the others `luxfit advise` would take.
#ifndef LUXFIT_TESTS_SUPPORT_APPS_ADVISED_OFFICE_H_
#define LUXFIT_TESTS_SUPPORT_APPS_ADVISED_OFFICE_H_

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/apps/office_copy.h"
#include "tests/support/apps/program.h"
#include "tests/support/office_truth.h"

namespace luxfit::support {

using TakenPhoto = std::pair<std::string, std::string>;  // view and state

// Holds root mean squares over the four luminaires.
struct OfficeOutcome {
  double position_error_m = 0, position_sigma_m = 0, flux_sigma_percent = 0;
};

inline OfficeOutcome OutcomeOf(const nlohmann::json& result) {
  const nlohmann::json truth = OfficeTruth();
  OfficeOutcome sum;
  for (const nlohmann::json& l : result["luminaires"]) {
    for (const nlohmann::json& lamp : truth["lamps"]) {
      if (lamp["id"] != l["id"]) continue;
      sum.position_error_m += (VectorOf(l["position_m"]) - VectorOf(lamp["position"])).squaredNorm();
    }
    sum.position_sigma_m += VectorOf(l["position_sigma_m"]).squaredNorm();
    sum.flux_sigma_percent +=
        std::pow(100 * l["flux_sigma_lm"].get<double>() / l["flux_lm"].get<double>(), 2);
  }
  const auto count = static_cast<double>(result["luminaires"].size());
  return {std::sqrt(sum.position_error_m / count), std::sqrt(sum.position_sigma_m / count),
          std::sqrt(sum.flux_sigma_percent / count)};
}

// Returns the photos of every view and state in which views that see tags were photographed, in the table's order.
inline std::vector<TakenPhoto> RegisteredPhotos() {
  std::vector<TakenPhoto> photos;
  for (const std::vector<std::string>& row : OfficeTable("photos.csv"))
    if (row[0] != "file" && row[2] != "v08" && row[2] != "v09") photos.emplace_back(row[2], row[3]);
  return photos;
}

// Returns each of the states from the two views with which the tests begin.
inline std::set<TakenPhoto> FromTwoViews(const std::vector<std::string>& states) {
  std::set<TakenPhoto> photos;
  for (const char* view : {"v00", "v03"}) {
    for (const std::string& state : states) photos.insert({view, state});
  }
  return photos;
}

class AdvisedOffice {
 public:
  OfficeOutcome Fit(const std::set<TakenPhoto>& photos) const {
    office_.Write("office/photos.csv", all_photos_);
    office_.KeepPhotos([&](const std::string& view, const std::string& state) {
      return photos.count({view, state}) > 0;
    });
    return OutcomeOf(office_.ResultOf("fit", 0, "--budget 900"));
  }

  // Writes the poses of the photos that were held back, as their truth has them.
  void WritePlaces(const std::set<TakenPhoto>& taken) const {
    std::string places = "id,x_m,y_m,z_m,dx,dy,dz,state\n";
    const nlohmann::json poses = OfficeTruth()["views"];
    for (const auto& [photographed, state] : RegisteredPhotos()) {
      if (taken.count({photographed, state}) > 0) continue;
      for (const nlohmann::json& view : poses) {
        if (view["view"] != photographed) continue;
        std::ostringstream place;
        const Eigen::Vector3d centre = VectorOf(view["position_m"]);
        place << photographed;
        for (int i = 0; i < 3; ++i) place << "," << centre[i];
        for (int i = 0; i < 3; ++i) place << "," << view["R_scene_from_camera"][i][2].get<double>();
        places += place.str() + "," + state + "\n";
      }
    }
    office_.Write("places.csv", places);
  }

  // Returns the steps that are advised among photos of the places written, after the last fit.
  std::vector<nlohmann::json> Advise(int top) const { return StepsOf("'" + office_.Out() + "'", top, "out"); }
  // Returns those that are advised before the first photo.
  std::vector<nlohmann::json> AdviseFirst(int top) const {
    return StepsOf("'" + office_.Session() + "'", top, "first");
  }

 private:
  std::vector<nlohmann::json> StepsOf(const std::string& input, int top, const std::string& folder) const {
    const ProgramRun run =
        RunProgram("advise " + input + " --only photos --photos '" + office_.Path("places.csv") + "' --top " +
                   std::to_string(top) + " -o '" + office_.Path(folder) + "'");
    EXPECT_EQ(run.status, 0) << run.output;
    return office_.Json(folder + "/advise.json")["advice"].get<std::vector<nlohmann::json>>();
  }

  OfficeCopy office_;
  const std::string all_photos_ = office_.Read("office/photos.csv");
};

inline TakenPhoto PhotoOf(const nlohmann::json& step) {
  return {step["id"].get<std::string>(), step["state"].get<std::string>()};
}

inline double PredictedPositionSigmaM(const nlohmann::json& step) {
  double sum = 0, count = 0;
  for (const nlohmann::json& change : step["changes"]) {
    if (change["kind"] != "position") continue;
    sum += std::pow(change["sigma_after_m"].get<double>(), 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_APPS_ADVISED_OFFICE_H_
