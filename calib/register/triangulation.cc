#include "calib/register/triangulation.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace luxfit {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Returns the angle between a sight and a point, in its sigmas; infinite for a point behind it.
double SigmasOff(const Sight& sight, const Vector3d& p) {
  const Vector3d to = p - sight.origin;
  const double along = to.dot(sight.direction);
  if (!(along > 0)) return std::numeric_limits<double>::infinity();
  return (to - along * sight.direction).norm() / (to.norm() * sight.sigma_rad);
}

// Returns the point nearest to two rays; nothing where they are nearly parallel.
std::optional<Vector3d> Meeting(const Sight& a, const Sight& b, double min_parallax_rad) {
  const double cosine = a.direction.dot(b.direction), sine2 = 1 - cosine * cosine;
  if (sine2 < std::pow(std::sin(min_parallax_rad), 2)) return std::nullopt;
  const Vector3d between = b.origin - a.origin;
  const double along_a = (between.dot(a.direction) - cosine * between.dot(b.direction)) / sine2;
  const double along_b = (cosine * between.dot(a.direction) - between.dot(b.direction)) / sine2;
  return 0.5 * (a.origin + along_a * a.direction + b.origin + along_b * b.direction);
}

class Triangulation {
 public:
  Triangulation(const std::vector<Sight>& sights, const TriangulationOptions& options)
      : sights_(sights), options_(options), is_taken_(sights.size(), false) {}

  std::vector<TriangulatedPoint> Run() {
    std::vector<TriangulatedPoint> proposed;
    const size_t n = sights_.size();
    for (size_t i = 0; i < n; ++i) {
      for (size_t j = i + 1; j < n; ++j) {
        const std::optional<Vector3d> start = MeetingOf(sights_[i], sights_[j]);
        const std::optional<TriangulatedPoint> point = start ? PointNear(*start) : std::nullopt;
        if (point) proposed.push_back(*point);
      }
    }
    std::stable_sort(proposed.begin(), proposed.end(), IsBetter);
    std::vector<TriangulatedPoint> points;
    for (const TriangulatedPoint& proposal : proposed) {
      std::optional<TriangulatedPoint> point = proposal;
      const auto is_taken = [&](int i) { return is_taken_[static_cast<size_t>(i)]; };
      if (std::any_of(proposal.sights.begin(), proposal.sights.end(), is_taken))
        point = PointNear(proposal.position);  // from the sights that are left
      if (!point) continue;
      for (const int i : point->sights) is_taken_[static_cast<size_t>(i)] = true;
      points.push_back(*point);
    }
    return points;
  }

 private:
  std::optional<Vector3d> MeetingOf(const Sight& a, const Sight& b) const {
    if (a.view == b.view) return std::nullopt;
    const std::optional<Vector3d> p = Meeting(a, b, options_.min_parallax_rad);
    const bool near = p && SigmasOff(a, *p) <= options_.max_sigmas && SigmasOff(b, *p) <= options_.max_sigmas;
    return near ? p : std::nullopt;
  }

  // Returns the point solved with the sights about p, and again with those about the solution.
  std::optional<TriangulatedPoint> PointNear(const Vector3d& p) const {
    TriangulatedPoint point;
    point.position = p;
    for (int round = 0; round < 2; ++round) {
      const std::vector<int> gathered = Gathered(point.position);
      if (static_cast<int>(gathered.size()) < std::max(2, options_.min_views)) return std::nullopt;
      if (gathered != point.sights) point = Solved(point.position, gathered);
    }
    return point.parallax_rad >= options_.min_parallax_rad ? std::optional(point) : std::nullopt;
  }

  // Returns the nearest sight of every view, if it is near enough.
  std::vector<int> Gathered(const Vector3d& p) const {
    std::map<int, std::pair<double, int>> nearest;  // by view: sigmas, sight
    for (size_t i = 0; i < sights_.size(); ++i) {
      if (is_taken_[i]) continue;
      const double off = SigmasOff(sights_[i], p);
      if (off > options_.max_sigmas) continue;
      const std::pair<double, int> entry(off, static_cast<int>(i));
      const auto [at, is_new] = nearest.emplace(sights_[i].view, entry);
      if (!is_new) at->second = std::min(at->second, entry);
    }
    std::vector<int> gathered;
    gathered.reserve(nearest.size());
    for (const auto& [view, entry] : nearest) gathered.push_back(entry.second);
    return gathered;
  }

  // Solves by Gauss-Newton with the distances held in each step, which small angles allow.
  TriangulatedPoint Solved(Vector3d p, const std::vector<int>& of) const {
    constexpr int kSteps = 5;
    Matrix3d normal;
    for (int step = 0; step < kSteps; ++step) {
      normal.setZero();
      Vector3d moment = Vector3d::Zero();
      for (const int i : of) {
        const Sight& s = sights_[static_cast<size_t>(i)];
        const double sigma_m = s.sigma_rad * (p - s.origin).norm();
        const Matrix3d across =
            (Matrix3d::Identity() - s.direction * s.direction.transpose()) / (sigma_m * sigma_m);
        normal += across;
        moment += across * s.origin;
      }
      p = normal.ldlt().solve(moment);
    }
    TriangulatedPoint point;
    point.position = p;
    point.covariance_m2 = normal.inverse();
    point.sights = of;
    for (size_t a = 0; a < of.size(); ++a) {
      const Sight& s = sights_[static_cast<size_t>(of[a])];
      point.rms_sigmas += std::pow(SigmasOff(s, p), 2) / static_cast<double>(of.size());
      for (size_t b = 0; b < a; ++b) {
        const double cosine = s.direction.dot(sights_[static_cast<size_t>(of[b])].direction);
        point.parallax_rad = std::max(point.parallax_rad, std::acos(std::clamp(cosine, -1.0, 1.0)));
      }
    }
    point.rms_sigmas = std::sqrt(point.rms_sigmas);
    return point;
  }

  static bool IsBetter(const TriangulatedPoint& a, const TriangulatedPoint& b) {
    if (a.sights.size() != b.sights.size()) return a.sights.size() > b.sights.size();
    return a.rms_sigmas < b.rms_sigmas;
  }

  const std::vector<Sight>& sights_;
  const TriangulationOptions& options_;
  std::vector<bool> is_taken_;
};

}  // namespace

std::vector<TriangulatedPoint> TriangulateSights(const std::vector<Sight>& sights,
                                                 const TriangulationOptions& options) {
  for (const Sight& sight : sights) {
    if (!(sight.sigma_rad > 0))
      throw std::invalid_argument("TriangulateSights: sigma_rad: expected > 0, got " +
                                  std::to_string(sight.sigma_rad));
  }
  return Triangulation(sights, options).Run();
}

}  // namespace luxfit
