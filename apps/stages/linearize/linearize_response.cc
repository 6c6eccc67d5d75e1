#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "apps/stages/linearize/linearize.h"
#include "apps/text/formats/csv_table.h"
#include "calib/luminance/colour_profile.h"
#include "calib/luminance/response.h"
#include "calib/luminance/vignetting.h"

namespace luxfit {
namespace {

// Number of brackets that a response is estimated from, and of pixels in each exposure.
constexpr size_t kMaxBrackets = 6;
constexpr size_t kPixelsPerExposure = 600;

// Chooses places in the exposures at a quarter, a half and three quarters of a bracket, and reads their
// counts in all.
BracketSamples SamplesOf(const LinearizedPhoto& photo, const ResponseOptions& options) {
  const std::vector<PhotoExposure>& bracket = photo.bracket;
  std::vector<PixelPlace> places;
  std::vector<size_t> middles{bracket.size() / 4, bracket.size() / 2, 3 * bracket.size() / 4};
  middles.erase(std::unique(middles.begin(), middles.end()), middles.end());
  for (const size_t middle : middles) {
    const auto more = ChooseSamplePixels(ReadPhoto(bracket[middle].file), kPixelsPerExposure, options);
    places.insert(places.end(), more.begin(), more.end());
  }
  BracketSamples samples;
  const auto columns = static_cast<Eigen::Index>(bracket.size());
  samples.exposure_s.resize(columns);
  for (Eigen::MatrixXd& counts : samples.counts)
    counts.resize(static_cast<Eigen::Index>(places.size()), columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    const PhotoExposure& exposure = bracket[static_cast<size_t>(j)];
    samples.exposure_s[j] = exposure.relative_exposure_s;
    const Eigen::MatrixX3d counts = CountsAt(ReadPhoto(exposure.file), places);
    for (size_t c = 0; c < 3; ++c) samples.counts[c].col(j) = counts.col(static_cast<Eigen::Index>(c));
  }
  return samples;
}

// Two exposures of a view tell less than three: they count only where no view has three.
std::vector<BracketSamples> SamplesOfCamera(const LinearizedPhotos& photos, size_t camera,
                                            const ResponseOptions& options) {
  std::vector<const LinearizedPhoto*> brackets;
  for (const size_t fewest : {3, 2}) {
    for (const LinearizedPhoto& photo : photos.photos) {
      if (static_cast<size_t>(photo.camera) == camera && photo.bracket.size() >= fewest)
        brackets.push_back(&photo);
    }
    if (!brackets.empty()) break;
  }
  std::stable_sort(brackets.begin(), brackets.end(), [](const LinearizedPhoto* a, const LinearizedPhoto* b) {
    return a->bracket.size() > b->bracket.size();
  });
  brackets.resize(std::min(brackets.size(), kMaxBrackets));
  std::vector<BracketSamples> samples;
  samples.reserve(brackets.size());
  for (const LinearizedPhoto* photo : brackets) samples.push_back(SamplesOf(*photo, options));
  return samples;
}

CameraResponse EstimateForCamera(const LinearizedPhotos& photos, const Session& session, size_t index,
                                 RunContext& context, nlohmann::json& artifact) {
  const SessionCamera& camera = session.cameras[index];
  ResponseOptions options;
  options.full_scale_counts = photos.cameras[index].full_scale_counts;
  const ResponseEstimate estimate = EstimateResponse(SamplesOfCamera(photos, index, options), options);
  if (!estimate.response) {
    throw std::runtime_error(fmt::format(
        "{}:{}: camera[{}].response: expected photos that determine it, got brackets in which {}; take "
        "two exposures or more of one view and state, better three, or give a curve file",
        session.path, camera.line, index, estimate.message));
  }
  Choice choice{"response of " + camera.id, estimate.scores[estimate.chosen].method, {}, ""};
  std::string scores;
  for (const ResponseScore& score : estimate.scores) {
    choice.among.push_back(score.method);
    scores +=
        fmt::format("{}{} {:.3g}", scores.empty() ? "" : ", ", score.method, score.held_out_error_counts);
    artifact["held_out_error_counts"][score.method] = score.held_out_error_counts;
  }
  choice.because =
      "simplest whose error on exposures held out is the best's within its standard error (counts: " +
      scores + ")";
  context.choices.push_back(choice);
  if (context.out.empty()) return *estimate.response;
  const std::string path = fmt::format("{}/response_{}.csv", context.out, camera.id);
  WriteText(path, ResponseCsv(*estimate.response));
  artifact["file"] = path;
  return *estimate.response;
}

// Curves that differ by less are taken to be sRGB's.
constexpr double kLikeSrgb = 0.02;

// Returns what the colour profile of a camera's files states, where that is another curve than sRGB's.
std::optional<ColourProfile> ProfileOf(const LinearizedPhotos& photos, size_t camera) {
  const auto differs = [](const std::string& file) {
    std::optional<ColourProfile> profile = ReadColourProfile(file);
    if (profile && profile->DifferenceFromSrgb() < kLikeSrgb) profile.reset();
    return profile;
  };
  std::optional<ColourProfile> first;
  std::string first_file;
  for (const LinearizedPhoto& photo : photos.photos) {
    for (const PhotoExposure& exposure : photo.bracket) {
      if (static_cast<size_t>(photo.camera) != camera) continue;
      const std::optional<ColourProfile> profile = differs(exposure.file);
      if (first_file.empty()) first_file = exposure.file, first = profile;
      const auto name = [](const std::optional<ColourProfile>& p) { return p ? p->name : "sRGB"; };
      if (name(profile) == name(first)) continue;
      throw std::runtime_error(
          fmt::format("{}: expected the colour profile of the camera's other photos, got {} where {} has {}; "
                      "convert them alike, or "
                      "give them a [[camera]] of their own",
                      exposure.file, name(profile), first_file, name(first)));
    }
  }
  return first;
}

// Returns the curve that photos are taken to have where nothing tells the camera's own.
CameraResponse AssumedResponse(const LinearizedPhotos& photos, size_t index, double full_scale_counts,
                               RunContext& context) {
  const std::string& id = photos.cameras[index].given.id;
  const std::optional<ColourProfile> profile = ProfileOf(photos, index);
  if (profile) {
    context.choices.push_back({"response of " + id,
                               profile->name,
                               {"sRGB", profile->name},
                               fmt::format("the colour profile of its files; sRGB differs by up to {:.0f} %",
                                           100 * std::expm1(profile->DifferenceFromSrgb()))});
  }
  context.warnings.push_back({"response_assumed",
                              fmt::format("photos of camera {} are taken to have the curve of {}; most "
                                          "makers bend theirs, by 5 % and more",
                                          id, profile ? "their colour profile, " + profile->name : "sRGB"),
                              "take RAW, or three exposures or more of one view and state, one stop apart, "
                              "with response = \"estimate\""});
  return profile ? profile->Response(full_scale_counts) : SrgbResponse(full_scale_counts);
}

}  // namespace

CameraResponse ReadResponse(const std::string& path) {
  const std::string red = "relative_exposure", green = "relative_exposure_green",
                    blue = "relative_exposure_blue";
  const CsvTable table = ReadCsvTable(path, {{"count", red}, {green, blue}});
  const auto rows = static_cast<Eigen::Index>(table.rows.size());
  Eigen::VectorXd counts(rows);
  std::array<Eigen::VectorXd, 3> curves{Eigen::VectorXd(rows), Eigen::VectorXd(rows), Eigen::VectorXd(rows)};
  const std::array<std::string, 3> columns{red, HasColumn(table, green) ? green : red,
                                           HasColumn(table, blue) ? blue : red};
  for (Eigen::Index i = 0; i < rows; ++i) {
    const CsvRow& row = table.rows[static_cast<size_t>(i)];
    counts[i] = CsvNumber(table, row, "count");
    if (i > 0 && !(counts[i] > counts[i - 1]))
      throw CsvError(table, row, "count", "expected counts that increase; sort the table, one row a count");
    for (size_t c = 0; c < 3; ++c) {
      curves[c][i] = CsvNumber(table, row, columns[c]);
      if (curves[c][i] < 0 || (i > 0 && !(curves[c][i] > curves[c][i - 1])))
        throw CsvError(table, row, columns[c],
                       "expected exposures >= 0 that increase with the count; correct the row or remove it");
    }
  }
  if (rows < 2)
    throw CsvError(table, table.rows.back(), "count",
                   "expected two rows or more, got one; give black and white");
  return {counts, curves};
}

std::string ResponseCsv(const CameraResponse& response) {
  std::string csv = "count,relative_exposure,relative_exposure_green,relative_exposure_blue\n";
  for (Eigen::Index i = 0; i < response.counts().size(); ++i) {
    csv += fmt::format("{:g},{:.9g},{:.9g},{:.9g}\n", response.counts()[i], response.exposure(0)[i],
                       response.exposure(1)[i], response.exposure(2)[i]);
  }
  return csv;
}

LinearizedPhotos WithResponses(LinearizedPhotos photos, const Session& session, RunContext& context,
                               nlohmann::json& artifact) {
  artifact["cameras"] = nlohmann::json::array();
  for (size_t c = 0; c < photos.cameras.size(); ++c) {
    LinearizedCamera& camera = photos.cameras[c];
    const SessionCamera& given = camera.given;
    nlohmann::json entry = {{"camera", given.id}, {"response", given.response}};
    const auto of_camera =
        std::find_if(photos.photos.begin(), photos.photos.end(),
                     [&](const LinearizedPhoto& p) { return static_cast<size_t>(p.camera) == c; });
    const bool is_asked = given.response != "linear" || given.cdm2_per_count_s > 0;
    if (of_camera != photos.photos.end() && is_asked) {
      const Photo photo = ReadPhoto(of_camera->file);
      camera.full_scale_counts = photo.full_scale_counts;
      if (given.response != "linear" && (photo.bits_per_channel == 32 || photo.is_black_subtracted)) {
        throw std::runtime_error(fmt::format(
            "{}: expected a photo of 8 or 16 bit for the response of camera \"{}\", got one that is "
            "linear by its format; write response = \"linear\"",
            of_camera->file, given.id));
      }
      if (given.response == "estimate") {
        camera.response = EstimateForCamera(photos, session, c, context, entry);
      } else if (given.response == "srgb") {
        camera.response = AssumedResponse(photos, c, camera.full_scale_counts, context);
      } else if (given.response != "linear") {
        camera.response = ReadResponse(given.response_path);
      }
    }
    entry["full_scale_counts"] = camera.full_scale_counts;
    artifact["cameras"].push_back(entry);
  }
  return photos;
}

LinearizedPhotos WithFlatFields(LinearizedPhotos photos, RunContext& context, nlohmann::json& artifact) {
  for (size_t c = 0; c < photos.cameras.size(); ++c) {
    LinearizedCamera& camera = photos.cameras[c];
    const std::string& path = camera.given.vignetting_path;
    if (path.empty()) continue;
    const LuminanceImage flat = ReadExposure(camera, {path, 1, 0});
    const VignettingEstimate estimate = VignettingOfFlatField(flat);
    if (!estimate.is_determined || estimate.residual_rms > 0.05) {
      throw std::runtime_error(fmt::format(
          "{}: expected a flat field, one evenly bright surface that fills the picture unsaturated, got {}",
          path,
          estimate.is_determined ? fmt::format("one that departs from a smooth fall-off by {:.0f} %",
                                               100 * estimate.residual_rms)
                                 : estimate.message));
    }
    camera.vignetting = estimate.vignetting;
    const auto& k = estimate.vignetting.coefficients;
    artifact["cameras"][c]["vignetting"] = {{"coefficients", std::vector<double>(k.begin(), k.end())},
                                            {"residual_rms", estimate.residual_rms}};
    context.choices.push_back(
        {"vignetting of " + camera.given.id,
         fmt::format("order {}", k.size()),
         {"0", "1", "2", "3"},
         "the flat field; simplest whose error on cells held out is the best's within its standard error"});
  }
  return photos;
}

}  // namespace luxfit
