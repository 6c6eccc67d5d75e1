#include "inverse/furniture/furniture.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "inverse/furniture/internal/faces/face.h"
#include "inverse/furniture/internal/faces/refine_face.h"
#include "inverse/furniture/internal/faces/solid_box.h"
#include "inverse/furniture/internal/mesh_agreement.h"
#include "inverse/furniture/internal/view_rays.h"

namespace luxfit {
namespace {

constexpr double kSweptCellM = 0.08, kSweptStepM = 0.02;
// Tolerance of the sweep over that of the refinement: its planes miss a face by up to 1 cm.
constexpr double kCoarse = 2;
// Tolerance of the second sweep over that of the first: varnish mirrors 2 % of what lights it. One luminance agrees by chance so well.
constexpr double kShiny = 5. / 3;
constexpr int kFewestStatesOfShiny = 2;

// Finds one box after the other. It is a class because votes shrink as boxes explain views.
class FurnitureFinder {
 public:
  FurnitureFinder(const Scene& scene, const std::vector<SignatureView>& views,
                  const FurnitureOptions& options)
      : scene_(scene),
        views_(views),
        options_(options),
        axes_(AxesOf(scene)),
        mesh_(scene),
        agreement_(FindMeshAgreement(mesh_, views, options.tolerance)),
        swept_{views, agreement_, EyesOf(views), kCoarse * options.tolerance, 3},
        refined_{views, agreement_, EyesOf(views), options.tolerance, 2},
        rays_(ViewRays(views, agreement_, axes_.world_from_axes.transpose())),
        free_places_(AlongAxes(options.free_places, axes_)) {}

  std::vector<FoundBox> Run() {
    MakePlanes();
    FindAll();
    if (views_.front().states >= kFewestStatesOfShiny) {
      Loosen();
      FindAll();
    }
    return std::move(found_);
  }

 private:
  struct Swept {
    Facing facing;
    Eigen::AlignedBox3d region;  // flat
    SweptPlane plane;
    PlaneVotes votes;
  };

  void MakePlanes() {
    for (const Facing& facing : kFacings) {
      Eigen::AlignedBox3d region = axes_.bounds;
      const double high = region.max()[facing.axis] - kOnMeshM;
      for (double offset = region.min()[facing.axis] + kOnMeshM; offset < high; offset += kSweptStepM) {
        region.min()[facing.axis] = region.max()[facing.axis] = offset;
        planes_.push_back({facing, region, PlaneOf(axes_, facing, region, kSweptCellM), {}});
      }
    }
  }

  void Loosen() {
    swept_.tolerance *= kShiny;
    refined_.tolerance *= kShiny;
    agreement_ = FindMeshAgreement(mesh_, views_, refined_.tolerance);
  }

  // Takes one face after the other, the strongest first.
  void FindAll() {
    tbb::parallel_for(size_t{0}, planes_.size(),
                      [&](size_t i) { planes_[i].votes = Sweep(swept_, planes_[i].plane); });
    while (static_cast<int>(found_.size()) < options_.most_boxes) {
      const std::optional<Face> face = Strongest();
      if (!face) break;
      const std::optional<Face> fine = RefineFace(refined_, axes_, *face, options_.least_face_m2);
      std::optional<SolidBox> solid;
      if (fine) solid = SolidBehind(*fine, axes_, mesh_, refined_, rays_, free_places_);
      if (solid) {
        Add(solid->box);
        found_.push_back(FoundOf(*fine, *solid));
      }
      Forget(*face);
    }
  }

  std::optional<Face> Strongest() const {
    const auto least = static_cast<int>(std::ceil(options_.least_face_m2 / (kSweptCellM * kSweptCellM)));
    std::vector<VoteRectangle> best(planes_.size());
    tbb::parallel_for(size_t{0}, planes_.size(), [&](size_t i) {
      const VoteGrid& votes = planes_[i].votes.votes;
      if ((votes > 0).count() >= least) best[i] = FindLargestRectangle(votes);
    });
    const auto largest = std::max_element(best.begin(), best.end(),
                                          [](const auto& a, const auto& b) { return a.sum < b.sum; });
    if (largest == best.end() || largest->sum < least) return std::nullopt;
    const Swept& at = planes_[static_cast<size_t>(largest - best.begin())];
    Face face;
    face.facing = at.facing;
    face.region = RegionOf(at.facing, at.region, kSweptCellM, *largest);
    return face;
  }

  // Adds a box to the mesh: what it explains of the views takes no part in later faces.
  void Add(const Eigen::AlignedBox3d& box) {
    boxes_.push_back(RoomBoxOf(box, static_cast<int>(boxes_.size()) + 1));
    mesh_ = RayScene(WithBoxes(scene_, boxes_));
    agreement_ = FindMeshAgreement(mesh_, views_, refined_.tolerance);
    tbb::parallel_for(size_t{0}, planes_.size(),
                      [&](size_t i) { SweepAgain(swept_, planes_[i].plane, planes_[i].votes); });
  }

  // Leaves a face out of what is still sought, with what is near it.
  void Forget(const Face& face) {
    Eigen::AlignedBox3d near = face.region;
    near.min()[face.facing.axis] -= kRefinedDepthM;
    near.max()[face.facing.axis] += kRefinedDepthM;
    for (Swept& swept : planes_) {
      if (!(swept.facing == face.facing) || !near.intersects(swept.region)) continue;
      for (int row = 0; row < swept.plane.rows; ++row) {
        for (int column = 0; column < swept.plane.columns; ++column) {
          signed char& vote = swept.votes.votes(row, column);
          if (vote > 0 &&
              near.contains(axes_.world_from_axes.transpose() * swept.plane.CenterOf(row, column)))
            vote = 0;
        }
      }
    }
  }

  RoomBox RoomBoxOf(const Eigen::AlignedBox3d& box, int number) const {
    const Eigen::Vector3d center = axes_.world_from_axes * box.center(), half = 0.5 * box.sizes();
    return {fmt::format("found {}", number), center - half, center + half, axes_.turn_rad};
  }

  FoundBox FoundOf(const Face& face, const SolidBox& solid) const {
    FoundBox found;
    found.box = boxes_.back();
    found.face_area_m2 = face.area_m2;
    found.views = __builtin_popcountll(face.views);
    found.sigma_m = face.sigma_m;
    found.is_upright = face.facing.axis != 2;
    found.is_thin = solid.is_thin;
    return found;
  }

  const Scene& scene_;
  const std::vector<SignatureView>& views_;
  const FurnitureOptions& options_;
  RoomAxes axes_;
  RayScene mesh_;  // with the boxes found so far
  std::vector<RoomBox> boxes_;
  std::vector<MeshAgreement> agreement_;
  SweptViews swept_, refined_;
  std::vector<ViewRay> rays_;                 // along the axes, of the mesh without boxes
  std::vector<Eigen::Vector3d> free_places_;  // along the axes
  std::vector<Swept> planes_;
  std::vector<FoundBox> found_;
};

}  // namespace

std::vector<FoundBox> FindFurniture(const Scene& scene, const std::vector<SignatureView>& views,
                                    const FurnitureOptions& options) {
  constexpr size_t kFewestViews = 3;
  if (views.size() < kFewestViews || scene.facets.empty()) return {};
  return FurnitureFinder(scene, views, options).Run();
}

}  // namespace luxfit
