#include "calib/targets/tags.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "calib/luminance/median.h"
#include "calib/photo_files/internal/display_image.h"
#include "calib/targets/internal/tags/tag_family.h"

namespace luxfit {
namespace {

using DetectorPtr = std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)>;
using DetectionsPtr = std::unique_ptr<zarray_t, void (*)(zarray_t*)>;

// Returns the reduction to use. Decimation by 2 misses a third of the tags below 40 px: small tags are
// searched for where time allows.
double DecimationOf(const ImagePlane& grey, double asked) {
  constexpr Eigen::Index kLargePhotoPixels = 8'000'000;
  if (asked > 0) return asked;
  return grey.size() > kLargePhotoPixels ? 1.5 : 1;
}

TagDetection ToHouse(const apriltag_detection_t& found) {
  TagDetection tag;
  tag.id = found.id;
  tag.decision_margin = found.decision_margin;
  // libapriltag's order is bottom-left, bottom-right, top-right, top-left; its first pixel's centre is (0.5,
  // 0.5).
  constexpr std::array<std::size_t, 4> kTheirCorner = {3, 2, 1, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    const double* p = found.p[kTheirCorner[i]];
    tag.corners_px[i] = Eigen::Vector2d(p[0] - 0.5, p[1] - 0.5);
  }
  tag.side_px = MeanSidePx(tag.corners_px);
  tag.corner_sigma_px = DetectorCornerSigmaPx(tag.side_px);
  return tag;
}

std::vector<TagDetection> DetectIn(const ImagePlane& grey, apriltag_detector_t& detector, double gamma) {
  std::vector<uint8_t> display = DisplayImage(grey, gamma);
  image_u8_t view = {static_cast<int32_t>(grey.cols()), static_cast<int32_t>(grey.rows()),
                     static_cast<int32_t>(grey.cols()), display.data()};
  const DetectionsPtr found(apriltag_detector_detect(&detector, &view), apriltag_detections_destroy);
  std::vector<TagDetection> tags;
  tags.reserve(static_cast<std::size_t>(zarray_size(found.get())));
  for (int i = 0; i < zarray_size(found.get()); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(found.get(), i, &detection);
    tags.push_back(ToHouse(*detection));
  }
  return tags;
}

std::vector<TagDetection> DetectInEnlarged(const ImagePlane& grey, apriltag_detector_t& detector,
                                           const DetectTagsOptions& options) {
  const auto enlarged = [&](Eigen::Index pixels) {
    return static_cast<Eigen::Index>(std::lround(static_cast<double>(pixels) * options.enlarge));
  };
  ImagePlane large(enlarged(grey.rows()), enlarged(grey.cols()));
  const cv::Mat from(static_cast<int>(grey.rows()), static_cast<int>(grey.cols()), CV_32F,
                     const_cast<float*>(grey.data()));  // read only: cv::Mat has no const data
  cv::Mat to(static_cast<int>(large.rows()), static_cast<int>(large.cols()), CV_32F, large.data());
  cv::resize(from, to, to.size(), 0, 0, cv::INTER_CUBIC);
  const Eigen::Array2d scale(static_cast<double>(large.cols()) / static_cast<double>(grey.cols()),
                             static_cast<double>(large.rows()) / static_cast<double>(grey.rows()));
  std::vector<TagDetection> tags = DetectIn(large, detector, options.display_gamma);
  for (TagDetection& tag : tags) {
    for (Eigen::Vector2d& corner : tag.corners_px) corner = ((corner.array() + 0.5) / scale - 0.5).matrix();
    tag.side_px = MeanSidePx(tag.corners_px);
    tag.corner_sigma_px = DetectorCornerSigmaPx(tag.side_px);
  }
  return tags;
}

// Holds the detections of one tag (or of one of several copies of it) in several photos.
using Cluster = std::vector<TagDetection>;

Eigen::Vector2d Center(const TagDetection& tag) {
  return (tag.corners_px[0] + tag.corners_px[1] + tag.corners_px[2] + tag.corners_px[3]) / 4;
}

// Returns `tags` and those of `others` that are at another place or have another id.
std::vector<TagDetection> WithOthers(std::vector<TagDetection> tags,
                                     const std::vector<TagDetection>& others) {
  for (const TagDetection& other : others) {
    const bool is_known = std::any_of(tags.begin(), tags.end(), [&](const TagDetection& tag) {
      return tag.id == other.id && (Center(tag) - Center(other)).norm() < 0.5 * tag.side_px;
    });
    if (!is_known) tags.push_back(other);
  }
  return tags;
}

double LargestCornerDistance(const TagDetection& tag, const std::array<Eigen::Vector2d, 4>& corners_px) {
  double largest_px = 0;
  for (std::size_t i = 0; i < 4; ++i)
    largest_px = std::max(largest_px, (tag.corners_px[i] - corners_px[i]).norm());
  return largest_px;
}

std::array<Eigen::Vector2d, 4> MedianCorners(const Cluster& cluster) {
  std::array<Eigen::Vector2d, 4> median_px;
  for (std::size_t i = 0; i < 4; ++i) {
    for (int axis = 0; axis < 2; ++axis) {
      std::vector<double> values;
      for (const TagDetection& tag : cluster) values.push_back(tag.corners_px[i][axis]);
      median_px[i][axis] = Median(values);
    }
  }
  return median_px;
}

// Returns the detections over which the mean is taken.
Cluster WithoutOutliers(const Cluster& cluster) {
  double least_sigma_px = cluster.front().corner_sigma_px;
  for (const TagDetection& tag : cluster) least_sigma_px = std::min(least_sigma_px, tag.corner_sigma_px);
  // Photos that could not be refined (clipped whites, a shadow) only add bias to photos that could.
  constexpr double kMuchWorse = 3;
  Cluster precise;
  for (const TagDetection& tag : cluster) {
    if (tag.corner_sigma_px <= kMuchWorse * least_sigma_px) precise.push_back(tag);
  }
  constexpr double kOutlierSigmas = 5;  // beyond it a shadow's edge or an occluder
  const std::array<Eigen::Vector2d, 4> median_px = MedianCorners(precise);
  Cluster kept;
  for (const TagDetection& tag : precise) {
    if (LargestCornerDistance(tag, median_px) <= kOutlierSigmas * tag.corner_sigma_px) kept.push_back(tag);
  }
  return kept.empty() ? precise : kept;
}

TagDetection CombineCluster(const Cluster& cluster, double systematic_fraction) {
  const Cluster kept = WithoutOutliers(cluster);
  TagDetection combined = kept.front();
  for (Eigen::Vector2d& corner_px : combined.corners_px) corner_px.setZero();
  combined.decision_margin = 0;
  double weight_sum = 0;
  for (const TagDetection& tag : kept) {
    const double weight = 1 / (tag.corner_sigma_px * tag.corner_sigma_px);
    for (std::size_t i = 0; i < 4; ++i) combined.corners_px[i] += weight * tag.corners_px[i];
    weight_sum += weight;
    combined.decision_margin = std::max(combined.decision_margin, tag.decision_margin);
  }
  for (Eigen::Vector2d& corner_px : combined.corners_px) corner_px /= weight_sum;

  const double count = static_cast<double>(kept.size());
  const double single_variance = count / weight_sum;
  const double common = systematic_fraction * systematic_fraction;
  double chi2 = 0;  // chi2 of the photos about the mean
  for (const TagDetection& tag : kept) {
    const double sigma_px = tag.corner_sigma_px;
    for (std::size_t i = 0; i < 4; ++i) {
      chi2 += (tag.corners_px[i] - combined.corners_px[i]).squaredNorm() / (sigma_px * sigma_px);
    }
  }
  const double degrees_of_freedom = 8 * (count - 1);
  const double scatter_of_mean = degrees_of_freedom > 0 ? chi2 / degrees_of_freedom / weight_sum : 0;
  combined.corner_sigma_px =
      std::sqrt(common * single_variance + std::max((1 - common) * single_variance / count, scatter_of_mean));
  combined.side_px = MeanSidePx(combined.corners_px);
  return combined;
}

}  // namespace

std::array<Eigen::Vector3d, 4> TagCornersInWorld(const SurveyedTag& tag) {
  const double half_m = tag.size_m / 2;
  const Eigen::Vector3d up = half_m * tag.up_in_world;
  const Eigen::Vector3d right = half_m * tag.up_in_world.cross(tag.normal_in_world);
  const Eigen::Vector3d& c = tag.center_in_world;
  return {c - right + up, c + right + up, c + right - up, c - right - up};
}

std::string TagSquareWords(const std::string& family) {
  return MakeTagFamily(family)->reversed_border ? "white square in the black frame" : "black square";
}

double MeanSidePx(const std::array<Eigen::Vector2d, 4>& corners_px) {
  double sum_px = 0;
  for (std::size_t i = 0; i < 4; ++i) sum_px += (corners_px[(i + 1) % 4] - corners_px[i]).norm();
  return sum_px / 4;
}

double DetectorCornerSigmaPx(double side_px) {
  // Measured on area-integrated renders with lens blur 0.7 px; below 16 px extrapolated as 1 / side.
  constexpr std::array<std::pair<double, double>, 5> kTable = {
      {{16, 0.22}, {24, 0.14}, {40, 0.055}, {80, 0.045}, {160, 0.04}}};
  // The detector sees the photo with a display gamma. Whatever the tag's size, that moves edges towards the
  // black by 0.36 px at a lens blur of 0.7 px (docs/calib.md, "Boards and tags"). Photos sharper than the
  // pixel grid are aliased.
  constexpr double kDisplayPx = 0.35;
  double blurred_px = kTable.back().second;
  if (side_px <= kTable.front().first) {
    blurred_px = kTable.front().second * kTable.front().first / std::max(side_px, 1.0);
  } else {
    for (std::size_t i = 0; i + 1 < kTable.size(); ++i) {
      if (side_px >= kTable[i + 1].first) continue;
      const double t = (side_px - kTable[i].first) / (kTable[i + 1].first - kTable[i].first);
      blurred_px = (1 - t) * kTable[i].second + t * kTable[i + 1].second;
      break;
    }
  }
  return std::hypot(blurred_px, kDisplayPx);
}

namespace {

struct FamilyDetector {
  explicit FamilyDetector(const std::string& name) : family(MakeTagFamily(name)) {
    apriltag_detector_add_family(detector.get(), family.get());
    detector->nthreads = 1;
  }
  TagFamilyPtr family;
  DetectorPtr detector{apriltag_detector_create(), apriltag_detector_destroy};
};

// Listing a family's codes with all their errors takes longer than searching a photo: each thread does it
// once.
apriltag_detector_t& DetectorOf(const std::string& family) {
  thread_local std::map<std::string, FamilyDetector> detectors;
  return *detectors.try_emplace(family, family).first->second.detector;
}

}  // namespace

std::vector<TagDetection> DetectTags(const ImagePlane& grey, const DetectTagsOptions& options) {
  if (!(options.display_gamma > 0)) throw std::invalid_argument("DetectTags: display_gamma: expected > 0");
  if (grey.size() == 0) throw std::invalid_argument("DetectTags: the plane is empty");
  if (options.decimate != 0 && !(options.decimate >= 1))
    throw std::invalid_argument("DetectTags: decimate: expected 0 or at least 1");
  if (!(options.enlarge >= 1)) throw std::invalid_argument("DetectTags: enlarge: expected at least 1");

  apriltag_detector_t& detector = DetectorOf(options.family);
  detector.quad_decimate = static_cast<float>(DecimationOf(grey, options.decimate));
  detector.refine_edges = options.refine_edges;
  std::vector<TagDetection> tags = DetectIn(grey, detector, options.display_gamma);
  if (options.enlarge > 1) {
    detector.quad_decimate = 1;
    tags = WithOthers(std::move(tags), DetectInEnlarged(grey, detector, options));
  }
  tags.erase(std::remove_if(tags.begin(), tags.end(),
                            [&](const TagDetection& tag) {
                              return tag.side_px < options.min_side_px ||
                                     tag.decision_margin < options.min_decision_margin;
                            }),
             tags.end());
  // The detector's own order depends on its hash table.
  std::sort(tags.begin(), tags.end(), [](const TagDetection& a, const TagDetection& b) {
    if (a.id != b.id) return a.id < b.id;
    return a.corners_px[0].x() < b.corners_px[0].x();
  });
  return tags;
}

std::vector<TagDetection> CombineDetections(const std::vector<std::vector<TagDetection>>& photos,
                                            const CombineDetectionsOptions& options) {
  std::map<int, std::vector<Cluster>> clusters_by_id;
  for (const std::vector<TagDetection>& photo : photos) {
    for (const TagDetection& tag : photo) {
      std::vector<Cluster>& clusters = clusters_by_id[tag.id];
      const auto same_place = std::find_if(clusters.begin(), clusters.end(), [&tag](const Cluster& cluster) {
        return (Center(cluster.front()) - Center(tag)).norm() < 0.5 * tag.side_px;
      });
      if (same_place != clusters.end()) {
        same_place->push_back(tag);
      } else {
        clusters.push_back({tag});
      }
    }
  }
  std::vector<TagDetection> combined;
  for (const auto& [id, clusters] : clusters_by_id) {
    for (const Cluster& cluster : clusters)
      combined.push_back(CombineCluster(cluster, options.systematic_fraction));
  }
  return combined;
}

}  // namespace luxfit
