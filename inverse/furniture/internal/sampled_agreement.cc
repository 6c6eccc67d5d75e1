#include "inverse/furniture/internal/sampled_agreement.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "inverse/furniture/internal/mesh_agreement.h"

namespace luxfit {
namespace {

constexpr int kSampleCells = 6;                   // 12 pixels
constexpr int kBlockColumns = 4, kBlockRows = 3;  // of a view
// Places nearer than this share of their distance are one: views tell depth no better.
constexpr double kSamePlaceShare = 0.01;

std::vector<PixelSample> SamplesOf(const RayScene& mesh, const std::vector<SignatureView>& views, size_t a,
                                   double tolerance) {
  const SignatureView& view = views[a];
  const std::vector<Eigen::Vector3d> eyes = EyesOf(views);
  Signatures signatures(view.states);
  const int columns = view.width_px / MeshAgreement::kCellPx, rows = view.height_px / MeshAgreement::kCellPx;
  std::vector<PixelSample> samples;
  for (int row = kSampleCells / 2; row < rows; row += kSampleCells) {
    for (int column = kSampleCells / 2; column < columns; column += kSampleCells) {
      PixelSample sample;
      sample.block = (static_cast<int>(a) * kBlockRows + row * kBlockRows / rows) * kBlockColumns +
                     column * kBlockColumns / columns;
      const Eigen::Vector3d ray = RayOf(view, column, row);
      const RayHit hit = mesh.Trace(eyes[a], ray);
      sample.distance_m = hit.facet < 0 ? std::numeric_limits<double>::infinity() : hit.distance;
      if (hit.facet >= 0) {
        const Eigen::Vector3d place = eyes[a] + hit.distance * ray;
        const OthersAt others =
            CompareOthers(views, a, place, tolerance, signatures, [&](size_t b, const Eigen::Vector2d&) {
              const double to_place_m = (place - eyes[b]).norm();
              const RayHit before = mesh.Trace(eyes[b], (place - eyes[b]) / to_place_m);
              return before.facet < 0 || to_place_m <= before.distance + kOnMeshM;
            });
        sample.is_compared = others.seen > 0;
        sample.is_explained = others.Explain();
      }
      samples.push_back(sample);
    }
  }
  return samples;
}

bool IsOnePlace(double a_m, double b_m) {
  if (!std::isfinite(a_m) || !std::isfinite(b_m)) return std::isfinite(a_m) == std::isfinite(b_m);
  return std::abs(a_m - b_m) < kSamePlaceShare * std::min(a_m, b_m);
}

}  // namespace

std::vector<PixelSample> SampleAgreement(const RayScene& mesh, const std::vector<SignatureView>& views,
                                         double tolerance) {
  std::vector<std::vector<PixelSample>> by_view(views.size());
  tbb::parallel_for(size_t{0}, views.size(),
                    [&](size_t a) { by_view[a] = SamplesOf(mesh, views, a, tolerance); });
  std::vector<PixelSample> samples;
  for (const std::vector<PixelSample>& of_view : by_view)
    samples.insert(samples.end(), of_view.begin(), of_view.end());
  return samples;
}

ComparedMeshes CompareMeshes(const std::vector<PixelSample>& a, const std::vector<PixelSample>& b) {
  ComparedMeshes compared;
  for (size_t i = 0; i < a.size(); ++i) {
    if (!(a[i].is_compared || b[i].is_compared) || IsOnePlace(a[i].distance_m, b[i].distance_m)) continue;
    compared.a[a[i].block].Add(a[i].is_explained ? 1 : 0);
    compared.b[a[i].block].Add(b[i].is_explained ? 1 : 0);
    ++compared.pixels;
  }
  return compared;
}

}  // namespace luxfit
