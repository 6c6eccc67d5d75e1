#include "apps/report/report_views.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/report/encoded_image.h"
#include "apps/session/photo_corrections.h"
#include "apps/stages/stages.h"
#include "apps/text/formats/base64.h"
#include "forward/views/surface_view.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr int kMaxWidthPx = 400;
constexpr double kMaxPixels = 1e6;  // in all photos together
// Residual at which the colour scale ends.
constexpr double kResidualLimitPercent = 20;

// Holds a photo and its prediction, pixel by pixel, reduced.
struct ComparedView {
  std::string view;
  std::array<ImagePlane, 3> photo_rgb, predicted_rgb;  // relative luminance; cd/m2
  ImagePlane photo, predicted;                         // NaN where the photo tells nothing
};

// Holds red, green and blue where every material has a colour, else the grey reflectance. The last channel is
// always grey.
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

// Returns what a view shows of each luminaire alone, fully on: pixels x channels. Light adds, so that every
// state is a sum.
std::vector<Eigen::MatrixXd> LuminanceOf(const FittedRoom& fitted, const std::vector<LitRoom>& lit,
                                         const RegisteredView& view, int width_px, int height_px) {
  const Camera& camera = fitted.registered.cameras[static_cast<size_t>(view.camera)];
  const Eigen::Isometry3d world_from_cam = view.cam_from_world.inverse();
  Eigen::Matrix3Xd directions = DirectionsOf(camera, world_from_cam.linear(), width_px, height_px);
  // Corners outside the lens's image circle take the axis instead, since the photo shows nothing there.
  const Eigen::Vector3d axis = world_from_cam.linear().col(2);
  for (auto direction : directions.colwise()) {
    if (!direction.allFinite()) direction = axis;
  }
  ViewOptions options;
  options.shadow_grid = 1;
  std::vector<Eigen::MatrixXd> luminance;
  luminance.reserve(lit.size());
  for (const LitRoom& one : lit)
    luminance.push_back(RenderView(fitted.room, one, world_from_cam.translation(), directions, options));
  return luminance;
}

// Fills in the photo's part; the prediction follows later.
ComparedView ReducedPhoto(const LuminanceImage& image, const std::string& view, int width_px) {
  ComparedView compared;
  compared.view = view;
  compared.photo = Reduced(OnlyValid(image.relative_luminance, image.valid), width_px);
  for (size_t c = 0; c < 3; ++c) compared.photo_rgb[c] = Reduced(image.relative_rgb[c], width_px);
  return compared;
}

void Predict(const std::vector<Eigen::MatrixXd>& of_luminaire, const Eigen::VectorXd& dimming,
             ComparedView& view) {
  Eigen::MatrixXd luminance = Eigen::MatrixXd::Zero(of_luminaire[0].rows(), of_luminaire[0].cols());
  for (size_t k = 0; k < of_luminaire.size(); ++k)
    luminance += dimming[static_cast<Eigen::Index>(k)] * of_luminaire[k];
  const int width = static_cast<int>(view.photo.cols()), height = static_cast<int>(view.photo.rows());
  for (int c = 0; c < 3; ++c)
    view.predicted_rgb[static_cast<size_t>(c)] = PlaneOf(luminance.col(c), width, height);
  view.predicted = PlaneOf(luminance.col(3), width, height);
}

// Returns the value that the given share of the finite ones lies below; 0 where there are none.
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

// Colours are blue where the photo is darker than predicted, red where it is brighter, white between, and
// grey where it has no residual.
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

int WidthFor(const Camera& camera, size_t pictures) {
  const double pixels = kMaxPixels / static_cast<double>(std::max<size_t>(1, pictures));
  const double width = std::sqrt(pixels * camera.width_px / camera.height_px);
  return std::clamp(static_cast<int>(width), 16, std::min(kMaxWidthPx, camera.width_px));
}

// Holds photos that can be compared: those of registered views with a luminaire on, by state in the session's
// order.
struct StatePhotos {
  std::string state;
  Eigen::VectorXd dimming;
  std::vector<const LinearizedPhoto*> photo_of_view;  // null: no photo in this state
  std::vector<ComparedView> views;
};

std::vector<float> RatiosOf(const std::vector<StatePhotos>& states) {
  std::vector<float> ratios;
  for (const StatePhotos& state : states) {
    for (const ComparedView& view : state.views) {
      for (Eigen::Index i = 0; i < view.photo.size(); ++i) {
        const float photo = view.photo.data()[i], predicted = view.predicted.data()[i];
        if (std::isfinite(photo) && predicted > 0) ratios.push_back(photo / predicted);
      }
    }
  }
  return ratios;
}

std::vector<StatePhotos> PhotosByState(const FittedRoom& fitted, const LinearizedPhotos& photos) {
  std::vector<StatePhotos> all;
  for (const SessionState& state : fitted.session.states) {
    StatePhotos own{state.id, DimmingOf(fitted, state.id), {}, {}};
    bool has_one = false;
    for (const RegisteredView& view : fitted.registered.registration.views) {
      const auto found = std::find_if(
          photos.photos.begin(), photos.photos.end(),
          [&](const LinearizedPhoto& photo) { return photo.view == view.view && photo.state == state.id; });
      own.photo_of_view.push_back(found == photos.photos.end() ? nullptr : &*found);
      has_one = has_one || own.photo_of_view.back() != nullptr;
    }
    if (has_one && own.dimming.maxCoeff() > 0) all.push_back(std::move(own));
  }
  return all;
}

// Compares the photos of one view in every state.
void CompareView(const FittedRoom& fitted, const LinearizedPhotos& photos,
                 const PhotoCorrections& corrections, const std::vector<LitRoom>& lit, size_t index,
                 int width_px, std::vector<StatePhotos>& states) {
  const RegisteredView& view = fitted.registered.registration.views[index];
  const Camera& camera = fitted.registered.cameras[static_cast<size_t>(view.camera)];
  std::vector<ComparedView> compared(states.size());
  tbb::parallel_for(size_t{0}, states.size(), [&](size_t s) {
    const LinearizedPhoto* photo = states[s].photo_of_view[index];
    if (photo == nullptr) return;
    compared[s] = ReducedPhoto(ReadCorrected(photos, *photo, camera, corrections), view.view, width_px);
  });
  std::vector<Eigen::MatrixXd> luminance;
  for (size_t s = 0; s < states.size(); ++s) {
    const ImagePlane& photo = compared[s].photo;
    if (photo.size() == 0) continue;
    if (luminance.empty()) {
      luminance =
          LuminanceOf(fitted, lit, view, static_cast<int>(photo.cols()), static_cast<int>(photo.rows()));
    }
    Predict(luminance, states[s].dimming, compared[s]);
    states[s].views.push_back(std::move(compared[s]));
  }
}

}  // namespace

json ReportViewsJson(const FittedRoom& fitted) {
  json page = {
      {"limit_percent", kResidualLimitPercent}, {"scale_is_of_fit", true}, {"states", json::array()}};
  const auto& registered = fitted.registered.registration.views;
  if (registered.empty() || fitted.session.photos.empty()) return page;
  RunContext context;
  context.is_quiet = true;
  const LinearizedPhotos photos = LinearizePhotos(fitted.session, context);
  std::vector<StatePhotos> states = PhotosByState(fitted, photos);
  const PhotoCorrections corrections = ReadPhotoCorrections(fitted.out);
  const std::vector<LitRoom> lit = LightRoomByEach(fitted.room, fitted.luminaires, ChannelsOf(fitted));
  for (size_t v = 0; v < registered.size(); ++v) {
    const Camera& camera = fitted.registered.cameras[static_cast<size_t>(registered[v].camera)];
    CompareView(fitted, photos, corrections, lit, v, WidthFor(camera, registered.size() * states.size()),
                states);
  }
  double scale = fitted.camera_scale;
  page["scale_is_of_fit"] = scale > 0;
  if (!(scale > 0)) scale = QuantileOf(RatiosOf(states), 0.5);
  if (!(scale > 0)) return page;
  for (const StatePhotos& state : states) {
    std::vector<json> views(state.views.size());
    tbb::parallel_for(size_t{0}, views.size(), [&](size_t v) { views[v] = ViewJson(state.views[v], scale); });
    page["states"].push_back({{"id", state.state}, {"views", std::move(views)}});
  }
  return page;
}

}  // namespace luxfit
