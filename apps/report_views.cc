#include "apps/report_views.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/base64.h"
#include "apps/stages.h"
#include "calib/encoded_image.h"
#include "forward/surface_view.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr int kMaxWidthPx = 400;

// A photo and its prediction, pixel by pixel, reduced.
struct ComparedView {
  std::string view;
  std::array<ImagePlane, 3> photo_rgb, predicted_rgb;  // relative luminance; cd/m2
  ImagePlane photo, predicted;                         // NaN where the photo tells nothing
};

// Red, green, blue where every material has a colour, else the grey reflectance; the last is always grey.
Eigen::MatrixXd ChannelsOf(const FittedRoom& fitted) {
  Eigen::MatrixXd albedo = fitted.albedo.replicate(1, 4);
  const json& materials = fitted.result->at("materials");
  const auto& names = fitted.room.scene.materials;
  for (const json& material : materials) {
    const auto at = std::find(names.begin(), names.end(), material.at("name"));
    const json& rgb = material.at("albedo_rgb");
    if (at == names.end() || !rgb.is_array()) continue;
    for (Eigen::Index c = 0; c < 3; ++c) {
      const double value = rgb.at(static_cast<size_t>(c));
      albedo(at - names.begin(), c) = std::clamp(value, 0.0, 0.98);
    }
  }
  return albedo;
}

ImagePlane OnlyValid(const ImagePlane& plane, const PixelMask& valid) {
  return valid.select(plane, ImagePlane::Constant(plane.rows(), plane.cols(), kNaN));
}

Eigen::Matrix3Xd DirectionsOf(const Camera& camera, const Eigen::Matrix3d& world_from_cam, int width_px,
                              int height_px) {
  Eigen::Matrix3Xd directions(3, static_cast<Eigen::Index>(width_px) * height_px);
  const double step_x = static_cast<double>(camera.width_px) / width_px;
  const double step_y = static_cast<double>(camera.height_px) / height_px;
  tbb::parallel_for(0, height_px, [&](int y) {
    for (int x = 0; x < width_px; ++x) {
      const Eigen::Vector2d pixel((x + 0.5) * step_x - 0.5, (y + 0.5) * step_y - 0.5);
      directions.col(static_cast<Eigen::Index>(y) * width_px + x) = world_from_cam * Unproject(camera, pixel);
    }
  });
  return directions;
}

ImagePlane PlaneOf(const Eigen::VectorXd& column, int width_px, int height_px) {
  return Eigen::Map<const Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
             column.data(), height_px, width_px)
      .cast<float>();
}

ComparedView CompareView(const FittedRoom& fitted, const Session& session, const LitRoom& lit,
                         const SessionPhoto& photo, const RegisteredView& view, int width_px) {
  const Camera& camera = fitted.registered.cameras[static_cast<size_t>(view.camera)];
  const LuminanceImage image = ReadLuminance(session, photo, camera);
  ComparedView compared;
  compared.view = view.view;
  compared.photo = Reduced(OnlyValid(image.relative_luminance, image.valid), width_px);
  const int width = static_cast<int>(compared.photo.cols()), height = static_cast<int>(compared.photo.rows());
  for (size_t c = 0; c < 3; ++c) compared.photo_rgb[c] = Reduced(image.relative_rgb[c], width_px);
  const Eigen::Isometry3d world_from_cam = view.cam_from_world.inverse();
  Eigen::Matrix3Xd directions = DirectionsOf(camera, world_from_cam.linear(), width, height);
  // Corners outside the lens's circle: the axis stands in for them, the photo shows nothing there.
  const Eigen::Vector3d axis = world_from_cam.linear().col(2);
  for (auto direction : directions.colwise()) {
    if (!direction.allFinite()) direction = axis;
  }
  ViewOptions options;
  options.shadow_grid = 1;
  const Eigen::MatrixXd luminance =
      RenderView(fitted.room, lit, world_from_cam.translation(), directions, options);
  for (int c = 0; c < 3; ++c)
    compared.predicted_rgb[static_cast<size_t>(c)] = PlaneOf(luminance.col(c), width, height);
  compared.predicted = PlaneOf(luminance.col(3), width, height);
  return compared;
}

std::vector<float> RatiosOf(const std::vector<ComparedView>& views) {
  std::vector<float> ratios;
  for (const ComparedView& view : views) {
    for (Eigen::Index i = 0; i < view.photo.size(); ++i) {
      const float photo = view.photo.data()[i], predicted = view.predicted.data()[i];
      if (std::isfinite(photo) && predicted > 0) ratios.push_back(photo / predicted);
    }
  }
  return ratios;
}

// The value that a share of the finite ones lies below; 0 where there are none.
double QuantileOf(std::vector<float> values, double share) {
  values.erase(std::remove_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); }),
               values.end());
  if (values.empty()) return 0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::vector<float> ValuesOf(const ImagePlane& plane) { return {plane.data(), plane.data() + plane.size()}; }

ImagePlane ResidualPercent(const ComparedView& view, double scale) {
  ImagePlane residual = 100 * (view.photo / (static_cast<float>(scale) * view.predicted) - 1);
  return (view.predicted > 0).select(residual, ImagePlane::Constant(residual.rows(), residual.cols(), kNaN));
}

// Blue where the photo is darker than predicted, red where brighter, white between; grey: not told.
DisplayPicture DivergingPicture(const ImagePlane& percent) {
  const Eigen::Vector3d low(33, 86, 165), middle(250, 250, 250), high(178, 34, 34);
  DisplayPicture picture{static_cast<int>(percent.cols()), static_cast<int>(percent.rows()), {}};
  picture.rgb.reserve(3 * static_cast<size_t>(percent.size()));
  for (Eigen::Index i = 0; i < percent.size(); ++i) {
    const double value = percent.data()[i];
    Eigen::Vector3d colour(140, 140, 140);
    if (std::isfinite(value)) {
      const double t = std::clamp(value / kResidualLimitPercent, -1.0, 1.0);
      colour = middle + std::abs(t) * ((t < 0 ? low : high) - middle);
    }
    for (int c = 0; c < 3; ++c) picture.rgb.push_back(static_cast<uint8_t>(std::lround(colour[c])));
  }
  return picture;
}

std::string DataUri(const std::string& type, const std::vector<uint8_t>& bytes) {
  return "data:image/" + type + ";base64," + Base64(bytes);
}

json ViewJson(const ComparedView& view, double scale) {
  const double white = std::max(1e-12, QuantileOf(ValuesOf(view.photo), 0.99));
  const ImagePlane residual = ResidualPercent(view, scale);
  std::vector<float> magnitudes = ValuesOf(residual);
  for (float& value : magnitudes) value = std::abs(value);
  return {{"view", view.view},
          {"width_px", view.photo.cols()},
          {"height_px", view.photo.rows()},
          {"photo", DataUri("jpeg", EncodeJpeg(ToDisplay(view.photo_rgb, white)))},
          {"predicted", DataUri("jpeg", EncodeJpeg(ToDisplay(view.predicted_rgb, white / scale)))},
          {"residual", DataUri("png", EncodePng(DivergingPicture(residual)))},
          {"white_cd_m2", white / scale},
          {"median_percent", QuantileOf(ValuesOf(residual), 0.5)},
          {"median_magnitude_percent", QuantileOf(magnitudes, 0.5)},
          {"largest_tenth_percent", QuantileOf(magnitudes, 0.9)}};
}

int WidthFor(const Camera& camera, size_t views, int max_pixels) {
  const double pixels = static_cast<double>(max_pixels) / static_cast<double>(std::max<size_t>(1, views));
  const double width = std::sqrt(pixels * camera.width_px / camera.height_px);
  return std::clamp(static_cast<int>(width), 16, std::min(kMaxWidthPx, camera.width_px));
}

}  // namespace

json ReportViewsJson(const FittedRoom& fitted, const std::string& state, const ReportViewsOptions& options) {
  json page = {{"state", state}, {"limit_percent", kResidualLimitPercent}, {"views", json::array()}};
  const auto& registered = fitted.registered.registration.views;
  if (registered.empty() || fitted.session.photos.empty()) return page;
  RunContext context;
  context.is_quiet = true;
  const Session session = LinearizeSession(fitted.session, context);
  std::vector<Luminaire> luminaires = fitted.luminaires;
  const Eigen::VectorXd dimming = DimmingOf(fitted, state);
  for (size_t k = 0; k < luminaires.size(); ++k)
    luminaires[k].flux_lm *= dimming[static_cast<Eigen::Index>(k)];
  const LitRoom lit = LightRoom(fitted.room, luminaires, ChannelsOf(fitted));
  std::vector<ComparedView> views;
  for (const RegisteredView& view : registered) {
    const auto photo = std::find_if(session.photos.begin(), session.photos.end(), [&](const SessionPhoto& p) {
      return p.view == view.view && p.state == state;
    });
    if (photo == session.photos.end()) continue;
    const Camera& camera = fitted.registered.cameras[static_cast<size_t>(view.camera)];
    views.push_back(CompareView(fitted, session, lit, *photo, view,
                                WidthFor(camera, registered.size(), options.max_pixels)));
  }
  const double scale = fitted.camera_scale > 0 ? fitted.camera_scale : QuantileOf(RatiosOf(views), 0.5);
  page["scale_is_of_fit"] = fitted.camera_scale > 0;
  if (!(scale > 0)) return page;
  for (const ComparedView& view : views) page["views"].push_back(ViewJson(view, scale));
  return page;
}

}  // namespace luxfit
