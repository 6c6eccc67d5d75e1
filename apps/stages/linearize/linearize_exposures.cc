#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>

#include "apps/stages/linearize/linearize.h"
#include "apps/text/file_stem.h"
#include "calib/luminance/exposure.h"

namespace luxfit {
namespace {

// Labels are rounded by up to 7 % (1/60 for 1/64); a larger difference is another exposure.
constexpr double kLabelRounding = 0.10;

std::string PhotoName(const Session& session, const std::string& file, int line) {
  return fmt::format("{}:{} ({})", FileName(session.photos_path), line, FileName(file));
}

// Returns the value of the table, else that of the file. Warns where they differ.
std::optional<double> Reconciled(const Session& session, const SessionPhoto& photo, const std::string& column,
                                 std::optional<double> table, std::optional<double> file,
                                 RunContext& context) {
  if (!table) return file;
  if (file && std::abs(std::log(*table / *file)) > kLabelRounding) {
    context.warnings.push_back(
        {"exposure_metadata",
         fmt::format(
             "{}: {} is {:g} in the table and {:g} in the photo's own metadata; the table's value was used",
             PhotoName(session, photo.file, photo.line), column, *table, *file),
         fmt::format("correct the table, or leave {} empty so that the photo's own value is taken", column)});
  }
  return table;
}

// Holds ISO and aperture of the camera's first photo, to which exposures are relative.
struct Setting {
  std::optional<double> f_number, iso;
};

double RelativeExposure(const SessionPhoto& photo, const Setting& first) {
  double exposure = photo.exposure_s;
  if (photo.iso && first.iso) exposure *= *photo.iso / *first.iso;
  if (photo.f_number && first.f_number) exposure *= std::pow(*first.f_number / *photo.f_number, 2);
  return exposure;
}

void WarnOfIncomplete(const Session& session, const std::vector<SessionPhoto>& rows, RunContext& context) {
  for (size_t c = 0; c < session.cameras.size(); ++c) {
    int photos = 0, with_iso = 0, with_aperture = 0;
    for (const SessionPhoto& photo : rows) {
      if (static_cast<size_t>(photo.camera) != c) continue;
      ++photos;
      with_iso += photo.iso ? 1 : 0;
      with_aperture += photo.f_number ? 1 : 0;
    }
    for (const auto& [what, known] : {std::pair("iso", with_iso), std::pair("aperture", with_aperture)}) {
      if (known == 0 || known == photos) continue;
      context.warnings.push_back(
          {"exposure_incomplete",
           fmt::format("{} is known of {} of the {} photos of camera \"{}\"; the others were taken to have "
                       "that of its "
                       "first photo",
                       what, known, photos, session.cameras[c].id),
           fmt::format("fill in the column {} of {}", what, FileName(session.photos_path))});
    }
  }
}

// Returns the ratios of neighbouring exposures of one bracket, with photos numbered from 0.
std::vector<ExposureRatio> RatiosOf(const LinearizedCamera& camera, const LinearizedPhoto& photo) {
  std::vector<ExposureRatio> ratios;
  ratios.reserve(photo.bracket.size());
  LuminanceImage longer = ReadExposure(camera, photo.bracket[0]);
  for (size_t i = 1; i < photo.bracket.size(); ++i) {
    LuminanceImage shorter = ReadExposure(camera, photo.bracket[i]);
    auto ratio = MeasureRatio(longer, photo.bracket[i - 1].relative_exposure_s, shorter,
                              photo.bracket[i].relative_exposure_s);
    if (ratio) {
      ratio->first = static_cast<int>(i) - 1;
      ratio->second = static_cast<int>(i);
      ratios.push_back(*ratio);
    }
    longer = std::move(shorter);
  }
  return ratios;
}

void WarnOfGain(const Session& session, const PhotoExposure& exposure, double log_gain, bool is_alone,
                RunContext& context) {
  const double factor = std::exp(log_gain);
  const std::string label =
      std::abs(log_gain) < kLabelRounding
          ? "; times are often rounded labels (1/60 s for 1/64 s)"
          : "; automatic ISO, or a time that was copied from another photo, looks like this";
  context.warnings.push_back(
      {"exposure_metadata",
       fmt::format("{}: its stated exposure (table or metadata) is off by a factor of {:.3f} against the "
                   "other photos of "
                   "its bracket{}{}",
                   PhotoName(session, exposure), factor, is_alone ? " (or the other one is)" : "", label),
       fmt::format("give exposure_s in the photo table, multiplied by {:.3f}, or the ISO of every photo; it "
                   "was corrected here",
                   factor)});
}

}  // namespace

std::string PhotoName(const Session& session, const PhotoExposure& exposure) {
  return PhotoName(session, exposure.file, exposure.line);
}

std::string PhotoName(const Session& session, const LinearizedPhotos& photos, const std::string& view,
                      const std::string& state) {
  for (const LinearizedPhoto& photo : photos.photos)
    if (photo.view == view && photo.state == state) return PhotoName(session, photo.bracket.front());
  return view;
}

std::vector<SessionPhoto> RowsWithMetadata(const Session& session, RunContext& context) {
  std::vector<SessionPhoto> rows = session.photos;
  std::vector<ExposureMetadata> metadata(rows.size());
  tbb::parallel_for(size_t{0}, metadata.size(),
                    [&](size_t i) { metadata[i] = ReadExposureMetadata(rows[i].file); });
  for (size_t i = 0; i < metadata.size(); ++i) {
    SessionPhoto& photo = rows[i];
    const auto stated = photo.exposure_s > 0 ? std::optional(photo.exposure_s) : std::nullopt;
    const auto time = Reconciled(session, photo, "exposure_s", stated, metadata[i].exposure_s, context);
    if (!time) {
      throw std::runtime_error(fmt::format(
          "{}:{}: exposure_s: expected the exposure time in s, got none here and none in {}; fill it in",
          session.photos_path, photo.line, photo.file));
    }
    photo.exposure_s = *time;
    photo.f_number = Reconciled(session, photo, "aperture", photo.f_number, metadata[i].f_number, context);
    photo.iso = Reconciled(session, photo, "iso", photo.iso, metadata[i].iso, context);
  }
  return rows;
}

LinearizedPhotos MakeBrackets(const Session& session, const std::vector<SessionPhoto>& rows,
                              RunContext& context) {
  WarnOfIncomplete(session, rows, context);
  LinearizedPhotos made;
  made.cameras.reserve(session.cameras.size());
  for (const SessionCamera& camera : session.cameras) {
    made.cameras.emplace_back();
    made.cameras.back().given = camera;
  }
  std::map<int, Setting> first_of_camera;
  std::map<std::tuple<std::string, std::string, int>, size_t> index;
  std::vector<LinearizedPhoto>& photos = made.photos;
  photos.reserve(rows.size());
  for (const SessionPhoto& photo : rows) {
    Setting& first = first_of_camera[photo.camera];
    if (!first.iso) first.iso = photo.iso;
    if (!first.f_number) first.f_number = photo.f_number;
    const auto [at, is_new] = index.emplace(std::tuple(photo.view, photo.state, photo.camera), photos.size());
    if (is_new) photos.push_back({photo.file, photo.camera, photo.view, photo.state, photo.exposure_s, {}});
    photos[at->second].bracket.push_back({photo.file, RelativeExposure(photo, first), photo.line});
  }
  for (LinearizedPhoto& photo : photos) {
    std::stable_sort(photo.bracket.begin(), photo.bracket.end(), [](const auto& a, const auto& b) {
      return a.relative_exposure_s > b.relative_exposure_s;
    });
    photo.file = photo.bracket.front().file;
  }
  return made;
}

LinearizedPhotos WithCorrectedExposures(LinearizedPhotos photos, const Session& session, RunContext& context,
                                        nlohmann::json& artifact) {
  std::vector<std::vector<ExposureRatio>> ratios(photos.photos.size());
  tbb::parallel_for(size_t{0}, photos.photos.size(), [&](size_t i) {
    const LinearizedPhoto& photo = photos.photos[i];
    if (photo.bracket.size() > 1)
      ratios[i] = RatiosOf(photos.cameras[static_cast<size_t>(photo.camera)], photo);
  });
  artifact["exposure_gains"] = nlohmann::json::array();
  for (size_t i = 0; i < ratios.size(); ++i) {
    std::vector<PhotoExposure>& bracket = photos.photos[i].bracket;
    if (bracket.size() < 2) continue;
    const ExposureGains gains = SolveGains(static_cast<int>(bracket.size()), ratios[i]);
    for (const int off : gains.off)
      WarnOfGain(session, bracket[static_cast<size_t>(off)], gains.log_gain[off], bracket.size() == 2,
                 context);
    for (size_t k = 0; k < bracket.size(); ++k) {
      const Eigen::Index at = static_cast<Eigen::Index>(k);
      bracket[k].relative_exposure_s *= std::exp(gains.log_gain[at]);
      artifact["exposure_gains"].push_back({{"file", bracket[k].file},
                                            {"factor", std::exp(gains.log_gain[at])},
                                            {"relative_sigma", gains.sigma[at]}});
    }
    std::stable_sort(bracket.begin(), bracket.end(), [](const auto& a, const auto& b) {
      return a.relative_exposure_s > b.relative_exposure_s;
    });
  }
  return photos;
}

}  // namespace luxfit
