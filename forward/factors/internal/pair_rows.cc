// Form-factor rows pair by pair: closed form or quadrature of what would be seen, times the share that is
// visible.
//
// Pairs that shaft culling proves free need no ray. Unoccluded factors, by distance d against the larger
// radius R of the two:
//   d > 4 R      Gauss 2 x 2 points on the patch, 1 (small elements) or 2 x 2 on the element: relative error
//                < 2e-3, typically 3e-4
//   d > 2.2 R    Gauss 3 x 3 on the patch, 2 x 2 or 3 x 3 on the element: < 6e-4
//   nearer       closed form, point to polygon from Gauss points of a small element, or the double contour
// Partly hidden pairs get rays between points spread over both, one at least and as many as their share of
// the hemisphere asks for; four times as many where those disagree. Elements that are partly inside a solid
// cast rays over the hemisphere.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "forward/factors/internal/methods.h"
#include "forward/factors/internal/patch_sight.h"
#include "forward/factors/internal/ray_rows.h"
#include "forward/factors/internal/unoccluded.h"
#include "forward/factors/internal/visible_share.h"

namespace luxfit {
namespace {

constexpr int kProbeRays = 8;  // per element, to learn whether the room is closed
constexpr int kPartlyBuriedFactor =
    16;  // rays for elements that are partly inside a solid, in units of the others'
// Shaft culling compares pairs of facets with each other facet: beyond this many, rays cost less.
constexpr size_t kMaxFacetsForHybrid = 400;
constexpr double kClosed = 1e-5;  // escaped share of the probes below which a room counts as closed

// What receivers on one patch have in common.
struct PatchView {
  std::vector<float> sees;  // 1 where some part of the patch may see that patch
  std::vector<int> near;    // not to be had from the rule for distant ones
  std::vector<int> partial;
};

class PairRows {
 public:
  PairRows(const RayScene& rays, const Patches& patches, bool contour_always, int rays_per_element)
      : rays_(rays),
        patches_(patches),
        rays_per_element_(rays_per_element),
        sight_(patches),
        unoccluded_(patches, contour_always),
        buried_(rays, patches, FormFactorMethod::kMalley, kPartlyBuriedFactor * rays_per_element) {
    Probe();
  }

  // Shares that escape and that meet a back, found with a few rays.
  const RayTally& probe() const { return probe_; }
  bool IsClosed() const { return probe_.escaped < kClosed; }

  PatchView ViewOf(int p) const {
    PatchView view;
    const size_t n = patches_.patches.size();
    view.sees.resize(n);
    for (size_t j = 0; j < n; ++j) {
      const Sight sight = sight_.Between(static_cast<size_t>(p), j);
      view.sees[j] = sight == Sight::kNone ? 0.0f : 1.0f;
      if (sight == Sight::kPartial || (sight == Sight::kFree && !patches_.patches[j].is_whole))
        view.partial.push_back(static_cast<int>(j));
    }
    for (const int j : unoccluded_.NearOf(p)) {
      if (view.sees[static_cast<size_t>(j)] > 0) view.near.push_back(j);
    }
    return view;
  }

  struct Report {
    int64_t rays = 0;
    double missing = 0;          // sum of 1 - row sum, before closure is enforced
    double missing_squares = 0;  // and of its square
  };

  // The rows of all elements of a patch; `rows` is the whole matrix.
  Report Fill(int p, FormFactorMatrix& rows) const {
    const Patch& patch = patches_.patches[static_cast<size_t>(p)];
    const PatchView view = ViewOf(p);
    const Eigen::Index n = rows.cols(), m = patch.element_count;
    const Eigen::Index partial = static_cast<Eigen::Index>(view.partial.size());
    Eigen::ArrayXXf factors(m, partial);
    for (Eigen::Index i = 0; i < m; ++i) {
      const Element& element = patches_.elements[static_cast<size_t>(patch.first_element + i)];
      float* const row = rows.row(patch.first_element + i).data();
      unoccluded_.Far(element, row);
      Eigen::Map<Eigen::ArrayXf>(row, n) *= Eigen::Map<const Eigen::ArrayXf>(view.sees.data(), n);
      for (const int j : view.near) row[j] = static_cast<float>(unoccluded_.Near(element, j));
      for (Eigen::Index k = 0; k < partial; ++k)
        factors(i, k) = element.is_whole ? row[view.partial[static_cast<size_t>(k)]] : 0;
    }
    const VisibleShares shares =
        ComputeVisibleShares(rays_, patches_, p, view.partial, factors, rays_per_element_);
    Report report{shares.rays, 0, 0};
    for (Eigen::Index i = 0; i < m; ++i) {
      const int e = patch.first_element + static_cast<int>(i);
      const Element& element = patches_.elements[static_cast<size_t>(e)];
      auto row = rows.row(e);
      if (!element.is_whole) {
        row.setZero();
        report.rays += buried_.Cast(element, static_cast<uint64_t>(e), row.data()).rays;
        continue;
      }
      for (Eigen::Index k = 0; k < partial; ++k)
        row[view.partial[static_cast<size_t>(k)]] *= shares.share(i, k);
      if (tallies_[static_cast<size_t>(e)].SeesNothing()) continue;
      const double missing = 1 - static_cast<double>(row.sum());
      report.missing += missing;
      report.missing_squares += missing * missing;
      if (IsClosed())
        Close(view.partial, factors.row(i), factors.row(i).square() * shares.variance.row(i), row.data());
    }
    return report;
  }

 private:
  void Probe() {
    const RayRows probes(rays_, patches_, FormFactorMethod::kMalley, kProbeRays);
    tallies_.resize(patches_.elements.size());
    tbb::parallel_for(tbb::blocked_range<size_t>(0, tallies_.size(), 256),
                      [&](const tbb::blocked_range<size_t>& range) {
                        std::vector<float> row(patches_.patches.size());
                        for (size_t e = range.begin(); e < range.end(); ++e)
                          tallies_[e] = probes.Cast(patches_.elements[e], e, row.data());
                      });
    probe_ = Summarise(tallies_);
  }

  // A closed room's row adds up to 1: what is missing belongs to the pairs in doubt, in proportion to the
  // variance of each (the correction of least weighted squares), none below 0 or above what it would be
  // unhidden. What quadrature has left is spread over the row.
  void Close(const std::vector<int>& partial, const Eigen::ArrayXf& most, const Eigen::ArrayXf& variance,
             float* row) const {
    constexpr int kRounds = 4;  // each clamps some pairs and leaves their part to the others
    Eigen::Map<Eigen::ArrayXf> all(row, static_cast<Eigen::Index>(patches_.patches.size()));
    for (int round = 0; round < kRounds; ++round) {
      const float missing = 1 - all.sum();
      float free = 0;
      const auto moves = [&](size_t k) {
        const float factor = row[partial[k]];
        return missing > 0 ? factor < most[static_cast<Eigen::Index>(k)] : factor > 0;
      };
      for (size_t k = 0; k < partial.size(); ++k)
        free += moves(k) ? variance[static_cast<Eigen::Index>(k)] : 0;
      if (free <= 0) break;
      for (size_t k = 0; k < partial.size(); ++k) {
        if (!moves(k)) continue;
        const Eigen::Index i = static_cast<Eigen::Index>(k);
        row[partial[k]] = std::clamp(row[partial[k]] + missing * variance[i] / free, 0.0f, most[i]);
      }
    }
    const float sum = all.sum();
    if (sum > 0.5f) all /= sum;
  }

  const RayScene& rays_;
  const Patches& patches_;
  int rays_per_element_;
  PatchSight sight_;
  UnoccludedFactors unoccluded_;
  RayRows buried_;
  std::vector<RayTally> tallies_;  // of the probes, by element
  RayTally probe_;
};

// `method`: kHybrid, or kAnalytic (the double contour for every pair).
FormFactors PairFormFactors(const RayScene& rays, const Patches& patches, FormFactorMethod method,
                            int rays_per_element) {
  const PairRows rows(rays, patches, method == FormFactorMethod::kAnalytic, rays_per_element);
  FormFactors result;
  result.method = method;
  result.element_to_patch.resize(static_cast<Eigen::Index>(patches.elements.size()),
                                 static_cast<Eigen::Index>(patches.patches.size()));
  std::vector<PairRows::Report> reports(patches.patches.size());
  tbb::parallel_for(size_t{0}, patches.patches.size(),
                    [&](size_t p) { reports[p] = rows.Fill(static_cast<int>(p), result.element_to_patch); });
  const RayTally& probe = rows.probe();
  double missing = 0, squares = 0;
  const double n = std::max<double>(1, static_cast<double>(patches.elements.size()));
  result.rays = probe.rays;
  for (const PairRows::Report& report : reports) {
    missing += report.missing / n;
    squares += report.missing_squares / n;
    result.rays += report.rays;
  }
  result.back_fraction = probe.back;
  result.escaped_fraction = rows.IsClosed() ? probe.escaped : missing;
  result.closure_error = rows.IsClosed() ? std::sqrt(squares) : 0;
  return result;
}

FormFactors HybridFormFactors(const RayScene& rays, const Patches& patches, int rays_per_element) {
  if (patches.facets.size() <= kMaxFacetsForHybrid)
    return PairFormFactors(rays, patches, FormFactorMethod::kHybrid, rays_per_element);
  FormFactors result = RayFormFactors(rays, patches, FormFactorMethod::kMalley, rays_per_element);
  result.because =
      "hybrid compares facets pair by pair, and there are more than " + std::to_string(kMaxFacetsForHybrid);
  return result;
}

FormFactors AnalyticFormFactors(const RayScene& rays, const Patches& patches, int rays_per_element) {
  return PairFormFactors(rays, patches, FormFactorMethod::kAnalytic, rays_per_element);
}

}  // namespace

FormFactorOps HybridMethod() {
  FormFactorOps ops;
  ops.method = FormFactorMethod::kHybrid;
  ops.name = "hybrid";
  ops.by_pairs = HybridFormFactors;
  return ops;
}

FormFactorOps AnalyticMethod() {
  FormFactorOps ops;
  ops.method = FormFactorMethod::kAnalytic;
  ops.name = "analytic";
  ops.by_pairs = AnalyticFormFactors;
  return ops;
}

}  // namespace luxfit
