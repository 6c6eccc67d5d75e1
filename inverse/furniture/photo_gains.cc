#include "inverse/furniture/photo_gains.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "forward/room/visibility.h"
#include "inverse/furniture/internal/mesh_agreement.h"
#include "inverse/select/internal/robust_weight.h"

namespace luxfit {
namespace {

constexpr int kSampleCells = 8;  // every 16 pixels of a view
// Rounds of least absolute differences, then all.
constexpr int kStartRounds = 8, kRounds = 20;
// Sigmas of the priors, wide: they settle what no pair of views tells.
constexpr double kGainSigma = 0.5, kVignettingSigma = 0.5;
constexpr double kMatters = 1. / 3;  // share of the tolerance: what registration and interpolation leave

// Holds what two views show of one place in one state.
struct Pair {
  int a = 0, b = 0, state = 0;
  double difference = 0;  // of ln Y, a less b
  double a_r2 = 0, b_r2 = 0;
};

double Radius2(const SignatureView& view, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d size(view.width_px, view.height_px);
  return (2 * pixel - size).squaredNorm() / size.squaredNorm();
}

// Compares what a view shows at a grid of its pixels with what the later views show there.
class PairsOfView {
 public:
  PairsOfView(const RayScene& mesh, const std::vector<SignatureView>& views,
              const std::vector<Eigen::Vector3d>& eyes, size_t a)
      : mesh_(mesh), views_(views), eyes_(eyes), a_(a) {}

  std::vector<Pair> Run() {
    const SignatureView& view = views_[a_];
    const int columns = view.width_px / MeshAgreement::kCellPx,
              rows = view.height_px / MeshAgreement::kCellPx;
    for (int row = kSampleCells / 2; row < rows; row += kSampleCells)
      for (int column = kSampleCells / 2; column < columns; column += kSampleCells) {
        const Eigen::Vector3d ray = RayOf(view, column, row);
        const RayHit hit = mesh_.Trace(eyes_[a_], ray);
        if (hit.facet >= 0) AddPlace(eyes_[a_] + hit.distance * ray);
      }
    return std::move(pairs_);
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
    for (int s = 0; s < views_[a_].states; ++s) {
      const double difference = ValueAt(views_[a_], own, s) - ValueAt(views_[b], pixel, s);
      if (std::isfinite(difference))
        pairs_.push_back({static_cast<int>(a_), static_cast<int>(b), s, difference, Radius2(views_[a_], own),
                          Radius2(views_[b], pixel)});
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
  const std::vector<Eigen::Vector3d>& eyes_;
  size_t a_;
  std::vector<Pair> pairs_;
};

std::vector<Pair> PairsOf(const Scene& mesh, const std::vector<SignatureView>& views) {
  const RayScene rays(mesh);
  const std::vector<Eigen::Vector3d> eyes = EyesOf(views);
  std::vector<std::vector<Pair>> of_view(views.size());
  tbb::parallel_for(size_t{0}, views.size(),
                    [&](size_t a) { of_view[a] = PairsOfView(rays, views, eyes, a).Run(); });
  std::vector<Pair> pairs;
  for (const std::vector<Pair>& some : of_view) pairs.insert(pairs.end(), some.begin(), some.end());
  return pairs;
}

// Numbers the unknowns: gains by view and state, then vignetting by camera and term.
class GainFit {
 public:
  GainFit(const std::vector<SignatureView>& views, double tolerance) : views_(views), tolerance_(tolerance) {
    for (const SignatureView& view : views) cameras_ = std::max(cameras_, view.camera + 1);
    x_ = Eigen::VectorXd::Zero(gains() + cameras_ * kVignettingTerms);
  }

  void Solve(const std::vector<Pair>& pairs) {
    for (int round = 0; round < kRounds; ++round) {
      Eigen::MatrixXd normal = Prior();
      Eigen::VectorXd right = Eigen::VectorXd::Zero(x_.size());
      for (const Pair& pair : pairs) Add(pair, round < kStartRounds, normal, right);
      x_ = normal.selfadjointView<Eigen::Lower>().ldlt().solve(right);
    }
  }

  PhotoGains Gains() const {
    PhotoGains found;
    const Eigen::Index states = views_.front().states;
    found.log_gain = x_.head(gains()).reshaped(states, static_cast<Eigen::Index>(views_.size())).transpose();
    found.vignetting = x_.tail(cameras_ * kVignettingTerms).reshaped(kVignettingTerms, cameras_);
    const double least = kMatters * tolerance_;
    found.matter = (found.log_gain.array().abs() > least).any() ||
                   (found.vignetting.colwise().sum().array().abs() > least).any();
    return found;
  }

 private:
  static constexpr int kOfPair = 2 + 2 * kVignettingTerms;

  Eigen::Index gains() const { return static_cast<Eigen::Index>(views_.size()) * views_.front().states; }
  Eigen::Index GainAt(int view, int state) const {
    return static_cast<Eigen::Index>(view) * views_.front().states + state;
  }

  Eigen::MatrixXd Prior() const {
    Eigen::VectorXd diagonal =
        Eigen::VectorXd::Constant(x_.size(), 1 / (kVignettingSigma * kVignettingSigma));
    diagonal.head(gains()).setConstant(1 / (kGainSigma * kGainSigma));
    return diagonal.asDiagonal();
  }

  // Adds a pair to the lower triangle of the normal equations.
  void Add(const Pair& pair, bool is_start, Eigen::MatrixXd& normal, Eigen::VectorXd& right) const {
    std::array<Eigen::Index, kOfPair> at{GainAt(pair.a, pair.state), GainAt(pair.b, pair.state)};
    std::array<double, kOfPair> by{1, -1};
    double a_power = 1, b_power = 1;
    for (int k = 0; k < kVignettingTerms; ++k) {
      a_power *= pair.a_r2;
      b_power *= pair.b_r2;
      const auto i = static_cast<size_t>(2 + 2 * k);
      at[i] = gains() + views_[static_cast<size_t>(pair.a)].camera * kVignettingTerms + k;
      at[i + 1] = gains() + views_[static_cast<size_t>(pair.b)].camera * kVignettingTerms + k;
      by[i] = a_power;
      by[i + 1] = -b_power;
    }
    double residual = pair.difference;
    for (size_t i = 0; i < at.size(); ++i) residual -= by[i] * x_[at[i]];
    const double z = std::abs(residual) / tolerance_;
    const double weight = (is_start ? 1 / std::max(1.0, z) : CauchyWeight(z, 1)) / (tolerance_ * tolerance_);
    for (size_t i = 0; i < at.size(); ++i) {
      right[at[i]] += weight * by[i] * pair.difference;
      for (size_t j = 0; j < at.size(); ++j)
        if (at[i] >= at[j]) normal(at[i], at[j]) += weight * by[i] * by[j];
    }
  }

  const std::vector<SignatureView>& views_;
  double tolerance_;
  int cameras_ = 0;
  Eigen::VectorXd x_;
};

}  // namespace

PhotoGains EstimatePhotoGains(const Scene& mesh, const std::vector<SignatureView>& views, double tolerance) {
  if (views.empty()) return {};
  GainFit fit(views, tolerance);
  fit.Solve(PairsOf(mesh, views));
  return fit.Gains();
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
