#include "inverse/furniture/internal/facet_picture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "calib/luminance/median.h"
#include "inverse/furniture/internal/mesh_agreement.h"

namespace luxfit {
namespace {

// Returns a view's ln Y in all states at a place; empty where it shows the place in none.
std::vector<float> SignatureAt(const Eigen::Vector3d& place, const Eigen::Vector3d& normal,
                               const RayScene& rays, const SignatureView& view) {
  const Eigen::Vector3d eye = view.Eye();
  if (normal.dot(eye - place) <= 0) return {};
  const Eigen::Vector2d p = PixelOf(view, place);
  if (!p.allFinite() || rays.Occluded(eye, LiftedOff(place, normal))) return {};
  const auto column = static_cast<size_t>(std::lround(p.x())), row = static_cast<size_t>(std::lround(p.y()));
  const auto states = static_cast<size_t>(view.states);
  const float* first =
      view.log_luminance.data() + (row * static_cast<size_t>(view.width_px) + column) * states;
  if (std::none_of(first, first + states, [](float value) { return std::isfinite(value); })) return {};
  return {first, first + states};
}

// Returns the median over states of |signature - cell|; infinite where no state is known of both.
double Apart(const std::vector<float>& signature, const float* cell) {
  std::vector<double> apart;
  for (size_t s = 0; s < signature.size(); ++s) {
    const double difference = std::abs(static_cast<double>(signature[s]) - static_cast<double>(cell[s]));
    if (std::isfinite(difference)) apart.push_back(difference);
  }
  return apart.empty() ? std::numeric_limits<double>::infinity() : Median(std::move(apart));
}

// Writes the medians over views of a cell in all states. Returns how far views are apart.
double FillCell(const std::vector<std::vector<float>>& signatures, size_t states, float* cell) {
  for (size_t s = 0; s < states; ++s) {
    std::vector<double> values;
    for (const std::vector<float>& signature : signatures)
      if (std::isfinite(signature[s])) values.push_back(static_cast<double>(signature[s]));
    if (!values.empty()) cell[s] = static_cast<float>(Median(std::move(values)));
  }
  if (signatures.size() < static_cast<size_t>(kLeastViews)) return std::numeric_limits<double>::infinity();
  std::vector<double> apart;
  apart.reserve(signatures.size());
  for (const std::vector<float>& signature : signatures) apart.push_back(Apart(signature, cell));
  std::sort(apart.begin(), apart.end());
  return apart[static_cast<size_t>(std::ceil(kAgreeing * static_cast<double>(apart.size()))) - 1];
}

}  // namespace

double FacetPicture::Step(size_t a, size_t b) const {
  std::vector<double> steps;
  const auto n = static_cast<size_t>(states);
  for (size_t s = 0; s < n; ++s) {
    const double step =
        static_cast<double>(log_luminance[b * n + s]) - static_cast<double>(log_luminance[a * n + s]);
    if (std::isfinite(step)) steps.push_back(step);
  }
  return steps.empty() ? std::numeric_limits<double>::quiet_NaN() : Median(std::move(steps));
}

FacetPicture PictureOf(const Facet& facet, const RayScene& rays, const std::vector<SignatureView>& views) {
  FacetPicture picture;
  if (views.empty()) return picture;
  const double across_m = facet.edge_u.norm(), up_m = facet.edge_v.norm();
  picture.columns = std::max(1, static_cast<int>(std::lround(across_m / kPictureCellM)));
  picture.rows = std::max(1, static_cast<int>(std::lround(up_m / kPictureCellM)));
  picture.width_m = across_m / picture.columns;
  picture.height_m = up_m / picture.rows;
  picture.states = views.front().states;
  const auto states = static_cast<size_t>(picture.states);
  picture.log_luminance.assign(
      static_cast<size_t>(picture.rows) * static_cast<size_t>(picture.columns) * states,
      std::numeric_limits<float>::quiet_NaN());
  picture.apart.resize(static_cast<size_t>(picture.rows) * static_cast<size_t>(picture.columns));
  const Eigen::Vector3d normal = facet.Normal();
  tbb::parallel_for(0, picture.rows, [&](int row) {
    for (int column = 0; column < picture.columns; ++column) {
      const Eigen::Vector3d place =
          facet.PointAt((column + 0.5) / picture.columns, (row + 0.5) / picture.rows);
      std::vector<std::vector<float>> signatures;
      for (const SignatureView& view : views) {
        std::vector<float> signature = SignatureAt(place, normal, rays, view);
        if (!signature.empty()) signatures.push_back(std::move(signature));
      }
      const size_t cell = picture.At(row, column);
      picture.apart[cell] =
          static_cast<float>(FillCell(signatures, states, &picture.log_luminance[cell * states]));
    }
  });
  return picture;
}

}  // namespace luxfit
