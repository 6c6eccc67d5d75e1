#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "tests/validation/catalogue/catalogue_case.h"
#include "tests/validation/catalogue/session_edits.h"

namespace luxfit {
namespace {

using nlohmann::json;
using support::OfficeCopy;

constexpr char kGroup[] = "registration";

bool Every(const std::string&, const std::string&) { return true; }

void ScaleFocalLength(const OfficeCopy& office) {
  office.Replace("office/cam0.yaml", "371.,", "408.,");
  office.Replace("office/cam0.yaml", "3.7060000000000002e+02", "407.7");
}

void ExchangeAxesOfTags(const OfficeCopy& office) {
  EditTags(office, [](json& tags) {
    for (json& tag : tags)
      for (const char* key : {"center_m", "normal", "up"}) std::swap(tag[key][0], tag[key][1]);
  });
}

void MirrorTags(const OfficeCopy& office) {
  EditTags(office, [](json& tags) {
    for (json& tag : tags) {
      tag["center_m"][0] = 6 - tag["center_m"][0].get<double>();
      for (const char* key : {"normal", "up"}) tag[key][0] = -tag[key][0].get<double>();
    }
  });
}

void Blur(const OfficeCopy& office, double sigma_px) {
  EditPhotos(office, Every, [=](cv::Mat& counts) { cv::GaussianBlur(counts, counts, cv::Size(), sigma_px); });
}

}  // namespace

std::vector<CatalogueCase> RegistrationCases() {
  return {
      {kGroup,
       "one tag surveyed 5 cm off",
       Required::kNamed,
       {"tag_disagrees"},
       [](const OfficeCopy& office) {
         MoveTag(office, 2, {0, 0.05, 0});
       }},
      {kGroup,
       "one tag surveyed 0.5 m off",
       Required::kNamed,
       {"tag_disagrees"},
       [](const OfficeCopy& office) {
         MoveTag(office, 1, {0, 0.5, 0});
       }},
      {kGroup,
       "two tags surveyed 5 cm off",
       Required::kNamed,
       {"tag_disagrees", "survey_less_accurate"},
       [](const OfficeCopy& office) {
         MoveTag(office, 2, {0, 0.05, 0});
         MoveTag(office, 7, {0.05, 0, 0});
       }},
      {kGroup,
       "two tags with one id in the map",
       Required::kRefused,
       {"tags.json"},
       [](const OfficeCopy& office) { EditTags(office, [](json& tags) { tags[1]["id"] = 0; }); }},
      {kGroup,
       "two tags exchanged in the map",
       Required::kNamed,
       {"tag_disagrees"},
       [](const OfficeCopy& office) {
         EditTags(office, [](json& tags) { std::swap(tags[0]["id"], tags[2]["id"]); });
       }},
      {kGroup,
       "tags said to be twice as large",
       Required::kNamed,
       {"tag_sizes_wrong", "times as large"},
       [](const OfficeCopy& office) {
         EditTags(office, [](json& tags) {
           for (json& tag : tags) tag["size_m"] = 0.4;
         });
       }},
      {kGroup, "tag map mirrored", Required::kNamed, {"map_mirrored", "mirror"}, MirrorTags},
      {kGroup,
       "x and y of the tag map exchanged",
       Required::kRefused,
       {"exchanged", "mirror"},
       ExchangeAxesOfTags},
      {kGroup,
       "three tags of twelve known",
       Required::kSolved,
       {},
       [](const OfficeCopy& office) { KeepTags(office, [](int id) { return id % 4 == 0; }); }},
      {kGroup,
       "photos blurred by 1 px",
       Required::kSolved,
       {},
       [](const OfficeCopy& office) { Blur(office, 1); }},
      {kGroup,
       "photos blurred by 2 px",
       Required::kRefused,
       {"sharp"},
       [](const OfficeCopy& office) { Blur(office, 2); }},
      {kGroup, "focal length wrong by 10 %", Required::kNamed, {"focal_length_off"}, ScaleFocalLength},
      {kGroup,
       "all photos of a view are of another view",
       Required::kNamed,
       {"photo_of_other_view", "view_disagrees", "photos_as_if"},
       [](const OfficeCopy& office) {
         for (const char* state : {"A", "B", "C"})
           ExchangeFiles(office, std::string("office/photos/v02_") + state + ".png",
                         std::string("office/photos/v05_") + state + ".png");
       }},
  };
}

}  // namespace luxfit
