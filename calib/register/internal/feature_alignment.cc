#include "calib/register/internal/feature_alignment.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "calib/lens/internal/rotation_vector.h"
#include "calib/targets/internal/boards/solve_symmetric.h"

namespace luxfit {
namespace {

constexpr double kAgreementFraction = 0.15;  // in tag sides: reconstructions drift by centimetres

struct Sight {
  const BundleView* view = nullptr;
  std::size_t tag = 0;  // index into view->tags
  Eigen::Isometry3d cam_from_model;

  const TagObservation& Tag() const { return view->tags[tag]; }
};

std::vector<Sight> SightsOf(const std::vector<BundleView>& views, const FeatureModel& features,
                            const std::vector<std::size_t>& view_of) {
  std::vector<Sight> sights;
  for (std::size_t v = 0; v < features.views.size(); ++v) {
    const BundleView& view = views[view_of[v]];
    for (std::size_t i = 0; i < view.tags.size(); ++i)
      sights.push_back({&view, i, features.views[v].cam_from_model});
  }
  return sights;
}

double TolerancePx(const TagObservation& tag) { return 6 * tag.sigma_px + kAgreementFraction * tag.side_px; }

// Returns the point nearest to the rays of a pixel in several views; NaN where they are almost parallel.
Eigen::Vector3d NearestToRays(const BundleContext& context, const std::vector<Sight>& sights,
                              std::size_t corner) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Sight& sight : sights) {
    const Eigen::Isometry3d model_from_cam = sight.cam_from_model.inverse();
    const Eigen::Vector3d ray =
        model_from_cam.linear() * Unproject(context.CameraOf(*sight.view), sight.Tag().corners_px[corner]);
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - ray * ray.transpose();
    normal += across;
    right += across * model_from_cam.translation();
  }
  constexpr double kLeastParallax = 0.02;  // rad; below it depth is unreliable
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normal);
  // Two rays at an angle a: the least eigenvalue is 1 - cos a.
  if (!normal.allFinite() || eigen.eigenvalues()[0] < kLeastParallax * kLeastParallax / 2) {
    return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  return normal.ldlt().solve(right);
}

// Returns the worst of the sights' rms errors, in units of their tolerance, and its index.
std::pair<double, std::size_t> WorstSight(const BundleContext& context, const std::vector<Sight>& sights,
                                          const Eigen::Matrix<double, 3, 4>& corners_in_model) {
  std::pair<double, std::size_t> worst{-1, 0};
  for (std::size_t s = 0; s < sights.size(); ++s) {
    double sum = 0;
    for (Eigen::Index i = 0; i < 4; ++i) {
      const Eigen::Vector2d pixel =
          Project(context.CameraOf(*sights[s].view), sights[s].cam_from_model * corners_in_model.col(i));
      sum += (pixel - sights[s].Tag().corners_px[static_cast<std::size_t>(i)]).squaredNorm() / 4;
    }
    const double error = std::isfinite(sum) ? std::sqrt(sum) / TolerancePx(sights[s].Tag())
                                            : std::numeric_limits<double>::infinity();
    if (error > worst.first) worst = {error, s};
  }
  return worst;
}

std::optional<TriangulatedTag> Triangulate(const BundleContext& context, std::vector<Sight> sights) {
  while (sights.size() >= 2) {
    TriangulatedTag tag;
    tag.tag = &sights.front().Tag();
    for (std::size_t i = 0; i < 4; ++i)
      tag.corners_in_model.col(static_cast<Eigen::Index>(i)) = NearestToRays(context, sights, i);
    if (!tag.corners_in_model.allFinite()) return std::nullopt;
    const auto [error, worst] = WorstSight(context, sights, tag.corners_in_model);
    if (error <= 1) return tag;
    sights.erase(sights.begin() + static_cast<std::ptrdiff_t>(worst));
  }
  return std::nullopt;
}

void Append(Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& more) {
  points.conservativeResize(Eigen::NoChange, points.cols() + more.cols());
  points.rightCols(more.cols()) = more;
}

std::vector<Similarity> ProposalsOfTags(const std::vector<TriangulatedTag>& tags) {
  std::vector<Similarity> proposals;
  constexpr std::size_t kMostPairs = 12;  // pairs of a tag with later ones
  for (std::size_t i = 0; i < tags.size(); ++i) {
    for (std::size_t j = i; j < std::min(tags.size(), i + kMostPairs); ++j) {
      Eigen::Matrix3Xd in_model(3, 0), in_world(3, 0);
      for (const std::size_t k : {i, j}) {
        if (k == j && i == j && in_model.cols() > 0) break;
        Append(in_model, tags[k].corners_in_model);
        for (const Eigen::Vector3d& corner : tags[k].tag->corners_in_world) Append(in_world, corner);
      }
      if (const std::optional<Similarity> fit = FitSimilarity(in_model, in_world)) proposals.push_back(*fit);
    }
  }
  return proposals;
}

// Returns the proposals of pairs of views: two views give the scale by their distance, and each the rotation.
std::vector<Similarity> ProposalsOfViews(const std::vector<BundleView>& views, const FeatureModel& features,
                                         const std::vector<std::size_t>& view_of) {
  std::vector<std::size_t> posed;
  for (std::size_t v = 0; v < features.views.size(); ++v) {
    if (views[view_of[v]].active) posed.push_back(v);
  }
  std::vector<Similarity> proposals;
  constexpr std::size_t kMostPairs = 12;
  for (std::size_t i = 0; i < posed.size(); ++i) {
    for (std::size_t j = i + 1; j < std::min(posed.size(), i + kMostPairs); ++j) {
      const Eigen::Isometry3d world_from_a = views[view_of[posed[i]]].CamFromWorld().inverse(),
                              world_from_b = views[view_of[posed[j]]].CamFromWorld().inverse(),
                              model_from_a = features.views[posed[i]].cam_from_model.inverse(),
                              model_from_b = features.views[posed[j]].cam_from_model.inverse();
      const double in_model = (model_from_a.translation() - model_from_b.translation()).norm();
      Similarity proposal;
      proposal.scale = (world_from_a.translation() - world_from_b.translation()).norm() / in_model;
      if (!std::isfinite(proposal.scale) || proposal.scale <= 0) continue;
      proposal.rotation = world_from_a.linear() * model_from_a.linear().transpose();
      proposal.translation =
          world_from_a.translation() - proposal.scale * (proposal.rotation * model_from_a.translation());
      proposals.push_back(proposal);
    }
  }
  return proposals;
}

bool Agrees(const BundleContext& context, const Sight& sight, const Similarity& world_from_model) {
  return TagRmsPx(context.CameraOf(*sight.view), PoseUnder(world_from_model, sight.cam_from_model),
                  sight.Tag()) <= TolerancePx(sight.Tag());
}

std::vector<Sight> Agreeing(const BundleContext& context, const std::vector<Sight>& sights,
                            const Similarity& world_from_model) {
  std::vector<Sight> agreeing;
  for (const Sight& sight : sights) {
    if (Agrees(context, sight, world_from_model)) agreeing.push_back(sight);
  }
  return agreeing;
}

// Holds one corner's part in the normal equations of (rotation vector, shift, log scale) of model_from_world.
struct Normal {
  Eigen::Matrix<double, 7, 7> left = Eigen::Matrix<double, 7, 7>::Zero();
  Eigen::Matrix<double, 7, 1> right = Eigen::Matrix<double, 7, 1>::Zero();
};

void AddCorner(const BundleContext& context, const Sight& sight, std::size_t corner,
               const Similarity& model_from_world, Normal& normal) {
  const Eigen::Vector3d turned =
      model_from_world.scale * (model_from_world.rotation * sight.Tag().corners_in_world[corner]);
  const Projection projection = ProjectWithJacobian(
      context.CameraOf(*sight.view), sight.cam_from_model * (turned + model_from_world.translation));
  if (!projection.pixel.allFinite()) return;
  Eigen::Matrix<double, 3, 7> d_point;
  d_point << 0, turned.z(), -turned.y(), 1, 0, 0, turned.x(), -turned.z(), 0, turned.x(), 0, 1, 0, turned.y(),
      turned.y(), -turned.x(), 0, 0, 0, 1, turned.z();
  const Eigen::Matrix<double, 2, 7> d = projection.d_pixel_d_point * sight.cam_from_model.linear() * d_point;
  const Eigen::Vector2d error = projection.pixel - sight.Tag().corners_px[corner];
  const double sigma_px = sight.Tag().sigma_px;
  const double weight =
      std::min(1.0, context.options.huber_sigmas * sigma_px / error.norm()) / (sigma_px * sigma_px);
  normal.left += weight * d.transpose() * d;
  normal.right -= weight * d.transpose() * error;
}

Similarity Refine(const BundleContext& context, const std::vector<Sight>& sights, const Similarity& start) {
  Similarity model_from_world = start.Inverse();
  for (int iteration = 0; iteration < 20; ++iteration) {
    Normal normal;
    for (const Sight& sight : sights) {
      for (std::size_t corner = 0; corner < 4; ++corner)
        AddCorner(context, sight, corner, model_from_world, normal);
    }
    const Eigen::Matrix<double, 7, 1> step = SolveSymmetric(normal.left, normal.right);
    if (!step.allFinite()) return start;
    const Eigen::Vector3d turn = step.head<3>();
    model_from_world.rotation = RotationBy(turn) * model_from_world.rotation;
    model_from_world.translation += step.segment<3>(3);
    model_from_world.scale *= std::exp(std::clamp(step[6], -0.5, 0.5));
    if (turn.norm() < 1e-12 && std::abs(step[6]) < 1e-12) break;
  }
  return model_from_world.Inverse();
}

}  // namespace

std::vector<bool> AgreeingTags(const BundleContext& context, const BundleView& view,
                               const Eigen::Isometry3d& cam_from_world) {
  std::vector<bool> agrees;
  agrees.reserve(view.tags.size());
  for (const TagObservation& tag : view.tags)
    agrees.push_back(TagRmsPx(context.CameraOf(view), cam_from_world, tag) <= TolerancePx(tag));
  return agrees;
}

std::vector<TriangulatedTag> TriangulateTags(const BundleContext& context,
                                             const std::vector<BundleView>& views,
                                             const FeatureModel& features,
                                             const std::vector<std::size_t>& view_of) {
  std::map<int, std::vector<Sight>> sights_of_tag;
  for (const Sight& sight : SightsOf(views, features, view_of))
    sights_of_tag[sight.Tag().id].push_back(sight);
  std::vector<TriangulatedTag> tags;
  for (const auto& [id, sights] : sights_of_tag) {
    if (const std::optional<TriangulatedTag> tag = Triangulate(context, sights)) tags.push_back(*tag);
  }
  return tags;
}

std::optional<FeatureAlignment> AlignToTags(const BundleContext& context,
                                            const std::vector<BundleView>& views,
                                            const FeatureModel& features,
                                            const std::vector<std::size_t>& view_of) {
  const std::vector<Sight> sights = SightsOf(views, features, view_of);
  std::vector<Similarity> proposals = ProposalsOfTags(TriangulateTags(context, views, features, view_of));
  const std::vector<Similarity> of_views = ProposalsOfViews(views, features, view_of);
  proposals.insert(proposals.end(), of_views.begin(), of_views.end());
  FeatureAlignment best;
  best.detections = static_cast<int>(sights.size());
  for (const Similarity& proposal : proposals) {
    const auto agreeing = static_cast<int>(Agreeing(context, sights, proposal).size());
    if (agreeing <= best.agreeing) continue;
    best.agreeing = agreeing;
    best.world_from_model = proposal;
  }
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds && best.agreeing > 0; ++round) {
    const Similarity refined =
        Refine(context, Agreeing(context, sights, best.world_from_model), best.world_from_model);
    const auto agreeing = static_cast<int>(Agreeing(context, sights, refined).size());
    if (agreeing < best.agreeing) break;
    best.agreeing = agreeing;
    best.world_from_model = refined;
  }
  if (best.agreeing < 2 || 2 * best.agreeing < best.detections) return std::nullopt;
  return best;
}

}  // namespace luxfit
