#include <cmath>
#include <random>

#include "tests/validation/catalogue/catalogue_case.h"
#include "tests/validation/catalogue/session_edits.h"

namespace luxfit {
namespace {

using support::OfficeCopy;

constexpr char kGroup[] = "geometry";

void Shift(const OfficeCopy& office, const Eigen::Vector3d& by_m) {
  office.MapMesh([&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return p + by_m; });
}

void Turn(const OfficeCopy& office, double deg) {
  const double a = deg * M_PI / 180;
  office.MapMesh([&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    const Eigen::Vector3d d = p - Eigen::Vector3d(3, 2, 0);
    return {3 + std::cos(a) * d.x() - std::sin(a) * d.y(), 2 + std::sin(a) * d.x() + std::cos(a) * d.y(),
            p.z()};
  });
}

void Scale(const OfficeCopy& office, double factor) {
  office.MapMesh([&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return factor * p; });
}

}  // namespace

std::vector<CatalogueCase> GeometryCases() {
  return {
      {kGroup,
       "a wall missing",
       Required::kNamed,
       {"open_mesh"},
       [](const OfficeCopy& office) { LeaveOutGroups(office, "room_+x"); }},
      {kGroup,
       "a wall 5 cm off",
       Required::kNamed,
       {"wall_moved"},
       [](const OfficeCopy& office) {
         office.MapMesh([](Eigen::Vector3d p) {
           if (p.x() == 6) p.x() = 6.05;
           return p;
         });
       }},
      {kGroup,
       "a desk missing",
       Required::kNamed,
       {"furniture_found", "unmodelled_surface"},
       [](const OfficeCopy& office) { LeaveOutGroups(office, "desk1"); }},
      {kGroup,
       "all furniture missing",
       Required::kNamed,
       {"furniture_found", "unmodelled_surface"},
       [](const OfficeCopy& office) {
         LeaveOutGroups(office, "desk");
         LeaveOutGroups(office, "cabinet");
       }},
      {kGroup,
       "a desk that the room lacks",
       Required::kNamed,
       {"furniture_moved", "unmodelled_surface"},
       [](const OfficeCopy& office) {
         office.Write("office/room.obj",
                      office.Read("office/room.obj") +
                          "g extra\nusemtl desk\nv 4.4 0.2 0.7\nv 5.6 0.2 0.7\nv 5.6 1.0 0.7\nv 4.4 1.0 0.7\n"
                          "v 4.4 0.2 0.74\nv 5.6 0.2 0.74\nv 5.6 1.0 0.74\nv 4.4 1.0 0.74\n"
                          "f -4 -3 -2 -1\nf -8 -5 -6 -7\nf -8 -7 -3 -4\nf -7 -6 -2 -3\nf -6 -5 -1 -2\n"
                          "f -5 -8 -4 -1\n");
       }},
      {kGroup,
       "mesh mirrored in x",
       Required::kNamed,
       {"mesh_as_if"},
       [](const OfficeCopy& office) {
         office.MapMesh(
             [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
               return {6 - p.x(), p.y(), p.z()};
             },
             true);
       }},
      {kGroup,
       "mesh 0.1 m off",
       Required::kNamed,
       {"mesh_as_if"},
       [](const OfficeCopy& office) {
         Shift(office, {0.1, 0, 0});
       }},
      {kGroup,
       "mesh 1 degree askew",
       Required::kNamed,
       {"mesh_as_if"},
       [](const OfficeCopy& office) { Turn(office, 1); }},
      {kGroup,
       "mesh in mm, said to be m",
       Required::kRefused,
       {"mm"},
       [](const OfficeCopy& office) { Scale(office, 1000); }},
      {kGroup,
       "mesh in feet, said to be m",
       Required::kRefused,
       {"ft"},
       [](const OfficeCopy& office) { Scale(office, 1 / 0.3048); }},
      {kGroup,
       "mesh with y up",
       Required::kRefused,
       {"z up"},
       [](const OfficeCopy& office) {
         office.MapMesh([](const Eigen::Vector3d& p) -> Eigen::Vector3d { return {p.x(), p.z(), -p.y()}; });
       }},
      {kGroup,
       "all facets flipped",
       Required::kRefused,
       {"turn them round"},
       [](const OfficeCopy& office) { office.MapMesh([](const Eigen::Vector3d& p) { return p; }, true); }},
      {kGroup,
       "vertices off by 5 mm",
       Required::kSolved,
       {},
       [](const OfficeCopy& office) {
         std::mt19937 rng(1);
         std::normal_distribution<double> noise(0, 0.005);
         office.MapMesh([&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
           return p + Eigen::Vector3d(noise(rng), noise(rng), noise(rng));
         });
       }},
      {kGroup,
       "one material for everything",
       Required::kSolved,
       {},
       [](const OfficeCopy& office) {
         std::string mesh = office.Read("office/room.obj");
         for (size_t at = mesh.find("usemtl"); at != std::string::npos; at = mesh.find("usemtl", at + 1))
           mesh.replace(at, mesh.find('\n', at) - at, "usemtl wall");
         office.Write("office/room.obj", mesh);
       }},
  };
}

}  // namespace luxfit
