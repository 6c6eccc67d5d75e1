// Gives the surfaces of fixtures/office a carpet, posters and wood: a factor on the luminance of each place.
//
//   L'(p) = f(p) L(p),   mean of f over what the views see of a material = 1
//
// - floor: carpet tiles of 0.25 m, each of its own reflectance (sigma 20 %), with stripes of +-10 %;
// - wall and wall_accent: posters of 0.4 to 1.2 m that cover half of each wall. About a quarter of them have
//   factors of 0.3 to 0.9, the others of 1.05 to 1.25, so that no reflectance exceeds 0.95;
// - tops of desks and cabinet: boards of 0.12 m of +-10 %, with a grain of +-5 %;
// - all else, and places within 1.5 sizes of a tag's centre: 1.
// A constant factor for each material makes the mean 1, so that the true reflectances stay those of truth.json. What
// no view sees (the wall behind the cabinet) moves the mean by area by less than 1 %.
//
// The light that reaches a surface stays that of the plain room. In a real room it would change too, by the
// textures' contrast at the scale of the room; the mean reflectances, and so most of that light, are the same.
//
// Metres. Facets are those of room.obj. The pattern is the same on every machine. Source: own.
#ifndef LUXFIT_TESTS_VALIDATION_OFFICE_TEXTURE_H_
#define LUXFIT_TESTS_VALIDATION_OFFICE_TEXTURE_H_

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/targets/tags.h"
#include "forward/room/scene.h"
#include "forward/room/visibility.h"

namespace luxfit {

class OfficeTexture {
 public:
  // Reads room.obj, cam0.yaml, tags.json and truth.json of the folder. Throws as their readers do.
  explicit OfficeTexture(const std::filesystem::path& office);

  // Returns the mean factor in each pixel of the view's photos: height x width, float. Rays start at the true
  // pose. Throws std::out_of_range for a view that truth.json does not name.
  cv::Mat FactorsIn(const std::string& view) const;

  // Prints the mean factor of each material: by area, and of the part that at least one view sees.
  void PrintMeans() const;

 private:
  struct View {
    Eigen::Vector3d eye;
    Eigen::Matrix3d world_from_cam;
  };
  using Pattern = std::function<double(const Eigen::Vector2d& p_m)>;  // by place along the facet's edges
  using Visit = std::function<void(int facet, double u, double v, double area_m2)>;

  void DrawPatterns();
  void MakeMeansOne();
  // Visits the middle of every cell of the mesh, without those inside a solid.
  void VisitSurface(const Visit& visit) const;
  bool IsInsideSolid(int facet, const Eigen::Vector3d& p) const;
  bool IsNearTag(const Eigen::Vector3d& p) const;
  bool IsSeen(int facet, const Eigen::Vector3d& p) const;
  bool IsTextured(int facet, double u, double v) const;
  double FactorAt(int facet, double u, double v) const;

  const Facet& FacetOf(int facet) const { return scene_.facets[static_cast<size_t>(facet)]; }
  double PatternAt(int facet, double u, double v) const;

  Scene scene_;
  RayScene rays_;
  Camera camera_;
  std::vector<SurveyedTag> tags_;
  std::map<std::string, View> views_;
  std::vector<Pattern> patterns_;  // by facet; empty: plain
  Eigen::VectorXd scale_;          // by material
};

}  // namespace luxfit

#endif  // LUXFIT_TESTS_VALIDATION_OFFICE_TEXTURE_H_
