#include "inverse/furniture/internal/offset_sweep.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "inverse/furniture/internal/cell_judge.h"
#include "inverse/furniture/internal/mesh_agreement.h"
#include "inverse/furniture/internal/signature.h"

namespace luxfit {
namespace {

constexpr double kBeforeM = 0.01;  // what lies before a place by less does not hide it

using Row6 = Eigen::Matrix<double, 1, 6>;

// Says how the place of the plane that a pixel shows moves along the plane. `to_place`: from the eye.
struct PixelMotion {
  Eigen::Vector3d with_offset;
  Eigen::Matrix<double, 3, 6> with_pose;

  PixelMotion(const Eigen::Vector3d& to_place, const Eigen::Vector3d& normal) {
    const Eigen::Vector3d along_ray = to_place / normal.dot(to_place);
    with_offset = along_ray - normal;
    Eigen::Matrix<double, 3, 6> of_ray;
    of_ray.leftCols<3>() << 0, to_place.z(), -to_place.y(), -to_place.z(), 0, to_place.x(), to_place.y(),
        -to_place.x(), 0;
    of_ray.rightCols<3>().setIdentity();
    with_pose = of_ray - along_ray * (normal.transpose() * of_ray);
  }
};

double OffsetOf(int step) { return (step - kOffsetSteps) * kOffsetStepM; }

// It is a class because eyes and buffers serve all places.
class OffsetSweeper {
 public:
  OffsetSweeper(const HullPlane& plane, const RayScene& mesh, const std::vector<SignatureView>& views,
                double tolerance)
      : plane_(plane),
        mesh_(mesh),
        views_(views),
        tolerance_(tolerance),
        eyes_(EyesOf(views)),
        by_pose_(views.size(), Row6::Zero()) {
    for (int k = 0; k < kOffsets; ++k) signatures_.emplace_back(views.front().states);
  }

  SweptOffsets Run() {
    const auto places = static_cast<Eigen::Index>(plane_.cells.size()),
               views = static_cast<Eigen::Index>(views_.size());
    SweptOffsets swept{OffsetLosses::Zero(places, kOffsets), std::vector<int>(plane_.cells.size(), 0),
                       OffsetLosses::Zero(views, kOffsets), std::vector<int>(views_.size(), 0)};
    for (size_t i = 0; i < plane_.cells.size(); ++i) {
      FindSeeing(plane_.cells[i]);
      for (size_t a = 0; a < seeing_.size(); ++a)
        for (size_t b = 0; b < a; ++b) AddPair(i, a, b, swept);
    }
    if (parallax2_ > 0) swept.pose_sigma_m = std::sqrt(PoseVariance());
    return swept;
  }

 private:
  // Keeps the views that see the place at all offsets, with its signatures.
  void FindSeeing(const PieceCell& cell) {
    seeing_.clear();
    for (Signatures& at : signatures_) at.Clear();
    for (size_t v = 0; v < views_.size(); ++v) {
      if (!FacesAllOffsets(cell, v) || IsHidden(cell, v)) continue;
      std::array<Eigen::Vector2d, kOffsets> pixels;
      bool is_whole = true;
      for (int k = 0; k < kOffsets && is_whole; ++k) {
        pixels[static_cast<size_t>(k)] = PixelOf(views_[v], cell.place + OffsetOf(k) * cell.normal);
        is_whole = pixels[static_cast<size_t>(k)].allFinite();
      }
      if (is_whole && AddAll(v, pixels)) seeing_.push_back(v);
    }
  }

  bool FacesAllOffsets(const PieceCell& cell, size_t v) const {
    for (const double offset : {-kOffsetReachM, kOffsetReachM}) {
      const Eigen::Vector3d to_eye = eyes_[v] - cell.place - offset * cell.normal;
      if (to_eye.dot(cell.normal) < kLeastCosine * to_eye.norm()) return false;
    }
    return true;
  }

  // Tells whether something lies before the place at an end of the sweep or in its middle. The plane itself does not.
  bool IsHidden(const PieceCell& cell, size_t v) const {
    for (const double offset : {-kOffsetReachM, 0.0, kOffsetReachM}) {
      const Eigen::Vector3d ray = cell.place + offset * cell.normal - eyes_[v];
      const double distance = ray.norm();
      const double to_plane =
          distance * (plane_.offset_m - plane_.normal.dot(eyes_[v])) / plane_.normal.dot(ray);
      const RayHit hit = mesh_.Trace(eyes_[v], ray / distance);
      if (hit.facet >= 0 && hit.distance < std::min(distance, to_plane) - kBeforeM) return true;
    }
    return false;
  }

  // Adds the signatures of a view at all offsets, or none.
  bool AddAll(size_t v, const std::array<Eigen::Vector2d, kOffsets>& pixels) {
    for (size_t k = 0; k < pixels.size(); ++k) {
      if (signatures_[k].Add(views_[v], pixels[k].x(), pixels[k].y())) continue;
      for (size_t done = 0; done < k; ++done) signatures_[done].DropLast();
      return false;
    }
    return true;
  }

  double PoseVariance() const {
    double variance = 0;
    for (size_t v = 0; v < views_.size(); ++v)
      variance += by_pose_[v].dot(by_pose_[v] * views_[v].pose_covariance) / (parallax2_ * parallax2_);
    return variance;
  }

  void AddPair(size_t place, size_t a, size_t b, SweptOffsets& swept) {
    Eigen::Array<double, 1, kOffsets> losses;
    for (int k = 0; k < kOffsets; ++k) {
      const double q = signatures_[static_cast<size_t>(k)].Difference(static_cast<int>(a),
                                                                      static_cast<int>(b), tolerance_);
      losses[k] = q / (1 + q);
    }
    if (!losses.allFinite()) return;
    swept.by_place.row(static_cast<Eigen::Index>(place)) += losses;
    ++swept.pairs_of_place[place];
    for (const size_t v : {seeing_[a], seeing_[b]}) {
      swept.by_view.row(static_cast<Eigen::Index>(v)) += losses;
      ++swept.pairs_of_view[v];
    }
    const Eigen::Vector3d& p = plane_.cells[place].place;
    const PixelMotion of_a(p - eyes_[seeing_[a]], plane_.normal), of_b(p - eyes_[seeing_[b]], plane_.normal);
    const Eigen::Vector3d parallax = of_a.with_offset - of_b.with_offset;
    parallax2_ += parallax.squaredNorm();
    by_pose_[seeing_[a]] += parallax.transpose() * of_a.with_pose;
    by_pose_[seeing_[b]] -= parallax.transpose() * of_b.with_pose;
  }

  const HullPlane& plane_;
  const RayScene& mesh_;
  const std::vector<SignatureView>& views_;
  double tolerance_;
  std::vector<Eigen::Vector3d> eyes_;
  std::vector<Signatures> signatures_;  // by offset
  std::vector<size_t> seeing_;
  std::vector<Row6> by_pose_;  // by view: how the offset moves with its pose, times parallax2_
  double parallax2_ = 0;
};

}  // namespace

SweptOffsets SweepOffsets(const HullPlane& plane, const RayScene& mesh,
                          const std::vector<SignatureView>& views, double tolerance) {
  return OffsetSweeper(plane, mesh, views, tolerance).Run();
}

}  // namespace luxfit
