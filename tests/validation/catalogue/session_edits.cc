#include "tests/validation/catalogue/session_edits.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace luxfit {
namespace {

using nlohmann::json;
using support::OfficeCopy;

constexpr double kFullScale = 65535;

}  // namespace

void EditTags(const OfficeCopy& office, const std::function<void(json&)>& edit) {
  json tags = office.Json("office/tags.json");
  edit(tags);
  office.Write("office/tags.json", tags.dump(1));
}

void MoveTag(const OfficeCopy& office, int tag, const Eigen::Vector3d& by_m) {
  EditTags(office, [&](json& tags) {
    for (json& entry : tags)
      for (size_t axis = 0; entry["id"] == tag && axis < 3; ++axis)
        entry["center_m"][axis] =
            entry["center_m"][axis].get<double>() + by_m[static_cast<Eigen::Index>(axis)];
  });
}

void KeepTags(const OfficeCopy& office, const std::function<bool(int)>& keeps) {
  EditTags(office, [&](json& tags) {
    json kept = json::array();
    for (const json& entry : tags)
      if (keeps(entry["id"])) kept.push_back(entry);
    tags = kept;
  });
}

void EditPhotos(const OfficeCopy& office,
                const std::function<bool(const std::string&, const std::string&)>& is_edited,
                const std::function<void(cv::Mat&)>& edit) {
  for (const auto& entry : std::filesystem::directory_iterator(office.Path("office/photos"))) {
    const std::string stem = entry.path().stem().string();  // v00_A
    const size_t cut = stem.find('_');
    if (!is_edited(stem.substr(0, cut), stem.substr(cut + 1))) continue;
    const cv::Mat given = cv::imread(entry.path().string(), cv::IMREAD_UNCHANGED);
    if (given.empty()) throw std::runtime_error("EditPhotos: expected a photo, got " + entry.path().string());
    cv::Mat counts, written;
    given.convertTo(counts, CV_64F);
    edit(counts);
    cv::min(cv::max(counts, 0.0), kFullScale, counts);
    counts.convertTo(written, given.type());
    cv::imwrite(entry.path().string(), written);
  }
}

void ExchangeFiles(const OfficeCopy& office, const std::string& a, const std::string& b) {
  const std::string of_a = office.Read(a);
  office.Write(a, office.Read(b));
  office.Write(b, of_a);
}

void LeaveOutGroups(const OfficeCopy& office, const std::string& prefix) {
  std::istringstream given(office.Read("office/room.obj"));
  std::string kept;
  bool leaves_out = false;
  int left_out = 0;
  for (std::string line; std::getline(given, line);) {
    if (line.rfind("g ", 0) == 0) leaves_out = line.rfind("g " + prefix, 0) == 0;
    const bool is_face = line.rfind("f ", 0) == 0;
    left_out += leaves_out && is_face ? 1 : 0;
    if (!leaves_out || !is_face) kept += line + "\n";  // vertices stay: faces count them
  }
  if (left_out == 0) throw std::runtime_error("LeaveOutGroups: expected a group " + prefix + ", got none");
  office.Write("office/room.obj", kept);
}

void EditReadings(const OfficeCopy& office, const std::function<void(Fields&)>& edit) {
  office.ChangeRows("office/luxmeter.csv", [&](Fields& fields) {
    edit(fields);
    return true;
  });
}

void MultiplyReadings(const OfficeCopy& office, double factor,
                      const std::function<bool(const Fields&)>& is_wrong) {
  EditReadings(office, [&](Fields& fields) {
    if (is_wrong(fields)) fields[8] = fmt::format("{}", factor * std::stod(fields[8]));
  });
}

}  // namespace luxfit
