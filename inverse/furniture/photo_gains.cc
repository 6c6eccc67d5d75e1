#include "inverse/furniture/photo_gains.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "forward/room/visibility.h"
#include "inverse/furniture/internal/mesh_agreement.h"
#include "inverse/select/internal/robust_rows.h"

namespace luxfit {
namespace {

constexpr int kSampleCells = 8;  // every 16 pixels of a view
// Sigma of the prior of each, wide: it settles what no pair of views tells.
constexpr double kGainSigma = 0.5;
constexpr double kMatters = 1. / 3;  // share of the tolerance: what registration and interpolation leave

double Radius2(const SignatureView& view, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d size(view.width_px, view.height_px);
  return (2 * pixel - size).squaredNorm() / size.squaredNorm();
}

// Numbers the unknowns: gains by view and state, then vignetting by camera and term.
class GainNumbers {
 public:
  explicit GainNumbers(const std::vector<SignatureView>& views) : views_(views) {
    for (const SignatureView& view : views) cameras_ = std::max(cameras_, view.camera + 1);
  }

  int states() const { return views_.front().states; }
  int gains() const { return static_cast<int>(views_.size()) * states(); }
  int terms() const { return cameras_ * kVignettingTerms; }
  int cameras() const { return cameras_; }

  // Adds the terms of ln Y in a view's photo at a pixel.
  void AddTerms(size_t view, int state, double radius2, double sign,
                std::vector<RobustRows::Term>& terms) const {
    terms.push_back({static_cast<int>(view) * states() + state, sign});
    double power = sign;
    for (int k = 0; k < kVignettingTerms; ++k)
      terms.push_back({gains() + views_[view].camera * kVignettingTerms + k, power *= radius2});
  }

 private:
  const std::vector<SignatureView>& views_;
  int cameras_ = 0;
};

// Compares what a view shows at a grid of its pixels with what the others show there.
class PairsOfView {
 public:
  PairsOfView(const RayScene& mesh, const std::vector<SignatureView>& views,
              const std::vector<Eigen::Vector3d>& eyes, size_t a)
      : mesh_(mesh), views_(views), numbers_(views), eyes_(eyes), a_(a) {}

  RobustRows Run() {
    const SignatureView& view = views_[a_];
    const int columns = view.width_px / MeshAgreement::kCellPx,
              rows = view.height_px / MeshAgreement::kCellPx;
    for (int row = kSampleCells / 2; row < rows; row += kSampleCells)
      for (int column = kSampleCells / 2; column < columns; column += kSampleCells) {
        const Eigen::Vector3d ray = RayOf(view, column, row);
        const RayHit hit = mesh_.Trace(eyes_[a_], ray);
        if (hit.facet >= 0) AddPlace(eyes_[a_] + hit.distance * ray);
      }
    return std::move(rows_);
  }

 private:
  void AddPlace(const Eigen::Vector3d& place) {
    const Eigen::Vector2d own = PixelOf(views_[a_], place);
    if (!own.allFinite()) return;
    for (size_t b = 0; b < views_.size(); ++b) {
      if (b == a_) continue;
      const Eigen::Vector2d pixel = PixelOf(views_[b], place);
      if (pixel.allFinite() && Sees(b, place)) AddStates(own, b, pixel);
    }
  }

  bool Sees(size_t b, const Eigen::Vector3d& place) const {
    const double to_place_m = (place - eyes_[b]).norm();
    const RayHit first = mesh_.Trace(eyes_[b], (place - eyes_[b]) / to_place_m);
    return first.facet < 0 || to_place_m <= first.distance + kOnMeshM;
  }

  void AddStates(const Eigen::Vector2d& own, size_t b, const Eigen::Vector2d& pixel) {
    for (int s = 0; s < numbers_.states(); ++s) {
      const double difference = ValueAt(views_[a_], own, s) - ValueAt(views_[b], pixel, s);
      if (!std::isfinite(difference)) continue;
      std::vector<RobustRows::Term> terms;
      numbers_.AddTerms(a_, s, Radius2(views_[a_], own), 1, terms);
      numbers_.AddTerms(b, s, Radius2(views_[b], pixel), -1, terms);
      rows_.Add(terms, difference, 1, 0);
    }
  }

  static double ValueAt(const SignatureView& view, const Eigen::Vector2d& pixel, int state) {
    const auto u = static_cast<size_t>(std::lround(pixel.x())),
               v = static_cast<size_t>(std::lround(pixel.y()));
    return view
        .log_luminance[(v * static_cast<size_t>(view.width_px) + u) * static_cast<size_t>(view.states) +
                       static_cast<size_t>(state)];
  }

  const RayScene& mesh_;
  const std::vector<SignatureView>& views_;
  const GainNumbers numbers_;
  const std::vector<Eigen::Vector3d>& eyes_;
  size_t a_;
  RobustRows rows_;
};

RobustRows PairsOf(const Scene& mesh, const std::vector<SignatureView>& views) {
  const RayScene rays(mesh);
  const std::vector<Eigen::Vector3d> eyes = EyesOf(views);
  std::vector<RobustRows> of_view(views.size());
  tbb::parallel_for(size_t{0}, views.size(),
                    [&](size_t a) { of_view[a] = PairsOfView(rays, views, eyes, a).Run(); });
  RobustRows pairs;
  for (const RobustRows& some : of_view) pairs.Add(some);
  return pairs;
}

}  // namespace

PhotoGains EstimatePhotoGains(const Scene& mesh, const std::vector<SignatureView>& views, double tolerance) {
  if (views.empty()) return {};
  const GainNumbers numbers(views);
  const RobustRows pairs = PairsOf(mesh, views);
  const Eigen::VectorXd x = pairs.Solve(0, kGainSigma, numbers.gains() + numbers.terms(), -1);
  PhotoGains found;
  found.log_gain =
      x.head(numbers.gains()).reshaped(numbers.states(), static_cast<Eigen::Index>(views.size())).transpose();
  found.vignetting = x.tail(numbers.terms()).reshaped(kVignettingTerms, numbers.cameras());
  const double least = kMatters * tolerance;
  const bool are_large = (found.log_gain.array().abs() > least).any() ||
                         (found.vignetting.colwise().sum().array().abs() > least).any();
  found.matter = are_large && pairs.NoiseAt(x) <= std::sqrt(2) * tolerance;
  return found;
}

std::vector<SignatureView> WithoutGains(std::vector<SignatureView> views, const PhotoGains& gains) {
  if (!gains.matter) return views;
  for (size_t n = 0; n < views.size(); ++n) {
    SignatureView& view = views[n];
    const Eigen::VectorXd log_gain = gains.log_gain.row(static_cast<Eigen::Index>(n));
    const Eigen::VectorXd c = gains.vignetting.col(view.camera);
    float* y = view.log_luminance.data();
    for (int v = 0; v < view.height_px; ++v)
      for (int u = 0; u < view.width_px; ++u) {
        const double r2 = Radius2(view, {u, v});
        double darker = 0;
        for (Eigen::Index k = c.size(); k-- > 0;) darker = (darker + c[k]) * r2;
        for (int s = 0; s < view.states; ++s) *y++ -= static_cast<float>(log_gain[s] + darker);
      }
  }
  return views;
}

}  // namespace luxfit
