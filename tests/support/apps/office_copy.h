// A copy of fixtures/office that a test may change, and what the program says of it. Files of the session lie in office/,
// results in out/.
#ifndef LUXFIT_TESTS_SUPPORT_APPS_OFFICE_COPY_H_
#define LUXFIT_TESTS_SUPPORT_APPS_OFFICE_COPY_H_

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/apps/program.h"
#include "tests/support/office_truth.h"
#include "tests/support/temp_folder.h"

namespace luxfit::support {

class OfficeCopy : public TempFolder {
 public:
  OfficeCopy() {
    std::filesystem::copy(kOfficeFolder, Path("office"), std::filesystem::copy_options::recursive);
  }

  std::string Session() const { return Path("office/session.toml"); }
  std::string Out() const { return Path("out"); }

  // Runs `luxfit COMMAND office/session.toml -o out OPTIONS`.
  ProgramRun Run(const std::string& command, const std::string& options = "") const {
    return RunProgram(command + " '" + Session() + "' -o '" + Out() + "' " + options);
  }

  // Returns result.json of the same, and expects the exit status.
  nlohmann::json ResultOf(const std::string& command, int status, const std::string& options = "") const {
    const ProgramRun run = Run(command, options);
    EXPECT_EQ(run.status, status) << run.output;
    return Json("out/result.json");
  }

  nlohmann::json Json(const std::string& name) const { return nlohmann::json::parse(Read(name)); }

  // Changes the fields of each row of a table, and leaves out rows for which `change` returns false.
  template <typename Change>
  void ChangeRows(const std::string& table, const Change& change) const {
    std::istringstream rows(Read(table));
    std::string row, text;
    std::getline(rows, row);
    text = row + "\n";
    while (std::getline(rows, row)) {
      std::vector<std::string> fields;
      std::istringstream of_row(row);
      for (std::string field; std::getline(of_row, field, ',');) fields.push_back(field);
      if (!change(fields)) continue;
      for (size_t i = 0; i < fields.size(); ++i) text += fields[i] + (i + 1 < fields.size() ? "," : "\n");
    }
    Write(table, text);
  }

  // Leaves in the table those photos for which `keeps(view, state)` is true.
  template <typename Keeps>
  void KeepPhotos(const Keeps& keeps) const {
    ChangeRows("office/photos.csv",
               [&](const std::vector<std::string>& photo) { return keeps(photo.at(2), photo.at(3)); });
  }

  // Moves every vertex of the mesh. A mirror turns the faces round, as a modeller does.
  template <typename Map>
  void MapMesh(const Map& map, bool is_mirror = false) const {
    std::istringstream given(Read("office/room.obj"));
    std::ostringstream mapped;
    mapped.precision(17);
    for (std::string line; std::getline(given, line);) {
      std::istringstream words(line);
      std::string key;
      words >> key;
      if (key == "v") {
        Eigen::Vector3d p;
        words >> p.x() >> p.y() >> p.z();
        p = map(p);
        mapped << "v " << p.x() << " " << p.y() << " " << p.z() << "\n";
      } else if (key == "f" && is_mirror) {
        std::string turned;
        for (std::string corner; words >> corner;) turned = " " + corner + turned;
        mapped << "f" << turned << "\n";
      } else {
        mapped << line << "\n";
      }
    }
    Write("office/room.obj", mapped.str());
  }

  // Gives the camera its true scale.
  void GiveCameraScale() const {
    const double per_cdm2_s = OfficeTruth().at("cameras").at("cam0").at("counts_per_cdm2_s");
    Replace("office/session.toml", "black_level = 0",
            "black_level = 0\ncdm2_per_count_s = " + nlohmann::json(1 / per_cdm2_s / 65535).dump());
  }
};

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_APPS_OFFICE_COPY_H_
